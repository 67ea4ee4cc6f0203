"""The package's metrics against scikit-learn and SciPy, where they have them."""

import numpy as np
import pytest
from scipy import stats
from sklearn import metrics as sklearn_metrics

from leaderboard.metrics import accuracy, agreement, calibration, exact_tests

SEEDS = range(5)


def _case(seed: int, size: int = 120) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Draw probabilities with ties, labels, and human means."""
    rng = np.random.default_rng(seed)
    probabilities = np.round(rng.random(size), 2)
    labels = rng.integers(0, 2, size)
    people = np.clip(0.3 * probabilities + 0.2 * labels + 0.4 * rng.random(size), 0, 1)
    return probabilities, labels, people


@pytest.mark.parametrize("seed", SEEDS)
def test_auc_equals_scikit_learn(seed: int) -> None:
    """Tied probabilities count half, as in roc_auc_score."""
    probabilities, labels, _ = _case(seed)
    expected = sklearn_metrics.roc_auc_score(labels, probabilities)
    assert calibration.auc(probabilities, labels) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_brier_equals_scikit_learn(seed: int) -> None:
    """The Brier score for two classes is the mean squared error of P(YES)."""
    probabilities, labels, _ = _case(seed)
    expected = sklearn_metrics.brier_score_loss(labels, probabilities)
    assert calibration.brier(probabilities, labels) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_accuracy_equals_scikit_learn_without_ties(seed: int) -> None:
    """Where nothing is exactly 0.5 the mean credit is the usual accuracy."""
    probabilities, labels, _ = _case(seed)
    probabilities = np.where(probabilities == 0.5, 0.51, probabilities)
    credits = accuracy.credits_of(probabilities, labels, np.ones(labels.size, bool))
    expected = sklearn_metrics.accuracy_score(labels, probabilities > 0.5)
    assert accuracy.accuracy(credits) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_kappa_of_one_person_equals_scikit_learn(seed: int) -> None:
    """With one person and hard answers it is Cohen's kappa."""
    probabilities, labels, _ = _case(seed)
    answers = (probabilities > 0.5).astype(float)
    expected = sklearn_metrics.cohen_kappa_score(answers, labels)
    computed = agreement.mean_kappa(answers, labels, np.zeros(labels.size, int))
    assert computed == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_human_r_equals_scipy(seed: int) -> None:
    """Pearson's r."""
    probabilities, _, people = _case(seed)
    expected = stats.pearsonr(probabilities, people).statistic
    assert agreement.human_r(probabilities, people) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_partial_correlation_equals_that_of_regression_residuals(seed: int) -> None:
    """Least squares on the label leaves the residuals that are correlated."""
    probabilities, labels, people = _case(seed)
    design = np.column_stack([np.ones(labels.size), labels])
    left = [v - design @ np.linalg.lstsq(design, v, rcond=None)[0] for v in (probabilities, people)]
    expected = stats.pearsonr(*left).statistic
    assert agreement.human_r_partial(probabilities, people, labels) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_accuracy_p_without_pairs_equals_the_binomial_test(seed: int) -> None:
    """Single trials with hard answers are coin flips under the null."""
    probabilities, labels, _ = _case(seed)
    probabilities = np.where(probabilities == 0.5, 0.51, probabilities)
    answered = np.ones(labels.size, bool)
    credits = accuracy.credits_of(probabilities, labels, answered)
    computed = exact_tests.accuracy_p(credits, labels, np.arange(labels.size), answered)
    expected = stats.binomtest(int(credits.sum()), labels.size, 0.5, alternative="greater").pvalue
    assert computed == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_accuracy_p_with_pairs_equals_the_exact_permutation_test(seed: int) -> None:
    """SciPy's enumeration of all sign patterns of twelve pairs gives the same p."""
    probabilities, _, _ = _case(seed, 24)
    pairs = np.repeat(np.arange(12), 2)
    labels = np.tile([0, 1], 12)
    answered = np.ones(24, bool)
    credits = accuracy.credits_of(probabilities, labels, answered)
    differences = credits.reshape(12, 2).sum(axis=1) - 1
    expected = stats.permutation_test(
        (differences,), np.sum, permutation_type="samples", alternative="greater", n_resamples=np.inf
    ).pvalue
    computed = exact_tests.accuracy_p(credits, labels, pairs, answered)
    assert computed == pytest.approx(expected, rel=1e-12)
