"""Probabilities as probabilities: ranking, sharpness and calibration."""

from itertools import groupby
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.undefined import NO_RATED_TRIALS, NO_TRIALS, Estimate, Undefined

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Unsigned = NDArray[np.unsignedinteger[Any]]

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


def count_outranked(probabilities: Floats, labels: Integers, positions: Integers, drawn: Unsigned) -> Floats:
    """Count, in each resample, the drawn YES and NO trials of which the YES trial has the higher P(YES).

    Ties count 1/2. Trials are gone through by ascending P(YES), adding up the NO trials met so far: so many
    each YES trial outranks. All is done for all resamples at once, in short whole numbers: few sums of rows
    instead of the product of all YES with all NO trials.

    Parameters
    ----------
    probabilities, labels, positions : (n_trials,)
        ``positions`` says in which row of ``drawn`` each trial's pair is.
    drawn : (n_pairs, n_resamples)
        How often each pair is drawn, in a type that also holds the product of the drawn YES and NO trials.

    Examples
    --------
    >>> q, labels, drawn = np.array([0.1, 0.4, 0.4, 0.8]), np.array([0, 0, 1, 1]), np.array([[1, 0], [1, 2]])
    >>> count_outranked(q, labels, np.array([0, 1, 1, 0]), drawn.astype(np.uint16))
    array([3.5, 2. ])
    """
    n_no, outranked, tied, n_yes, n_equal, product = np.zeros((6, drawn.shape[1]), drawn.dtype)
    for yes, no, are_equal in _list_steps(probabilities, labels, positions):
        if yes:
            of_yes = _add_rows(drawn, yes, n_yes)
            np.add(outranked, np.multiply(of_yes, n_no, out=product), out=outranked)
            if are_equal:
                of_no = _add_rows(drawn, no, n_equal)
                np.add(tied, np.multiply(of_yes, of_no, out=product), out=tied)
        for row in no:
            np.add(n_no, drawn[row], out=n_no)
    return outranked + tied / 2


def _list_steps(
    probabilities: Floats, labels: Integers, positions: Integers
) -> list[tuple[list[int], list[int], bool]]:
    """Go up through P(YES): rows of YES trials, of NO trials above them, and whether these are equal instead.

    YES trials with no NO trial in between, and NO trials with no YES trial in between, are taken together.
    """
    order = np.argsort(probabilities, kind="stable")
    trials = zip(*(values[order].tolist() for values in (probabilities, labels, positions)), strict=True)
    steps: list[tuple[list[int], list[int], bool]] = [([], [], False)]
    for _, group in groupby(trials, key=itemgetter(0)):
        rows: tuple[list[int], list[int]] = [], []
        for _, label, row in group:
            rows[label].append(row)
        no, yes = rows
        are_equal = bool(yes and no)
        if are_equal or steps[-1][2] or (yes and steps[-1][1]):
            steps.append((yes, no, are_equal))
        else:
            steps[-1][0].extend(yes)
            steps[-1][1].extend(no)
    return steps


def _add_rows(drawn: Unsigned, rows: list[int], total: Unsigned) -> Unsigned:
    """Add some rows up, in ``total`` unless it is one."""
    if len(rows) == 1:
        row: Unsigned = drawn[rows[0]]
        return row
    np.add(drawn[rows[0]], drawn[rows[1]], out=total)
    for number in rows[2:]:
        np.add(total, drawn[number], out=total)
    return total


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
