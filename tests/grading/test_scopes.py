"""Which trials are in a scope, and which in a subset."""

from dataclasses import replace

import numpy as np
import pytest

from builders import build_reference
from leaderboard.grading import list_scopes, subset_masks
from leaderboard.models import Benchmark
from leaderboard.reference import Reference

REFERENCE = build_reference(2)
EVERYTHING = np.ones(REFERENCE.n_trials, bool)


def _with_right(n_right: list[int], n: list[int], reference: Reference = REFERENCE) -> Reference:
    """Let some people be right on the first trials, and nobody rate the others."""
    assert reference.people is not None
    right, total = (np.array(counts + [0] * (reference.n_trials - len(counts))) for counts in (n_right, n))
    n_yes = np.where(reference.labels == 1, right, total - right)
    return replace(reference, people=replace(reference.people, n=total, n_yes=n_yes, responses=None))


def _first_two_pairs(mask: np.ndarray) -> list[bool]:
    assert not mask[4:].any()
    return [bool(value) for value in mask[:4]]


def test_scopes_come_from_the_whole_to_its_parts() -> None:
    """Overall, then each property before its scenarios, in the benchmark's order."""
    scopes = list_scopes(REFERENCE, EVERYTHING)
    assert [(scope.name, scope.kind) for scope in scopes] == [
        ("overall", "overall"),
        ("Alpha", "property"),
        ("alpha_one", "scenario"),
        ("alpha_two", "scenario"),
        ("Beta", "property"),
        ("beta_one", "scenario"),
    ]


def test_a_scope_holds_its_own_trials() -> None:
    """Scenarios make up their property, properties the whole."""
    masks = {scope.name: scope.mask for scope in list_scopes(REFERENCE, EVERYTHING)}
    assert (masks["alpha_one"] | masks["alpha_two"]).tolist() == masks["Alpha"].tolist()
    assert (masks["Alpha"] ^ masks["Beta"]).all()
    assert masks["overall"].all()


def test_one_missing_trial_closes_every_scope_around_it() -> None:
    """What is not covered wholly is no scope."""
    covered = EVERYTHING.copy()
    covered[np.flatnonzero(REFERENCE.in_scenario("beta_one"))[0]] = False
    names = [scope.name for scope in list_scopes(REFERENCE, covered)]
    assert names == ["Alpha", "alpha_one", "alpha_two"]


def test_a_scenario_without_trials_is_no_scope() -> None:
    """It could only be empty, and does not keep its property from being whole."""
    content = REFERENCE.benchmark.model_dump(mode="json", by_alias=True)
    content["scenarios"].append({"id": "alpha_new", "title": "alpha new", "property": "Alpha"})
    extended = replace(REFERENCE, benchmark=Benchmark.model_validate(content))
    names = [scope.name for scope in list_scopes(extended, EVERYTHING)]
    assert "alpha_new" not in names
    assert {"overall", "Alpha"} <= set(names)


@pytest.mark.parametrize(
    ("n_right", "n", "easy", "hard"),
    [
        ([3, 2, 2, 2], [4, 4, 4, 4], True, False),  # one easy member suffices
        ([2, 1, 2, 2], [4, 4, 4, 4], False, True),  # one hard member
        ([4, 0, 2, 2], [4, 4, 4, 4], True, True),  # one of each: in both
        ([2, 1, 2, 2], [3, 3, 4, 4], False, False),  # at the bounds exactly
        ([3, 0, 2, 2], [4, 0, 4, 4], True, False),  # a member that nobody rated is neither
        ([0, 0, 2, 2], [0, 0, 4, 4], False, False),
    ],
)
def test_a_pair_is_easy_or_hard_as_a_whole(n_right: list[int], n: list[int], easy: bool, hard: bool) -> None:
    """Both members of the first pair are in the subset or none; the second pair never is."""
    masks = subset_masks(_with_right(n_right, n))
    assert _first_two_pairs(masks["easy"]) == [easy, easy, False, False]
    assert _first_two_pairs(masks["hard"]) == [hard, hard, False, False]
    assert masks["all"].all()


def test_bounds_are_those_of_the_benchmark() -> None:
    """With easy above 1/2 a trial on which two of three are right is easy."""
    content = REFERENCE.benchmark.model_dump(mode="json", by_alias=True)
    content["grading"]["easy"] = "1/2"
    lenient = replace(REFERENCE, benchmark=Benchmark.model_validate(content))
    strict_masks, masks = (subset_masks(_with_right([2], [3], r)) for r in (REFERENCE, lenient))
    assert not strict_masks["easy"].any()
    assert masks["easy"].sum() == 2


def test_trials_without_partner_count_for_themselves() -> None:
    """Where each trial has a pair id of its own, nothing spreads."""
    single = replace(REFERENCE, pairs=np.arange(REFERENCE.n_trials), pair_ids=REFERENCE.trial_ids)
    masks = subset_masks(_with_right([4, 0, 2, 2], [4, 4, 4, 4], single))
    assert _first_two_pairs(masks["easy"]) == [True, False, False, False]
    assert _first_two_pairs(masks["hard"]) == [False, True, False, False]


def test_without_people_there_are_no_easy_and_hard_trials() -> None:
    """Only `all` is left."""
    assert list(subset_masks(build_reference(2, n_people=0))) == ["all"]
    assert list(subset_masks(REFERENCE)) == ["all", "easy", "hard"]
