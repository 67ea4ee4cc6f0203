"""How sure ranks are: rank sets, the chance to be the best, the group of the best, what can be detected.

Everywhere ``shares`` says in whole numbers what each pair of trials adds to a system's score, with shape
(n_systems, n_pairs). Sums of whole numbers are exact: equal systems stay equal on every resample.
"""

from math import inf
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.exact_tests import paired_p
from leaderboard.metrics.undefined import Estimate, Undefined

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]
Weights = NDArray[np.number[Any]]
Scores = NDArray[np.floating[Any]]

ALPHA = 0.05
POWER = 0.8
EXACT_IN_FLOAT32 = 2**24
MAX_COMPARISONS = 600_000_000
MIN_RESAMPLES = 1000
ONE_SYSTEM = Undefined("there are fewer than two different systems")

MARGIN = 1e-6
"""What is this near to the critical value equals it but for rounding, and is not significant."""

ROUNDING = 1e-9
"""A variance this small beside those it is the difference of is what rounding leaves of none."""


def resample_scores(shares: Integers, weights: Weights) -> Scores:
    """Compute the score of each system on each resample, in float32 where that is exact, else in float64.

    Parameters
    ----------
    weights : (n_resamples, n_pairs)
        How often each pair is drawn, from ``draw_weights``.

    Returns
    -------
    (n_systems, n_resamples), whole numbers

    Examples
    --------
    >>> resample_scores(np.array([[2, 0], [0, 1]]), np.array([[1, 1], [0, 2]]))
    array([[2., 0.],
           [1., 2.]], dtype=float32)
    """
    largest = int(np.abs(shares).max(initial=0)) * shares.shape[1]
    kind = np.float32 if largest < EXACT_IN_FLOAT32 else np.float64
    scores: Scores = shares.astype(kind) @ weights.T.astype(kind, copy=False)
    return scores


def find_rank_sets(shares: Integers, strata: Integers, resampled: Scores) -> Integers:
    """Find the 95 % rank set of each system: the ranks that paired tests against all rivals do not exclude.

    With s the scores, a rival j of system i is significantly better if t = (s_j - s_i) / se_ij exceeds the
    95 % point, over resamples, of the largest |t| of any rival about its own mean (max-t of Romano and Wolf
    2005). The set goes from 1 + the number of rivals significantly better to the number of systems less those
    significantly worse (test inversion, as in Mogstad, Romano, Shaikh and Wilhelm 2024). se_ij is the exact
    bootstrap standard error, from the covariance of shares within strata. Where it is 0, any difference is
    significant. A set holds every rank that ties could be given.

    Equal systems are compared once. Beyond about 250 different ones critical values come from fewer
    resamples, but at least from the first 1,000, so that the work stays bounded.

    Parameters
    ----------
    strata : (n_pairs,)
        Within what pairs were drawn.
    resampled : (n_systems, n_resamples)
        From ``resample_scores``.

    Returns
    -------
    (n_systems, 2), lowest and highest rank, 1 being the best
    """
    different, first, copies, counts = _find_different(shares)
    scores = different.sum(axis=1)
    errors = _standard_errors(different, strata)
    n_used = max(MIN_RESAMPLES, MAX_COMPARISONS // len(different) ** 2)
    moved = resampled[first, :n_used] - scores[:, None].astype(resampled.dtype)
    critical = np.quantile(_find_largest(moved, errors), 1 - ALPHA, axis=1)[:, None] * (1 + MARGIN)
    t = _divide(scores - scores[:, None], errors)
    sets = np.column_stack([1 + (t > critical) @ counts, len(shares) - (t < -critical) @ counts])
    return sets[copies]


def find_best_probabilities(resampled: Scores) -> Floats:
    """Find the share of resamples in which each system has the highest score; ties share equally.

    Parameters
    ----------
    resampled : (n_systems, n_resamples)
        From ``resample_scores``.

    Returns
    -------
    (n_systems,), which sum to 1

    Examples
    --------
    >>> find_best_probabilities(np.array([[2.0, 0.0], [1.0, 2.0], [1.0, 2.0]])).tolist()
    [0.5, 0.25, 0.25]
    """
    is_best = resampled == resampled.max(axis=0)
    n_best = is_best.sum(axis=0)
    return np.array([(wins / n_best).mean() for wins in is_best])  # one at a time stays in the cache


def find_best_group(points: Integers, best: int) -> Booleans:
    """Find the systems that are not distinguishable from the best one.

    Each other system is tested against it by the exact two-sided sign-flip test over pairs, with Holm's
    correction for their number, at 5 %.

    Parameters
    ----------
    points : (n_systems, n_pairs)
        What each system earned on each pair, in small whole numbers such as twice the credits. Unlike shares
        they need not add up to the score: under the hypothesis that two systems are equally good, the test
        is exact whatever a pair weighs, and its cost grows with the numbers.
    best
        Which system is the best.

    Returns
    -------
    (n_systems,), true for the best itself

    Examples
    --------
    >>> points = np.array([[1] * 8, [1] * 7 + [0], [0] * 8])
    >>> find_best_group(points, 0).tolist()
    [True, True, False]
    """
    different, _, copies, _ = _find_different(points[best] - np.delete(points, best, axis=0))
    p = np.array([paired_p(row) for row in different])
    return np.insert(holm_adjust(p[copies]) >= ALPHA, best, values=True)


def holm_adjust(p: Floats) -> Floats:
    """Adjust p-values for their number by Holm's (1979) step-down procedure.

    Sorted upwards, p_(k) of m becomes the largest of (m - j + 1) p_(j) for j up to k, at most 1.

    >>> holm_adjust(np.array([0.04, 0.01, 0.03])).tolist()
    [0.06, 0.03, 0.06]
    """
    order = np.argsort(p, kind="stable")
    steps = p[order] * (p.size - np.arange(p.size))
    adjusted = np.empty(p.size)
    adjusted[order] = np.minimum(np.maximum.accumulate(steps), 1)
    return adjusted


def detectable_difference(shares: Integers, strata: Integers) -> Estimate:
    """Give the smallest difference in scores that a test at 5 % finds with a power of 80 %.

    (z_.975 + z_.80) times the root mean square of the standard errors of differences between different
    systems (Cohen 1988), in units of scores. Undefined with fewer than two different systems.

    Parameters
    ----------
    strata : (n_pairs,)
        Within what pairs are drawn.
    """
    different, _, _, _ = _find_different(shares)
    if len(different) <= 1:
        return ONE_SYSTEM
    errors = _standard_errors(different, strata)[np.triu_indices(len(different), 1)]
    normal = NormalDist()
    return (normal.inv_cdf(1 - ALPHA / 2) + normal.inv_cdf(POWER)) * float(np.sqrt(np.mean(errors**2)))


def _find_largest(moved: Scores, errors: Floats) -> NDArray[np.float32]:
    """Find, on each resample, the largest |t| of a system against any other, (n_systems, n_resamples).

    Parameters
    ----------
    moved : (n_systems, n_resamples)
        How far each score is from its mean.
    errors : (n_systems, n_systems)
    """
    small = moved.astype(np.float32, copy=False)  # twice as fast, and a percentile needs no more digits
    inverse = np.where(errors > 0, 1 / np.where(errors > 0, errors, 1), 0).astype(np.float32)
    largest = np.zeros_like(small)
    for i in range(len(small) - 1):
        t = np.abs(small[i + 1 :] - small[i])
        t *= inverse[i, i + 1 :, None]
        np.maximum(largest[i + 1 :], t, out=largest[i + 1 :])
        np.maximum(largest[i], t.max(axis=0), out=largest[i])
    return largest


def _find_different(shares: Integers) -> tuple[Integers, Integers, Integers, Integers]:
    """Find the different rows, where each is first, which of them each row is, and how often each occurs."""
    different, first, copies, counts = np.unique(
        shares, axis=0, return_index=True, return_inverse=True, return_counts=True
    )
    return different, first, copies.ravel(), counts


def _standard_errors(shares: Integers, strata: Integers) -> Floats:
    """Standard errors of differences between scores under the stratified bootstrap, (n_systems, n_systems).

    Drawing m pairs of a stratum with replacement gives the sum over them m times the variance of the shares
    in it, with m as denominator: the sum of squares about the mean.
    """
    centred = shares.astype(np.float64)
    for stratum in np.unique(strata):
        inside = strata == stratum
        centred[:, inside] -= centred[:, inside].mean(axis=1, keepdims=True)
    covariance = centred @ centred.T
    variances = np.diag(covariance)
    sums = variances[:, None] + variances
    squares = sums - 2 * covariance
    errors: Floats = np.sqrt(np.where(squares > ROUNDING * sums, squares, 0))
    return errors


def _divide(differences: Integers, errors: Floats) -> Floats:
    """Give t; infinite where a difference has no error, and 0 where there is no difference."""
    t = np.where(differences > 0, inf, np.where(differences < 0, -inf, 0.0))
    return np.divide(differences, errors, out=t, where=errors > 0)
