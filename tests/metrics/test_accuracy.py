"""Credits, accuracy, people's accuracy, and the exact bounds of easy and hard."""

import math
from fractions import Fraction

import numpy as np
import pytest

from leaderboard.metrics.accuracy import (
    accuracy,
    credits_of,
    human_accuracy,
    human_gap,
    is_above,
    is_below,
    right_counts,
)
from leaderboard.metrics.undefined import Undefined

NONE = np.array([], dtype=np.int64)


@pytest.mark.parametrize(
    ("probability", "label", "credit"),
    [
        (0.51, 1, 1),
        (0.51, 0, 0),
        (0.49, 1, 0),
        (0.49, 0, 1),
        (0.5, 1, 0.5),
        (0.5, 0, 0.5),
        (0.0, 0, 1),
        (1.0, 0, 0),
    ],
)
def test_credit_depends_on_the_side_of_one_half(probability: float, label: int, credit: float) -> None:
    """The label's side earns 1, the other 0, and one half exactly earns 1/2 whatever the label."""
    assert credits_of(np.array([probability]), np.array([label]), np.array([True])) == [credit]


def test_the_neighbours_of_one_half_are_not_ties() -> None:
    """The next number above or below 0.5 is on a side."""
    neighbours = np.array([math.nextafter(0.5, 0), math.nextafter(0.5, 1), 5e-324])
    earned = credits_of(neighbours, np.array([0, 0, 0]), np.ones(3, bool))
    assert earned.tolist() == [1, 0, 1]


def test_no_answer_earns_nothing() -> None:
    """Not even the half credit of the 0.5 that stands in for it."""
    assert credits_of(np.array([0.5, 0.5]), np.array([0, 1]), np.zeros(2, bool)).tolist() == [0, 0]


def test_accuracy_is_the_mean_credit() -> None:
    """Half credits count half."""
    assert accuracy(np.array([1, 0.5, 0, 0.5])) == 0.5


def test_accuracy_of_nothing_is_undefined() -> None:
    """There is no mean of no trials."""
    assert accuracy(np.array([])) == Undefined("there are no trials")


def test_people_are_right_by_the_label() -> None:
    """Where it is NO, those are right who did not say YES."""
    assert right_counts(np.array([5, 5]), np.array([2, 2]), np.array([1, 0])).tolist() == [2, 3]


def test_trials_weigh_the_same_however_many_rated_them() -> None:
    """One person who is right and ninety-nine of a hundred who are wrong make 0.505."""
    assert human_accuracy(np.array([1, 100]), np.array([1, 1]), np.array([1, 1])) == pytest.approx(0.505)


def test_unrated_trials_are_no_part_of_human_accuracy() -> None:
    """They are neither right nor wrong."""
    assert human_accuracy(np.array([4, 0]), np.array([1, 0]), np.array([1, 0])) == 0.25


def test_the_gap_is_taken_over_rated_trials_on_both_sides() -> None:
    """A miss on a trial that nobody rated does not widen it."""
    credits, n, n_yes = np.array([1.0, 0.5, 0.0]), np.array([4, 4, 0]), np.array([2, 4, 0])
    assert human_gap(credits, n, n_yes, np.array([1, 1, 1])) == 0.75 - 0.75
    assert human_gap(1 - credits, n, n_yes, np.array([1, 1, 1])) == 0.25 - 0.75


def test_without_ratings_people_have_no_accuracy_and_nobody_a_gap() -> None:
    """Both say why."""
    zeros, labels = np.zeros(2, np.int64), np.array([0, 1])
    assert human_accuracy(zeros, zeros, labels) == Undefined("nobody rated these trials")
    assert human_gap(np.ones(2), zeros, zeros, labels) == Undefined("nobody rated these trials")
    assert human_gap(np.array([]), NONE, NONE, NONE) == Undefined("nobody rated these trials")


@pytest.mark.parametrize("total", [3, 30, 3_000_000_003])
def test_a_count_at_the_bound_is_on_neither_side(total: int) -> None:
    """Bounds are strict and compared in whole numbers, one more or one less is beyond them."""
    two_thirds, third, totals = 2 * total // 3, total // 3, np.array([total])
    above = [is_above(np.array([two_thirds + step]), totals, Fraction(2, 3))[0] for step in (-1, 0, 1)]
    below = [is_below(np.array([third + step]), totals, Fraction(1, 3))[0] for step in (-1, 0, 1)]
    assert above == [False, False, True]
    assert below == [True, False, False]


def test_a_trial_that_nobody_rated_is_on_neither_side() -> None:
    """None of nobody is no share at all, whatever the bound."""
    zero = np.array([0])
    for bound in (Fraction(0), Fraction(1, 3), Fraction(1)):
        assert not is_above(zero, zero, bound).any()
        assert not is_below(zero, zero, bound).any()
