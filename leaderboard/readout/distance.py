"""The paper's rule for particle models: contact, if the smallest distance is below a threshold."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from leaderboard.errors import SourceError
from leaderboard.readout.features import Features, Integers
from leaderboard.readout.folds import list_splits
from leaderboard.readout.logistic import LogisticReadout
from leaderboard.readout.matching import FittingSet, TargetSet
from leaderboard.readout.outcome import Fit
from leaderboard.readout.projection import Projection, project
from leaderboard.reference.cells import quote

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ThresholdReadout:
    """Answers YES where the distance is below the threshold that is right most often, else NO."""

    fitting: FittingSet
    test: TargetSet

    @cached_property
    def projection(self) -> Projection:
        """Counts of features; the distances themselves are compared as they are."""
        return project(self.fitting, self.test)

    def fit(self, folds: Integers, seed: int) -> Fit:
        """Learn a threshold without each fold, and one on all trials."""
        del seed
        distances, labels = _distances_of(self.fitting), self.fitting.labels
        held_out = np.empty(len(labels))
        for outside, inside in list_splits(folds):
            held_out[inside] = distances[inside] < learn_threshold(distances[outside], labels[outside])
        threshold = learn_threshold(distances, labels)
        answers = (_distances_of(self.test) < threshold).astype(np.float64)
        return Fit(held_out, answers, {"threshold": threshold})


@dataclass(frozen=True)
class DistanceReadout:
    """Turns the distance into P(YES) by logistic regression; the threshold is told beside it."""

    fitting: FittingSet
    test: TargetSet

    @cached_property
    def _logistic(self) -> LogisticReadout:
        return LogisticReadout(self.fitting, self.test)

    @property
    def projection(self) -> Projection:
        """The standardised distances."""
        return self._logistic.projection

    def fit(self, folds: Integers, seed: int) -> Fit:
        """Fit the regression, and learn the threshold that ``ThresholdReadout`` would use."""
        fit = self._logistic.fit(folds, seed)
        threshold = learn_threshold(_distances_of(self.fitting), self.fitting.labels)
        return Fit(fit.held_out, fit.test, {**fit.choices, "threshold": threshold})


def learn_threshold(distances: Floats, labels: Integers) -> float:
    """Find the distance below which to say YES, so that the most trials are right.

    Tried are the smallest distance, the middles between neighbouring ones, and the next number above the
    largest. Of equally good ones it is the middle one.

    Parameters
    ----------
    distances, labels : (n_trials,)

    Examples
    --------
    >>> learn_threshold(np.array([0.25, 0.50, 1.00, 4.00]), np.array([1, 1, 0, 0]))
    0.75
    """
    order = np.argsort(distances, kind="stable")
    ordered = distances[order]
    is_last = np.append(ordered[1:] > ordered[:-1], [True])  # of equal distances; no threshold splits these
    above = np.append((ordered[:-1] + ordered[1:]) / 2, np.nextafter(ordered[-1], np.inf))
    thresholds = np.append(ordered[0], above[is_last])
    gains = np.append(0, np.cumsum(2 * labels[order] - 1)[is_last])
    best = np.flatnonzero(gains == gains.max())
    return float(thresholds[best[(len(best) - 1) // 2]])


def check_distances(features: Features) -> None:
    """Insist that none of what is given as distances is below 0.

    Raises
    ------
    SourceError
        If one is.
    """
    row = int(features.values[:, 0].argmin())
    smallest = float(features.values[row, 0])
    if smallest < 0:
        message = f"the distance of trial {quote(features.trial_ids[row])} is {smallest:g}, which is below 0"
        raise SourceError(f"{features.origin.name}: {message}", "give distances, not their logarithms")


def _distances_of(trials: FittingSet | TargetSet) -> Floats:
    return trials.values[:, 0].astype(np.float64)
