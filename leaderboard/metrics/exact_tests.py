"""Sign-flip tests counted exactly, in whole numbers."""

from collections.abc import Iterator
from itertools import accumulate
from math import ulp

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.pairs import find_opposite_pairs
from leaderboard.metrics.undefined import NO_TRIALS, Estimate

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

SMALLEST = ulp(0.0)
"""The smallest positive float64, 5e-324: given for what is smaller still but not 0."""


def tail_probability(n_halves: int, n_ones: int, observed: int) -> float:
    """Probability that a sum of randomly signed halves and ones is at least the observed one.

    All 2^(n_halves + n_ones) patterns of signs are equally likely. With i of the halves and j of the ones
    positive, twice the sum is (2i - n_halves) + 2 (2j - n_ones), and comb(n_halves, i) comb(n_ones, j)
    patterns give it. They are counted in whole numbers and divided once, so the result is the float64
    nearest to the exact value; it is 0 only if no pattern reaches the observed sum, which cannot be where
    that sum was observed.

    Parameters
    ----------
    n_halves, n_ones
        How many differences are 1/2 and 1 in absolute value; those that are 0 do not matter.
    observed
        Twice the observed sum, a whole number.

    Examples
    --------
    >>> tail_probability(0, 3, 6), tail_probability(1, 1, 1), tail_probability(0, 0, 0)
    (0.125, 0.5, 1.0)
    """
    # at_least[i]: patterns of the halves with i or more of them positive, as many as with i or more negative.
    at_least = list(accumulate(_binomials(n_halves), initial=0))[::-1]
    count = 0
    for j, patterns_of_ones in enumerate(_binomials(n_ones)):
        # smallest i with (2i - n_halves) + 2 (2j - n_ones) >= observed
        needed = -((2 * (2 * j - n_ones) - n_halves - observed) // 2)
        count += patterns_of_ones * at_least[min(max(needed, 0), n_halves + 1)]
    share: float = count / 2 ** (n_halves + n_ones)  # Python divides whole numbers with one rounding
    return max(share, SMALLEST) if count else 0.0


def accuracy_p(credits: Floats, labels: Integers, pairs: Integers, answered: Booleans) -> Estimate:
    """Exact one-sided p of the accuracy against knowing nothing, in (0, 1].

    In a pair with opposite labels, knowing nothing, the labels could as well be swapped: d, the sum of the
    credits minus half the number of answered members, changes its sign with probability 1/2. A trial without
    such a partner stands alone with d = credit - 1/2 if answered, else 0. p is the probability that the sum
    of randomly signed d is at least the observed sum. Undefined without trials.

    Parameters
    ----------
    credits, labels, pairs, answered : (n_trials,)

    Examples
    --------
    >>> accuracy_p(np.ones(4), np.array([0, 1, 1, 0]), np.array([0, 0, 1, 1]), np.ones(4, bool))
    0.25
    """
    if not credits.size:
        return NO_TRIALS
    # Twice d, which is whole, first for every trial alone and then joined within opposite-label pairs.
    twice = np.rint(np.where(answered, 2 * credits - 1, 0)).astype(np.int64)
    members = find_opposite_pairs(pairs, labels)
    joined = twice[members].sum(axis=1)
    is_single = np.ones(credits.size, bool)
    is_single[members] = False
    differences = np.concatenate([joined, twice[is_single]])
    sizes = np.abs(differences)
    return tail_probability(int((sizes == 1).sum()), int((sizes == 2).sum()), int(differences.sum()))  # noqa: PLR2004


def _binomials(n: int) -> Iterator[int]:
    """Yield n over 0, n over 1, ..., n over n, each from the one before."""
    return accumulate(range(n), lambda previous, i: previous * (n - i) // (i + 1), initial=1)


def paired_p(differences: Integers) -> float:
    """Exact two-sided p of a paired comparison, in (0, 1].

    If two systems are equally good, exchanging them in a pair of trials changes the sign of its difference
    and nothing else, so each sign has probability 1/2 (Fisher 1935). p is the probability that the sum of
    randomly signed differences is at least as far from 0 as the observed sum. It is counted in whole
    numbers: the number of patterns with positive differences of sum s is the coefficient of x^s in the
    product of (1 + x^|d|), which is multiplied out as one long integer (Kronecker substitution).

    Parameters
    ----------
    differences : (n_pairs,)
        Whole numbers, such as twice the difference of two sums of credits; zeros do not matter.

    Examples
    --------
    >>> paired_p(np.array([2, 2, -1, 0])), paired_p(np.array([1, -1]))
    (0.5, 1.0)
    """
    sizes = np.abs(differences)
    sizes = sizes[sizes > 0].tolist()
    observed = abs(int(differences.sum()))
    if not observed:
        return 1.0
    width = len(sizes) // 8 + 1  # bytes that hold any coefficient
    product = 1
    for size in sorted(set(sizes)):
        product *= (1 + (1 << (8 * width * size))) ** sizes.count(size)
    smallest = (observed + sum(sizes) + 1) // 2  # sum of the positive ones that reaches the observed sum
    tail = product >> (8 * width * smallest)
    digits = tail.to_bytes(width * (sum(sizes) - smallest + 1), "little")
    count = sum(int.from_bytes(digits[i : i + width], "little") for i in range(0, len(digits), width))
    share: float = 2 * count / 2 ** len(sizes)
    return max(share, SMALLEST)
