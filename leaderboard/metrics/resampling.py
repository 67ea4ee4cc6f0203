"""The bootstrap as weights: shared, reproducible draws, and percentile intervals."""

from dataclasses import dataclass
from math import floor

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.undefined import Undefined

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Counts = NDArray[np.uint16]

TAILS = (0.025, 0.975)
CHUNK = 1000  # resamples at a time stay in the processor's cache; even, so that no random number is split

PROBE = 16  # one in so many resamples tells about where the tails begin
REACH = 2.5  # times as far as needed: NumPy finds more than a tenth of all faster than fewer

INFLUENCE_BITS = 30
"""Derivatives are rounded to multiples of 2^-30 before they are summed."""


ALWAYS_UNDEFINED = Undefined("it has no value in any resample")


@dataclass(frozen=True)
class Interval:
    """An estimate with its 95 % percentile bootstrap interval.

    Attributes
    ----------
    value, low, high
        The estimate on the data, and the 2.5 % and 97.5 % points of its resamples.
    n_undefined
        Resamples in which it has no value, such as a correlation without variance. The interval is that of
        the others.
    """

    value: float
    low: float
    high: float
    n_undefined: int = 0


def draw_weights(strata: Integers, n_resamples: int, *, seed: int, stream: int) -> Counts:
    """Draw bootstrap resamples within strata, as how often each unit is drawn.

    In each resample as many units are drawn from a stratum, with replacement, as it has (Efron 1979). A unit
    is chosen by the high bits of r m for a 32-bit random number r and m units (Lemire 2019, without
    rejection: no probability is off by more than 2^-32). The numbers are raw ones of PCG64, whose stream
    NumPy keeps between versions (NEP 19), not of its generators' distributions, which may change.

    Parameters
    ----------
    strata : (n_units,)
        Which stratum each unit is in, as non-negative integers.
    n_resamples
        How many resamples.
    seed, stream
        Equal numbers give equal draws; different streams of one seed are independent.

    Returns
    -------
    (n_resamples, n_units), whole numbers whose sum over each stratum is its size; a unit's are next to each
    other in memory

    Examples
    --------
    >>> draw_weights(np.array([0, 0, 0, 1]), 2, seed=1, stream=0)
    array([[0, 2, 1, 1],
           [2, 0, 1, 1]], dtype=uint16)
    """
    bits = np.random.PCG64(np.random.SeedSequence([seed, stream]))
    weights = np.zeros((strata.size, n_resamples), np.uint16)
    for stratum in sorted(set(strata.tolist())):
        units = np.flatnonzero(strata == stratum)
        for start in range(0, n_resamples, CHUNK):
            n_rows = min(CHUNK, n_resamples - start)
            chosen = _draw_below(bits, units.size, n_rows)
            chosen += units.size * np.arange(n_rows)[:, None]
            counts = np.bincount(chosen.ravel(), minlength=n_rows * units.size)
            weights[units, start : start + n_rows] = counts.reshape(n_rows, units.size).T
    return weights.T


def percentile_interval(value: float, resampled: Floats) -> Interval | Undefined:
    """Give the 95 % percentile interval (Efron 1981) of an estimate; NaN counts as undefined.

    Parameters
    ----------
    value
        The estimate on the data.
    resampled : (n_resamples,)
        The estimate on each resample; percentiles interpolate linearly between neighbours.

    Examples
    --------
    >>> percentile_interval(0.5, np.arange(0.0, 41.0))
    Interval(value=0.5, low=1.0, high=39.0, n_undefined=0)
    """
    has_undefined = np.isnan(np.maximum.reduce(resampled, initial=0))  # the largest is NaN if any value is
    defined = resampled[~np.isnan(resampled)] if has_undefined else resampled
    last = defined.size - 1
    if last < 0:
        return ALWAYS_UNDEFINED
    places = [floor(tail * last) for tail in TAILS]
    ordered = _sort_tails(defined, places[0] + 2, defined.size - places[1])
    n_left_out = defined.size - ordered.size
    ends = []
    for tail, below, n_before in zip(TAILS, places, (0, n_left_out), strict=True):
        lower, upper = (float(ordered[place - n_before]) for place in (below, min(below + 1, last)))
        ends.append(lower + (upper - lower) * (tail * last - below))
    return Interval(value, ends[0], ends[1], resampled.size - defined.size)


def on_grid(values: Floats, bits: int = 20) -> Floats:
    """Round to multiples of 2^-bits, so that sums of them, and of their products in pairs, are exact.

    A float64 holds 53 bits: a sum of weighted products of two numbers of 20 bits in [-1, 1] stays exact up
    to a total weight of 8,192. Exact sums are the same in any order of addition, so on any machine.

    >>> on_grid(np.array([0.3]), bits=2)
    array([0.25])
    """
    rounded: Floats = np.rint(np.ldexp(values, bits))
    return np.ldexp(rounded, -bits)


def _sort_tails(values: Floats, n_lowest: int, n_highest: int) -> Floats:
    """Sort without the middle: at least so many of the lowest values, then at least so many of the highest.

    Where the tails begin is guessed from every 16th value, generously. Where that was not enough, or there
    are few values, all are sorted.
    """
    probe = np.sort(values[::PROBE])
    reach = min(int(REACH * max(n_lowest, n_highest)) // PROBE, probe.size - 1)
    is_low, is_high = values <= probe[reach], values >= probe[-1 - reach]
    if np.count_nonzero(is_low) < n_lowest or np.count_nonzero(is_high) < n_highest:
        return np.sort(values)
    is_low |= is_high
    tails: Floats = values.take(is_low.nonzero()[0])
    tails.sort()
    return tails


def _draw_below(bits: np.random.PCG64, bound: int, n_rows: int) -> Integers:
    """Draw whole numbers below ``bound``, shape (n_rows, bound)."""
    size = n_rows * bound
    raw = bits.random_raw((size + 1) // 2).astype("<u8", copy=False).view("<u4")[:size].astype(np.uint64)
    raw *= np.uint64(bound)
    raw >>= np.uint64(32)
    return raw.view(np.int64).reshape(n_rows, bound)
