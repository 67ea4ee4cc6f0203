"""What checking a reference found, as text and as JSON."""

import json
from pathlib import Path

import pytest

from leaderboard.reference.checking import check_reference
from leaderboard.reference.describing import describe_reference
from leaderboard.report.datasheet import render_check, render_check_json
from leaderboard.report.reference import render_description, render_description_json
from leaderboard.report.terminal import Terminal
from reference_folders import ReferenceFolder, pair_name, trial_name

NARROW = Terminal(80)
PAIR, OTHER = pair_name("alpha_one", 0), pair_name("alpha_two", 1)
TRIAL = trial_name("beta_one", 0, 0)
ERRATA = f"""\
[[accept]]
code = "reference-copies"
reason = "Both were released as copy 0."

[[drop]]
trial_id = "{TRIAL}"
reason = "The video is empty."
"""


@pytest.fixture
def folder() -> ReferenceFolder:
    """Make a reference with a finding that is accepted, a trial that is dropped, and findings that stay."""
    folder = ReferenceFolder(raw={"errata.toml": ERRATA.encode()})
    folder.rows["Alpha.csv"][1][3] = "0"
    folder.rows["Alpha.csv"][7][1] = "alone"
    return folder


def test_the_text_fits_80_columns(tmp_path: Path) -> None:
    """Tables are no wider, and each row says how its assumption fares."""
    text = render_check(check_reference(ReferenceFolder().write(tmp_path)), terminal=NARROW)
    lines = text.splitlines()
    assert max(map(len, lines)) <= 80
    assert [line.split() for line in lines if line.startswith(" Trials of Alpha")] == [
        ["Trials", "of", "Alpha", "8", "8", "ok"]
    ]
    assert lines[-1] == "the reference is sound"


def test_errata_and_findings_follow_the_tables(folder: ReferenceFolder, tmp_path: Path) -> None:
    """What is dropped and accepted has its reason; what is left comes last, before the verdict."""
    text = render_check(check_reference(folder.write(tmp_path)), terminal=NARROW)
    listed = text[text.index("dropped: ") :].splitlines()
    assert listed == [
        f"dropped: {TRIAL}: The video is empty.",
        (
            f"accepted: reference/Alpha.csv:3: reference-copies: both trials of the pair {PAIR} are copy 0; "
            "they should be copy 0 and copy 1: Both were released as copy 0."
        ),
        f"reference/Alpha.csv:8: warning: reference-incomplete-pair: the pair {OTHER} has 1 trial, not two",
        "reference/Alpha.csv:9: warning: reference-incomplete-pair: the pair alone has 1 trial, not two",
        (
            "reference/Beta.csv: note: reference-imbalance: "
            "2 of 3 trials of beta_one end in YES, not half of them"
        ),
        "the reference departs from its definition",
    ]


def test_the_json_has_everything(folder: ReferenceFolder, tmp_path: Path) -> None:
    """Findings as validate gives them, what errata say, and every row of the datasheet."""
    data = json.loads(render_check_json(check_reference(folder.write(tmp_path))))
    assert (data["sound"], data["valid"], data["errors"]) == (False, True, [])
    assert [found["code"] for found in data["warnings"]] == [
        "reference-incomplete-pair",
        "reference-incomplete-pair",
        "reference-imbalance",
    ]
    assert data["dropped"] == {TRIAL: "The video is empty."}
    assert [(found["code"], found["line"], found["reason"]) for found in data["accepted"]] == [
        ("reference-copies", 3, "Both were released as copy 0.")
    ]
    pairs = next(section for section in data["datasheet"] if section["title"] == "Pairs")
    assert pairs["rows"][3] == {
        "assumption": "One trial is copy 0, one copy 1",
        "expected": "every pair",
        "found": "3 of 4 pairs",
        "status": "accepted",
        "code": "reference-copies",
    }


def test_without_a_datasheet_there_are_findings(tmp_path: Path) -> None:
    """Files that nobody understands have no tables, and programs see that there is no datasheet."""
    verdict = check_reference(ReferenceFolder(raw={"Beta.csv": None}).write(tmp_path))
    text = render_check(verdict)
    assert text.startswith("reference/Beta.csv: reference-file-missing: is not there\n")
    assert text.endswith("the reference departs from its definition\n")
    data = json.loads(render_check_json(verdict))
    assert (data["datasheet"], data["dropped"], data["valid"]) == (None, {}, False)


def test_a_description_names_dropped_trials(folder: ReferenceFolder, tmp_path: Path) -> None:
    """`reference show` says what is not in its counts, and why."""
    reference = check_reference(folder.write(tmp_path)).reference
    assert reference is not None
    description = describe_reference(reference)
    text = render_description(description, reference, terminal=Terminal(120))
    assert text.endswith(f"dropped: {TRIAL}: The video is empty.\n")
    assert json.loads(render_description_json(description))["dropped"] == {TRIAL: "The video is empty."}
