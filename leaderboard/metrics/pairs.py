"""Twins: two trials that look the same at first and end differently."""

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.undefined import Estimate, Undefined

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

NO_PAIRS = Undefined("no two of these trials form a pair")
NO_OPPOSITE_PAIRS = Undefined("no two of these trials form a pair with opposite labels")


def find_pairs(pairs: Integers) -> NDArray[np.intp]:
    """Find the two trials of each pair that has exactly two.

    Parameters
    ----------
    pairs : (n_trials,)
        Which pair each trial belongs to, as non-negative integers.

    Returns
    -------
    (n_pairs, 2)
        Positions of the members, the earlier trial first.

    Examples
    --------
    >>> find_pairs(np.array([7, 3, 7, 5]))
    array([[0, 2]])
    """
    order = np.argsort(pairs, kind="stable")
    ordered = pairs[order]
    is_start = np.ones(pairs.size + 1, bool)
    is_start[1:-1] = ordered[1:] != ordered[:-1]
    starts = np.flatnonzero(is_start)
    first = starts[:-1][starts[1:] - starts[:-1] == 2]  # noqa: PLR2004  (a pair has two members)
    return np.column_stack([order[first], order[first + 1]])


def find_opposite_pairs(pairs: Integers, labels: Integers) -> NDArray[np.intp]:
    """Find the pairs whose members have opposite labels, the YES member first; (n_pairs, 2).

    >>> find_opposite_pairs(np.array([0, 0, 1, 1]), np.array([0, 1, 1, 1]))
    array([[1, 0]])
    """
    members = find_pairs(pairs)
    members = members[labels[members[:, 0]] != labels[members[:, 1]]]
    is_yes_first = labels[members[:, 0]] == 1
    ordered: NDArray[np.intp] = np.where(is_yes_first[:, None], members, members[:, ::-1])
    return ordered


def pair_accuracy(credits: Floats, pairs: Integers) -> Estimate:
    """Mean over pairs of the product of the two credits: both right; in [0, 1], coin flips give 1/4.

    Parameters
    ----------
    credits, pairs : (n_trials,)

    Examples
    --------
    >>> pair_accuracy(np.array([1.0, 1.0, 1.0, 0.0]), np.array([0, 0, 1, 1]))
    0.5
    """
    members = find_pairs(pairs)
    if not len(members):
        return NO_PAIRS
    return float(np.mean(credits[members[:, 0]] * credits[members[:, 1]]))


def pair_order(probabilities: Floats, pairs: Integers, labels: Integers) -> Estimate:
    """Share of opposite-label pairs whose YES member has the higher P(YES), ties 1/2; chance 0.5.

    Parameters
    ----------
    probabilities, pairs, labels : (n_trials,)

    Examples
    --------
    >>> pair_order(np.array([0.2, 0.3, 0.4, 0.4]), np.array([0, 0, 1, 1]), np.array([0, 1, 0, 1]))
    0.75
    """
    members = find_opposite_pairs(pairs, labels)
    if not len(members):
        return NO_OPPOSITE_PAIRS
    difference = probabilities[members[:, 0]] - probabilities[members[:, 1]]
    return float(np.mean((1 + np.sign(difference)) / 2))
