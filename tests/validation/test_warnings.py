"""What a reader should look at twice."""

import dataclasses

import numpy as np
import pytest
from numpy.typing import ArrayLike

from builders import build_metadata, build_reference, build_submission
from leaderboard.problems import Problems
from leaderboard.reference import Reference
from leaderboard.submission import Submission
from leaderboard.validation.warnings import find_suspicions, judge_inputs

REFERENCE = build_reference(16)
N = REFERENCE.n_trials
RANDOM = np.random.default_rng(3).uniform(0.05, 0.95, N).round(3)


def make(
    probabilities: ArrayLike, team: str = "Team", slug: str = "example", **changes: object
) -> Submission:
    plain = build_submission(REFERENCE, np.asarray(probabilities, float).tolist())
    metadata = build_metadata("Example", team=team, **changes)
    return dataclasses.replace(plain, slug=slug, metadata=metadata)


def warn(submission: Submission, *others: Submission, reference: Reference = REFERENCE) -> list[str]:
    problems = Problems()
    find_suspicions(submission, reference, others, "f", problems)
    judge_inputs(submission, reference, "f", problems)
    assert not problems.has_errors
    return [problem.code for problem in problems]


def test_ordinary_predictions_raise_no_brow() -> None:
    """A warning is rare enough to be read."""
    assert warn(make(RANDOM)) == []


@pytest.mark.parametrize("value", [0.0, 0.5, 1.0])
def test_constants_are_named(value: float) -> None:
    """Whatever the constant is."""
    assert warn(make([value] * N)) == ["constant-probabilities"]


def test_labels_are_recognised() -> None:
    """Exactly the labels; a single difference is a model's."""
    assert warn(make(REFERENCE.labels)) == ["equal-to-labels"]
    assert warn(make([0.4, *REFERENCE.labels[1:]])) == []


def test_labels_are_recognised_in_part_of_the_benchmark() -> None:
    """What is covered and answered counts."""
    covered = REFERENCE.in_scenario("beta_one")
    probabilities = np.where(covered, REFERENCE.labels, 0.5)
    partial = build_submission(
        REFERENCE, probabilities.tolist(), answered=covered.tolist(), covered=covered.tolist()
    )
    assert warn(partial) == ["equal-to-labels"]


def test_human_means_are_recognised_up_to_rounding() -> None:
    """Four decimals are as good as all; without human data there is nothing to compare with."""
    people = REFERENCE.people
    assert people is not None
    means = people.n_yes / people.n
    assert warn(make(means)) == ["equal-to-human-means"]
    assert warn(make(means.round(4))) == ["equal-to-human-means"]
    assert warn(make(means.round(2))) == []
    assert warn(make(means), reference=dataclasses.replace(REFERENCE, people=None)) == []


def test_copies_of_another_team_are_named() -> None:
    """Equal, or turned by something that keeps order and side."""
    rival = make(RANDOM, "Other", "rival")
    assert warn(make(RANDOM), rival) == ["copy-of-another"]
    assert warn(make(0.5 + (RANDOM - 0.5) ** 3), rival) == ["copy-of-another"]
    assert warn(make(1 - RANDOM), rival) == []
    assert warn(make(RANDOM[::-1]), rival) == []


def test_a_team_may_send_its_own_predictions_again() -> None:
    """Nor is a submission a copy of itself."""
    assert warn(make(RANDOM), make(RANDOM, "Team", "second")) == []
    assert warn(make(RANDOM), make(RANDOM, "Other", "example")) == []


def test_few_shared_trials_prove_nothing() -> None:
    """Fewer than 50 trials answered by both are not compared, nor are constants."""
    few = np.arange(N) < 49
    rival = dataclasses.replace(make(RANDOM, "Other", "rival"), answered=few)
    assert warn(make(RANDOM), rival) == []
    more = dataclasses.replace(rival, answered=np.arange(N) < 50)
    assert warn(make(RANDOM), more) == ["copy-of-another"]
    assert warn(make([0.5] * N), make([0.5] * N, "Other", "rival")) == ["constant-probabilities"]


def test_swapped_copies_are_recognised() -> None:
    """Pairs told apart the wrong way round, far more than chance; told apart rightly is no fault."""
    right = np.where(REFERENCE.labels == 1, 0.8, 0.3) + 0.001 * np.arange(N)
    assert warn(make(1 - right)) == ["swapped-copies"]
    assert warn(make(right)) == []


def test_below_chance_without_telling_pairs_apart_is_bad_luck() -> None:
    """Both members with the same answer cannot have been swapped."""
    by_pair = np.where(REFERENCE.pairs % 2 == 0, 0.8, 0.3) + 0.0001 * np.arange(N)
    assert warn(make(by_pair)) == []


def test_state_is_more_than_a_track_with_pixels_shows() -> None:
    """Unless the track is fully observed; baselines are no competitors, a bare file says nothing."""
    assert warn(make(RANDOM, inputs="state")) == ["beyond-track"]
    assert warn(make(RANDOM, inputs="state", family="baseline")) == []
    assert warn(make(RANDOM, inputs="state", testing="fully_observed")) == []
    assert warn(dataclasses.replace(make(RANDOM), metadata=None)) == []
