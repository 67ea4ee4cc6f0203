"""How well the people's means would be reproduced by other people, and so how well they can be predicted."""

from dataclasses import dataclass
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.agreement import CONSTANT_OBSERVED, MIN_TRIALS, NOT_RELIABLE
from leaderboard.metrics.splits import Halves, Tables
from leaderboard.metrics.undefined import Estimate, Undefined

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

NO_SPLIT = Undefined("in no split of the people do the means of both halves vary")
HALVES_OPPOSED = Undefined("the halves of the people are perfectly opposed")
TOO_FEW_RATED_TWICE = Undefined("fewer than two trials were rated by two people")

DIGITS = 12
"""To so many decimals estimates are rounded, lest rounding errors hide that one is 0 or -1 exactly."""


@dataclass(frozen=True)
class Reliability:
    """An estimate of reliability, and how much each trial and each person moves it.

    With trials weighted by w and people by u instead of 1, the estimate is to first order
    value + sum((w - 1) trial_influence) + sum((u - 1) person_influence): the infinitesimal jackknife
    (Jaeckel 1972, Efron 1982). Both influences are 0 where there is no value.

    Attributes
    ----------
    value
        At most 1; may be negative, as an estimate of something small.
    trial_influence : (n_trials,)
        Sums to 0, since only the proportions of weights matter; 0 for trials that are left out.
    response_influence : (n_people, n_trials)
        By single responses, 0 where a person did not judge a trial; their sums are the influence of people.
        Empty where single responses are unknown.
    """

    value: Estimate
    trial_influence: Floats
    response_influence: Floats

    @property
    def person_influence(self) -> Floats:
        """The influence of each person, (n_people,)."""
        sums: Floats = self.response_influence.sum(axis=1)
        return sums


@dataclass(frozen=True)
class SplitHalf:
    """What random halves of the people tell.

    Attributes
    ----------
    split_half_r
        Mean correlation of the halves: the reliability of the means of half as many people.
    reliability
        Of the means of all people.
    n_undefined
        Splits without a correlation, since the means of a half do not vary.
    """

    split_half_r: Reliability
    reliability: Reliability
    n_undefined: int


@dataclass(frozen=True)
class _Standardized:
    """The means of both halves, centred in each split over the trials that both rated, and of length 1.

    Attributes
    ----------
    values : (2, n_splits, n_trials)
        0 on trials that a half did not rate, and throughout where a half does not vary.
    lengths : (2, n_splits)
        What the centred means were divided by; infinite where a half does not vary.
    """

    values: Floats
    lengths: Floats


def split_half_reliability(halves: Halves) -> SplitHalf:
    """Estimate reliability from random halves of the people.

    In each split r is Pearson's correlation of the halves' means over the trials that both rated. The mean r
    over splits, stepped up to all people by the formula of Spearman (1910) and Brown (1910), is
    2 r / (1 + r). Undefined if no split has an r, or if r = -1.

    To first order, a trial of weight w moves r by z_A z_B - r (z_A^2 + z_B^2) / 2, with z the halves' centred
    means scaled to length 1. A person of weight u in half A moves the mean h_A of a trial by
    (x - h_A) / n_A, and that moves r by (z_B - r z_A) / length of the centred h_A.

    Parameters
    ----------
    halves
        From ``count_halves``.

    Examples
    --------
    >>> from leaderboard.metrics.splits import count_halves
    >>> persons, trials = np.repeat([0, 1], 4), np.tile([0, 1, 2, 3], 2)
    >>> answers = np.array([1, 1, 0, 0, 1, 1, 1, 0])
    >>> found = split_half_reliability(count_halves(np.array([[True, False]]), persons, trials, answers, 4))
    >>> round(found.split_half_r.value, 6), round(found.reliability.value, 6)
    (0.57735, 0.732051)
    """
    sums = [_sum_splits(batch) for batch in halves.batches()]
    n_defined, total, by_trial, by_person = (sum(parts) for parts in zip(*sums, strict=True))
    n_undefined = len(halves.is_first) - n_defined
    if not n_defined:
        nothing = Reliability(NO_SPLIT, by_trial, by_person)
        return SplitHalf(nothing, nothing, n_undefined)
    r = round(total / n_defined, DIGITS)
    split_half_r = Reliability(r, by_trial / n_defined, by_person / n_defined)
    return SplitHalf(split_half_r, _step_up(split_half_r, r), n_undefined)


def count_reliability(n: Integers, n_yes: Integers, tables: Tables | None = None) -> Reliability:
    """Estimate reliability from counts alone: 1 - mean(h (1 - h) / (n - 1)) / var(h).

    h (1 - h) / (n - 1) is without bias the variance that sampling n people gives to a trial's mean h, and
    var(h), with one less than the number of trials in its denominator, is that of all causes together; over
    the trials that at least two people rated. Undefined with fewer than two such trials, or if h is the same
    on all of them.

    Parameters
    ----------
    n, n_yes : (n_trials,)
        Answers to each trial, and of these YES.
    tables
        The single answers behind the counts, for the influence of people; their weights move n as well as h.

    Examples
    --------
    >>> round(count_reliability(np.array([4, 4, 4]), np.array([0, 2, 4])).value, 6)
    0.888889
    """
    n_people = len(tables.judged) if tables else 0
    usable = n >= MIN_TRIALS
    n_usable = int(usable.sum())
    if n_usable < MIN_TRIALS:
        return _without_value(TOO_FEW_RATED_TWICE, n.size, n_people)
    h, others = n_yes[usable] / n[usable], n[usable] - 1
    if np.ptp(h) == 0:
        return _without_value(CONSTANT_OBSERVED, n.size, n_people)
    distances, sampling = h - h.mean(), h * (1 - h) / others
    noise, variance = float(sampling.mean()), float((distances**2).sum() / (n_usable - 1))
    share = noise / variance
    by_weight, by_mean, by_count = np.zeros((3, n.size))
    by_weight[usable] = share * distances**2 / (n_usable - 1) - sampling / n_usable
    by_mean[usable] = 2 * share * distances / (n_usable - 1) - (1 - 2 * h) / others / n_usable
    by_count[usable] = sampling / others / n_usable
    by_response = np.zeros((0, n.size))
    if tables:
        by_mean, all_h = by_mean / np.maximum(n, 1), n_yes / np.maximum(n, 1)
        by_response = tables.said_yes * by_mean + tables.judged * (by_count - by_mean * all_h)
    return Reliability(round(1 - share, DIGITS), by_weight / variance, by_response / variance)


def ceiling_of(reliability: Estimate) -> Estimate:
    """Give the highest correlation with the people's means that noise in them allows: sqrt(reliability).

    Noise in one of two variables keeps their correlation below the root of its reliability (Spearman 1904).
    The split-half r is lower, being the correlation of two noisy variables of half as many people each.
    Undefined as the reliability is, and where it is not above 0.

    >>> ceiling_of(0.64)
    0.8
    """
    if isinstance(reliability, Undefined):
        return reliability
    return sqrt(reliability) if reliability > 0 else NOT_RELIABLE


def _sum_splits(halves: Halves) -> tuple[int, float, Floats, Floats]:
    """Sum over the splits that have an r: their number, r, and its influences by trial and by person."""
    standardized = _standardize(halves)
    z, lengths = standardized.values, standardized.lengths
    r = np.einsum("st,st->s", z[0], z[1])
    slopes = z[::-1] - r[:, None] * z
    by_trial = np.einsum("hst,hst->t", z, slopes) / 2
    slopes /= lengths[:, :, None]
    n_defined = int(np.isfinite(lengths[0]).sum())
    return n_defined, float(r.sum()), by_trial, _pull_responses(slopes, halves)


def _standardize(halves: Halves) -> _Standardized:
    """Centre and scale; a first mean is subtracted before, so that equal means leave nothing."""
    usable = (halves.n > 0).all(axis=0)
    inside = usable.astype(np.float64)
    first = np.argmax(usable, axis=1)[None, :, None]
    centred = halves.means - np.take_along_axis(halves.means, first, axis=2)
    centred *= inside
    centred -= centred.sum(axis=2, keepdims=True) / np.maximum(inside.sum(axis=1), 1)[:, None]
    centred *= inside
    lengths = np.sqrt(np.einsum("hst,hst->hs", centred, centred))
    lengths = np.where((lengths > 0).all(axis=0), lengths, np.inf)
    centred /= lengths[:, :, None]
    return _Standardized(centred, lengths)


def _pull_responses(slopes: Floats, halves: Halves) -> Floats:
    """Sum over splits what the weights of responses do by way of the mean of their half.

    A response in the first half adds slope (x - h) / n with its slopes, one in the second half with the
    second's: as if all were in the second half, and those of the first add the difference.

    Parameters
    ----------
    slopes : (2, n_splits, n_trials)
        Derivatives by the halves' means.

    Returns
    -------
    (n_people, n_trials)
    """
    members = halves.is_first.astype(np.float64).T
    by_answer = slopes / np.maximum(halves.n, 1)
    by_rating = by_answer * halves.means
    sums = [members @ (v[0] - v[1]) + v[1].sum(axis=0) for v in (by_answer, by_rating)]
    pulls: Floats = halves.tables.said_yes * sums[0] - halves.tables.judged * sums[1]
    return pulls


def _step_up(half: Reliability, r: float) -> Reliability:
    """Apply the formula of Spearman and Brown, whose derivative is 2 / (1 + r)^2."""
    if r == -1:
        return _without_value(HALVES_OPPOSED, half.trial_influence.size, len(half.response_influence))
    slope = 2 / (1 + r) ** 2
    return Reliability(2 * r / (1 + r), slope * half.trial_influence, slope * half.response_influence)


def _without_value(why: Undefined, n_trials: int, n_people: int) -> Reliability:
    return Reliability(why, np.zeros(n_trials), np.zeros((n_people, n_trials)))
