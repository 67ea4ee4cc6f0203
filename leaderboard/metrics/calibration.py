"""Probabilities as probabilities: ranking, sharpness and calibration."""

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.undefined import NO_RATED_TRIALS, NO_TRIALS, Estimate, Undefined

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

ONE_CLASS = Undefined("all labels are equal")
N_BINS = 10


def auc(probabilities: Floats, labels: Integers) -> Estimate:
    """Area under the ROC curve, in [0, 1], chance 0.5: how often a YES trial outranks a NO trial, ties 1/2.

    Computed from the ranks of Mann and Whitney (1947), tied values sharing their mean rank. Undefined where
    all labels are equal.

    Parameters
    ----------
    probabilities, labels : (n_trials,)

    Examples
    --------
    >>> auc(np.array([0.1, 0.4, 0.4, 0.8]), np.array([0, 0, 1, 1]))
    0.875
    """
    if not labels.size:
        return NO_TRIALS
    n_yes = int(labels.sum())
    n_no = labels.size - n_yes
    if not n_yes or not n_no:
        return ONE_CLASS
    _, inverse, counts = np.unique(probabilities, return_inverse=True, return_counts=True)
    # Twice the mean rank of each distinct value is whole, so the sum is exact.
    twice_ranks = 2 * np.cumsum(counts) - counts + 1
    twice_sum = int(twice_ranks[inverse][labels == 1].sum())
    return (twice_sum - n_yes * (n_yes + 1)) / (2 * n_yes * n_no)


def brier(probabilities: Floats, labels: Integers) -> Estimate:
    """Mean squared difference between P(YES) and the label (Brier 1950), in [0, 1], lower is better.

    >>> brier(np.array([0.5, 1.0]), np.array([1, 1]))
    0.125
    """
    return float(np.mean((probabilities - labels) ** 2)) if labels.size else NO_TRIALS


def ece(probabilities: Floats, labels: Integers | Floats) -> Estimate:
    """Expected calibration error over 10 equal-width bins (Guo et al. 2017), in [0, 1], lower is better.

    The sum over bins of (trials in the bin / trials) times the distance between the mean label and the mean
    probability there. Bins are (0.0, 0.1], ..., (0.9, 1.0], with 0 in the first.

    >>> round(ece(np.array([0.9, 0.9, 0.2]), np.array([1, 0, 0])), 6)
    0.333333
    """
    if not labels.size:
        return NO_TRIALS
    excess = np.bincount(find_bins(probabilities), probabilities - labels, minlength=N_BINS)
    return float(np.abs(excess).sum() / labels.size)


def human_ece(predicted: Floats, observed: Floats) -> Estimate:
    """Calibration error toward people, in [0, 1], lower is better: as ``ece``, with human means for labels.

    Parameters
    ----------
    predicted, observed : (n_rated,)

    Examples
    --------
    >>> human_ece(np.array([0.75, 0.75]), np.array([0.5, 1.0]))
    0.0
    """
    return NO_RATED_TRIALS if not predicted.size else ece(predicted, observed)


def find_bins(probabilities: Floats) -> Integers:
    """Number the calibration bin of each probability, 0 to 9; the bins are those of ``ece``.

    >>> find_bins(np.array([0.0, 0.1, 0.15, 1.0])).tolist()
    [0, 0, 1, 9]
    """
    return np.searchsorted(np.arange(1, N_BINS) / N_BINS, probabilities, side="left")


def yes_rate(probabilities: Floats) -> Estimate:
    """Share of trials with P(YES) above 0.5, ties 1/2, in [0, 1].

    >>> yes_rate(np.array([0.9, 0.5, 0.1, 0.1]))
    0.375
    """
    if not probabilities.size:
        return NO_TRIALS
    return float(np.mean((1 + np.sign(probabilities - 0.5)) / 2))
