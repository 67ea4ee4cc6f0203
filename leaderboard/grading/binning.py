"""The numbers of the reliability diagram: P(YES) against what happened, and against what people said."""

from collections.abc import Iterable

import numpy as np

from leaderboard.grading.observations import Observations
from leaderboard.grading.scopes import Scope
from leaderboard.metrics.accuracy import Floats
from leaderboard.metrics.calibration import N_BINS, find_bins
from leaderboard.models import Bin, Calibration

DECIMALS = 6


def bin_scopes(observations: Observations, scopes: Iterable[Scope]) -> dict[str, Calibration]:
    """Bin the trials of each scope by P(YES); overall pools the trials of all properties.

    The bins are those of ``ece`` and ``human_ece``, which are the distances between the two means, averaged
    over trials.
    """
    diagrams = {}
    for scope in scopes:
        o = observations.select(scope.mask)
        people = _bin(o.probabilities[o.rated], o.human_means) if o.rated.any() else None
        diagrams[scope.name] = Calibration(
            label=_bin(o.probabilities, o.labels.astype(np.float64)), people=people
        )
    return diagrams


def _bin(predicted: Floats, observed: Floats) -> tuple[Bin, ...]:
    bins = find_bins(predicted)
    sizes = np.bincount(bins, minlength=N_BINS)
    sums = [np.bincount(bins, values, minlength=N_BINS) for values in (predicted, observed)]
    means = [
        [round(float(s / n), DECIMALS) if n else None for s, n in zip(v, sizes, strict=True)] for v in sums
    ]
    return tuple(
        Bin(
            upto=(number + 1) / N_BINS,
            n=int(sizes[number]),
            predicted=means[0][number],
            observed=means[1][number],
        )
        for number in range(N_BINS)
    )
