"""Logistic regression whose strength is chosen by cross-validation on the trials to fit on."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from leaderboard.readout.features import Integers
from leaderboard.readout.folds import list_splits
from leaderboard.readout.matching import FittingSet, TargetSet
from leaderboard.readout.outcome import Fit
from leaderboard.readout.projection import Projection, project

Floats = NDArray[np.float64]

EXPONENTS = tuple(range(-3, 5))
"""The strengths that are tried: C = 10^k / n_features, so that a feature given twice changes nothing."""

TOLERANCE = 1e-10  # so that what is written does not depend on where the steps end
MAX_STEPS = 1000


@dataclass(frozen=True)
class LogisticReadout:
    """Fits weights with a quadratic penalty, by scikit-learn's ``LogisticRegressionCV``.

    Minimised is C times the sum of log losses plus half the squared length of the weights; the intercept is
    free. The strength C is the one with the smallest mean log loss over held-out folds, of equals the
    smallest. For predictions of a fold's own trials it is chosen on the other folds.
    """

    fitting: FittingSet
    test: TargetSet

    @cached_property
    def projection(self) -> Projection:
        """The features as coordinates."""
        return project(self.fitting, self.test)

    def fit(self, folds: Integers, seed: int) -> Fit:
        """Choose the strength and fit; nothing here is random but the folds."""
        del seed
        coordinates = self.projection.fitting
        held_out = np.empty(len(folds))
        for outside, inside in list_splits(folds):
            model = self._choose_strength(outside, folds[outside])
            held_out[inside] = model.predict_proba(coordinates[inside])[:, 1]
        model = self._choose_strength(np.arange(len(folds)), folds)
        predicted = model.predict_proba(self.projection.test)[:, 1]
        return Fit(held_out, predicted, {"strength": float(np.ravel(model.C_)[0])})

    def _choose_strength(self, chosen: Integers, folds: Integers) -> Any:  # noqa: ANN401  (no types)
        """Cross-validate on some of the trials, and fit all of these with the best strength."""
        from sklearn.linear_model import LogisticRegressionCV

        model = LogisticRegressionCV(
            Cs=[10.0**k / self.projection.n_features for k in EXPONENTS],
            l1_ratios=(0,),
            cv=list_splits(folds),
            scoring=_score_likelihood,
            solver="newton-cholesky",
            tol=TOLERANCE,
            max_iter=MAX_STEPS,
            use_legacy_attributes=False,
        )
        return model.fit(self.projection.fitting[chosen], self.fitting.labels[chosen])


def _score_likelihood(model: Any, coordinates: Floats, labels: Integers) -> float:  # noqa: ANN401
    """Mean logarithm of the probability given to the label; a fold may hold one label only."""
    scores = model.decision_function(coordinates)
    return -float(np.logaddexp(0, np.where(labels == model.classes_[1], -scores, scores)).mean())
