"""Finding pairs, and what is asked of both members at once."""

import numpy as np
import pytest

from leaderboard.metrics.pairs import find_opposite_pairs, find_pairs, pair_accuracy, pair_order
from leaderboard.metrics.undefined import Undefined

NO_PAIRS = Undefined("no two of these trials form a pair")
NO_OPPOSITE_PAIRS = Undefined("no two of these trials form a pair with opposite labels")


@pytest.mark.parametrize(
    ("pairs", "found"),
    [
        ([], []),
        ([0], []),
        ([0, 1, 2], []),
        ([0, 0], [[0, 1]]),
        ([5, 2, 2, 5], [[1, 2], [0, 3]]),
        ([1, 1, 1], []),  # three trials are no pair
        ([0, 1, 1, 1, 0], [[0, 4]]),
    ],
)
def test_a_pair_is_two_trials_that_share_a_number(pairs: list[int], found: list[list[int]]) -> None:
    """Wherever they stand, the earlier first; fewer or more than two are no pair."""
    assert find_pairs(np.array(pairs, np.int64)).tolist() == found


def test_every_pair_of_a_large_benchmark_is_found_once() -> None:
    """In any order of trials, the earlier member first, pairs by number."""
    pairs = np.random.default_rng(0).permutation(np.repeat(np.arange(2000), 2))
    members = find_pairs(pairs)
    assert pairs[members].tolist() == [[number, number] for number in range(2000)]
    assert (members[:, 0] < members[:, 1]).all()


def test_opposite_pairs_name_the_yes_member_first() -> None:
    """Pairs of equal labels are left out."""
    pairs, labels = np.array([0, 1, 2, 0, 1, 2]), np.array([0, 1, 1, 1, 0, 1])
    assert find_opposite_pairs(pairs, labels).tolist() == [[3, 0], [1, 4]]


@pytest.mark.parametrize(
    ("credits", "value"),
    [([1, 1], 1), ([1, 0], 0), ([0, 0], 0), ([0.5, 0.5], 0.25), ([1, 0.5], 0.5)],
)
def test_pair_accuracy_multiplies_the_two_credits(credits: list[float], value: float) -> None:
    """Both must be right; half credits are chances of it."""
    assert pair_accuracy(np.array(credits, float), np.array([3, 3])) == value


def test_pair_accuracy_leaves_single_trials_out() -> None:
    """A trial without partner is no pair, whether right or wrong; nor does the label of a partner matter."""
    credits, pairs = np.array([1.0, 0.0, 1.0, 1.0]), np.array([0, 1, 2, 2])
    assert pair_accuracy(credits, pairs) == 1
    assert pair_accuracy(credits[:2], pairs[:2]) == NO_PAIRS
    assert pair_accuracy(credits[:0], pairs[:0]) == NO_PAIRS


@pytest.mark.parametrize(
    ("no", "yes", "value"), [(0.2, 0.3, 1), (0.3, 0.2, 0), (0.3, 0.3, 0.5), (0.8, 0.9, 1)]
)
def test_pair_order_asks_only_which_is_higher(no: float, yes: float, value: float) -> None:
    """Both may lie on one side of 0.5; a tie counts half; the order in the file does not matter."""
    pairs = np.array([0, 0])
    assert pair_order(np.array([no, yes]), pairs, np.array([0, 1])) == value
    assert pair_order(np.array([yes, no]), pairs, np.array([1, 0])) == value


def test_pair_order_needs_opposite_labels() -> None:
    """In a pair with equal labels neither ought to be higher."""
    probabilities, pairs = np.array([0.1, 0.9, 0.4, 0.6]), np.array([0, 0, 1, 1])
    assert pair_order(probabilities, pairs, np.array([1, 1, 0, 1])) == 1
    assert pair_order(probabilities, pairs, np.array([1, 1, 0, 0])) == NO_OPPOSITE_PAIRS
    assert pair_order(probabilities[:1], pairs[:1], np.array([1])) == NO_OPPOSITE_PAIRS
