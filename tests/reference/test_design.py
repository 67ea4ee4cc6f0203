"""How people were asked is read off their answers, and compared with the definition where it says."""

from pathlib import Path

import pytest

from leaderboard.reference.checking import Row, check_reference
from leaderboard.reference.checking.design import find_trial_sets
from reference_folders import DEFINITION, ReferenceFolder, Rows, trial_name

RESPONSES, RATINGS = "human_responses.csv", "human_trials.csv"
SCENARIOS = ("alpha_one", "alpha_two")


def study(*sittings: tuple[int, int], design: str = "") -> ReferenceFolder:
    """Let people judge trials of Alpha: each is told by the copies of the first pair of both scenarios."""
    folder = ReferenceFolder(definition=f"{DEFINITION}\n[people]\n{design}\n" if design else DEFINITION)
    rows: Rows = []
    for number, copies in enumerate(sittings, 1):
        for scenario, own in zip(SCENARIOS, copies, strict=True):
            rows.append([f"p{number}", trial_name(scenario, own, 0), "1"])
    counts: dict[str, int] = {}
    for _, trial_id, _ in rows:
        counts[trial_id] = counts.get(trial_id, 0) + 1
    folder.rows[RESPONSES] = rows
    folder.rows[RATINGS] = [[trial_id, str(n), str(n)] for trial_id, n in counts.items()]
    return folder


def design_of(folder: ReferenceFolder, root: Path) -> dict[str, Row]:
    datasheet = check_reference(folder.write(root)).datasheet
    assert datasheet is not None
    (section,) = [section for section in datasheet.sections if section.title == "Design"]
    return {row.assumption: row for row in section.rows}


ZERO, ONE, MIXED = ((0, 0), (1, 1), (0, 1))


def test_what_is_not_stated_is_only_told(tmp_path: Path) -> None:
    """Without a design in the definition there is nothing to depart from."""
    rows = design_of(study(ZERO, ZERO, ONE), tmp_path)
    assert {name: (row.expected, row.found, row.code) for name, row in rows.items()} == {
        "People of Alpha": ("", "3", ""),
        "Trials per person of Alpha": ("", "2", ""),
        "Sets of trials of Alpha": (
            "",
            "2, disjoint; trials in each: 2; people for each: 1 to 2, median 1.5",
            "",
        ),
        "People of Beta": ("", "0", ""),
        "Who saw both trials of a pair": ("nobody", "nobody", ""),
        "People who judged several properties": ("", "0", ""),
    }


def test_overlapping_sets_are_told(tmp_path: Path) -> None:
    """Two sets may share trials."""
    row = design_of(study(ZERO, MIXED), tmp_path)["Sets of trials of Alpha"]
    assert row.found == "2, overlapping (trials in several: 1); trials in each: 2; people for each: 1"


@pytest.mark.parametrize(
    ("design", "sittings", "code", "message"),
    [
        (
            "per_property = 4",
            (ZERO, ONE),
            "reference-people-count",
            "2 people judged trials of Alpha, not the 4 expected",
        ),
        (
            "trials_per_person = 3",
            (ZERO, ONE),
            "reference-trials-per-person",
            (
                "2 of the 2 people of Alpha judged another number of trials than the 3 expected, "
                "for instance p1: 2"
            ),
        ),
        (
            "sets = 8",
            (ZERO, ONE),
            "reference-sets",
            "the people of Alpha saw 2 different sets of trials, not the 8 expected",
        ),
        (
            "sets = 2",
            (ZERO, MIXED),
            "reference-sets",
            "the sets of trials of Alpha overlap (trials in several: 1)",
        ),
    ],
)
def test_each_departure_from_the_design_is_a_note(
    tmp_path: Path, design: str, sittings: tuple[tuple[int, int], ...], code: str, message: str
) -> None:
    """The counts stated and found are named, and the check does not fail for them."""
    verdict = check_reference(study(*sittings, design=design).write(tmp_path))
    found = [(p.code, p.message) for p in verdict.problems if "Alpha" in p.message and p.code == code]
    assert found == [(code, message)]
    assert verdict.is_sound


def test_the_design_stated_is_confirmed(tmp_path: Path) -> None:
    """Numbers that are met are no findings."""
    design = "per_property = 2\ntrials_per_person = 2\nsets = 2"
    rows = design_of(study(ZERO, ONE, design=design), tmp_path)
    stated = {name: (row.expected, row.status) for name, row in rows.items() if name.endswith("Alpha")}
    assert stated == {
        "People of Alpha": ("2", "ok"),
        "Trials per person of Alpha": ("2", "ok"),
        "Sets of trials of Alpha": ("2 disjoint", "ok"),
    }


def test_people_of_several_properties_are_counted(tmp_path: Path) -> None:
    """In the sound example both people judged both properties."""
    assert design_of(ReferenceFolder(), tmp_path)["People who judged several properties"].found == "2"


def test_sets_are_told_apart_by_their_trials() -> None:
    """The same trials are one set, whoever saw them."""
    sets = find_trial_sets({"p1": frozenset("ab"), "p2": frozenset("ab"), "p3": frozenset("bc")})
    assert (len(sets), sets.n_trials, sets.n_people, sets.n_shared) == (2, (2, 2), (2, 1), 1)
