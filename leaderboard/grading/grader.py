"""Computing a result: each metric on each subset of each scope."""

from collections.abc import Mapping, Sequence

import numpy as np

from leaderboard import __version__
from leaderboard.files import canonical_json
from leaderboard.grading.metrics import METRICS, METRICS_VERSION
from leaderboard.grading.observations import Observations
from leaderboard.grading.scopes import SUBSETS, Scope, list_scopes, subset_masks
from leaderboard.metrics.accuracy import Booleans, human_accuracy
from leaderboard.metrics.pairs import find_pairs
from leaderboard.metrics.undefined import NO_RATED_TRIALS, Estimate, Undefined
from leaderboard.models import Check, Coverage, Inputs, Result, Score, SubsetScores
from leaderboard.models.benchmark import OVERALL
from leaderboard.reference import People, Reference
from leaderboard.submission import Submission

DECIMALS = 6
P_VALUES = frozenset(metric.name for metric in METRICS if metric.is_p_value)
EMPTY_SUBSET = Undefined("no trial is in this subset")

Scores = Mapping[str, Mapping[str, SubsetScores]]
Estimates = dict[str, dict[str, dict[str, Estimate]]]


def grade(submission: Submission, reference: Reference, *, checks: Sequence[Check] = ()) -> Result:
    """Score a submission against a reference.

    Scores are given for every scope that the submission covers wholly: scenarios on all trials, properties
    and overall on all, easy and hard. ``checks`` are kept in the result as they are.
    """
    observations = Observations.of(submission, reference)
    masks = subset_masks(reference)
    scopes = list_scopes(reference, submission.covered)
    estimates: Estimates = {}
    counts: dict[str, dict[str, dict[str, int]]] = {}
    for scope in scopes:
        for subset in _subsets_of(scope, masks):
            selected = observations.select(scope.mask & masks[subset])
            estimates.setdefault(scope.name, {})[subset] = _estimate(selected)
            counts.setdefault(scope.name, {})[subset] = _count(reference, scope, subset, masks)
    _average_properties(estimates, reference)
    properties = tuple(scope.name for scope in scopes if scope.kind == "property")
    return Result(
        metrics_version=METRICS_VERSION,
        grader=__version__,
        submission=submission.slug,
        inputs=Inputs(
            predictions_sha256=submission.predictions_sha256,
            reference_digest=reference.manifest.digest,
            reference_kind=reference.manifest.kind,
        ),
        coverage=Coverage(
            trials=int(submission.covered.sum()),
            answered=int(submission.answered.sum()),
            properties=properties,
            complete=OVERALL in estimates,
        ),
        scores=_assemble(estimates, counts),
        checks=tuple(checks),
    )


def grade_people(reference: Reference) -> Scores:
    """Score people themselves, for the human row: accuracy and YES rate over the trials that were rated.

    Accuracy is the mean over rated trials of the share of people who were right; overall is the mean of
    the properties. Empty without human data.
    """
    people = reference.people
    if people is None:
        return {}
    masks = subset_masks(reference)
    estimates: Estimates = {}
    counts: dict[str, dict[str, dict[str, int]]] = {}
    for scope in list_scopes(reference, masks["all"]):
        for subset in _subsets_of(scope, masks):
            mask = scope.mask & masks[subset]
            estimates.setdefault(scope.name, {})[subset] = _estimate_people(people, reference, mask)
            counts.setdefault(scope.name, {})[subset] = _count(reference, scope, subset, masks)
    _average_properties(estimates, reference)
    return _assemble(estimates, counts)


def result_bytes(result: Result) -> bytes:
    """Write a result as the bytes of ``result.json``; equal results give equal bytes."""
    return canonical_json(result.model_dump(mode="json", by_alias=True)).encode()


def _subsets_of(scope: Scope, masks: Mapping[str, Booleans]) -> tuple[str, ...]:
    return ("all",) if scope.kind == "scenario" else tuple(name for name in SUBSETS if name in masks)


def _estimate(observations: Observations) -> dict[str, Estimate]:
    if not observations.labels.size:
        return {metric.name: EMPTY_SUBSET for metric in METRICS}
    return {metric.name: metric.compute(observations) for metric in METRICS}


def _estimate_people(people: People, reference: Reference, mask: Booleans) -> dict[str, Estimate]:
    n, n_yes, labels = people.n[mask], people.n_yes[mask], reference.labels[mask]
    rated = n > 0
    said_yes: Estimate = float(np.mean(n_yes[rated] / n[rated])) if rated.any() else NO_RATED_TRIALS
    return {"accuracy": human_accuracy(n, n_yes, labels), "yes_rate": said_yes}


def _average_properties(estimates: Estimates, reference: Reference) -> None:
    """Replace overall values by the mean of the properties', but for metrics that pool the trials."""
    names = [property_.name for property_ in reference.benchmark.properties]
    for subset, values in estimates.get(OVERALL, {}).items():
        for metric in values:
            if metric not in P_VALUES:
                parts = {name: estimates[name][subset][metric] for name in names}
                values[metric] = _mean(parts)


def _mean(parts: Mapping[str, Estimate]) -> Estimate:
    """Average the properties' values; undefined if one of them is, for the first reason."""
    defined = [value for value in parts.values() if not isinstance(value, Undefined)]
    if len(defined) == len(parts):
        return float(np.mean(defined))
    name, first = next((name, value) for name, value in parts.items() if isinstance(value, Undefined))
    return Undefined(first.why if not defined and len({*parts.values()}) == 1 else f"{name}: {first.why}")


def _count(reference: Reference, scope: Scope, subset: str, masks: Mapping[str, Booleans]) -> dict[str, int]:
    mask = scope.mask & masks[subset]
    counts = {"n": int(mask.sum()), "n_pairs": _count_pairs(reference, mask)}
    counts["n_rated"] = int((reference.people.n[mask] > 0).sum()) if reference.people else 0
    if subset != "all":
        counts["n_pairs_in_both"] = _count_pairs(reference, scope.mask & masks["easy"] & masks["hard"])
    return counts


def _count_pairs(reference: Reference, mask: Booleans) -> int:
    """Count the pairs with both members; a trial with a pair id of its own is no pair."""
    return len(find_pairs(reference.pairs[mask]))


def _assemble(
    estimates: Estimates, counts: Mapping[str, Mapping[str, Mapping[str, int]]]
) -> dict[str, dict[str, SubsetScores]]:
    return {
        scope: {
            subset: SubsetScores(
                **counts[scope][subset],
                metrics={metric: _to_score(metric, estimate) for metric, estimate in values.items()},
            )
            for subset, values in subsets.items()
        }
        for scope, subsets in estimates.items()
    }


def _to_score(metric: str, estimate: Estimate) -> Score:
    """Round to 6 decimals; a smaller p-value keeps 6 significant digits, since it is never 0."""
    if isinstance(estimate, Undefined):
        return Score(value=None, why=estimate.why)
    rounded = round(estimate, DECIMALS)
    if rounded == 0 and metric in P_VALUES:
        rounded = float(f"{estimate:.{DECIMALS}g}")
    return Score(value=rounded + 0.0)
