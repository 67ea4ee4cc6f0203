"""The people of a property: the same splits every time, and reliability from whatever is known."""

from dataclasses import replace

import numpy as np

from builders import build_reference
from leaderboard.grading.draws import find_sets
from leaderboard.grading.panels import find_panels
from leaderboard.metrics.reliability import count_reliability

REFERENCE = build_reference(6, n_people=16)


def test_each_property_has_its_people_and_splits_of_its_own() -> None:
    """1,000 splits within sets; the same ones at every call, other ones for another property."""
    panels, again = find_panels(REFERENCE), find_panels(REFERENCE)
    alpha, beta = panels["Alpha"].halves, panels["Beta"].halves
    assert alpha is not None
    assert beta is not None
    assert again["Alpha"].halves is not None
    assert (alpha.is_first == again["Alpha"].halves.is_first).all()
    assert alpha.is_first.shape == (1000, 16)
    assert (alpha.is_first != beta.is_first).any()
    assert REFERENCE.people is not None
    assert REFERENCE.people.responses is not None
    sets = find_sets(REFERENCE.people.responses, REFERENCE)
    for number in set(sets.tolist()):
        assert (alpha.is_first[:, sets == number].sum(axis=1) == 4).all()


def test_reliability_is_from_halves_where_they_are_known_and_else_from_counts() -> None:
    """Both are there where both can be."""
    panel = find_panels(REFERENCE)["Beta"]
    assert panel.split_half is not None
    assert panel.reliability is panel.split_half.reliability
    counts = find_panels(build_reference(6, n_people=16, responses=False))["Beta"]
    assert counts.split_half is None
    assert counts.crossfit is None
    assert (counts.people.size, counts.sets.size) == (0, 0)
    assert counts.reliability is counts.from_counts
    mask = REFERENCE.in_property("Beta")
    assert REFERENCE.people is not None
    expected = count_reliability(REFERENCE.people.n[mask], REFERENCE.people.n_yes[mask])
    assert counts.from_counts.value == panel.from_counts.value == expected.value


def test_without_people_there_are_no_panels() -> None:
    """Neither where the reference lacks them, nor halves where nobody judged a property."""
    assert find_panels(build_reference(n_people=0)) == {}
    people = REFERENCE.people
    assert people is not None
    assert people.responses is not None
    none = np.zeros(0, np.int64)
    nobody = replace(people.responses, participants=none, trials=none, answers=none)
    empty = replace(REFERENCE, people=replace(people, n=0 * people.n, n_yes=0 * people.n, responses=nobody))
    assert find_panels(empty)["Alpha"].halves is None
