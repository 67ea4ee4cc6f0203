"""Coordinates in place of features: fewer numbers, the same fit."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sklearn.linear_model import LogisticRegression
from sklearn.preprocessing import StandardScaler

from feature_sets import simulate_sets
from leaderboard.errors import SourceError
from leaderboard.readout import projection
from leaderboard.readout.matching import FittingSet, TargetSet
from leaderboard.readout.projection import project


@given(st.integers(0, 100), st.integers(2, 90))
def test_scalar_products_are_those_of_standardised_features(seed: int, n_features: int) -> None:
    """Products of trials, and of test trials with these, are kept, with many features or few."""
    fitting, test, _ = simulate_sets(seed, n_features=n_features)
    found = project(fitting, test)
    scaler = StandardScaler().fit(fitting.values)
    own, other = scaler.transform(fitting.values), scaler.transform(test.values)
    np.testing.assert_allclose(found.fitting @ found.fitting.T, own @ own.T, atol=1e-8)
    np.testing.assert_allclose(found.test @ found.fitting.T, other @ own.T, atol=1e-8)
    assert found.fitting.shape[1] <= min(n_features, len(own))


@pytest.mark.parametrize("strength", [1e-5, 1e-3, 1e-1])
def test_fit_is_the_same_as_with_all_features(strength: float) -> None:
    """Logistic regression on coordinates predicts what it predicts on all 300 features of 40 trials."""
    fitting, test, _ = simulate_sets(1, n_features=300, signal=1.0)
    found = project(fitting, test)
    scaler = StandardScaler().fit(fitting.values)
    models = [LogisticRegression(C=strength, tol=1e-12, max_iter=100_000) for _ in range(2)]
    models[0].fit(found.fitting, fitting.labels)
    models[1].fit(scaler.transform(fitting.values), fitting.labels)
    ours = models[0].predict_proba(found.test)
    theirs = models[1].predict_proba(scaler.transform(test.values))
    np.testing.assert_allclose(ours, theirs, atol=1e-6)


def test_blocks_of_columns_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Standardised seven columns at a time, the coordinates are the same up to rounding."""
    fitting, test, _ = simulate_sets(2, n_features=100)
    whole = project(fitting, test)
    monkeypatch.setattr(projection, "COLUMNS", 7)
    blocks = project(fitting, test)
    np.testing.assert_allclose(blocks.fitting @ blocks.fitting.T, whole.fitting @ whole.fitting.T, atol=1e-9)
    assert blocks.n_features == whole.n_features


def build(values: list[list[float]], test: list[list[float]]) -> tuple[FittingSet, TargetSet]:
    n = len(values)
    names = tuple(map(str, range(n)))
    return (
        FittingSet("Alpha", names, names, np.array(values), np.arange(n) % 2),
        TargetSet(("t",), np.array(test)),
    )


def test_constant_features_are_left_out_and_counted() -> None:
    """What is the same on all trials to fit on says nothing; that a test trial differs changes nothing."""
    found = project(*build([[1.0, 0.1], [3.0, 0.1], [5.0, 0.1]], [[3.0, 9.0]]))
    assert (found.n_features, found.n_constant) == (1, 1)
    np.testing.assert_allclose(found.fitting, np.array([[-1], [0], [1]]) * 1.5**0.5)
    assert found.test.tolist() == [[0.0]]


def test_features_must_vary_and_agree() -> None:
    """Features that all are constant, or of two lengths, are refused."""
    with pytest.raises(SourceError, match=r"^Alpha: every feature is the same on all trials to fit on"):
        project(*build([[1.0], [1.0]], [[1.0]]))
    with pytest.raises(SourceError, match=r"^Alpha: the trials to fit on have 1 features, the test trials 2"):
        project(*build([[1.0], [2.0]], [[1.0, 2.0]]))
