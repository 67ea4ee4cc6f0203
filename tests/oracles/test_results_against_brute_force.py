"""Whole results against plain loops: every metric on every subset of every scope, overall included."""

import math
from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import pytest

from builders import build_reference, build_submission
from leaderboard.grading import METRICS, grade, grade_people
from leaderboard.grading.scopes import CROSSFIT_SUBSETS
from leaderboard.models import Score
from leaderboard.reference import Reference
from oracles import brute_force
from oracles.brute_force import Trial

SEEDS = range(6)


def _list_trials(
    reference: Reference, probabilities: np.ndarray, answered: np.ndarray
) -> dict[str, list[Trial]]:
    """Turn a reference and predictions into trials, by property and by scenario."""
    people = reference.people
    assert people is not None
    assert people.responses is not None
    votes: list[dict[str, int]] = [{} for _ in reference.trial_ids]
    names = people.responses.participant_ids
    for person, trial, answer in zip(
        people.responses.participants, people.responses.trials, people.responses.answers, strict=True
    ):
        votes[trial][names[person]] = int(answer)
    scopes: dict[str, list[Trial]] = {}
    for i, pair in enumerate(reference.pairs):
        trial = Trial(
            str(pair), int(reference.labels[i]), float(probabilities[i]), bool(answered[i]), votes[i]
        )
        for scope in (
            reference.benchmark.properties[reference.properties[i]].name,
            reference.benchmark.scenarios[reference.scenarios[i]].id,
        ):
            scopes.setdefault(scope, []).append(trial)
    return scopes


def _average(values: Sequence[Fraction | float | None]) -> float | None:
    defined = [float(value) for value in values if value is not None]
    return sum(defined) / len(defined) if len(defined) == len(values) else None


def _expect(scopes: dict[str, list[Trial]], metric: str, scope: str, subset: str) -> Fraction | float | None:
    if scope != "overall":
        trials = brute_force.select(scopes[scope], subset)
        return brute_force.METRICS[metric](trials) if trials else None
    if metric != "accuracy_p":
        return _average([_expect(scopes, metric, name, subset) for name in ("Alpha", "Beta")])
    return brute_force.accuracy_p(brute_force.select(scopes["Alpha"] + scopes["Beta"], subset))


def _agree(score: Score, expected: Fraction | float | None) -> bool:
    if expected is None or score.value is None:
        return expected is None and score.value is None
    return score.value == pytest.approx(float(expected), abs=1e-6)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_result_equals_its_brute_force_twin(seed: int) -> None:
    """With ties and unanswered trials; easy and hard are chosen anew by the twin."""
    reference, rng = build_reference(3, seed=seed, n_people=6), np.random.default_rng(seed)
    answered = rng.random(reference.n_trials) < 0.9
    probabilities = np.where(answered, np.round(rng.random(reference.n_trials), 1), 0.5)
    submission = build_submission(reference, probabilities.tolist(), answered=answered.tolist())
    scopes = _list_trials(reference, probabilities, answered)
    different = [
        (scope, subset, metric.name)
        for scope, subsets in grade(submission, reference).scores.items()
        for subset, scores in subsets.items()
        if subset not in CROSSFIT_SUBSETS
        for metric in METRICS
        if metric.name != "human_r_normalized"
        if not _agree(scores.metrics[metric.name], _expect(scopes, metric.name, scope, subset))
    ]
    assert different == []


@pytest.mark.parametrize("seed", SEEDS)
def test_the_share_of_the_ceiling_is_of_each_property(seed: int) -> None:
    """Human r over the root of people's reliability, on whole properties; overall is their mean."""
    reference, rng = build_reference(10, seed=seed, n_people=30), np.random.default_rng(seed)
    result = grade(build_submission(reference, rng.random(reference.n_trials).tolist()), reference)
    people = grade_people(reference)
    shares = []
    for name in ("Alpha", "Beta"):
        r = result.scores[name]["all"].metrics["human_r"].value
        reliability = people[name]["all"].metrics["reliability"].value
        assert r is not None
        assert reliability is not None
        shares.append(r / math.sqrt(reliability))
        assert result.scores[name]["all"].metrics["human_r_normalized"].value == pytest.approx(
            shares[-1], abs=1e-5
        )
        assert people[name]["all"].metrics["ceiling"].value == pytest.approx(math.sqrt(reliability), abs=1e-5)
    overall = result.scores["overall"]["all"].metrics["human_r_normalized"]
    assert overall.value == pytest.approx(np.mean(shares), abs=1e-5)
    for scope, subset in (("Alpha", "easy"), ("alpha_one", "all")):
        assert result.scores[scope][subset].metrics["human_r_normalized"].why is not None


@pytest.mark.parametrize("seed", SEEDS)
def test_the_human_row_equals_its_brute_force_twin(seed: int) -> None:
    """People's accuracy and YES rate, averaged over trials and then over properties."""
    reference = build_reference(3, seed=seed, n_people=6)
    answered = np.ones(reference.n_trials, bool)
    scopes = _list_trials(reference, np.full(reference.n_trials, 0.5), answered)
    for subset in ("all", "easy", "hard"):
        parts = [brute_force.select(scopes[name], subset) for name in ("Alpha", "Beta")]
        row = grade_people(reference)["overall"][subset].metrics
        right = [[t.human_accuracy for t in part if t.votes] for part in parts]
        said_yes = [[t.human_mean for t in part if t.votes] for part in parts]
        assert _agree(row["accuracy"], _average([_average(values) if values else None for values in right]))
        assert _agree(
            row["yes_rate"], _average([_average(values) if values else None for values in said_yes])
        )
