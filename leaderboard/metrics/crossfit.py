"""Easy and hard trials chosen by one half of the people and measured on the other.

Whoever chooses trials on which some people were right finds those people good on them, even where all trials
are equally difficult. Other people have no part in that luck.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.agreement import CONSTANT_OBSERVED, CONSTANT_PREDICTED
from leaderboard.metrics.pairs import find_pairs
from leaderboard.metrics.splits import Halves
from leaderboard.metrics.undefined import Estimate, Undefined

if TYPE_CHECKING:
    from fractions import Fraction

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

NEVER_CHOSEN = Undefined("no half of the people chooses any of these trials")
NEVER_MEASURED = Undefined("of the trials that one half of the people chooses, the other rated none")

ROUNDING = 1e-12
"""A variance of people's means this small is what rounding leaves of none."""


@dataclass(frozen=True)
class CrossSubset:
    """A subset as weights of trials, pooled over the cases: each split, with either half choosing.

    Attributes
    ----------
    chosen, rated : (n_trials,), each in [0, 1]
        Share of cases in which the trial's pair is chosen, and in which the other half rated the trial too.
    mean_sum, square_sum, right_sum : (n_trials,), each in [0, 1]
        Sums over the latter cases of the other half's share of YES, of its square, and of the other half's
        accuracy, divided by the number of all cases.
    n_trials, n_pairs
        Mean numbers of trials and of complete pairs chosen in a case.
    """

    chosen: Floats
    rated: Floats
    mean_sum: Floats
    square_sum: Floats
    right_sum: Floats
    n_trials: float
    n_pairs: float


@dataclass(frozen=True)
class CrossFit:
    """The easy and the hard trials.

    Attributes
    ----------
    easy, hard
        The two subsets.
    n_pairs_in_both
        Mean number of complete pairs chosen as both in the same case.
    """

    easy: CrossSubset
    hard: CrossSubset
    n_pairs_in_both: float


def cross_fit(
    halves: Halves, labels: Integers, pairs: Integers, *, easy: "Fraction", hard: "Fraction"
) -> CrossFit:
    """Choose easy and hard pairs by each half of the people, and measure the other half on them.

    A pair is easy if at least one member's accuracy in the choosing half is above ``easy``, hard if at least
    one's is below ``hard``; a trial that this half did not rate is neither. Comparisons are exact. This is
    sample splitting with the roles of the halves exchanged (Cox 1975; Chernozhukov et al. 2018).

    Parameters
    ----------
    halves
        From ``count_halves``.
    labels : (n_trials,)
        1 for YES, 0 for NO.
    pairs : (n_trials,)
        Which pair each trial belongs to, as non-negative integers.
    easy, hard
        Bounds of accuracy.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from leaderboard.metrics.splits import count_halves
    >>> persons, trials, answers = np.array([0, 0, 1, 1]), np.array([0, 1, 0, 1]), np.array([1, 0, 1, 1])
    >>> halves = count_halves(np.array([[True, False]]), persons, trials, answers, 2)
    >>> labels, pairs = np.array([1, 1]), np.array([0, 1])
    >>> found = cross_fit(halves, labels, pairs, easy=Fraction(2, 3), hard=Fraction(1, 3))
    >>> found.easy.chosen, found.easy.n_trials, human_accuracy_on(found.easy)
    (array([1. , 0.5]), 1.5, 0.6666666666666666)
    """
    positions = np.unique(pairs, return_inverse=True)[1]
    sums = np.zeros((9, labels.size))
    for batch in halves.batches():
        is_easy, is_hard = _choose_pairs(batch, labels, positions, (easy, hard))
        sums[:4] += _sum_cases(is_easy, batch, positions)
        sums[4:8] += _sum_cases(is_hard, batch, positions)
        sums[8] += (is_easy & is_hard).sum(axis=(0, 1))[positions]
    sums /= 2 * len(halves.is_first)
    easy_subset, hard_subset = (_describe(rows, labels, pairs) for rows in (sums[:4], sums[4:8]))
    return CrossFit(easy_subset, hard_subset, _count_pairs(sums[8], pairs))


def human_accuracy_on(subset: CrossSubset) -> Estimate:
    """Mean accuracy of the half that did not choose, over cases and the trials that it rated, in [0, 1]."""
    total = float(subset.rated.sum())
    if total == 0:
        return _why_empty(subset)
    return float(subset.right_sum.sum()) / total


def accuracy_on(subset: CrossSubset, credits: Floats) -> Estimate:
    """Mean credit over cases and the trials chosen in them, in [0, 1].

    Parameters
    ----------
    credits : (n_trials,)

    Examples
    --------
    >>> none = np.zeros(2)
    >>> subset = CrossSubset(np.array([0.75, 0.25]), none, none, none, none, n_trials=1.0, n_pairs=0.0)
    >>> accuracy_on(subset, np.array([1.0, 0.0]))
    0.75
    """
    total = float(subset.chosen.sum())
    if total == 0:
        return NEVER_CHOSEN
    return float((subset.chosen * credits).sum()) / total


def human_r_on(subset: CrossSubset, predicted: Floats) -> Estimate:
    """Pearson correlation, pooled over cases, of P(YES) with the other half's share of YES, in [-1, 1].

    Undefined if nothing was chosen and rated, or if either does not vary.

    Parameters
    ----------
    predicted : (n_trials,)
        P(YES), 0.5 where it is missing.
    """
    is_in = subset.rated > 0
    if not is_in.any():
        return _why_empty(subset)
    shares = subset.rated[is_in] / subset.rated[is_in].sum()
    shifted = predicted[is_in] - predicted[is_in][0]  # so that equal values leave nothing
    largest = np.abs(shifted).max()
    if largest == 0:
        return CONSTANT_PREDICTED
    q = shifted / largest
    q -= (shares * q).sum()
    means, squares = (v[is_in] / subset.rated[is_in].sum() for v in (subset.mean_sum, subset.square_sum))
    variance = squares.sum() - means.sum() ** 2
    if variance < ROUNDING:
        return CONSTANT_OBSERVED
    covariance = (q * means).sum()  # q is centred, so the mean of the other need not be subtracted
    return float(np.clip(covariance / np.sqrt((shares * q**2).sum() * variance), -1, 1))


def _choose_pairs(
    halves: Halves, labels: Integers, positions: Integers, bounds: tuple["Fraction", "Fraction"]
) -> tuple[Booleans, Booleans]:
    """Let each half choose the easy and the hard pairs.

    Counts are whole numbers held as floats, whose products with a bound's terms are exact up to 2^53.

    Parameters
    ----------
    positions : (n_trials,)
        Index of each trial's pair.

    Returns
    -------
    Two of (2, n_splits, n_pairs), in the order of the half that measures, not of the one that chooses
    """
    right = np.where(labels == 1, halves.n_yes, halves.n - halves.n_yes)
    easy, hard = bounds
    is_easy = right * easy.denominator > halves.n * easy.numerator
    is_hard = right * hard.denominator < halves.n * hard.numerator
    is_member = (positions[:, None] == np.arange(positions.max() + 1)).astype(np.float32)
    easy_pairs, hard_pairs = (mask.astype(np.float32) @ is_member > 0 for mask in (is_easy, is_hard))
    return easy_pairs[::-1], hard_pairs[::-1]


def _sum_cases(is_chosen: Booleans, halves: Halves, positions: Integers) -> Floats:
    """Sum over cases: chosen, rated, the measuring half's means and their squares; (4, n_trials)."""
    measured = (is_chosen[:, :, positions] & (halves.n > 0)).astype(np.float64)
    means = measured * halves.means
    chosen = is_chosen.sum(axis=(0, 1))[positions]
    squares = np.einsum("hst,hst->t", means, halves.means)
    return np.stack([chosen, measured.sum(axis=(0, 1)), means.sum(axis=(0, 1)), squares])


def _describe(sums: Floats, labels: Integers, pairs: Integers) -> CrossSubset:
    chosen, rated, mean_sum, square_sum = sums
    return CrossSubset(
        chosen=chosen,
        rated=rated,
        mean_sum=mean_sum,
        square_sum=square_sum,
        right_sum=np.where(labels == 1, mean_sum, rated - mean_sum),
        n_trials=float(chosen.sum()),
        n_pairs=_count_pairs(chosen, pairs),
    )


def _count_pairs(chosen: Floats, pairs: Integers) -> float:
    """Sum over complete pairs of the share of cases in which they are chosen."""
    return float(chosen[find_pairs(pairs)[:, 0]].sum())


def _why_empty(subset: CrossSubset) -> Undefined:
    return NEVER_MEASURED if subset.chosen.any() else NEVER_CHOSEN
