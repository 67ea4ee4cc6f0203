"""How good held-out probabilities are, on the trials that a readout is fitted on."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from leaderboard.errors import LeaderboardError
from leaderboard.metrics.accuracy import accuracy, credits_of
from leaderboard.metrics.calibration import N_BINS, auc, brier, ece, find_bins
from leaderboard.metrics.resampling import Interval, draw_weights, percentile_interval
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.models import Bin
from leaderboard.readout.features import Integers
from leaderboard.readout.outcome import Agreement

Floats = NDArray[np.float64]

N_RESAMPLES = 2_000


def measure_agreement(probabilities: Floats, labels: Integers) -> Agreement:
    """Compare held-out probabilities with the labels, by the metrics that submissions are graded with.

    >>> measure_agreement(np.array([0.9, 0.9, 0.1, 0.1]), np.array([1, 0, 0, 0])).accuracy
    0.75
    """
    credits = credits_of(probabilities, labels, np.ones(len(labels), bool))
    return Agreement(
        accuracy=_require(accuracy(credits)),
        auc=_require(auc(probabilities, labels)),
        brier=_require(brier(probabilities, labels)),
        ece=_require(ece(probabilities, labels)),
    )


def estimate_accuracy(probabilities: Floats, labels: Integers, pair_ids: Sequence[str]) -> Interval:
    """Accuracy of held-out probabilities with its 95 % bootstrap interval over pairs."""
    credits = credits_of(probabilities, labels, np.ones(len(labels), bool))
    _, pairs = np.unique(np.array(pair_ids), return_inverse=True)
    sums, sizes = np.bincount(pairs, credits), np.bincount(pairs)
    weights = draw_weights(np.zeros(len(sums), np.int64), N_RESAMPLES, seed=0, stream=0)
    resampled = (weights @ sums) / (weights @ sizes)
    found = percentile_interval(float(credits.mean()), resampled)
    return Interval(float(credits.mean()), np.nan, np.nan) if isinstance(found, Undefined) else found


def bin_probabilities(probabilities: Floats, labels: Integers) -> tuple[Bin, ...]:
    """Bin held-out probabilities for the reliability diagram; the bins are those of ``ece``.

    >>> bin_probabilities(np.array([0.05, 0.75, 0.75]), np.array([0, 0, 1]))[7]
    Bin(upto=0.8, n=2, predicted=0.75, observed=0.5)
    """
    inside = [find_bins(probabilities) == number for number in range(N_BINS)]
    return tuple(
        Bin(
            upto=(number + 1) / N_BINS,
            n=int(mask.sum()),
            predicted=float(probabilities[mask].mean()) if mask.any() else None,
            observed=float(labels[mask].mean()) if mask.any() else None,
        )
        for number, mask in enumerate(inside)
    )


def _require(estimate: Estimate) -> float:
    if isinstance(estimate, Undefined):  # folds were dealt out, so there are trials of both labels
        raise LeaderboardError(f"the trials to fit on cannot be judged: {estimate.why}")
    return estimate
