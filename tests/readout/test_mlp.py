"""The appendix's perceptron: trained, stopped and judged on different pairs."""

import numpy as np
import pytest
from sklearn.neural_network import MLPClassifier

from feature_sets import simulate_sets
from leaderboard.readout import mlp
from leaderboard.readout.folds import split_pairs
from leaderboard.readout.mlp import MlpReadout


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Fewer and larger steps, so that a test takes no more than a moment."""
    monkeypatch.setattr(mlp, "LEARNING_RATE", 3e-3)
    monkeypatch.setattr(mlp, "MAX_EPOCHS", 15)
    monkeypatch.setattr(mlp, "PATIENCE", 4)


def test_a_strong_signal_is_found() -> None:
    """With a strong signal nearly all held-out and test trials are right."""
    fitting, test, hidden = simulate_sets(0, signal=12.0, n_features=4, n_pairs=40)
    fit = MlpReadout(fitting, test).fit(split_pairs(fitting.pair_ids, fitting.labels, seed=0), 0)
    assert np.mean((fit.held_out > 0.5) == fitting.labels) > 0.9
    assert np.mean((fit.test > 0.5) == hidden) > 0.9


def test_equal_seeds_give_equal_networks() -> None:
    """The same seed gives the same probabilities, another seed others."""
    fitting, test, _ = simulate_sets(1, signal=2.0)
    folds = split_pairs(fitting.pair_ids, fitting.labels, seed=0)
    first, again, other = (MlpReadout(fitting, test).fit(folds, seed).test for seed in (0, 0, 1))
    assert first.tolist() == again.tolist() != other.tolist()


def test_own_labels_do_not_reach_held_out_predictions() -> None:
    """Turned labels of a fold do not change what is predicted for it: another fold stops training."""
    fitting, test, _ = simulate_sets(2, signal=1.0)
    folds = split_pairs(fitting.pair_ids, fitting.labels, seed=0)
    before = MlpReadout(fitting, test).fit(folds, 0).held_out
    inside = folds == 3
    fitting.labels[inside] = 1 - fitting.labels[inside]
    after = MlpReadout(fitting, test).fit(folds, 0).held_out
    assert after[inside].tolist() == before[inside].tolist()
    assert after[~inside].tolist() != before[~inside].tolist()


def test_epoch_is_the_best_on_held_out_pairs() -> None:
    """The chosen epoch has the smallest loss on the fold that is held out of training."""
    fitting, test, _ = simulate_sets(3, signal=1.0)
    folds = split_pairs(fitting.pair_ids, fitting.labels, seed=0)
    readout = MlpReadout(fitting, test)
    fit = readout.fit(folds, 5)
    judge, coordinates, labels = folds == 0, readout.projection.fitting, fitting.labels
    rng = np.random.RandomState(5)  # it goes on from epoch to epoch, so that each draws other batches
    network = MLPClassifier(mlp.UNITS, learning_rate_init=mlp.LEARNING_RATE, batch_size=32, random_state=rng)
    losses, predictions = [], []
    for _ in range(mlp.MAX_EPOCHS):
        network.partial_fit(coordinates[~judge], labels[~judge], classes=[0, 1])
        p = network.predict_proba(coordinates[judge])[:, 1]
        losses.append(-np.mean(np.log(np.where(labels[judge] == 1, p, 1 - p))))
        predictions.append(network.predict_proba(readout.projection.test)[:, 1])
    best = 0
    while (better := int(np.argmin(losses[: best + mlp.PATIENCE + 1]))) > best:
        best = better  # within the patience
    assert fit.choices == {"epochs": best + 1}
    assert fit.test.tolist() == predictions[best].tolist()


def test_coordinates_have_unit_mean_square() -> None:
    """However large features are, the network sees numbers of size 1."""
    fitting, test, _ = simulate_sets(4, n_features=200)
    assert np.mean(MlpReadout(fitting, test).projection.fitting ** 2) == pytest.approx(1)
