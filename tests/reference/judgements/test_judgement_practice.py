"""Telling practice from the test."""

import pytest

from judgement_files import ANN, LONG, RAMP0, RAMP1, read_rows
from leaderboard.reference.judgements.practice import PracticeMarks, is_practice_name
from leaderboard.reference.source_tables import SourceRow


@pytest.mark.parametrize(
    "name",
    [
        "practice_01",
        "Practise",
        "familiarization_prediction",
        "familiarisation",
        "fam_3",
        "attention_check",
        "catch",
        "instructions",
        "training",
        "warm-up",
    ],
)
def test_practice_is_known_by_its_name(name: str) -> None:
    """The usual words, alone or as part of a name."""
    assert is_practice_name(name)


@pytest.mark.parametrize("name", ["prediction", "ramp_pp-copy0/zone=far/0001", "family", "trained_eye", ""])
def test_other_names_are_not_practice(name: str) -> None:
    """Words that only look alike are none of them."""
    assert not is_practice_name(name)


@pytest.mark.parametrize(
    ("column", "cell", "expected"),
    [
        ("condition", "familiarization", True),
        ("trial_type", "instructions", True),
        ("Block", "practice", True),
        ("condition", "prediction", False),
        ("is_practice", "True", True),
        ("isPractice", "0", False),
        ("practice", "1", True),
        ("comment", "practice", False),
    ],
)
def test_rows_are_marked_by_condition_or_flag(column: str, cell: str, expected: bool) -> None:
    """A column of conditions says it in words, a flag in truth values; other columns say nothing."""
    assert PracticeMarks([column]).are_on(SourceRow("people.csv", 2, {column: cell})) is expected


def test_practice_on_a_test_trial_is_left_out() -> None:
    """What the condition marks is left out even where a trial of that name exists."""
    reading = read_rows(
        (*LONG, "condition"), [(ANN, RAMP0, "NO", "familiarization"), (ANN, RAMP1, "NO", "prediction")]
    )
    assert reading.counts == {RAMP1: (1, 0)}
    assert reading.find("import-practice").message == "answers to practice trials, left out: 1"


def test_practice_by_name_is_left_out_and_not_unmatched() -> None:
    """Familiarisation trials, which no list holds, do not spoil the match rate."""
    reading = read_rows(LONG, [(ANN, "familiarization/0001", "YES"), (ANN, RAMP1, "NO")])
    assert reading.counts == {RAMP1: (1, 0)}
    assert reading.find("import-match").message == "1 of 1 answers name a trial"
