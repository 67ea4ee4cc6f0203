"""How likely streaks and alternation are in a row of answers: runs of equal ones, in any order.

A row of ones and zeros is cut into runs, the longest stretches of equal answers. Given how many ones and
zeros there are, all orders are equally likely: that is what both formulas are about, so nothing is assumed of
how often somebody says YES. Source: Wald & Wolfowitz (1940), On a test whether two samples are from the same
population, Annals of Mathematical Statistics 11, 147-162.
"""

from math import comb

import numpy as np
from numpy.typing import NDArray

Integers = NDArray[np.int64]


def measure_runs(answers: Integers) -> Integers:
    """Length of each run, in the order of the answers.

    Parameters
    ----------
    answers : (n_answers,)
        0 or 1.

    Examples
    --------
    >>> measure_runs(np.array([1, 1, 0, 1])), measure_runs(np.array([], int))
    (array([2, 1, 1]), array([], dtype=int64))
    """
    if not answers.size:
        return np.zeros(0, np.int64)
    starts = np.flatnonzero(np.diff(answers, prepend=answers[0] - 1))
    return np.diff(starts, append=answers.size).astype(np.int64)


def expect_streaks(n_ones: int, n_zeros: int, length: int) -> float:
    """How many runs of at least this length to expect; no smaller than the chance that there is one.

    A run of ones that is as long starts at the first place, with its ones where comb(n - length, n_zeros) of
    the comb(n, n_zeros) orders have them, or at one of the n - length places after that, just behind a zero:
    comb(n - length - 1, n_zeros - 1) orders each. Likewise for zeros. Where few are expected, this is hardly
    more than the chance of one.

    Parameters
    ----------
    n_ones, n_zeros
        How many there are.
    length
        1 or more.

    Examples
    --------
    >>> expect_streaks(2, 1, 2), expect_streaks(3, 0, 3), expect_streaks(3, 0, 4)
    (0.6666666666666666, 1.0, 0.0)
    """
    n = n_ones + n_zeros
    orders = _count_starts(n, n_zeros, length) + _count_starts(n, n_ones, length)
    return orders / comb(n, n_ones)


def runs_p(n_ones: int, n_zeros: int, n_runs: int) -> float:
    """Probability of at least so many runs, exactly: small where answers alternate too well.

    Of the orders, 2 comb(n_ones - 1, r - 1) comb(n_zeros - 1, r - 1) have 2r runs, and
    comb(n_ones - 1, r) comb(n_zeros - 1, r - 1) + comb(n_ones - 1, r - 1) comb(n_zeros - 1, r) have 2r + 1.

    Examples
    --------
    >>> runs_p(2, 2, 4), runs_p(16, 16, 1)
    (0.3333333333333333, 1.0)
    """
    n_most = 2 * min(n_ones, n_zeros) + (n_ones != n_zeros)
    orders = sum(_count_orders(n_ones, n_zeros, runs) for runs in range(max(n_runs, 1), n_most + 1))
    return orders / comb(n_ones + n_zeros, n_ones)


def _count_starts(n: int, n_others: int, length: int) -> int:
    """Count runs of at least this length over all orders, of what is not the others."""
    if n - n_others < length:
        return 0
    at_first = comb(n - length, n_others)
    return at_first + ((n - length) * comb(n - length - 1, n_others - 1) if n_others else 0)


def _count_orders(n_ones: int, n_zeros: int, n_runs: int) -> int:
    """Count the orders with exactly so many runs."""
    if not n_ones or not n_zeros:
        return int(n_runs == 1)
    half, is_odd = divmod(n_runs, 2)
    if not half:
        return 0
    ones, zeros = comb(n_ones - 1, half - 1), comb(n_zeros - 1, half - 1)
    if not is_odd:
        return 2 * ones * zeros
    return comb(n_ones - 1, half) * zeros + ones * comb(n_zeros - 1, half)
