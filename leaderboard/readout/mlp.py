"""The multilayer perceptron of the paper's appendix, stopped on held-out pairs of the readout set."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from leaderboard.readout.features import Integers
from leaderboard.readout.folds import N_FOLDS
from leaderboard.readout.matching import FittingSet, TargetSet
from leaderboard.readout.outcome import Fit
from leaderboard.readout.projection import Projection, project

Floats = NDArray[np.float64]
Booleans = NDArray[np.bool_]

UNITS = (256, 64)
LEARNING_RATE = 1e-4
BATCH = 32
MAX_EPOCHS = 500
PATIENCE = 20  # epochs without a smaller loss on the held-out pairs

_SMALLEST = 1e-12


@dataclass(frozen=True)
class MlpReadout:
    """Trains 256 and 64 units with Adam at a learning rate of 1e-4, as the paper's appendix says.

    One fold is held out of training: the epoch with the smallest log loss on it is kept. For predictions of a
    fold's own trials another fold judges, so that they choose nothing either. Features are first turned into
    coordinates with the same scalar products, scaled to a mean square of 1: training never moves the first
    layer's weights in directions that no trial has.
    """

    fitting: FittingSet
    test: TargetSet

    @cached_property
    def projection(self) -> Projection:
        """The features as coordinates."""
        found = project(self.fitting, self.test)
        scale = np.sqrt(np.mean(found.fitting**2))
        return Projection(found.fitting / scale, found.test / scale, found.n_features, found.n_constant)

    def fit(self, folds: Integers, seed: int) -> Fit:
        """Train once without each fold, and once for the test trials."""
        coordinates = self.projection.fitting
        held_out = np.empty(len(folds))
        for fold in range(N_FOLDS):
            judge = folds == (fold + 1) % N_FOLDS
            inside = folds == fold
            held_out[inside], _ = self._train(~inside & ~judge, judge, coordinates[inside], seed)
        judge = folds == 0
        predicted, epoch = self._train(~judge, judge, self.projection.test, seed)
        return Fit(held_out, predicted, {"epochs": epoch})

    def _train(self, seen: Booleans, judge: Booleans, targets: Floats, seed: int) -> tuple[Floats, int]:
        """Train until the loss on the judging trials stops falling; predict with the best epoch."""
        from sklearn.neural_network import MLPClassifier

        coordinates, labels = self.projection.fitting, self.fitting.labels
        rng = np.random.RandomState(
            seed
        )  # with a number in its place, every epoch would draw the same batches
        network = MLPClassifier(
            UNITS,
            learning_rate_init=LEARNING_RATE,
            batch_size=min(BATCH, int(seen.sum())),
            random_state=rng,
        )
        best_loss, best_epoch, predicted = np.inf, 0, np.full(len(targets), 0.5)
        for epoch in range(1, MAX_EPOCHS + 1):
            network.partial_fit(coordinates[seen], labels[seen], classes=[0, 1])
            loss = _mean_loss(network.predict_proba(coordinates[judge])[:, 1], labels[judge])
            if loss < best_loss:
                best_loss, best_epoch = loss, epoch
                predicted = network.predict_proba(targets)[:, 1]
            elif epoch - best_epoch >= PATIENCE:
                break
        return predicted, best_epoch


def _mean_loss(probabilities: Floats, labels: Integers) -> float:
    right = np.where(labels == 1, probabilities, 1 - probabilities)
    return float(-np.log(np.maximum(right, _SMALLEST)).mean())
