"""Every assumption has a row, whatever comes of it; findings are read off the rows."""

from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from builders import build_reference
from leaderboard.instance import Instance
from leaderboard.models import Errata
from leaderboard.problems import CODES, Problem, Problems, Severity
from leaderboard.reference import load_reference
from leaderboard.reference.checking import (
    Datasheet,
    Finding,
    Row,
    Section,
    Status,
    check_departures,
    check_reference,
    draw_datasheet,
)
from leaderboard.reference.checking.datasheet import accept_findings
from reference_folders import ReferenceFolder

NOTE = Finding(Problem("reference-imbalance", "a note", "reference/a"))
WARNING = Finding(Problem("reference-copies", "a warning", "reference/a"))
ERROR = Finding(Problem("reference-seal", "an error", "reference/a"))
ACCEPTED = Finding(WARNING.problem, "known")


@pytest.mark.parametrize(
    ("expected", "findings", "status"),
    [
        ("all", (), Status.OK),
        ("", (), Status.NOTE),
        ("all", (NOTE,), Status.NOTE),
        ("all", (NOTE, WARNING), Status.DEPARTS),
        ("all", (ERROR,), Status.DEPARTS),
        ("all", (ACCEPTED,), Status.ACCEPTED),
        ("all", (ACCEPTED, NOTE), Status.NOTE),
        ("all", (ACCEPTED, WARNING), Status.DEPARTS),
    ],
)
def test_an_assumption_fares_as_its_worst_finding(
    expected: str, findings: tuple[Finding, ...], status: Status
) -> None:
    """What is accepted counts for less than what is not, and a fact of which nothing is expected informs."""
    assert Row("Something", expected, "found", findings).status is status


@given(
    st.lists(st.sampled_from([code for code in CODES if code.startswith("reference-")]), max_size=6),
    st.sets(st.sampled_from([code for code in CODES if code.startswith("reference-")])),
)
def test_errata_accept_what_they_name_and_no_error(codes: list[str], accepted: set[str]) -> None:
    """No finding is lost or made: each is open or accepted, and errors stay open."""
    findings = tuple(Finding(Problem(code, f"of {code}", "reference/a")) for code in codes)
    entries = [{"code": code, "reason": "known"} for code in sorted(accepted)]
    errata = Errata.model_validate({"accept": entries})
    sheet = Datasheet(accept_findings([Section("One", (Row("a", "", "", findings),))], errata))
    assert len(sheet.problems) + len(sheet.accepted) == len(codes)
    for finding in sheet.findings:
        code = finding.problem.code
        is_named = code in accepted and CODES[code].severity is not Severity.ERROR
        assert finding.is_open is not is_named


def test_a_sound_reference_departs_nowhere(tmp_path: Path) -> None:
    """Every assumption has its row, and none a finding."""
    verdict = check_reference(ReferenceFolder().write(tmp_path))
    assert verdict.datasheet is not None
    sections = verdict.datasheet.sections
    titles = [section.title for section in sections]
    assert titles == ["Files", "Trials", "Pairs", "Balance", "Ratings", "People", "Design"]
    assert {row.status for section in sections for row in section.rows} == {Status.OK, Status.NOTE}
    rows = {row.assumption: (row.expected, row.found) for section in sections for row in section.rows}
    assert rows["Files are as sealed"] == ("all", "all 5")
    assert rows["Trials of Alpha"] == ("8", "8")
    assert rows["Trials of alpha_two"] == ("at least 1", "4")
    assert rows["Start frames"] == ("", "given for all 12 trials: 90")
    assert rows["Both trials end differently"] == ("every pair", "6 of 6 pairs")
    assert rows["Alpha ends in YES"] == ("half", "4 of 8 trials")
    assert rows["Responses"] == ("", "12")
    assert rows["People per trial of Beta"] == ("", "1")
    assert rows["Names are p and a number"] == ("all", "2 of 2 are")


def leave_out_frames(folder: ReferenceFolder) -> None:
    for file in ("Alpha.csv", "Beta.csv"):
        for row in folder.rows[file]:
            row[5] = ""


def leave_out_some_frames(folder: ReferenceFolder) -> None:
    folder.rows["Alpha.csv"][0][5] = ""
    folder.rows["Alpha.csv"][1][5] = "12"


@pytest.mark.parametrize(
    ("change", "found"),
    [
        (leave_out_frames, "not given"),
        (leave_out_some_frames, "given for 11 of 12 trials: 12 to 90"),
    ],
)
def test_start_frames_are_told(tmp_path: Path, change: Callable[[ReferenceFolder], None], found: str) -> None:
    """They may be missing, and nothing is wrong with that."""
    folder = ReferenceFolder()
    change(folder)
    verdict = check_reference(folder.write(tmp_path))
    assert verdict.datasheet is not None
    (row,) = [
        row
        for section in verdict.datasheet.sections
        for row in section.rows
        if row.assumption == "Start frames"
    ]
    assert (row.found, row.status, verdict.problems) == (found, Status.NOTE, ())


def test_files_that_cannot_be_understood_have_no_datasheet(tmp_path: Path) -> None:
    """Then only what is wrong with them is told."""
    instance = ReferenceFolder(raw={"Alpha.csv": b"trial_id\n"}).write(tmp_path)
    verdict = check_reference(instance)
    assert [problem.code for problem in verdict.problems] == ["reference-header"]
    assert (verdict.datasheet, verdict.reference, verdict.is_sound) == (None, None, False)


def test_a_reference_without_people_has_no_rows_of_them() -> None:
    """That there are none is a note, and counts alone say nothing of single people."""
    lonely = draw_datasheet(build_reference(n_people=0))
    assert [section.title for section in lonely.sections][-1] == "Ratings"
    assert [problem.message for problem in lonely.problems] == ["there are no human data"]
    counted = draw_datasheet(build_reference(responses=False))
    assert [section.title for section in counted.sections][-1] == "Ratings"


def test_departures_are_the_findings_of_the_datasheet(repo_root: Path) -> None:
    """An importer gets the same findings as the check."""
    problems = Problems()
    reference = build_reference(n_people=0)
    check_departures(reference, problems)
    assert tuple(problems) == draw_datasheet(reference).problems
    problems = Problems()
    check_departures(load_reference(Instance(repo_root)), problems)
    assert tuple(problems) == check_reference(Instance(repo_root)).problems
