"""The rule for particle models: a learned threshold on the smallest distance, hard or as a probability."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.errors import SourceError
from leaderboard.readout.distance import (
    DistanceReadout,
    ThresholdReadout,
    check_distances,
    learn_threshold,
)
from leaderboard.readout.features import features_from_columns
from leaderboard.readout.folds import split_pairs
from leaderboard.readout.matching import FittingSet, TargetSet

CASES = [
    ([0.25, 0.5, 1.0, 4.0], [1, 1, 0, 0], 0.75),  # between the two sides
    ([4.0, 0.25, 1.0, 0.5], [0, 1, 0, 1], 0.75),  # in any order
    ([1.0, 2.0, 3.0, 4.0], [1, 0, 1, 0], 1.5),  # below 1.5 or 3.5, three are right: the lower of the two
    ([1.0, 2.0, 3.0], [0, 0, 0], 1.0),  # below the smallest is none
    ([1.0, 1.0, 3.0], [0, 1, 0], 1.0),  # equal distances are never split
]


@pytest.mark.parametrize(("distances", "labels", "expected"), CASES)
def test_threshold_by_hand(distances: list[float], labels: list[int], expected: float) -> None:
    """The threshold is where one would put it by hand."""
    assert learn_threshold(np.array(distances), np.array(labels)) == expected


def test_all_yes_lies_above_the_largest() -> None:
    """Where all end with YES, the threshold is just above the largest distance."""
    assert learn_threshold(np.array([1.0, 2.0]), np.array([1, 1])) == np.nextafter(2.0, np.inf)


TRIALS = st.lists(st.tuples(st.integers(0, 8), st.integers(0, 1)), min_size=1, max_size=20)


@given(TRIALS)
def test_no_threshold_is_right_more_often(trials: list[tuple[int, int]]) -> None:
    """No other threshold gets more trials right, and scaled distances have the scaled threshold."""
    distances, labels = np.array([d for d, _ in trials], float), np.array([y for _, y in trials])
    threshold = learn_threshold(distances, labels)
    n_right = np.sum((distances < threshold) == labels)
    tried = [*(Fraction(d, 2) for d in range(19))]
    assert n_right == max(np.sum((distances < float(t)) == labels) for t in tried)
    assert learn_threshold(distances * 4, labels) == pytest.approx(threshold * 4)


def build(labels: list[int], distances: list[float], test: list[float]) -> tuple[FittingSet, TargetSet]:
    pairs = tuple(f"p{row // 2}" for row in range(len(labels)))
    ids = tuple(map(str, range(len(labels))))
    values = np.array(distances)[:, None]
    return (
        FittingSet("Alpha", ids, pairs, values, np.array(labels)),
        TargetSet(tuple(f"t{row}" for row in range(len(test))), np.array(test)[:, None]),
    )


LABELS, DISTANCES = [1, 0] * 6, [0.05, 0.1] * 6


def test_hard_answers() -> None:
    """Below the threshold the answer is 1, elsewhere 0; held-out trials are answered likewise."""
    fitting, test = build(LABELS, DISTANCES, [0.0, 0.07, 0.08, 3.0])
    folds = split_pairs(fitting.pair_ids, fitting.labels, seed=0)
    fit = ThresholdReadout(fitting, test).fit(folds, 0)
    assert fit.choices == {"threshold": pytest.approx(0.075)}
    assert fit.test.tolist() == [1, 1, 0, 0]
    assert fit.held_out.tolist() == LABELS


def test_held_out_threshold_is_learned_elsewhere() -> None:
    """A pair that contradicts all others is judged by the threshold of the others."""
    fitting, test = build([*LABELS, 0, 1], [*DISTANCES, 0.05, 0.1], [0.0])
    folds = split_pairs(fitting.pair_ids, fitting.labels, seed=0)
    fit = ThresholdReadout(fitting, test).fit(folds, 0)
    assert fit.held_out.tolist() == [*LABELS, 1, 0]


def test_probabilities_fall_with_the_distance() -> None:
    """By the fitted logistic, nearer is more probable, and even chances lie near the threshold."""
    fitting, test = build(LABELS, DISTANCES, [0.0, 0.05, 0.075, 0.1, 1.0])
    folds = split_pairs(fitting.pair_ids, fitting.labels, seed=0)
    readout = DistanceReadout(fitting, test)
    fit = readout.fit(folds, 0)
    assert (np.diff(fit.test) < 0).all()
    assert fit.test[2] == pytest.approx(0.5, abs=1e-6)
    assert fit.choices["threshold"] == pytest.approx(0.075)
    assert readout.projection.n_features == 1


def test_distances_below_zero_are_refused() -> None:
    """Logarithms or signed distances are no distances."""
    given_ = {"trial_id": ["a", "b"], "features": [[0.1, 0.2], [0.3, -1.5]]}
    features = features_from_columns(given_, name="mine", pooling="smallest", with_labels=False)
    with pytest.raises(SourceError, match=r"^mine: the distance of trial 'b' is -1.5, which is below 0"):
        check_distances(features)
