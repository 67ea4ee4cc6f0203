"""The bootstrap as weights: shared, reproducible draws, and percentile intervals."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.undefined import Undefined

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Counts = NDArray[np.uint16]

TAILS = (0.025, 0.975)


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
    (n_resamples, n_units), whole numbers whose sum over each stratum is its size

    Examples
    --------
    >>> draw_weights(np.array([0, 0, 0, 1]), 2, seed=1, stream=0)
    array([[0, 2, 1, 1],
           [2, 0, 1, 1]], dtype=uint16)
    """
    bits = np.random.PCG64(np.random.SeedSequence([seed, stream]))
    weights = np.zeros((n_resamples, strata.size), np.uint16)
    for stratum in sorted(set(strata.tolist())):
        units = np.flatnonzero(strata == stratum)
        chosen = _draw_below(bits, units.size, n_resamples)
        flat = chosen + units.size * np.arange(n_resamples)[:, None]
        counts = np.bincount(flat.ravel(), minlength=n_resamples * units.size)
        weights[:, units] = counts.reshape(n_resamples, units.size)
    return weights


def percentile_interval(value: float, resampled: Floats) -> Interval | Undefined:
    """Give the 95 % percentile interval (Efron 1981) of resampled values, of which NaN counts as undefined.

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
    defined = resampled[~np.isnan(resampled)]
    if not defined.size:
        return Undefined("it has no value in any resample")
    low, high = np.quantile(defined, TAILS).tolist()
    return Interval(value, low, high, resampled.size - defined.size)


def resample_correlation(predicted: Floats, observed: Floats, weights: Floats) -> Floats:
    """Compute Pearson's r on each resample; NaN where one side does not vary.

    Parameters
    ----------
    predicted : (n_trials,)
    observed : (n_trials,) or (n_resamples, n_trials)
        One for all resamples, or one for each, such as the mean of resampled people.
    weights : (n_resamples, n_trials)
        How often each trial is drawn.

    Returns
    -------
    (n_resamples,), each in [-1, 1] or NaN
    """
    # Centred at a common point first, so that little is lost when squares of means are subtracted.
    x = np.broadcast_to(predicted - predicted.mean(), weights.shape)
    y = np.broadcast_to(observed - observed.mean(), weights.shape)
    n = weights.sum(axis=1)
    sums = [np.einsum("ij,ij,ij->i", weights, a, b) for a, b in ((x, x), (y, y), (x, y))]
    mean_x, mean_y = (np.einsum("ij,ij->i", weights, v) / np.maximum(n, 1) for v in (x, y))
    spread_x, spread_y = sums[0] - n * mean_x**2, sums[1] - n * mean_y**2
    varies = (spread_x > _ROUNDING * sums[0]) & (spread_y > _ROUNDING * sums[1])
    scale = np.sqrt(np.where(varies, spread_x * spread_y, 1))
    r = np.clip((sums[2] - n * mean_x * mean_y) / scale, -1, 1)
    return np.where(varies, r, np.nan)


# A spread this small beside the sum of squares is what rounding leaves of none.
_ROUNDING = 1e-12


def _draw_below(bits: np.random.PCG64, bound: int, n_rows: int) -> Integers:
    """Draw whole numbers below ``bound``, shape (n_rows, bound)."""
    size = n_rows * bound
    raw = bits.random_raw((size + 1) // 2).astype("<u8").view("<u4")[:size].astype(np.uint64)
    chosen: Integers = ((raw * np.uint64(bound)) >> np.uint64(32)).astype(np.int64).reshape(n_rows, bound)
    return chosen
