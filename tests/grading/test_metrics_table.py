"""The one table of metrics: complete, and true of every metric in it."""

from dataclasses import replace

import numpy as np
import pytest

from builders import build_reference, build_submission
from leaderboard.grading import METRICS, Metric, find_metric
from leaderboard.grading.observations import Observations
from leaderboard.metrics.undefined import Undefined

EACH = pytest.mark.parametrize("metric", METRICS, ids=lambda metric: metric.name)
REFERENCE = build_reference(40, seed=3)


def _observe(probabilities: np.ndarray) -> Observations:
    observations = Observations.of(build_submission(REFERENCE, probabilities.tolist()), REFERENCE)
    return replace(observations, reliability=1.0)


def test_the_table_holds_the_metrics_of_the_contract() -> None:
    """In the order in which results and tables give them."""
    assert [metric.name for metric in METRICS] == [
        "accuracy",
        "accuracy_p",
        "human_r",
        "human_r_normalized",
        "human_r_partial",
        "human_rmse",
        "error_consistency",
        "cohen_kappa",
        "pair_accuracy",
        "pair_order",
        "auc",
        "brier",
        "ece",
        "human_ece",
        "yes_rate",
        "human_gap",
    ]


@EACH
def test_a_metric_is_found_by_its_name(metric: Metric) -> None:
    """And by nothing else."""
    assert find_metric(metric.name) is metric


@EACH
def test_a_metric_explains_itself(metric: Metric) -> None:
    """Its title is set, its meaning one sentence, and chance lies in its range."""
    assert metric.title
    assert metric.meaning.endswith(".")
    assert metric.low < metric.high
    assert metric.chance is None or metric.low <= metric.chance <= metric.high


@EACH
def test_the_better_end_is_the_end_that_people_and_labels_reach(metric: Metric) -> None:
    """Predicting better moves a value in the direction that the table calls better.

    For human metrics the good predictions are the human means, for the others the labels.
    """
    rng = np.random.default_rng(0)
    labels, people = REFERENCE.labels, REFERENCE.people
    assert people is not None
    best = (
        labels.astype(float)
        if metric.needs == "labels" or metric.name == "human_gap"
        else people.n_yes / people.n
    )
    bad = rng.random(labels.size)
    good = 0.8 * best + 0.2 * bad
    good_value, bad_value = metric.compute(_observe(good)), metric.compute(_observe(bad))
    assert isinstance(good_value, float)
    assert isinstance(bad_value, float)
    assert metric.low <= good_value <= metric.high
    if metric.direction != "none":
        assert (good_value > bad_value) is (metric.direction == "higher")


@EACH
def test_chance_is_what_guessing_gives_on_average(metric: Metric) -> None:
    """Random probabilities unrelated to anything average to the table's chance; one half for Brier's."""
    if metric.chance is None:
        return
    rng = np.random.default_rng(7)
    size = REFERENCE.n_trials
    guesses = [np.full(size, 0.5)] if metric.name == "brier" else [rng.random(size) for _ in range(100)]
    values = [metric.compute(_observe(guess)) for guess in guesses]
    defined = [value for value in values if isinstance(value, float)]
    assert np.mean(defined) == pytest.approx(metric.chance, abs=0.02)


@EACH
def test_a_metric_says_what_the_reference_lacks(metric: Metric) -> None:
    """Without people, or with counts only, a metric that needs more has a reason and the others a value."""
    whole = _observe(np.random.default_rng(1).random(REFERENCE.n_trials))
    counts_only = replace(whole, responses=None)
    bare = replace(counts_only, n=None, n_yes=None)
    lacking_people = Undefined("the reference has no human data")
    lacking_responses = Undefined("the reference has no responses of single people")
    assert isinstance(metric.compute(whole), float)
    assert (metric.compute(bare) == lacking_people) is (metric.needs != "labels")
    assert (metric.compute(counts_only) == lacking_responses) is (metric.needs == "responses")
