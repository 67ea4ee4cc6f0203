"""The package's metrics against plain loops on random cases, defined or not."""

import math
from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.grading import METRICS, Metric
from leaderboard.grading.observations import Observations
from leaderboard.metrics.accuracy import credits_of, is_above, is_below, right_counts
from leaderboard.metrics.undefined import Undefined
from oracles import brute_force
from oracles.brute_force import Trial

PEOPLE = ("p001", "p002", "p003", "p004")

# Few distinct values, so that ties, bin bounds and constant predictions are frequent; among them neighbours,
# and numbers so small that their squares are 0.
NEIGHBOURS = [math.nextafter(0.3, 1), math.nextafter(0.5, 1)]
PROBABILITIES = st.sampled_from([0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0, 5e-324, 1e-200, 1e-13, *NEIGHBOURS])


@st.composite
def trial_lists(draw: st.DrawFn) -> list[Trial]:
    """Draw up to nine trials in pairs that may be single, opposite or equal in their labels."""
    size = draw(st.integers(1, 9))
    same_probability = draw(st.one_of(st.none(), PROBABILITIES))
    same_label = draw(st.one_of(st.none(), st.integers(0, 1)))
    votes = st.dictionaries(st.sampled_from(PEOPLE), st.integers(0, 1))
    pairs = [f"pair{index // 2}" for index in range(size)]
    return [
        Trial(
            pair=pair,
            label=draw(st.integers(0, 1)) if same_label is None else same_label,
            probability=draw(PROBABILITIES) if same_probability is None else same_probability,
            is_answered=draw(st.sampled_from([True, True, True, False])),
            votes=draw(votes),
        )
        for pair in draw(st.permutations(pairs))
    ]


def observe(trials: Sequence[Trial]) -> Observations:
    """Lay the trials out as the arrays that the package works on."""
    labels = np.array([t.label for t in trials], dtype=np.int64)
    answered = np.array([t.is_answered for t in trials])
    probabilities = np.array([t.q for t in trials])
    names = sorted({t.pair for t in trials})
    votes = [(i, PEOPLE.index(p), vote) for i, t in enumerate(trials) for p, vote in t.votes.items()]
    columns = np.array(votes, dtype=np.int64).reshape(-1, 3).T
    return Observations(
        probabilities=probabilities,
        credits=credits_of(probabilities, labels, answered),
        answered=answered,
        labels=labels,
        pairs=np.array([names.index(t.pair) for t in trials]),
        n=np.array([len(t.votes) for t in trials], dtype=np.int64),
        n_yes=np.array([sum(t.votes.values()) for t in trials], dtype=np.int64),
        responses=(columns[0], columns[1], columns[2]),
        reliability=brute_force.RELIABILITY,
    )


@pytest.mark.parametrize("metric", METRICS, ids=lambda metric: metric.name)
@given(trials=trial_lists())
def test_metric_equals_its_brute_force_twin(metric: Metric, trials: list[Trial]) -> None:
    """Values agree to 9 decimals, and one is undefined exactly where the other is."""
    computed = metric.compute(observe(trials))
    expected = brute_force.METRICS[metric.name](trials)
    if expected is None:
        assert isinstance(computed, Undefined)
    else:
        assert computed == pytest.approx(float(expected), abs=1e-9)


def test_every_metric_has_a_brute_force_twin() -> None:
    """No metric enters the table without an independent implementation."""
    assert {metric.name for metric in METRICS} == set(brute_force.METRICS)


@given(trials=trial_lists())
def test_easy_and_hard_equal_their_brute_force_twins(trials: list[Trial]) -> None:
    """The exact comparison of counts chooses the same pairs as fractions do."""
    o = observe(trials)
    assert o.n is not None
    assert o.n_yes is not None
    right = right_counts(o.n, o.n_yes, o.labels)
    masks = {"easy": is_above(right, o.n, Fraction(2, 3)), "hard": is_below(right, o.n, Fraction(1, 3))}
    for subset, mask in masks.items():
        chosen = {trials[i].pair for i in np.flatnonzero(mask)}
        assert chosen == {t.pair for t in brute_force.select(trials, subset)}
