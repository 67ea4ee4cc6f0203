"""The reliability diagram's numbers."""

import numpy as np
import pytest

from builders import build_reference, build_submission
from leaderboard.grading import grade

REFERENCE = build_reference(8)
PROBABILITIES = np.random.default_rng(2).random(REFERENCE.n_trials).round(2)
RESULT = grade(build_submission(REFERENCE, PROBABILITIES.tolist()), REFERENCE)


@pytest.mark.parametrize("scope", ["Alpha", "Beta"])
@pytest.mark.parametrize(("side", "metric"), [("label", "ece"), ("people", "human_ece")])
def test_the_bins_are_those_of_the_calibration_errors(scope: str, side: str, metric: str) -> None:
    """The distances between both means, weighted by the trials of the bin, add up to the error."""
    bins = getattr(RESULT.calibration[scope], side)
    distances = [b.n * abs(b.predicted - b.observed) for b in bins if b.n]
    error = RESULT.scores[scope]["all"].metrics[metric].value
    assert sum(distances) / RESULT.scores[scope]["all"].n == pytest.approx(error, abs=2e-6)


def test_overall_pools_the_trials_and_empty_bins_have_no_means() -> None:
    """Ten bins up to .1, .2, ... 1; people's are absent without people."""
    overall = RESULT.calibration["overall"].label
    assert [b.upto for b in overall] == [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
    assert sum(b.n for b in overall) == REFERENCE.n_trials
    bare = build_reference(2, n_people=0)
    calibration = grade(build_submission(bare, [0.35] * bare.n_trials), bare).calibration["overall"]
    assert calibration.people is None
    filled = [b for b in calibration.label if b.n]
    assert [(b.upto, b.n, b.predicted, b.observed) for b in filled] == [(0.4, 12, 0.35, 0.5)]
    assert {(b.predicted, b.observed) for b in calibration.label if not b.n} == {(None, None)}
