"""The sign-flip distribution and the exact p of an accuracy."""

import itertools
from collections import Counter
from fractions import Fraction
from math import comb

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.metrics.accuracy import credits_of
from leaderboard.metrics.exact_tests import accuracy_p, paired_p, tail_probability
from leaderboard.metrics.undefined import Undefined

SMALL = st.integers(0, 25)


def _p(
    probabilities: list[float], labels: list[int], pairs: list[int], answered: list[bool] | None = None
) -> object:
    given_ = np.ones(len(labels), bool) if answered is None else np.array(answered)
    credits = credits_of(np.array(probabilities, float), np.array(labels, np.int64), given_)
    return accuracy_p(credits, np.array(labels, np.int64), np.array(pairs, np.int64), given_)


def _spread(sizes: list[int]) -> Counter[int]:
    """Count the sign patterns behind each sum, adding one difference after the other."""
    ways = Counter({0: 1})
    for size in sizes:
        following: Counter[int] = Counter()
        for total, count in ways.items():
            following[total + size] += count
            following[total - size] += count
        ways = following
    return ways


@given(n_halves=SMALL, n_ones=SMALL, observed=st.integers(-80, 80))
def test_the_tail_is_that_of_the_distribution_built_step_by_step(
    n_halves: int, n_ones: int, observed: int
) -> None:
    """The nearest float64 to the exact fraction, for every sum, reachable or not."""
    ways = _spread([1] * n_halves + [2] * n_ones)
    exact = Fraction(sum(count for total, count in ways.items() if total >= observed), ways.total())
    assert tail_probability(n_halves, n_ones, observed) == float(exact)


@given(n_halves=SMALL, n_ones=SMALL, observed=st.integers(-80, 80))
def test_the_distribution_is_symmetric(n_halves: int, n_ones: int, observed: int) -> None:
    """At least s, and less than s turned round to at least 1 - s, make 1."""
    above = tail_probability(n_halves, n_ones, observed)
    assert above + tail_probability(n_halves, n_ones, 1 - observed) == pytest.approx(1, abs=1e-15)


@pytest.mark.parametrize(("n_halves", "n_ones"), [(1000, 0), (0, 1000), (500, 500)])
def test_the_best_possible_is_one_pattern_of_all(n_halves: int, n_ones: int) -> None:
    """2^-1000 is exact in float64."""
    assert tail_probability(n_halves, n_ones, n_halves + 2 * n_ones) == 2.0**-1000


def test_a_p_too_small_for_float64_is_not_zero() -> None:
    """2^-1200 becomes the smallest positive number, and what cannot be reached stays 0."""
    assert tail_probability(1200, 0, 1200) == 5e-324
    assert tail_probability(1200, 0, 1201) == 0
    assert tail_probability(1200, 0, -1200) == 1


@pytest.mark.parametrize(
    ("probabilities", "p"),
    [
        ([0.9, 0.1], 0.5),  # d = 1: one of two patterns
        ([0.1, 0.9], 1),  # d = -1
        ([0.9, 0.9], 1),  # d = 0, always YES
        ([0.5, 0.5], 1),  # d = 0
        ([0.9, 0.5], 0.5),  # d = 1/2
        ([0.5, 0.9], 1),  # d = -1/2
    ],
)
def test_p_of_one_pair_by_hand(probabilities: list[float], p: float) -> None:
    """The first member is YES, the second NO."""
    assert _p(probabilities, [1, 0], [0, 0]) == p


def test_pairs_and_single_trials_add_up() -> None:
    """Differences 1 (pair), 1/2 and -1/2 (single): sums of at least 1 come from 3 of 8 patterns."""
    assert _p([0.9, 0.1, 0.9, 0.9], [1, 0, 1, 0], [0, 0, 1, 2]) == 3 / 8


def test_members_of_a_pair_with_equal_labels_stand_alone() -> None:
    """Their labels cannot be swapped: two halves with 1 of 4 patterns, not one whole with 1 of 2."""
    assert _p([0.9, 0.9], [1, 1], [0, 0]) == 1 / 4
    assert _p([0.9, 0.9], [1, 1], [0, 1]) == 1 / 4
    assert _p([0.9, 0.1], [1, 0], [0, 0]) == 1 / 2


def test_three_trials_under_one_number_stand_alone() -> None:
    """Only two trials make a pair."""
    assert _p([0.9, 0.1, 0.9], [1, 0, 1], [0, 0, 0]) == 1 / 8


@pytest.mark.parametrize(
    ("probabilities", "answered", "p"),
    [
        ([0.9, 0.5], [True, False], 0.5),  # d = 1 - 1/2
        ([0.1, 0.5], [True, False], 1),  # d = 0 - 1/2
        ([0.5, 0.5], [True, False], 1),  # d = 1/2 - 1/2
        ([0.5, 0.5], [False, False], 1),  # d = 0
    ],
)
def test_only_answered_members_enter_the_difference(
    probabilities: list[float], answered: list[bool], p: float
) -> None:
    """No answer is neither for nor against: it earns nothing and nothing is expected of it."""
    assert _p(probabilities, [1, 0], [0, 0], answered) == p


def test_an_unanswered_single_trial_has_no_difference() -> None:
    """Beside one right answer there is one of two patterns still."""
    assert _p([0.9, 0.5], [1, 1], [0, 1], [True, False]) == 1 / 2


def test_always_yes_knows_nothing() -> None:
    """In pairs it gains on one member what it loses on the other, however many pairs there are."""
    n_pairs = 384
    assert _p([0.9] * 2 * n_pairs, [1, 0] * n_pairs, [k // 2 for k in range(2 * n_pairs)]) == 1


def test_p_of_nothing_is_undefined() -> None:
    """There is no test without trials."""
    assert _p([], [], []) == Undefined("there are no trials")


@given(
    st.lists(
        st.tuples(st.sampled_from([0.1, 0.5, 0.9]), st.integers(0, 1), st.integers(0, 6), st.booleans()),
        min_size=1,
    )
)
def test_p_is_positive_and_does_not_see_the_order(trials: list[tuple[float, int, int, bool]]) -> None:
    """What was observed is one of the patterns, and trials may come in any order."""
    probabilities, labels, pairs, answered = (list(column) for column in zip(*trials, strict=True))
    p = _p(probabilities, labels, pairs, answered)
    assert isinstance(p, float)
    assert 0 < p <= 1
    assert _p(probabilities[::-1], labels[::-1], pairs[::-1], answered[::-1]) == p


@given(st.lists(st.integers(-4, 4), max_size=9))
def test_paired_p_equals_the_enumeration_of_all_signs(differences: list[int]) -> None:
    """Every pattern of signs is tried, and those at least as far from 0 are counted."""
    observed = abs(sum(differences))
    sizes = [abs(d) for d in differences]
    patterns = list(itertools.product((1, -1), repeat=len(sizes)))
    sums = [sum(sign * size for sign, size in zip(signs, sizes, strict=True)) for signs in patterns]
    reached = sum(abs(total) >= observed for total in sums)
    found = paired_p(np.array(differences, dtype=np.int64))
    assert found == pytest.approx(reached / len(patterns), rel=1e-15)


def test_paired_p_of_ones_is_mcnemar_s_exact_test() -> None:
    """With one trial a pair it is the binomial test on the discordant ones, to the last digit for 768."""
    differences = np.repeat([2, -2, 0], [400, 300, 68])
    expected = Fraction(2 * sum(comb(700, k) for k in range(400, 701)), 2**700)
    assert paired_p(differences) == float(expected)
