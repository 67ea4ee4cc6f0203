"""How good held-out probabilities are: the metrics of the board, and an interval over pairs."""

import numpy as np
import pytest
from sklearn.metrics import brier_score_loss, roc_auc_score

from leaderboard.errors import LeaderboardError
from leaderboard.readout.evaluation import bin_probabilities, estimate_accuracy, measure_agreement

PROBABILITIES = np.array([0.9, 0.2, 0.5, 0.35, 0.8, 0.15])
LABELS = np.array([1, 0, 1, 1, 0, 0])


def test_metrics_are_those_of_the_board() -> None:
    """Accuracy gives half a point for 0.5; AUC and Brier score are scikit-learn's."""
    found = measure_agreement(PROBABILITIES, LABELS)
    assert found.accuracy == pytest.approx(3.5 / 6)
    assert found.auc == pytest.approx(roc_auc_score(LABELS, PROBABILITIES))
    assert found.brier == pytest.approx(brier_score_loss(LABELS, PROBABILITIES))


def test_interval_is_over_pairs() -> None:
    """Where members of a pair share their fate, the interval is that of half as many trials."""
    labels = np.tile([0, 1], 50)
    is_right = np.repeat(np.arange(50) % 2 == 0, 2)
    probabilities = np.where(is_right == labels, 0.9, 0.1)
    pairs = [f"p{row // 2}" for row in range(100)]
    together = estimate_accuracy(probabilities, labels, pairs)
    alone = estimate_accuracy(probabilities, labels, [str(row) for row in range(100)])
    assert together.value == alone.value == 0.5
    widths = [found.high - found.low for found in (together, alone)]
    assert widths[0] / widths[1] == pytest.approx(2**0.5, rel=0.15)
    assert together.low == pytest.approx(0.5 - 1.96 * (0.25 / 50) ** 0.5, abs=0.03)


def test_bins_hold_each_trial_once() -> None:
    """The bins are ten; each has its means, and none where it is empty."""
    bins = bin_probabilities(PROBABILITIES, LABELS)
    assert [bin_.n for bin_ in bins] == [0, 2, 0, 1, 1, 0, 0, 1, 1, 0]
    assert bins[1].predicted == pytest.approx(0.175)
    assert bins[1].observed == 0
    assert (bins[0].predicted, bins[0].observed) == (None, None)


def test_one_outcome_cannot_be_judged() -> None:
    """Without trials of both outcomes there is no AUC, and the message says so."""
    with pytest.raises(LeaderboardError, match="the trials to fit on cannot be judged: "):
        measure_agreement(np.array([0.2, 0.7]), np.array([1, 1]))
