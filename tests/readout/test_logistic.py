"""Logistic readouts: scikit-learn's numbers, a nested choice of the strength, and simulations."""

from statistics import NormalDist
from typing import Any

import numpy as np
import pytest
from sklearn.linear_model import LogisticRegression
from sklearn.metrics import log_loss
from sklearn.preprocessing import StandardScaler

from feature_sets import simulate_sets
from leaderboard.metrics.accuracy import credits_of
from leaderboard.readout import logistic
from leaderboard.readout.evaluation import estimate_accuracy
from leaderboard.readout.folds import N_FOLDS, split_pairs
from leaderboard.readout.logistic import EXPONENTS, LogisticReadout
from leaderboard.readout.outcome import Fit


def fit_once(seed: int, **options: Any) -> tuple[Fit, np.ndarray, np.ndarray]:
    fitting, test, hidden = simulate_sets(seed, **options)
    folds = split_pairs(fitting.pair_ids, fitting.labels, seed=seed)
    return LogisticReadout(fitting, test).fit(folds, seed), fitting.labels, hidden


def choose_by_hand(
    values: np.ndarray, labels: np.ndarray, folds: np.ndarray, strengths: list[float]
) -> float:
    """The strength with the smallest mean log loss over folds."""
    losses = []
    for strength in strengths:
        model = LogisticRegression(C=strength, tol=1e-10, max_iter=10_000)
        found = []
        for fold in np.unique(folds):
            model.fit(values[folds != fold], labels[folds != fold])
            probabilities = model.predict_proba(values[folds == fold])[:, 1]
            found.append(log_loss(labels[folds == fold], probabilities, labels=[0, 1]))
        losses.append(np.mean(found))
    return strengths[int(np.argmin(losses))]


@pytest.mark.parametrize("n_features", [3, 60])
def test_steps_by_hand_give_the_same(n_features: int) -> None:
    """Standardise, choose the strength fold by fold, fit: done by hand on all features, it gives the same."""
    fitting, test, _ = simulate_sets(5, n_features=n_features, signal=1.5)
    folds = split_pairs(fitting.pair_ids, fitting.labels, seed=0)
    fit = LogisticReadout(fitting, test).fit(folds, 0)
    scaler = StandardScaler().fit(fitting.values)
    values, labels = scaler.transform(fitting.values), fitting.labels
    strengths = [10.0**k / n_features for k in EXPONENTS]
    model = LogisticRegression(tol=1e-10, max_iter=10_000)
    for fold in range(N_FOLDS):
        seen = folds != fold
        model.set_params(C=choose_by_hand(values[seen], labels[seen], folds[seen], strengths))
        model.fit(values[seen], labels[seen])
        expected = model.predict_proba(values[~seen])[:, 1]
        np.testing.assert_allclose(fit.held_out[~seen], expected, atol=1e-6)
    best = choose_by_hand(values, labels, folds, strengths)
    assert fit.choices == {"strength": best}
    model.set_params(C=best).fit(values, labels)
    expected = model.predict_proba(scaler.transform(test.values))[:, 1]
    np.testing.assert_allclose(fit.test, expected, atol=1e-6)


def test_own_labels_do_not_reach_held_out_predictions() -> None:
    """Turned labels of a fold change the predictions of other folds, and not its own."""
    fitting, test, _ = simulate_sets(3, signal=1.0)
    folds = split_pairs(fitting.pair_ids, fitting.labels, seed=0)
    before = LogisticReadout(fitting, test).fit(folds, 0).held_out
    inside = folds == 2
    fitting.labels[inside] = 1 - fitting.labels[inside]
    after = LogisticReadout(fitting, test).fit(folds, 0).held_out
    assert after[inside].tolist() == before[inside].tolist()
    assert not np.isclose(after[~inside], before[~inside]).any()


def test_features_given_twice_change_nothing() -> None:
    """Strengths go with the number of features, so a copy of each leaves predictions as they are."""
    fitting, test, _ = simulate_sets(4, signal=1.0)
    folds = split_pairs(fitting.pair_ids, fitting.labels, seed=0)
    once = LogisticReadout(fitting, test).fit(folds, 0)
    twice = LogisticReadout(
        type(fitting)(
            fitting.name, fitting.trial_ids, fitting.pair_ids, np.tile(fitting.values, 2), fitting.labels
        ),
        type(test)(test.trial_ids, np.tile(test.values, 2)),
    ).fit(folds, 0)
    np.testing.assert_allclose(twice.test, once.test, atol=1e-9)
    np.testing.assert_allclose(twice.held_out, once.held_out, atol=1e-9)


def test_separable_trials_do_not_break_it() -> None:
    """Where one feature tells everything, all are right and no warning is given."""
    fit, labels, hidden = fit_once(0, signal=50.0)
    assert ((fit.held_out > 0.5) == labels).all()
    assert ((fit.test > 0.5) == hidden).all()


def measure_accuracy(seed: int, **options: float) -> tuple[float, float]:
    """Accuracy on held-out and on test trials."""
    fit, labels, hidden = fit_once(seed, **options)
    both = (fit.held_out, labels), (fit.test, hidden)
    held_out, test = (credits_of(p, y, np.ones(len(y), bool)).mean() for p, y in both)
    return held_out, test


def test_no_signal_gives_chance(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a signal, held-out and test accuracy are 50 % over many seeds, within 4 standard errors.

    benchmarks/readout.py does so for 200 seeds of 192 trials, whose error is small enough for half a point.
    """
    monkeypatch.setattr(logistic, "EXPONENTS", (-1, 1))  # fewer fits; the choice between them remains
    found = np.array([measure_accuracy(seed, n_features=4) for seed in range(40)])
    errors = found.std(axis=0, ddof=1) / len(found) ** 0.5
    assert (np.abs(found.mean(axis=0) - 0.5) < 4 * errors).all()
    assert (errors < 0.025).all()


def test_known_signal_is_recovered() -> None:
    """With a signal of 2 standard deviations 84 % are possible: reached, and within the interval."""
    best = NormalDist().cdf(1.0)
    options = {"signal": 2.0, "n_pairs": 96, "n_test": 2000, "n_features": 4}
    _, accuracy = measure_accuracy(0, **options)
    assert best - 0.03 < accuracy < best + 0.02
    fitting, test, _ = simulate_sets(0, **options)  # type: ignore[arg-type]
    folds = split_pairs(fitting.pair_ids, fitting.labels, seed=0)
    held_out = LogisticReadout(fitting, test).fit(folds, 0).held_out
    interval = estimate_accuracy(held_out, fitting.labels, fitting.pair_ids)
    assert interval.low < accuracy < interval.high
    assert interval.high - interval.low < 0.15
