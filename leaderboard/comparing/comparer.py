"""Comparing two submissions, scope by scope, with the same resamples for both."""

from collections.abc import Iterator, Sequence

import numpy as np

from leaderboard.comparing.comparison import Comparison, Overlap, ScopeComparison, TrialDifference
from leaderboard.comparing.draws import Draws
from leaderboard.errors import LeaderboardError
from leaderboard.grading import Scope, list_scopes
from leaderboard.metrics.accuracy import Booleans, Floats, Integers, credits_of
from leaderboard.metrics.agreement import answers_of, human_r, mean_kappa
from leaderboard.metrics.exact_tests import paired_p
from leaderboard.metrics.resampling import Interval, percentile_interval, resample_correlation
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.models.benchmark import OVERALL
from leaderboard.reference import People, Reference
from leaderboard.submission import Submission

N_TRIALS_SHOWN = 10

NO_HUMAN_DATA = Undefined("the reference has no human data")
SAME_ANSWER_ALWAYS = Undefined("both give one and the same answer to every trial")

Two = tuple[Submission, Submission]


def compare(a: Submission, b: Submission, reference: Reference) -> Comparison:
    """Compare two submissions on every scope that both cover wholly, by pairs.

    Intervals are 95 % percentile bootstrap intervals over pairs, stratified by scenario, with the same draws
    for both; where responses of single people are known, people are drawn as well, within the set of people
    who saw the same trials. Overall is the mean of the properties; its exact test pools their pairs.

    Raises
    ------
    LeaderboardError
        If they share no scope.
    """
    scopes = list_scopes(reference, a.covered & b.covered)
    if not scopes:
        names = f"{a.slug} and {b.slug}"
        raise LeaderboardError(f"{names} cover no scenario in common", "there is nothing to compare")
    draws = Draws.of(reference)
    grading = reference.benchmark.grading
    return Comparison(
        a=a.slug or "A",
        b=b.slug or "B",
        resamples=grading.resamples,
        seed=grading.seed,
        scopes=tuple(_compare_scope(scope, (a, b), reference, draws) for scope in scopes),
        trials=tuple(_find_trials(a, b, reference)),
    )


def _compare_scope(scope: Scope, two: Two, reference: Reference, draws: Draws) -> ScopeComparison:
    mask, parts = scope.mask, _parts_of(scope, reference)
    credits = [credits_of(s.probabilities, reference.labels, s.answered) for s in two]
    answers = [answers_of(s.probabilities[mask]) for s in two]
    difference = _sum_by_pair(reference.pairs[mask], (credits[0] - credits[1])[mask])
    return ScopeComparison(
        name=scope.name,
        kind=scope.kind,
        n=int(mask.sum()),
        n_pairs=difference.size,
        accuracy_a=_average([credits[0][part].mean() for part in parts]),
        accuracy_b=_average([credits[1][part].mean() for part in parts]),
        difference=_accuracy_interval(credits[0] - credits[1], parts, reference, draws),
        p=paired_p(np.rint(2 * difference).astype(np.int64)),
        overlap=_count_overlap(credits[0][mask], credits[1][mask], difference),
        human_r_difference=_human_r_interval(two, parts, reference, draws),
        kappa=_kappa(answers[0], answers[1]),
    )


def _parts_of(scope: Scope, reference: Reference) -> list[Booleans]:
    """The masks whose values are averaged: the properties for overall, else the scope itself."""
    if scope.name != OVERALL:
        return [scope.mask]
    return [reference.in_property(property_.name) for property_ in reference.benchmark.properties]


def _average(values: Sequence[float]) -> float:
    return float(np.mean(values))


def _sum_by_pair(pairs: Integers, values: Floats) -> Floats:
    """Sum values within each pair that occurs, in the order of pairs."""
    sums = np.bincount(pairs, values).astype(np.float64)
    return sums[np.bincount(pairs) > 0]


def _accuracy_interval(
    difference: Floats, parts: Sequence[Booleans], reference: Reference, draws: Draws
) -> Interval:
    """Bootstrap the mean over parts of the mean difference of credits: weights times sums by pair."""
    values, resampled = [], []
    for part in parts:
        pairs, weights = reference.pairs[part], draws.pairs.astype(np.float64)
        n_pairs = len(reference.pair_ids)
        sums = np.bincount(pairs, difference[part], minlength=n_pairs)
        sizes = np.bincount(pairs, minlength=n_pairs).astype(np.float64)
        values.append(difference[part].mean())
        resampled.append((weights @ sums) / (weights @ sizes))
    interval = percentile_interval(_average(values), np.mean(resampled, axis=0))
    if isinstance(interval, Undefined):
        raise TypeError("a mean over drawn pairs always has a value")
    return interval


def _human_r_interval(
    two: Two, parts: Sequence[Booleans], reference: Reference, draws: Draws
) -> Interval | Undefined:
    """Bootstrap the mean over parts of the difference in human r, trials and people drawn together."""
    people = reference.people
    if people is None:
        return NO_HUMAN_DATA
    values, resampled = [], []
    for part in parts:
        rated = part & (people.n > 0)
        means = people.n_yes[rated] / people.n[rated]
        r_a, r_b = (human_r(s.probabilities[rated], means) for s in two)
        if isinstance(r_a, Undefined):
            return Undefined(f"A has no human r: {r_a.why}")
        if isinstance(r_b, Undefined):
            return Undefined(f"B has no human r: {r_b.why}")
        values.append(r_a - r_b)
        resampled.append(_resample_difference(two, rated, (reference, people), draws))
    return percentile_interval(_average(values), np.mean(resampled, axis=0))


def _resample_difference(two: Two, rated: Booleans, people: tuple[Reference, People], draws: Draws) -> Floats:
    """Compute the difference in human r on each resample, shape (n_resamples,); NaN where one has none."""
    a, b = (submission.probabilities[rated] for submission in two)
    chunks = [
        resample_correlation(a, means, weights) - resample_correlation(b, means, weights)
        for weights, means in draws.resample_people(*people, rated)
    ]
    return np.concatenate(chunks)


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
