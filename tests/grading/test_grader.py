"""A whole result: scopes, subsets, counts, overall values, and what must not change it."""

import json
import re
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from builders import build_reference, build_submission
from leaderboard.errors import LeaderboardError
from leaderboard.grading import (
    METRICS,
    SUBSETS,
    find_metric,
    grade,
    grade_people,
    result_bytes,
    subset_masks,
)
from leaderboard.grading.scopes import CROSSFIT_SUBSETS
from leaderboard.models import Check, Result
from leaderboard.reference import Reference

REFERENCE = build_reference(5)
VALUES = st.sampled_from([0.0, 0.1, 0.3, 0.5, 0.6, 0.9, 1.0])
PREDICTIONS = st.lists(VALUES, min_size=REFERENCE.n_trials, max_size=REFERENCE.n_trials)
ANSWERED = st.lists(st.booleans(), min_size=REFERENCE.n_trials, max_size=REFERENCE.n_trials)


def _value(result: Result, metric: str, scope: str = "overall", subset: str = "all") -> float | None:
    return result.scores[scope][subset].metrics[metric].value


def test_scopes_and_subsets_are_those_of_the_contract() -> None:
    """Overall and properties come on five subsets, scenarios on all; each with its metrics."""
    result = grade(build_submission(REFERENCE, [0.5] * REFERENCE.n_trials), REFERENCE)
    assert {scope: tuple(subsets) for scope, subsets in result.scores.items()} == {
        "overall": SUBSETS,
        "Alpha": SUBSETS,
        "alpha_one": ("all",),
        "alpha_two": ("all",),
        "Beta": SUBSETS,
        "beta_one": ("all",),
    }
    names = {subset: [metric.name for metric in METRICS] for subset in ("all", "easy", "hard")}
    names |= {subset: ["accuracy", "human_r", "human_gap"] for subset in CROSSFIT_SUBSETS}
    for subsets in result.scores.values():
        assert {subset: list(scores.metrics) for subset, scores in subsets.items()} == {
            s: names[s] for s in subsets
        }


def test_counts_are_of_trials_pairs_and_pairs_in_both() -> None:
    """The numbers behind a score are those of the subset's masks."""
    result = grade(build_submission(REFERENCE, [0.5] * REFERENCE.n_trials), REFERENCE)
    masks = subset_masks(REFERENCE)
    assert (result.scores["Alpha"]["all"].n, result.scores["Alpha"]["all"].n_pairs) == (20, 10)
    easy = result.scores["overall"]["easy"]
    assert easy.n == masks["easy"].sum() == 2 * easy.n_pairs
    assert easy.n_pairs_in_both == (masks["easy"] & masks["hard"]).sum() / 2
    assert result.scores["overall"]["all"].n_pairs_in_both is None


@given(probabilities=PREDICTIONS, answered=ANSWERED)
def test_values_stay_in_their_range_and_json_has_no_nan(
    probabilities: list[float], answered: list[bool]
) -> None:
    """Whatever is predicted, each value is in its range or null with a reason, and JSON round-trips."""
    submission = build_submission(
        REFERENCE, np.where(answered, probabilities, 0.5).tolist(), answered=answered
    )
    result = grade(submission, REFERENCE)
    ranges = {metric.name: (metric.low, metric.high) for metric in METRICS}
    for subsets in result.scores.values():
        for scores in subsets.values():
            for name, score in scores.metrics.items():
                low, high = ranges[name]
                assert score.why if score.value is None else low <= score.value <= high
    assert Result.model_validate_json(result_bytes(result)) == result


@given(probabilities=PREDICTIONS)
def test_overall_is_the_mean_of_the_properties(probabilities: list[float]) -> None:
    """Except for the pooled p, and undefined where a property is."""
    result = grade(build_submission(REFERENCE, probabilities), REFERENCE)
    for metric in METRICS:
        parts = [_value(result, metric.name, name) for name in ("Alpha", "Beta")]
        overall = _value(result, metric.name)
        if metric.is_p_value:
            assert overall is not None
        elif None in parts:
            assert overall is None
        else:
            assert overall == pytest.approx(np.mean([p for p in parts if p is not None]), abs=1e-6)


@given(probabilities=PREDICTIONS)
def test_exchanging_yes_and_no_everywhere_changes_no_symmetric_score(probabilities: list[float]) -> None:
    """With labels, answers of people and probabilities all turned round, only the YES rate turns round."""
    people = REFERENCE.people
    assert people is not None
    assert people.responses is not None
    turned_responses = replace(people.responses, answers=1 - people.responses.answers)
    turned = replace(
        REFERENCE,
        labels=1 - REFERENCE.labels,
        people=replace(people, n_yes=people.n - people.n_yes, responses=turned_responses),
    )
    plain = grade(build_submission(REFERENCE, probabilities), REFERENCE)
    other = grade(build_submission(turned, [1 - p for p in probabilities]), turned)
    for metric in METRICS:
        value, twin = _value(plain, metric.name), _value(other, metric.name)
        if metric.name == "yes_rate":
            assert value is not None
            assert twin == pytest.approx(1 - value, abs=2e-6)
        elif metric.name not in (
            "ece",
            "human_ece",
        ):  # bins are open at one end, so values on their bounds change bins
            assert twin == (value if value is None else pytest.approx(value, abs=2e-6))


@given(probabilities=PREDICTIONS)
def test_a_monotone_change_leaves_order_alone(probabilities: list[float]) -> None:
    """AUC and pair order see only which probability is higher."""
    plain = grade(build_submission(REFERENCE, probabilities), REFERENCE)
    squared = grade(build_submission(REFERENCE, [p**2 for p in probabilities]), REFERENCE)
    for name in ("auc", "pair_order"):
        assert _value(plain, name) == _value(squared, name)


def test_the_order_of_trials_does_not_matter() -> None:
    """The same trials listed in another order give the same scores."""
    rng = np.random.default_rng(5)
    order = rng.permutation(REFERENCE.n_trials)
    place = np.argsort(order)
    people = REFERENCE.people
    assert people is not None
    assert people.responses is not None
    shuffled = replace(
        REFERENCE,
        trial_ids=tuple(REFERENCE.trial_ids[i] for i in order),
        properties=REFERENCE.properties[order],
        scenarios=REFERENCE.scenarios[order],
        pairs=REFERENCE.pairs[order],
        copies=REFERENCE.copies[order],
        labels=REFERENCE.labels[order],
        people=replace(
            people,
            n=people.n[order],
            n_yes=people.n_yes[order],
            responses=replace(people.responses, trials=place[people.responses.trials]),
        ),
    )
    probabilities = rng.random(REFERENCE.n_trials)
    plain = grade(build_submission(REFERENCE, probabilities.tolist()), REFERENCE)
    other = grade(build_submission(shuffled, probabilities[order].tolist()), shuffled)
    assert other.scores == plain.scores


def test_a_partial_submission_has_only_what_it_covers_wholly() -> None:
    """Without one scenario of Alpha there is neither Alpha nor overall."""
    covered = ~REFERENCE.in_scenario("alpha_two")
    submission = build_submission(
        REFERENCE, [0.5] * REFERENCE.n_trials, answered=covered.tolist(), covered=covered.tolist()
    )
    result = grade(submission, REFERENCE)
    assert list(result.scores) == ["alpha_one", "Beta", "beta_one"]
    assert result.coverage.model_dump() == {
        "trials": 20,
        "answered": 20,
        "properties": ("Beta",),
        "complete": False,
    }


def test_without_human_data_human_metrics_say_so() -> None:
    """No easy and hard subsets, and a reason in place of each human value."""
    bare = build_reference(n_people=0)
    result = grade(build_submission(bare, [0.9] * bare.n_trials), bare)
    assert list(result.scores["overall"]) == ["all"]
    whys = {
        m.name: result.scores["overall"]["all"].metrics[m.name].why for m in METRICS if m.needs != "labels"
    }
    assert set(whys.values()) == {"the reference has no human data"}
    assert grade_people(bare) == {}


def test_with_counts_only_single_people_are_missed() -> None:
    """Correlations are there, kappas are not."""
    counts = build_reference(responses=False)
    rng = np.random.default_rng(2)
    result = grade(build_submission(counts, rng.random(counts.n_trials).tolist()), counts)
    scores = result.scores["overall"]["all"].metrics
    assert scores["human_r"].value is not None
    assert scores["error_consistency"].why == "the reference has no responses of single people"


def test_trials_that_nobody_rated_count_in_accuracy_but_not_in_human_metrics() -> None:
    """The gap is taken over rated trials on both sides."""
    people = REFERENCE.people
    assert people is not None
    n = people.n.copy()
    n[: REFERENCE.n_trials // 2] = 0
    half = replace(REFERENCE, people=replace(people, n=n, n_yes=np.minimum(people.n_yes, n), responses=None))
    right = np.where(half.labels == 1, 0.9, 0.1)
    right[n == 0] = 1 - right[n == 0]
    result = grade(build_submission(half, right.tolist()), half)
    beta = result.scores["Beta"]["all"]
    assert (beta.n, beta.n_rated) == (10, 10)
    alpha = result.scores["Alpha"]["all"]
    assert (alpha.n, alpha.n_rated) == (20, 5)
    assert alpha.metrics["accuracy"].value == 0.25
    human = grade_people(half)["Alpha"]["all"].metrics["accuracy"].value
    assert human is not None
    assert alpha.metrics["human_gap"].value == pytest.approx(1 - human, abs=1e-6)


def test_a_tiny_p_is_never_zero() -> None:
    """Right on all of 400 pairs has p = 2^-400, and that is what is written."""
    large = build_reference(134, n_people=0)
    result = grade(build_submission(large, large.labels.astype(float).tolist()), large)
    p = _value(result, "accuracy_p")
    assert p == float(f"{2.0**-402:.6g}")
    assert json.loads(result_bytes(result))["scores"]["overall"]["all"]["accuracy_p"]["value"] == p


def test_a_p_too_small_for_a_float_is_the_smallest_float() -> None:
    """Right on all of 603 pairs: 2^-1206 with single trials is no float64, and 0 would be wrong."""
    paired = build_reference(201, n_people=0)
    single = replace(paired, pairs=np.arange(paired.n_trials), pair_ids=paired.trial_ids)
    result = grade(build_submission(single, single.labels.astype(float).tolist()), single)
    assert _value(result, "accuracy_p") == 5e-324
    assert Result.model_validate_json(result_bytes(result)) == result


def _rate_equally(share: Fraction) -> Reference:
    """Let the same share of people be right on every trial."""
    people = REFERENCE.people
    assert people is not None
    n = np.full(REFERENCE.n_trials, share.denominator)
    n_yes = np.where(REFERENCE.labels == 1, share.numerator, n - share.numerator)
    return replace(REFERENCE, people=replace(people, n=n, n_yes=n_yes, responses=None))


def test_a_subset_without_trials_is_undefined_throughout() -> None:
    """Where everything is easy nothing is hard, and each metric says so, overall too."""
    easy = _rate_equally(Fraction(3, 4))
    result = grade(build_submission(easy, np.linspace(0, 1, easy.n_trials).tolist()), easy)
    for scope in ("overall", "Alpha", "Beta"):
        scores = result.scores[scope]["hard"]
        assert (scores.n, scores.n_pairs, scores.n_rated, scores.n_pairs_in_both) == (0, 0, 0, 0)
        assert {score.why for score in scores.metrics.values()} == {"no trial is in this subset"}
        assert grade_people(easy)[scope]["hard"].metrics["accuracy"].value is None
    assert result.scores["overall"]["easy"].n == easy.n_trials


def test_an_overall_value_is_undefined_for_the_property_that_has_none() -> None:
    """The reason names the first such property; a reason that all share stands alone."""
    rng = np.random.default_rng(3)
    constant_in_beta = np.where(REFERENCE.in_property("Beta"), 0.5, rng.random(REFERENCE.n_trials))
    result = grade(build_submission(REFERENCE, constant_in_beta.tolist()), REFERENCE)
    assert result.scores["overall"]["all"].metrics["human_r"].why == "Beta: all probabilities are equal"
    constant = grade(build_submission(REFERENCE, [0.5] * REFERENCE.n_trials), REFERENCE)
    assert constant.scores["overall"]["all"].metrics["human_r"].why == "all probabilities are equal"


def test_p_overall_pools_the_pairs() -> None:
    """Right on one pair of each property and tied on the others: p = 1/4, not the mean of 1/2 and 1/2."""
    probabilities = np.full(REFERENCE.n_trials, 0.5)
    for name in ("Alpha", "Beta"):
        first = np.flatnonzero(REFERENCE.in_property(name))[:2]
        probabilities[first] = REFERENCE.labels[first]
    result = grade(build_submission(REFERENCE, probabilities.tolist()), REFERENCE)
    assert [_value(result, "accuracy_p", scope) for scope in ("Alpha", "Beta", "overall")] == [0.5, 0.5, 0.25]


def test_a_result_says_what_was_graded_against_what() -> None:
    """Checksum of the predictions, digest and kind of the reference, and how much was attempted."""
    answered = np.arange(REFERENCE.n_trials) > 2
    result = grade(build_submission(REFERENCE, [0.5] * answered.size, answered=answered.tolist()), REFERENCE)
    assert result.inputs.model_dump() == {
        "predictions_sha256": "1" * 64,
        "reference_digest": "0" * 64,
        "reference_kind": "synthetic",
    }
    assert result.coverage.model_dump() == {
        "trials": 30,
        "answered": 27,
        "properties": ("Alpha", "Beta"),
        "complete": True,
    }


@given(probabilities=PREDICTIONS)
def test_equal_submissions_give_equal_bytes(probabilities: list[float]) -> None:
    """And no value is -0 or has more than six decimals, a tiny p aside."""
    submission = build_submission(REFERENCE, probabilities)
    written = result_bytes(grade(submission, REFERENCE))
    assert written == result_bytes(grade(submission, REFERENCE))
    assert b"-0.0," not in written
    assert b"-0.0\n" not in written
    assert not re.search(rb"[0-9]\.[0-9]{7}", written)


def test_checks_are_kept_as_they_are() -> None:
    """What validation remarked on stands in the result."""
    check = Check(code="constant-probabilities", message="all equal")
    result = grade(build_submission(REFERENCE, [0.5] * REFERENCE.n_trials), REFERENCE, checks=[check])
    assert result.checks == (check,)


def test_people_score_themselves_over_rated_trials() -> None:
    """The human row averages the share who were right, and overall the properties."""
    people = REFERENCE.people
    assert people is not None
    right = np.where(REFERENCE.labels == 1, people.n_yes, people.n - people.n_yes) / people.n
    scores = grade_people(REFERENCE)
    parts = [right[REFERENCE.in_property(name)].mean() for name in ("Alpha", "Beta")]
    assert scores["Alpha"]["all"].metrics["accuracy"].value == pytest.approx(parts[0], abs=1e-6)
    assert scores["overall"]["all"].metrics["accuracy"].value == pytest.approx(np.mean(parts), abs=1e-6)
    easy, hard = (scores["overall"][name].metrics["accuracy"].value for name in ("easy", "hard"))
    assert easy is not None
    assert hard is not None
    assert easy > hard


def test_people_who_judged_one_property_only_leave_overall_undefined() -> None:
    """What the other property lacks is a reason or left out; nothing fails."""
    people = REFERENCE.people
    assert people is not None
    assert people.responses is not None
    alpha = REFERENCE.in_property("Alpha")
    r, kept = people.responses, alpha[people.responses.trials]
    single = replace(r, participants=r.participants[kept], trials=r.trials[kept], answers=r.answers[kept])
    half = replace(
        REFERENCE,
        people=replace(
            people, n=np.where(alpha, people.n, 0), n_yes=np.where(alpha, people.n_yes, 0), responses=single
        ),
    )
    result = grade(build_submission(half, np.linspace(0, 1, half.n_trials).tolist()), half)
    assert set(result.scores["Alpha"]) == set(SUBSETS)
    assert set(result.scores["overall"]) == set(result.scores["Beta"]) == {"all", "easy", "hard"}
    assert result.scores["overall"]["all"].metrics["human_r"].why == "Beta: fewer than two rated trials"
    scores = grade_people(half)
    assert scores["Alpha"]["all"].metrics["split_half_r"].value is not None
    assert "split_half_r" not in scores["overall"]["all"].metrics
    assert scores["overall"]["all"].metrics["reliability"].value is None


def test_an_unknown_metric_is_refused_by_name() -> None:
    """The hint lists the metrics."""
    with pytest.raises(LeaderboardError, match="there is no metric 'beauty'") as caught:
        find_metric("beauty")
    assert caught.value.hint.startswith("choose one of accuracy, ")


def test_bounds_of_easy_and_hard_are_strict_and_exact() -> None:
    """Two of three right is not above 2/3, and one of three is not below 1/3."""
    people = REFERENCE.people
    assert people is not None
    n = np.full(REFERENCE.n_trials, 3)
    n_right = np.where(np.arange(REFERENCE.n_trials) % 2, 1, 2)
    n_yes = np.where(REFERENCE.labels == 1, n_right, n - n_right)
    exact: Reference = replace(REFERENCE, people=replace(people, n=n, n_yes=n_yes, responses=None))
    masks = subset_masks(exact)
    assert not masks["easy"].any()
    assert not masks["hard"].any()
