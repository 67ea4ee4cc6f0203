"""Comparing two submissions, scope by scope, with the same resamples for both."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, Self, TypeVar

import numpy as np

from leaderboard.comparing.comparison import Comparison, Overlap, ScopeComparison, TrialDifference
from leaderboard.errors import LeaderboardError
from leaderboard.grading import Scope, Yardstick, find_metric, list_scopes, tally_scores
from leaderboard.grading.metrics import NO_HUMAN_DATA
from leaderboard.grading.observations import Observations
from leaderboard.metrics.accuracy import Booleans, Floats, Integers, credits_of
from leaderboard.metrics.agreement import answers_of, mean_kappa
from leaderboard.metrics.exact_tests import paired_p
from leaderboard.metrics.resampling import Interval, percentile_interval
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.models import Metadata
from leaderboard.ranking import is_counterpart
from leaderboard.reference import Reference
from leaderboard.submission import Submission

N_TRIALS_SHOWN = 10
COMPARED = ("accuracy", "human_r")

SAME_ANSWER_ALWAYS = Undefined("both give one and the same answer to every trial")
ONE_TRIAL = Undefined("there is but one trial")

T = TypeVar("T")


@dataclass(frozen=True)
class Contender:
    """A submission with what it is compared by, made once for any number of comparisons.

    Attributes
    ----------
    submission
        Whose.
    covered : (n_trials,)
        The trials that it is compared on; those of its rival are the same.
    estimates, resampled
        By scope and metric; resamples have the shape (n_resamples,).
    """

    submission: Submission
    covered: Booleans
    estimates: Mapping[tuple[str, str], Estimate]
    resampled: Mapping[tuple[str, str], Floats]

    @classmethod
    def of(cls, submission: Submission, covered: Booleans, yardstick: Yardstick) -> Self:
        """Score a submission on trials that it covers, and keep only what comparing needs."""
        observations = Observations.of(submission, yardstick.reference)
        tally = tally_scores(observations, covered, yardstick, subsets=("all",), metrics=COMPARED)
        keys = [(scope, metric) for scope in tally.estimates for metric in COMPARED]
        return cls(
            submission,
            covered,
            estimates={key: tally.estimates[key[0]]["all"][key[1]] for key in keys},
            resampled={
                (scope, metric): tally.resampled[scope, "all", metric].copy()  # not the whole that it is of
                for scope, metric in keys
                if (scope, "all", metric) in tally.resampled
            },
        )


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
    if not list_scopes(reference, covered):
        names = f"{a.slug} and {b.slug}"
        raise LeaderboardError(f"{names} cover no scenario in common", "there is nothing to compare")
    yardstick = yardstick or Yardstick.of(reference)
    return compare_contenders(*(Contender.of(s, covered, yardstick) for s in (a, b)), reference=reference)


def compare_contenders(first: Contender, second: Contender, *, reference: Reference) -> Comparison:
    """Compare two that cover the same trials, A and B, on every scope of these."""
    a, b = first.submission, second.submission
    scopes, grading = list_scopes(reference, first.covered), reference.benchmark.grading
    return Comparison(
        a=a.slug or "A",
        b=b.slug or "B",
        property_gain=_find_gain(a.metadata, b.metadata),
        resamples=grading.resamples,
        seed=grading.seed,
        scopes=tuple(_compare_scope(scope, (first, second), reference) for scope in scopes),
        trials=tuple(_find_trials(a, b, reference)),
    )


def _find_gain(a: Metadata | None, b: Metadata | None) -> Literal["A-B", "B-A"] | None:
    if a is None or b is None:
        return None
    if is_counterpart(a, b):
        return "A-B"
    return "B-A" if is_counterpart(b, a) else None


def _compare_scope(scope: Scope, contenders: Sequence[Contender], reference: Reference) -> ScopeComparison:
    mask, two = scope.mask, [contender.submission for contender in contenders]
    credits = [credits_of(s.probabilities, reference.labels, s.answered) for s in two]
    answers = [answers_of(s.probabilities[mask]) for s in two]
    difference = _sum_by_pair(reference.pairs[mask], (credits[0] - credits[1])[mask])
    accuracies = [contender.estimates[scope.name, "accuracy"] for contender in contenders]
    accuracy = _subtract(contenders, scope.name, "accuracy")
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
        human_r_difference=_subtract(contenders, scope.name, "human_r"),
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


def _subtract(contenders: Sequence[Contender], scope: str, metric: str) -> Interval | Undefined:
    """Subtract B's estimate from A's, resample by resample."""
    values = []
    for name, contender in zip("AB", contenders, strict=True):
        estimate = contender.estimates[scope, metric]
        if isinstance(estimate, Undefined):
            if estimate == NO_HUMAN_DATA:
                return estimate
            return Undefined(f"{name} has no {find_metric(metric).title.lower()}: {estimate.why}")
        values.append(estimate)
    a, b = (contender.resampled[scope, metric] for contender in contenders)
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
    if isinstance(kappa, Undefined):
        return SAME_ANSWER_ALWAYS if answers_a.size > 1 else ONE_TRIAL
    return kappa


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
