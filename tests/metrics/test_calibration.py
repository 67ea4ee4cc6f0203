"""Ranking, sharpness and calibration of probabilities."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.metrics.calibration import auc, brier, count_outranked, ece, human_ece, yes_rate
from leaderboard.metrics.undefined import Undefined

NOTHING = np.array([])
NO_LABELS = np.array([], np.int64)
NO_TRIALS = Undefined("there are no trials")


@pytest.mark.parametrize(
    ("probabilities", "value"),
    [
        ([0.1, 0.2, 0.8, 0.9], 1),
        ([0.9, 0.8, 0.2, 0.1], 0),
        ([0.3, 0.3, 0.3, 0.3], 0.5),
        ([0.1, 0.8, 0.2, 0.9], 0.75),  # one of four comparisons lost
        ([0.1, 0.4, 0.4, 0.9], 0.875),  # one of four tied
        ([0.0, 5e-324, 1e-323, 1.0], 1),  # however close
    ],
)
def test_auc_counts_comparisons_won(probabilities: list[float], value: float) -> None:
    """Of the trials, two are NO and then two are YES; ties count half."""
    assert auc(np.array(probabilities), np.array([0, 0, 1, 1])) == value


@pytest.mark.parametrize("label", [0, 1])
def test_auc_needs_both_labels(label: int) -> None:
    """Nothing is to be told apart among trials of one label."""
    assert auc(np.array([0.1, 0.9]), np.full(2, label)) == Undefined("all labels are equal")


@given(st.lists(st.tuples(st.sampled_from([0.0, 0.2, 0.5, 0.9, 1.0]), st.integers(0, 1)), min_size=1))
def test_auc_and_its_mirror_image_sum_to_one(trials: list[tuple[float, int]]) -> None:
    """With labels exchanged every comparison is lost that was won."""
    probabilities, labels = (np.array(column) for column in zip(*trials, strict=True))
    value, mirrored = auc(probabilities, labels), auc(probabilities, 1 - labels)
    if isinstance(value, Undefined):
        assert mirrored == value
    else:
        assert isinstance(mirrored, float)
        assert value + mirrored == pytest.approx(1, abs=1e-15)


def test_brier_is_the_mean_square() -> None:
    """0.04, 0.04 and 1 make 0.36."""
    assert brier(np.array([0.2, 0.8, 1.0]), np.array([0, 1, 0])) == pytest.approx(0.36, abs=1e-15)


def test_one_half_everywhere_has_a_brier_score_of_one_quarter() -> None:
    """Whatever the labels."""
    assert brier(np.full(3, 0.5), np.array([0, 1, 1])) == 0.25


def test_ece_of_a_case_by_hand() -> None:
    """Three trials in (0.1, 0.2] are off by |1/3 - 0.2|, and two in (0.9, 1] by |1 - 0.95|."""
    probabilities, labels = np.array([0.2, 0.2, 0.2, 0.95, 0.95]), np.array([0, 0, 1, 1, 1])
    expected = 3 / 5 * (1 / 3 - 0.2) + 2 / 5 * 0.05
    assert ece(probabilities, labels) == pytest.approx(expected, abs=1e-15)


@pytest.mark.parametrize("bound", [k / 10 for k in range(1, 10)])
def test_a_bound_belongs_to_the_bin_below(bound: float) -> None:
    """Beside a value just above it two errors add up; beside a value just below they cancel."""
    labels = np.array([0, 1])
    above, below = math.nextafter(bound, 1), math.nextafter(bound, 0)
    apart = ece(np.array([bound, above]), labels)
    together = ece(np.array([bound, below]), labels)
    assert apart == pytest.approx(0.5, abs=1e-12)
    assert together == pytest.approx(abs(0.5 - bound), abs=1e-12)


def test_zero_belongs_to_the_first_bin_and_one_to_the_last() -> None:
    """No trial falls out of the bins."""
    assert ece(np.array([0.0, 0.1]), np.array([1, 0])) == pytest.approx(0.45, abs=1e-15)
    assert ece(np.array([1.0, 0.95]), np.array([0, 1])) == pytest.approx(0.475, abs=1e-15)


def test_a_perfect_oracle_is_perfectly_calibrated() -> None:
    """Certain and right."""
    labels = np.array([0, 1, 1, 0])
    assert ece(labels.astype(float), labels) == 0
    assert ece(1.0 - labels, labels) == 1


def test_yes_rate_counts_what_is_above_one_half() -> None:
    """Ties count half, and labels do not matter."""
    assert yes_rate(np.array([0.6, 1.0, 0.5, 0.0])) == 0.625


def test_without_trials_nothing_is_defined() -> None:
    """Each says that there are no trials."""
    assert auc(NOTHING, NO_LABELS) == NO_TRIALS
    assert brier(NOTHING, NO_LABELS) == NO_TRIALS
    assert ece(NOTHING, NO_LABELS) == NO_TRIALS
    assert yes_rate(NOTHING) == NO_TRIALS
    assert human_ece(NOTHING, NOTHING) == Undefined("nobody rated these trials")


TRIAL_LISTS = st.lists(st.tuples(st.sampled_from([0.0, 0.2, 0.5, 0.6, 1.0]), st.integers(0, 1)), max_size=12)


@given(TRIAL_LISTS, st.integers(0, 2**32), st.sampled_from([np.uint16, np.uint32]))
def test_outranked_trials_are_those_of_a_loop_over_drawn_trials(
    trials: list[tuple[float, int]], seed: int, kind: type
) -> None:
    """Each drawn YES trial against each drawn NO trial, two trials a pair, ties 1/2."""
    probabilities, labels = np.array(trials).reshape(-1, 2).T
    positions = np.arange(labels.size) // 2
    drawn: np.ndarray = np.random.default_rng(seed).integers(0, 4, (6, 5)).astype(kind)
    expected = np.zeros(5)
    for i, (q_yes, label) in enumerate(trials):
        for j, (q_no, other) in enumerate(trials):
            if label == 1 and other == 0:
                times = drawn[positions[i]].astype(float) * drawn[positions[j]]
                expected += times * ((q_yes > q_no) + (q_yes == q_no) / 2)
    found = count_outranked(probabilities, labels.astype(np.int64), positions, drawn)
    assert found.tolist() == expected.tolist()
