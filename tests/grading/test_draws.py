"""What is drawn: pairs within scenarios, and people within the sets who saw the same trials."""

from dataclasses import replace

import numpy as np

from builders import build_reference
from leaderboard.grading.draws import Draws, find_sets, find_strata

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
