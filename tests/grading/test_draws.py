"""What is drawn: pairs within scenarios, and people within the sets who saw the same trials."""

from dataclasses import replace

import numpy as np
import pytest

from builders import build_reference
from leaderboard.grading.draws import Draws, find_run, find_sets, find_strata

REFERENCE = build_reference(6)


def test_draws_keep_the_size_of_each_scenario_and_set() -> None:
    """Every resample has as many pairs of a scenario and people of a set as the data, and not all alike."""
    draws = Draws.of(REFERENCE)
    assert draws.people is not None
    for stratum in range(3):
        sizes = draws.pairs[find_strata(REFERENCE) == stratum].sum(axis=0)
        assert (sizes == 6).all()
    assert (draws.people[::2].sum(axis=0) == 6).all()
    assert draws.pairs.shape == (18, 200)
    assert draws.pairs.std(axis=1).min() > 0


@pytest.mark.parametrize("rows", [[0], [5], [0, 1, 2], [4, 5, 6, 7]], ids=str)
def test_rows_that_follow_each_other_are_not_copied(rows: list[int]) -> None:
    """They are a slice, from the first to the last, wherever it begins."""
    assert find_run(np.array(rows)) == slice(rows[0], rows[-1] + 1)


@pytest.mark.parametrize("rows", [[], [0, 2], [1, 2, 4], [0, 2, 3], [3, 5, 6, 8]], ids=str)
def test_rows_with_gaps_stay_rows(rows: list[int]) -> None:
    """A slice would take in what is between them."""
    found = find_run(np.array(rows, np.int64))
    assert isinstance(found, np.ndarray)
    assert found.tolist() == rows


def test_people_who_saw_the_same_trials_are_a_set() -> None:
    """In the small reference people alternate between two sets; all different ones are one set."""
    people = REFERENCE.people
    assert people is not None
    assert people.responses is not None
    assert find_sets(people.responses, REFERENCE).tolist() == [0, 1] * 6
    first = people.responses.participants
    different = replace(
        people.responses,
        participant_ids=("p001", "p002"),
        participants=np.array([0, 0, 1, 1]),
        trials=np.array([0, 2, 0, 4]),
        answers=np.zeros(4, np.int64),
    )
    assert find_sets(different, REFERENCE).tolist() == [0, 0]
    assert first.max() == 11


def test_sets_are_looked_for_in_each_property() -> None:
    """In Alpha two saw the same and one another; in Beta both saw different ones; two saw none."""
    people = REFERENCE.people
    assert people is not None
    assert people.responses is not None
    beta = int(np.flatnonzero(REFERENCE.in_property("Beta"))[0])
    seen = {0: [0, 2], 1: [2, 0], 2: [4], 3: [beta], 4: [beta + 2, beta + 4], 5: [], 6: []}
    responses = replace(
        people.responses,
        participant_ids=tuple(f"p{person}" for person in seen),
        participants=np.repeat(list(seen), [len(trials) for trials in seen.values()]),
        trials=np.array([trial for trials in seen.values() for trial in trials]),
        answers=np.zeros(6, np.int64),
    )
    assert find_sets(responses, REFERENCE).tolist() == [1, 1, 2, 3, 3, 0, 0]


def test_people_of_two_properties_are_never_one_set() -> None:
    """Not even where in both of them all saw different trials."""
    people = REFERENCE.people
    assert people is not None
    assert people.responses is not None
    beta = int(np.flatnonzero(REFERENCE.in_property("Beta"))[0])
    responses = replace(
        people.responses,
        participant_ids=("p0", "p1", "p2", "p3"),
        participants=np.arange(4),
        trials=np.array([0, beta, 2, beta + 2]),
        answers=np.zeros(4, np.int64),
    )
    assert find_sets(responses, REFERENCE).tolist() == [0, 1, 0, 1]
