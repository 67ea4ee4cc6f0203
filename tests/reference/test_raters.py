"""Improbable patterns in somebody's answers are noted; ordinary answers are not, however one-sided."""

import random
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from leaderboard.reference import Responses
from leaderboard.reference.checking import Section, Status, check_reference
from leaderboard.reference.checking.raters import check_raters, keeps_order, list_raters
from reference_folders import ReferenceFolder

N_TRIALS = 32
ORDINARY = "10110100011101001011001000111010"
SAMENESS, STREAK = "Who gave one answer throughout", "Who gave one answer in long streaks"
ALTERNATION = "Who alternated"


def answered(*people: str, order: str = "random") -> Responses:
    """Make responses of people from their answers in the order in which they gave them.

    Everybody saw the same trials, in an order of their own, or in that of the trials.
    """
    rng = random.Random(3)
    rows = []
    for person, answers in enumerate(people):
        trials = list(range(len(answers)))
        if order == "random":
            rng.shuffle(trials)
        rows += [(person, trial, int(answer)) for trial, answer in zip(trials, answers, strict=True)]
    participants, trials, values = np.array(rows).T
    sorting = np.lexsort((trials, participants))
    names = tuple(f"p{person + 1}" for person in range(len(people)))
    return Responses(names, participants[sorting], trials[sorting], values[sorting], sorting)


def messages(section: Section) -> list[str]:
    return [finding.problem.message for row in section.rows for finding in row.findings]


def status_of(section: Section, assumption: str) -> Status:
    return next(row.status for row in section.rows if row.assumption == assumption)


@pytest.mark.parametrize(
    ("answers", "assumption", "message"),
    [
        ("1" * N_TRIALS, SAMENESS, "p2 answered YES to all 32 trials (p = 4.7e-10)"),
        ("0" * N_TRIALS, SAMENESS, "p2 answered NO to all 32 trials (p = 4.7e-10)"),
        ("10" * 16, ALTERNATION, "p2 changed the answer 31 times in 32 answers (p = 3.3e-09)"),
        ("1" * 16 + "0" * 16, STREAK, "p2 answered YES 16 times in a row, of 32 answers (p = 5.7e-08)"),
        (
            "010" + "0" * 15 + "1011101101101" + "1",
            STREAK,
            "p2 answered NO 16 times in a row, of 32 answers (p = 4.1e-04)",
        ),
    ],
)
def test_improbable_patterns_are_notes(answers: str, assumption: str, message: str) -> None:
    """The person, the pattern and its p are named; the assumption is a note, and fails no check."""
    section = check_raters(answered(ORDINARY, answers))
    assert messages(section) == [message]
    assert status_of(section, assumption) is Status.NOTE
    assert next(row.found for row in section.rows if row.assumption == assumption) == "1 of 2 people"


def test_ordinary_answers_are_not_mentioned() -> None:
    """Somebody who says YES to three trials in four is no pattern, nor is somebody with few answers."""
    leaning = "11101111011101111011101110111011"
    section = check_raters(answered(ORDINARY, leaning, "1111", "1010"))
    assert messages(section) == []
    assert {row.status for row in section.rows if row.expected} == {Status.OK}


def test_the_more_people_the_less_is_improbable() -> None:
    """One answer to 12 trials is improbable of one person, and not of the likeliest among many."""
    assert messages(check_raters(answered("1" * 12))) != []
    assert messages(check_raters(answered("1" * 12, *[ORDINARY] * 20))) == []


def test_streaks_need_the_order_of_answering() -> None:
    """Rows that follow the trial lists for everybody tell nothing of it; one answer throughout is seen."""
    section = check_raters(answered(ORDINARY, "10" * 16, "1" * N_TRIALS, order="listed"))
    assert messages(section) == ["p3 answered YES to all 32 trials (p = 4.7e-10)"]
    found = {row.assumption: row.found for row in section.rows}
    assert found["Order of a person's answers"] == "not kept: rows follow the trial lists"
    assert found[ALTERNATION] == found[STREAK] == "cannot be told without the order"


def test_the_order_is_that_of_the_file(tmp_path: Path) -> None:
    """Rows of several people may be mixed; what counts is their order within a person."""
    folder = ReferenceFolder()
    folder.rows["human_responses.csv"].reverse()
    verdict = check_reference(folder.write(tmp_path))
    assert verdict.reference is not None
    assert verdict.reference.people is not None
    responses = verdict.reference.people.responses
    assert responses is not None
    assert keeps_order(responses)
    first = next(list_raters(responses))
    told = [row[2] for row in folder.rows["human_responses.csv"] if row[0] == first.name]
    assert first.answers.tolist() == [int(answer) for answer in told]


def test_how_patterns_are_judged_is_said() -> None:
    """Threshold, number of tests and number of people stand beside the findings."""
    note = check_raters(answered(ORDINARY, ORDINARY)).note
    assert note.startswith(
        "A pattern is noted where its p is below 1.7e-03, which is 0.01 shared out over 3 tests of 2 people."
    )


@settings(max_examples=30)
@given(st.lists(st.integers(0, 2**N_TRIALS - 1), min_size=1, max_size=5), st.randoms(use_true_random=False))
def test_the_order_of_people_does_not_matter(numbers: list[int], chance: random.Random) -> None:
    """Whoever comes first in the file, the same people are noted."""
    people = [f"{number:0{N_TRIALS}b}" for number in numbers]
    mixed = people.copy()
    chance.shuffle(mixed)
    noted = [
        sorted(message.partition(" ")[2] for message in messages(check_raters(answered(*answers))))
        for answers in (people, mixed)
    ]
    assert noted[0] == noted[1]
