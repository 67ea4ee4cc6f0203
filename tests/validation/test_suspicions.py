"""Where suspicions begin and end, and what they say."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from builders import build_metadata, build_reference, build_submission
from leaderboard.metrics.pairs import find_opposite_pairs
from leaderboard.problems import Problem, Problems
from leaderboard.reference import Reference
from leaderboard.submission import Submission
from leaderboard.validation.warnings import find_suspicions, judge_inputs

REFERENCE = build_reference(20)
N = REFERENCE.n_trials
RANDOM = np.random.default_rng(5).uniform(0.05, 0.95, N).round(3)
ALL = np.ones(N, bool)


def make(
    probabilities: ArrayLike, *, answered: ArrayLike = ALL, slug: str | None = "example", team: str = "Team"
) -> Submission:
    given_values = np.where(answered, np.asarray(probabilities, float), 0.5)
    plain = build_submission(REFERENCE, given_values.tolist(), answered=np.asarray(answered).tolist())
    metadata = None if slug is None else build_metadata(team=team)
    return dataclasses.replace(plain, slug=slug, metadata=metadata)


def warn(submission: Submission, *others: Submission, reference: Reference = REFERENCE) -> list[Problem]:
    problems = Problems()
    find_suspicions(submission, reference, others, "f", problems)
    judge_inputs(submission, reference, "f", problems)
    assert not problems.has_errors
    assert all(problem.hint and problem.line is None for problem in problems)
    return problems.found


def codes(*submissions: Submission) -> list[str]:
    return [problem.code for problem in warn(*submissions)]


@pytest.mark.parametrize(
    ("value", "shown"), [(1.0, "1"), (0.5, "0.5"), (0.123456789, "0.123456789"), (1e-7, "1e-07")]
)
def test_a_constant_is_shown_to_its_last_digit(value: float, shown: str) -> None:
    """What the file says, not a rounded form of it."""
    assert warn(make([value] * N))[0].message == f"all {N} probabilities are {shown}"


def test_only_answered_trials_are_compared() -> None:
    """The 0.5 of an unanswered trial makes a constant or an oracle no less of one."""
    answered = np.arange(N) % 3 > 0
    labels = REFERENCE.labels[answered]
    assert warn(make([0.7] * N, answered=answered))[0].message == f"all {labels.size} probabilities are 0.7"
    assert codes(make(REFERENCE.labels, answered=answered)) == ["equal-to-labels"]


def test_without_any_answer_nothing_is_suspicious() -> None:
    """A model that refused everything is graded as such."""
    assert warn(make([0.5] * N, answered=~ALL), make(RANDOM, slug="rival", team="Rival")) == []


def test_human_means_are_compared_where_people_answered() -> None:
    """Trials that nobody judged may hold anything."""
    people = REFERENCE.people
    assert people is not None
    rated = np.arange(N) % 4 > 0
    partly = dataclasses.replace(
        people, n=np.where(rated, people.n, 0), n_yes=np.where(rated, people.n_yes, 0)
    )
    reference = dataclasses.replace(REFERENCE, people=partly)
    given_values = np.where(rated, people.n_yes / people.n, RANDOM)
    found = warn(make(given_values), reference=reference)
    assert [problem.code for problem in found] == ["equal-to-human-means"]


def test_a_bare_file_is_compared_with_submissions() -> None:
    """It has no team of its own yet; a rival without a name is no rival."""
    rival = make(RANDOM, slug="rival", team="Rival")
    assert codes(make(RANDOM, slug=None), rival) == ["copy-of-another"]
    assert codes(make(RANDOM, slug=None), make(RANDOM, slug=None)) == []


def test_every_original_is_named() -> None:
    """One warning for each submission that is the same, with how much of it."""
    partial = make(RANDOM, answered=np.arange(N) < 60, slug="half", team="Half")
    found = warn(make(RANDOM), make(RANDOM, slug="rival", team="Rival"), partial)
    assert [problem.message for problem in found] == [
        f"the probabilities equal those of rival on {N} trials",
        "the probabilities equal those of half on 60 trials",
    ]


def test_nearly_equal_means_the_same_order_and_the_same_answers() -> None:
    """The order may differ by noise in the last digits; one answer in a hundred may differ."""
    rival = make(RANDOM, slug="rival", team="Rival")
    noise = np.random.default_rng(1).normal(0, 1e-4, N)
    found = warn(make(RANDOM + noise), rival)
    assert [problem.message for problem in found] == [
        f"the probabilities nearly equal those of rival on {N} trials"
    ]
    assert codes(make(RANDOM / 2), rival) == []
    near_half = np.argsort(np.abs(RANDOM - 0.5))
    for n_turned, expected in ((1, ["copy-of-another"]), (2, [])):
        turned = RANDOM.copy()
        turned[near_half[:n_turned]] = 1 - turned[near_half[:n_turned]]
        assert codes(make(turned), rival) == expected


def test_a_constant_rival_is_nobodys_original() -> None:
    """Neither where only the rival is constant, nor among equal constants."""
    rival = make([0.7] * N, slug="rival", team="Rival")
    assert codes(make(np.where(RANDOM > 0.5, RANDOM, 1 - RANDOM)), rival) == []


def swap(n_wrong: int, n_right: int) -> Submission:
    """Tell so many opposite pairs apart the wrong way, so many rightly, and answer the others alike."""
    yes, no = find_opposite_pairs(REFERENCE.pairs, REFERENCE.labels).T
    probabilities = np.full(N, 0.7)
    probabilities[no[:n_wrong]], probabilities[yes[:n_wrong]] = 0.8, 0.1
    rightly = slice(n_wrong, n_wrong + n_right)
    probabilities[no[rightly]], probabilities[yes[rightly]] = 0.2, 0.9
    return make(probabilities)


@pytest.mark.parametrize(
    ("n_wrong", "n_right", "is_swapped"),
    [(60, 0, True), (30, 0, True), (29, 0, False), (40, 15, True), (30, 28, False), (0, 60, False)],
)
def test_swapping_begins_at_half_of_the_pairs(n_wrong: int, n_right: int, *, is_swapped: bool) -> None:
    """Fewer pairs told apart, or a number of wrong ones that chance would have, are bad luck."""
    found = warn(swap(n_wrong, n_right))
    assert [problem.code for problem in found] == ["swapped-copies"] * is_swapped
    if is_swapped:
        assert found[0].message == (
            f"{n_wrong + n_right} of 60 pairs get different answers, {n_wrong} of them the wrong way round"
        )


def test_a_benchmark_without_pairs_has_none_to_swap() -> None:
    """Every trial a pair of its own: being always wrong is no swap."""
    alone = dataclasses.replace(REFERENCE, pairs=np.arange(N), pair_ids=REFERENCE.trial_ids)
    assert warn(make(0.9 - 0.8 * REFERENCE.labels + RANDOM / 100), reference=alone) == []


@given(st.lists(st.sampled_from([0.0, 0.25, 0.5, 0.75, 1.0]), min_size=N, max_size=N))
def test_any_predictions_can_be_looked_at(values: list[float]) -> None:
    """Ties, constants and answers left out raise nothing but warnings, each at most once per rival."""
    answered = np.asarray(values) != 0.25
    rival = make(values[::-1], answered=answered[::-1], slug="rival", team="Rival")
    found = codes(make(values, answered=answered), rival)
    assert len(found) == len(set(found))
