"""Auditing: each flag on a number that has exactly that defect, and all of them on the paper's tables."""

import csv
from collections import Counter
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from leaderboard.auditing import FLAGS, AuditedNumber, audit
from leaderboard.models.published import PublishedNumber
from leaderboard.reference.published import read_published
from tools.write_published import render_published

PAPER = "Tung et al. (2023), NeurIPS Datasets and Benchmarks"


def number(printed: str, **changes: Any) -> PublishedNumber:
    """An accuracy on 192 trials of Mass, unless told otherwise."""
    usual: dict[str, Any] = {
        "source": "A paper",
        "system": "A",
        "scope": "Mass",
        "metric": "accuracy",
        "n": 192,
    }
    return PublishedNumber(**(usual | changes), printed=printed)


def table(overall: str, *parts: str, **changes: Any) -> list[PublishedNumber]:
    """Parts with 192 trials each, and their overall."""
    rows = [number(printed, scope=f"part {i}", **changes) for i, printed in enumerate(parts)]
    return [*rows, number(overall, scope="overall", **{"n": 192 * len(parts)} | changes)]


def flags_of(*numbers: PublishedNumber) -> list[tuple[str, ...]]:
    return [audited.flags for audited in audit(numbers)]


class TestCounts:
    """Whether k of n can be right."""

    @pytest.mark.parametrize(
        ("printed", "flags"),
        [("67.2", ()), ("67.1", ("truncated",)), ("75.9", ("impossible",)), ("129/192", ())],
    )
    def test_a_figure_that_no_count_gives_is_flagged(self, printed: str, flags: tuple[str, ...]) -> None:
        """Rounded, only cut off, or not at all."""
        assert flags_of(number(printed)) == [flags]

    def test_the_counts_are_named(self) -> None:
        """Those that give the figure, or the two on either side of it."""
        found = [audited.rights for audited in audit([number("67.1"), number("75.9"), number("60", n=1000)])]
        assert [(rights.fit, list(rights.counts)) for rights in found if rights] == [
            ("truncated", [129]),
            ("impossible", [145, 146]),
            ("rounded", list(range(595, 606))),
        ]

    def test_without_n_nothing_is_counted(self) -> None:
        """It is said, and not guessed."""
        (audited,) = audit([number("75.9", n=None)])
        assert (audited.rights, audited.flags) == (None, ("n-unknown",))

    def test_a_share_brings_its_own_n(self) -> None:
        """229/384 needs no other column."""
        (audited,) = audit([number("198/384", n=None)])
        assert audited.rights
        assert (list(audited.rights.counts), audited.flags) == ([198], ("not-above-chance",))

    def test_a_correlation_is_no_count(self) -> None:
        """Only accuracies are held against k/n and chance."""
        (audited,) = audit([number("0.12", metric="human_r")])
        assert (audited.rights, audited.flags) == (None, ())


class TestChance:
    """Whether the figure differs from coin flips."""

    @pytest.mark.parametrize(
        ("printed", "is_flagged"),
        [("57.3", True), ("57.8", False), ("50.0", True), ("25.0", True), ("100", False)],
    )
    def test_half_right_within_chance_or_below_is_flagged(self, printed: str, *, is_flagged: bool) -> None:
        """110 of 192 has p 0.051, 111 has 0.036; a figure far below one half is not above it."""
        assert flags_of(number(printed)) == [("not-above-chance",) if is_flagged else ()]

    def test_the_benefit_of_rounding_goes_to_chance(self) -> None:
        """Of all counts that give the figure, the one nearest to one half is tested; intervals hold all."""
        (audited,) = audit([number("56", n=300)])  # 167 to 169
        assert audited.rights
        assert list(audited.rights.counts) == [167, 168, 169]
        assert audited.rights.p == pytest.approx(0.05657, abs=1e-5)
        assert audited.rights.interval == pytest.approx((0.50009, 0.61831), abs=1e-5)


class TestMean:
    """Whether an overall is the mean of its parts."""

    def test_an_overall_beside_the_mean_is_flagged(self) -> None:
        """The mean is given exactly."""
        *_, overall = audit(table("56.0", "60.4", "54.2", "54.2", "69.8"))
        assert (overall.flags, overall.mean, overall.n_parts) == (("not-the-mean",), Fraction(5965, 10000), 4)

    def test_an_overall_with_parts_may_be_a_mean_of_rounded_figures(self) -> None:
        """55.4 is no k of 768 but the mean of 56.3, 52.6, 55.2 and 57.3, rounded: no flag."""
        parts = ("56.3", "52.6", "55.2", "57.3")
        assert flags_of(*table("55.4", *parts))[-1] == ()
        assert flags_of(number("55.4", scope="overall", n=768)) == [("truncated",)]

    @pytest.mark.parametrize(
        "field",
        [
            {"source": "Another paper"},
            {"system": "B"},
            {"training": "unified"},
            {"testing": "fully_observed"},
            {"training_trials": 500},
            {"auxiliary": "explicit"},
        ],
    )
    def test_parts_belong_to_one_source_system_and_protocol(self, field: dict[str, Any]) -> None:
        """What differs in one of these is no part."""
        overall = number("90.0", scope="overall", n=384)
        assert audit([*table("60.4", "60.4", "60.4", **field), overall])[-1].n_parts == 0

    def test_scopes_that_do_not_add_up_are_no_parts(self) -> None:
        """Two properties of four, or properties beside their scenarios, say nothing about the overall."""
        *_, overall = audit(table("70.3", "60.4", "60.4", n=192))
        assert (overall.n_parts, overall.mean) == (0, None)

    def test_without_trial_counts_scopes_are_taken_for_the_parts(self) -> None:
        """Where n is unknown, all other scopes together are the overall."""
        assert flags_of(*table("70.3", "60.4", "60.4", n=None))[-1] == ("not-the-mean", "n-unknown")

    def test_other_metrics_have_means_too(self) -> None:
        """An overall correlation is the mean of its parts as well."""
        assert flags_of(*table("0.30", "0.10", "0.20", metric="human_r"))[-1] == ("not-the-mean",)


def test_two_figures_for_one_number_contradict_each_other() -> None:
    """Both are flagged unless they differ in precision only, and no mean is taken of them."""
    assert flags_of(number("67.2"), number("68.2")) == [("contradicted",)] * 2
    assert flags_of(number("67.2"), number("67"), number("67.2")) == [()] * 3
    *_, overall = audit([*table("60.4", "60.4", "60.4"), number("68.2", scope="part 0")][::-1])
    assert overall.flags == ("contradicted",)


def test_flags_are_stable_words() -> None:
    """Other programs may rely on them, so they are written down here too."""
    assert list(FLAGS) == [
        "impossible",
        "truncated",
        "not-the-mean",
        "contradicted",
        "not-above-chance",
        "n-unknown",
    ]


@pytest.fixture(scope="module")
def committed(repo_root: Path) -> tuple[AuditedNumber, ...]:
    """Audit the numbers that are committed in reference/."""
    return audit(read_published(repo_root / "reference/published.csv"))


class TestThePaper:
    """What the audit finds in the paper's tables."""

    def test_all_numbers_are_there(self, committed: tuple[AuditedNumber, ...]) -> None:
        """Three tables, the people's figures and the model nearest to them, and a later paper's two."""
        notes = Counter(each.number.note.partition(",")[0] for each in committed)
        tables = {"Table 2": 140, "Table 3": 16, "Table in the appendix": 8}
        assert {name: notes[name] for name in tables} == tables
        others = [each.number for each in committed if "Table" not in each.number.note]
        assert [(each.system, each.metric, each.printed, each.n) for each in others] == [
            ("People", "accuracy", "60%", None),
            ("People", "split_half_r", "0.37", None),
            ("SlotFormer", "human_r", "0.12", None),
            ("PhysMind", "accuracy", "229/384", 384),
            ("Gemini-3-Flash, chain of thought", "accuracy", "198/384", 384),
        ]
        assert all("five scenarios" in each.note for each in others if each.n == 384)

    def test_thirteen_property_cells_are_no_rounded_count(self, committed: tuple[AuditedNumber, ...]) -> None:
        """Twelve are impossible, ten of them DPI-Net's; 67.1 is 129/192 cut off."""
        cells = [each for each in committed if each.number.n == 192]
        assert len(cells) == 112
        impossible = [each.number for each in cells if "impossible" in each.flags]
        assert len(impossible) == 12
        assert sum(each.system == "DPI-Net" for each in impossible) == 10
        assert {(e.system, e.printed) for e in impossible if e.system != "DPI-Net"} == {
            ("ResNet-mlp", "48.0"),
            ("DeiT-mlp", "55.0"),
        }
        truncated = [each for each in cells if "truncated" in each.flags]
        assert [(e.number.printed, e.rights and list(e.rights.counts)) for e in truncated] == [
            ("67.1", [129])
        ]

    def test_one_overall_is_not_the_mean_of_its_parts(self, committed: tuple[AuditedNumber, ...]) -> None:
        """VGG-mlp, fully observed: 56.0 is printed, the parts give 59.65; the other 27 agree."""
        assert sum(each.n_parts == 4 for each in committed if each.number.note == "Table 2") == 28
        (found,) = (each for each in committed if "not-the-mean" in each.flags)
        shown = (found.number.system, found.number.testing, found.number.printed, found.mean)
        assert shown == ("VGG-mlp", "fully_observed", "56.0", Fraction(5965, 10000))

    def test_tables_do_not_contradict_each_other(self, committed: tuple[AuditedNumber, ...]) -> None:
        """What the ablations repeat is what the first table has."""
        assert not any("contradicted" in each.flags for each in committed)

    def test_no_property_of_a_video_model_trained_on_all_differs_from_chance_but_one(
        self, committed: tuple[AuditedNumber, ...]
    ) -> None:
        """MCVD on Deformability, 113 of 192."""
        cells = [each for each in committed if each.number.training == "unified" and each.number.n == 192]
        above = [each.number for each in cells if "not-above-chance" not in each.flags]
        assert [(each.system, each.scope, each.printed) for each in above] == [
            ("MCVD", "Deformability", "58.9")
        ]

    @pytest.mark.shared
    def test_every_cell_is_the_papers(self, committed: tuple[AuditedNumber, ...], shared_dir: Path) -> None:
        """112 property cells, 28 overall and 24 ablation cells agree with the tables, protocol and all."""
        with (shared_dir / "paper/tables.csv").open(encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream))
        protocol = ("system", "training", "testing", "training_trials", "auxiliary")
        expected = Counter(
            (
                *(row[name] for name in protocol),
                row["property"].replace("Overall", "overall"),
                row["printed_percent"],
            )
            for row in rows
        )
        found = [each.number for each in committed if "Table" in each.number.note]
        shown = Counter(
            (*(str(getattr(each, name)) for name in protocol), each.scope, each.printed) for each in found
        )
        assert shown == expected
        assert Counter(row["table"] == "results" for row in rows) == {True: 112 + 28, False: 24}
        assert {each.n for each in found if each.scope == "overall"} == {768}
        assert {each.n for each in found if each.scope != "overall"} == {192}
        assert {each.source for each in found} == {PAPER}

    @pytest.mark.shared
    def test_the_file_is_what_the_script_writes(self, repo_root: Path, shared_dir: Path) -> None:
        """tools/write_published.py makes the committed file, byte for byte."""
        made = render_published(shared_dir / "paper/tables.csv")
        assert (repo_root / "reference/published.csv").read_text(encoding="utf-8") == made
