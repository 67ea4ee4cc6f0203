"""Comparing two submissions, scope by scope, with the same resamples for both."""

from collections.abc import Iterator, Sequence
from typing import Literal, TypeVar

import numpy as np

from leaderboard.comparing.comparison import Comparison, Overlap, ScopeComparison, TrialDifference
from leaderboard.errors import LeaderboardError
from leaderboard.grading import Scope, Yardstick, find_metric, list_scopes, tally_scores
from leaderboard.grading.metrics import NO_HUMAN_DATA
from leaderboard.grading.observations import Observations
from leaderboard.grading.tally import Tally
from leaderboard.metrics.accuracy import Floats, Integers, credits_of
from leaderboard.metrics.agreement import answers_of, mean_kappa
from leaderboard.metrics.exact_tests import paired_p
from leaderboard.metrics.resampling import Interval, percentile_interval
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.models import Metadata
from leaderboard.ranking import is_counterpart
from leaderboard.reference import Reference
from leaderboard.submission import Submission

N_TRIALS_SHOWN = 10

SAME_ANSWER_ALWAYS = Undefined("both give one and the same answer to every trial")

T = TypeVar("T")

Two = tuple[Submission, Submission]


def compare(
    a: Submission, b: Submission, reference: Reference, *, yardstick: Yardstick | None = None
) -> Comparison:
    """Compare two submissions on every scope that both cover wholly, by pairs.

    Intervals are those of grading, from the same resamples for both. Overall is the mean of the properties;
    its exact test pools their pairs.

    Raises
    ------
    LeaderboardError
        If they share no scope.
    """
    covered = a.covered & b.covered
    scopes = list_scopes(reference, covered)
    if not scopes:
        names = f"{a.slug} and {b.slug}"
        raise LeaderboardError(f"{names} cover no scenario in common", "there is nothing to compare")
    yardstick = yardstick or Yardstick.of(reference)
    tallies = [tally_scores(Observations.of(s, reference), covered, yardstick) for s in (a, b)]
    grading = reference.benchmark.grading
    return Comparison(
        a=a.slug or "A",
        b=b.slug or "B",
        property_gain=_find_gain(a.metadata, b.metadata),
        resamples=grading.resamples,
        seed=grading.seed,
        scopes=tuple(_compare_scope(scope, (a, b), reference, tallies) for scope in scopes),
        trials=tuple(_find_trials(a, b, reference)),
    )


def _find_gain(a: Metadata | None, b: Metadata | None) -> Literal["A-B", "B-A"] | None:
    if a is None or b is None:
        return None
    if is_counterpart(a, b):
        return "A-B"
    return "B-A" if is_counterpart(b, a) else None


def _compare_scope(scope: Scope, two: Two, reference: Reference, tallies: Sequence[Tally]) -> ScopeComparison:
    mask = scope.mask
    credits = [credits_of(s.probabilities, reference.labels, s.answered) for s in two]
    answers = [answers_of(s.probabilities[mask]) for s in two]
    difference = _sum_by_pair(reference.pairs[mask], (credits[0] - credits[1])[mask])
    accuracies = [tally.estimates[scope.name]["all"]["accuracy"] for tally in tallies]
    accuracy = _subtract(tallies, scope.name, "accuracy")
    return ScopeComparison(
        name=scope.name,
        kind=scope.kind,
        n=int(mask.sum()),
        n_pairs=difference.size,
        accuracy_a=_always_defined(accuracies[0]),
        accuracy_b=_always_defined(accuracies[1]),
        difference=_always_defined(accuracy),
        p=paired_p(np.rint(2 * difference).astype(np.int64)),
        overlap=_count_overlap(credits[0][mask], credits[1][mask], difference),
        human_r_difference=_subtract(tallies, scope.name, "human_r"),
        kappa=_kappa(answers[0], answers[1]),
    )


def _always_defined(value: T | Undefined) -> T:
    """Take a mean over trials, of which every scope has some."""
    if isinstance(value, Undefined):
        raise TypeError(value.why)
    return value


def _sum_by_pair(pairs: Integers, values: Floats) -> Floats:
    """Sum values within each pair that occurs, in the order of pairs."""
    sums = np.bincount(pairs, values).astype(np.float64)
    return sums[np.bincount(pairs) > 0]


def _subtract(tallies: Sequence[Tally], scope: str, metric: str) -> Interval | Undefined:
    """Subtract B's estimate from A's, resample by resample."""
    values = []
    for name, tally in zip("AB", tallies, strict=True):
        estimate = tally.estimates[scope]["all"][metric]
        if isinstance(estimate, Undefined):
            if estimate == NO_HUMAN_DATA:
                return estimate
            return Undefined(f"{name} has no {find_metric(metric).title.lower()}: {estimate.why}")
        values.append(estimate)
    a, b = (tally.resampled[scope, "all", metric] for tally in tallies)
    return percentile_interval(values[0] - values[1], a - b)


def _count_overlap(credits_a: Floats, credits_b: Floats, difference: Floats) -> Overlap:
    right_a, right_b = credits_a == 1, credits_b == 1
    return Overlap(
        n_both_right=int((right_a & right_b).sum()),
        n_only_a=int((right_a & ~right_b).sum()),
        n_only_b=int((right_b & ~right_a).sum()),
        n_neither=int((~right_a & ~right_b).sum()),
        n_pairs_a=int((difference > 0).sum()),
        n_pairs_b=int((difference < 0).sum()),
        n_pairs_equal=int((difference == 0).sum()),
    )


def _kappa(answers_a: Floats, answers_b: Floats) -> Estimate:
    kappa = mean_kappa(answers_a, answers_b, np.zeros(answers_a.size, np.int64))
    return SAME_ANSWER_ALWAYS if isinstance(kappa, Undefined) else kappa


def _find_trials(a: Submission, b: Submission, reference: Reference) -> Iterator[TrialDifference]:
    """Find the trials on which the probabilities differ most, the largest difference first, then by id."""
    both = np.flatnonzero(a.answered & b.answered)
    distance = np.abs(a.probabilities[both] - b.probabilities[both])
    order = sorted(range(both.size), key=lambda i: (-distance[i], reference.trial_ids[both[i]]))
    people = reference.people
    for index in both[order[:N_TRIALS_SHOWN]].tolist():
        is_rated = people is not None and people.n[index] > 0
        yield TrialDifference(
            trial_id=reference.trial_ids[index],
            label=int(reference.labels[index]),
            probability_a=float(a.probabilities[index]),
            probability_b=float(b.probabilities[index]),
            human_mean=float(people.n_yes[index] / people.n[index]) if people and is_rated else None,
        )
