"""Errata accept findings and drop trials, with reasons; entries without effect are findings themselves."""

from pathlib import Path

import pytest

from leaderboard.reference.checking import Status, Verdict, check_reference
from reference_folders import ReferenceFolder, pair_name, trial_name

TRIALS = "Alpha.csv"
PAIR = pair_name("alpha_one", 0)
TRIAL = trial_name("alpha_one", 0, 0)
REASON = "Kept as released."


def accept(code: str, where: str = "") -> str:
    line = f'where = "{where}"\n' if where else ""
    return f'[[accept]]\ncode = "{code}"\n{line}reason = "{REASON}"\n'


def drop(trial_id: str) -> str:
    return f'[[drop]]\ntrial_id = "{trial_id}"\nreason = "The video is empty."\n'


def equal_labels() -> ReferenceFolder:
    """Two pairs of alpha_one that end in YES and in NO; YES and NO stay as frequent."""
    folder = ReferenceFolder()
    folder.rows[TRIALS][0][4] = "1"
    folder.rows[TRIALS][2][4] = "0"
    return folder


def check(folder: ReferenceFolder, root: Path, errata: str) -> Verdict:
    folder.raw["errata.toml"] = errata.encode()
    return check_reference(folder.write(root))


def statuses(verdict: Verdict) -> dict[str, Status]:
    assert verdict.datasheet is not None
    return {row.assumption: row.status for section in verdict.datasheet.sections for row in section.rows}


def test_an_accepted_finding_fails_no_check(tmp_path: Path) -> None:
    """It stays visible with its reason, and its assumption is accepted."""
    verdict = check(equal_labels(), tmp_path, accept("reference-equal-labels"))
    assert verdict.problems == ()
    assert verdict.is_sound
    assert [(finding.problem.line, finding.reason) for finding in verdict.accepted] == [
        (3, REASON),
        (5, REASON),
    ]
    assert statuses(verdict)["Both trials end differently"] is Status.ACCEPTED


def test_an_acceptance_may_name_what_it_is_about(tmp_path: Path) -> None:
    """Findings that do not hold its words are left, and the assumption departs."""
    verdict = check(equal_labels(), tmp_path, accept("reference-equal-labels", PAIR))
    assert [(problem.code, problem.line) for problem in verdict.problems] == [("reference-equal-labels", 5)]
    assert [finding.problem.line for finding in verdict.accepted] == [3]
    assert not verdict.is_sound
    assert statuses(verdict)["Both trials end differently"] is Status.DEPARTS


def test_notes_can_be_accepted(tmp_path: Path) -> None:
    """What informs may be explained as well."""
    folder = ReferenceFolder()
    for name in ("human_trials.csv", "human_responses.csv"):
        del folder.rows[name][2:4]
    verdict = check(folder, tmp_path, accept("reference-unrated"))
    assert [finding.problem.message for finding in verdict.accepted] == [
        "nobody judged 2 of the 8 trials of Alpha"
    ]


@pytest.mark.parametrize(
    ("errata", "code", "message"),
    [
        (
            accept("reference-equal-labels"),
            "reference-errata-unused",
            "accepts reference-equal-labels, but there is no such finding",
        ),
        (
            accept("reference-copies", "alpha"),
            "reference-errata-unused",
            "accepts reference-copies, but there is no such finding with the words 'alpha'",
        ),
        (
            accept("reference-seal"),
            "reference-errata-unused",
            "accepts reference-seal, but an error cannot be accepted",
        ),
        (
            accept("equal labels"),
            "reference-errata-unused",
            "accepts 'equal labels', which is no code of a finding",
        ),
        (
            drop("alpha_one/0000"),
            "reference-errata-trial",
            "no trial list has 'alpha_one/0000', which is to be dropped",
        ),
    ],
)
def test_entries_without_effect_are_found(tmp_path: Path, errata: str, code: str, message: str) -> None:
    """An erratum that nothing fits is a mistake, or has had its day."""
    verdict = check(ReferenceFolder(), tmp_path, errata)
    assert [(p.code, p.message, p.file) for p in verdict.problems] == [
        (code, message, "reference/errata.toml")
    ]
    assert not verdict.is_sound


def test_dropping_a_trial_breaks_no_assumption(tmp_path: Path) -> None:
    """It counts as listed and as judged, and its partner is no incomplete pair; YES is rarer now."""
    verdict = check(ReferenceFolder(), tmp_path, drop(TRIAL))
    assert [problem.message for problem in verdict.problems] == [
        "4 of 7 trials of Alpha end in YES, not half of them",
        "2 of 3 trials of alpha_one end in YES, not half of them",
    ]
    assert verdict.datasheet is not None
    found = {row.assumption: row.found for section in verdict.datasheet.sections for row in section.rows}
    assert found["Trials of Alpha"] == "8, 1 of them dropped"
    assert found["A pair has two trials"] == "6 of 6 pairs, 1 of them less a dropped trial"
    assert found["Trials per person of Alpha"] == "4"
    assert found["Trials to drop are there"] == "1 of 1"


def test_dropping_a_trial_mends_its_pair(tmp_path: Path) -> None:
    """A pair that does not oppose is no pair any more once a trial is gone."""
    verdict = check(equal_labels(), tmp_path, drop(TRIAL) + drop(trial_name("alpha_one", 0, 1)))
    assert verdict.problems == ()


def test_findings_after_a_dropped_trial_name_the_right_line(tmp_path: Path) -> None:
    """Lines are those of the file as it is."""
    folder = ReferenceFolder()
    folder.rows["Beta.csv"][3][3] = "0"
    folder.rows[TRIALS][7][3] = "0"
    dropped = drop(trial_name("alpha_two", 0, 0)) + drop(trial_name("beta_one", 1, 0))
    verdict = check(folder, tmp_path, dropped + accept("reference-imbalance"))
    assert [(p.code, p.file, p.line) for p in verdict.problems] == [
        ("reference-copies", "reference/Alpha.csv", 9),
        ("reference-copies", "reference/Beta.csv", 5),
    ]


def test_empty_errata_change_nothing(tmp_path: Path) -> None:
    """A file without entries has no section of its own."""
    verdict = check(ReferenceFolder(), tmp_path, "# nothing so far\n")
    assert verdict.datasheet is not None
    assert "Errata" not in [section.title for section in verdict.datasheet.sections]


def test_files_that_do_not_belong_cannot_be_accepted(tmp_path: Path) -> None:
    """Errata are about the content; a stray file is moved."""
    folder = ReferenceFolder(raw={"errata.toml": accept("reference-stray-file").encode()})
    instance = folder.write(tmp_path)
    instance.reference_file("notes.txt").touch()
    codes = [problem.code for problem in check_reference(instance).problems]
    assert codes == ["reference-stray-file", "reference-errata-unused"]
