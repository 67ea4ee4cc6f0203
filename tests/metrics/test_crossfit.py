"""Easy and hard pairs chosen by some people and measured on others."""

import itertools
import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from leaderboard.metrics.accuracy import human_accuracy, is_above, is_below, right_counts
from leaderboard.metrics.crossfit import (
    CrossFit,
    CrossSubset,
    accuracy_on,
    cross_fit,
    human_accuracy_on,
    human_r_on,
)
from leaderboard.metrics.splits import BATCH, Halves, Tables, count_halves, split_people
from leaderboard.metrics.undefined import Undefined

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

EASY, HARD = Fraction(2, 3), Fraction(1, 3)
PROBABILITIES = (0.0, 0.25, 0.5, 0.8, 1.0)


@dataclass(frozen=True)
class Case:
    """Answers by (person, trial), splits, and what is known of the trials."""

    answers: dict[tuple[int, int], int]
    splits: list[list[bool]]
    labels: list[int]
    pairs: list[int]
    predicted: list[float]

    def halves(self) -> Halves:
        persons, trials = (np.array([key[k] for key in self.answers], np.int64) for k in (0, 1))
        answers = np.array(list(self.answers.values()), np.int64)
        return count_halves(np.array(self.splits), persons, trials, answers, len(self.labels))

    def cross_fit(self) -> CrossFit:
        labels, pairs = np.array(self.labels), np.array(self.pairs)
        return cross_fit(self.halves(), labels, pairs, easy=EASY, hard=HARD)


@st.composite
def cases(draw: st.DrawFn) -> Case:
    """Up to 7 people of two sets and 5 trials, of which some are alone and some in threes."""
    n_people, n_trials = draw(st.integers(1, 7)), draw(st.integers(1, 5))
    cells = draw(st.sets(st.tuples(st.integers(0, n_people - 1), st.integers(0, n_trials - 1))))
    answers = {cell: draw(st.integers(0, 1)) for cell in sorted(cells)}
    seed = draw(st.integers(0, 999))
    splits = split_people(np.arange(n_people) % 2, 4, seed=seed, stream=0).tolist()
    labels, pairs = (
        draw(st.lists(st.integers(0, last), min_size=n_trials, max_size=n_trials)) for last in (1, 3)
    )
    predicted = draw(st.lists(st.sampled_from(PROBABILITIES), min_size=n_trials, max_size=n_trials))
    return Case(answers, splits, labels, pairs, predicted)


@dataclass
class Twin:
    """One subset in plain loops and fractions: what every case chose, and what was measured."""

    chosen: list[list[int]]
    measured: list[tuple[int, Fraction]]

    def n_pairs(self, pairs: list[int]) -> int:
        complete = {pair for pair in pairs if pairs.count(pair) == 2}
        return sum(len({pairs[trial] for trial in trials} & complete) for trials in self.chosen)


def shares_of_yes(case: Case, split: list[bool], *, is_first: bool) -> dict[int, Fraction]:
    """What one half said of each trial that it judged."""
    votes: dict[int, list[int]] = {}
    for (person, trial), answer in case.answers.items():
        if split[person] is is_first:
            votes.setdefault(trial, []).append(answer)
    return {trial: Fraction(sum(answers), len(answers)) for trial, answers in votes.items()}


def right_of(case: Case, trial: int, share: Fraction) -> Fraction:
    return share if case.labels[trial] == 1 else 1 - share


def twins(case: Case) -> tuple[Twin, Twin, int]:
    """Easy, hard, and how often a complete pair is chosen as both."""
    easy, hard, n_both = Twin([], []), Twin([], []), 0
    for split, chooser in itertools.product(case.splits, (True, False)):
        choosing = shares_of_yes(case, split, is_first=chooser)
        measuring = shares_of_yes(case, split, is_first=not chooser)
        right = {trial: right_of(case, trial, share) for trial, share in choosing.items()}
        picks = (
            {case.pairs[trial] for trial, share in right.items() if share > EASY},
            {case.pairs[trial] for trial, share in right.items() if share < HARD},
        )
        for twin, picked in zip((easy, hard), picks, strict=True):
            chosen = [trial for trial, pair in enumerate(case.pairs) if pair in picked]
            twin.chosen.append(chosen)
            twin.measured += [(trial, measuring[trial]) for trial in chosen if trial in measuring]
        n_both += sum(case.pairs.count(pair) == 2 for pair in picks[0] & picks[1])
    return easy, hard, n_both


def twin_r(x: list[float], y: list[Fraction]) -> float | None:
    if len(set(x)) < 2 or len(set(y)) < 2:
        return None
    exact = [Fraction(value) for value in x]
    mean_x, mean_y = sum(exact) / len(exact), sum(y) / len(y)
    xy = sum((a - mean_x) * (b - mean_y) for a, b in zip(exact, y, strict=True))
    xx, yy = sum((a - mean_x) ** 2 for a in exact), sum((b - mean_y) ** 2 for b in y)
    return float(xy) / math.sqrt(xx * yy)


@given(cases())
def test_weights_of_trials_equal_plain_loops(case: Case) -> None:
    """Everything that is counted or summed is what a loop over splits, halves and trials gives."""
    found = case.cross_fit()
    easy, hard, n_both = twins(case)
    n_cases, n_trials = 2 * len(case.splits), len(case.labels)
    assert found.n_pairs_in_both == pytest.approx(n_both / n_cases)
    for subset, twin in ((found.easy, easy), (found.hard, hard)):
        chosen, rated, means, squares, right = np.zeros((5, n_trials))
        for trials in twin.chosen:
            chosen[trials] += 1 / n_cases
        for trial, mean in twin.measured:
            rated[trial] += 1 / n_cases
            means[trial] += float(mean) / n_cases
            squares[trial] += float(mean**2) / n_cases
            right[trial] += float(right_of(case, trial, mean)) / n_cases
        assert subset.chosen == pytest.approx(chosen)
        assert subset.rated == pytest.approx(rated)
        assert subset.mean_sum == pytest.approx(means)
        assert subset.square_sum == pytest.approx(squares)
        assert subset.right_sum == pytest.approx(right)
        assert subset.n_trials == pytest.approx(sum(map(len, twin.chosen)) / n_cases)
        assert subset.n_pairs == pytest.approx(twin.n_pairs(case.pairs) / n_cases)


@given(cases())
def test_estimates_equal_plain_loops(case: Case) -> None:
    """Accuracies and the pooled correlation are those of the long list of all cases."""
    found = case.cross_fit()
    easy, hard, _ = twins(case)
    for subset, twin in ((found.easy, easy), (found.hard, hard)):
        credits = np.array(case.predicted)
        pooled = [case.predicted[trial] for trials in twin.chosen for trial in trials]
        expected = sum(pooled) / len(pooled) if pooled else None
        assert accuracy_on(subset, credits) == (
            Undefined("no half of the people chooses any of these trials")
            if expected is None
            else pytest.approx(expected)
        )
        right = [right_of(case, trial, mean) for trial, mean in twin.measured]
        people = human_accuracy_on(subset)
        if right:
            assert people == pytest.approx(float(sum(right) / len(right)))
        else:
            assert isinstance(people, Undefined)
        r = twin_r([case.predicted[trial] for trial, _ in twin.measured], [mean for _, mean in twin.measured])
        found_r = human_r_on(subset, np.array(case.predicted))
        if r is None:
            assert isinstance(found_r, Undefined)
        else:
            assert found_r == pytest.approx(r, abs=1e-9)


@given(cases())
def test_it_does_not_matter_which_half_is_the_first(case: Case) -> None:
    """Both choose and both are measured."""
    swapped = [[not is_first for is_first in split] for split in case.splits]
    other = Case(case.answers, swapped, case.labels, case.pairs, case.predicted).cross_fit()
    found = case.cross_fit()
    assert found.n_pairs_in_both == pytest.approx(other.n_pairs_in_both)
    for subset, twin in ((found.easy, other.easy), (found.hard, other.hard)):
        for name in ("chosen", "rated", "mean_sum", "square_sum", "right_sum", "n_trials", "n_pairs"):
            assert getattr(subset, name) == pytest.approx(getattr(twin, name))


def test_a_case_by_hand() -> None:
    """Person 0 is right on both twins, person 1 on neither; each chooses the pair for the other."""
    found = Case(
        {(0, 0): 1, (0, 1): 0, (1, 0): 0, (1, 1): 1}, [[True, False]], [1, 0], [4, 4], [0.9, 0.1]
    ).cross_fit()
    assert found.easy.chosen.tolist() == [0.5, 0.5]
    assert (found.easy.n_trials, found.easy.n_pairs, found.n_pairs_in_both) == (1.0, 0.5, 0.0)
    assert (human_accuracy_on(found.easy), human_accuracy_on(found.hard)) == (0.0, 1.0)
    assert human_r_on(found.easy, np.array([0.9, 0.1])) == -1.0
    assert human_r_on(found.hard, np.array([0.9, 0.1])) == 1.0


def test_a_share_on_the_bound_is_on_neither_side() -> None:
    """Two of three are not above 2/3, one of three is not below 1/3."""
    answers = {(person, trial): int(person % 3 <= trial) for person in range(6) for trial in range(2)}
    case = Case(answers, [[True] * 3 + [False] * 3], [1, 1], [0, 1], [0.5, 0.5])
    assert not case.cross_fit().easy.chosen.any()
    assert not case.cross_fit().hard.chosen.any()
    labels_swapped = Case(answers, case.splits, [0, 0], case.pairs, case.predicted)
    assert not labels_swapped.cross_fit().easy.chosen.any()


@pytest.mark.parametrize(("n_right", "is_hard"), [(1, True), (2, False), (3, False)])
def test_bounds_may_be_any_fractions(n_right: int, is_hard: bool) -> None:
    """With hard below 2/5, one of five is hard, and two of five are not."""
    answers = {(person, 0): int(person % 5 < n_right) for person in range(10)}
    case = Case(answers, [[True] * 5 + [False] * 5], [1], [0], [0.5])
    halves = case.halves()
    labels, pairs = np.array([1]), np.array([0])
    found = cross_fit(halves, labels, pairs, easy=Fraction(4, 5), hard=Fraction(2, 5))
    assert found.hard.chosen.tolist() == [is_hard]
    assert not found.easy.chosen.any()


def test_many_splits_are_all_counted() -> None:
    """They are gone through in batches, of which every one counts as much as it has splits."""
    rng = np.random.default_rng(4)
    n_people, n_trials, n_splits = 9, 8, 2 * BATCH + 50
    answers = {
        (person, trial): int(rng.random() < 0.5) for person in range(n_people) for trial in range(n_trials)
    }
    splits = split_people(np.zeros(n_people, np.int64), n_splits, seed=1, stream=0).tolist()
    labels, pairs = rng.integers(0, 2, n_trials).tolist(), [trial // 2 for trial in range(n_trials)]
    case = Case(answers, splits, labels, pairs, [0.5] * n_trials)
    ends = [0, 100, 220, n_splits]
    parts = [Case(answers, splits[a:b], labels, pairs, case.predicted) for a, b in itertools.pairwise(ends)]
    sizes, found = np.diff(ends), [part.cross_fit() for part in parts]
    whole = case.cross_fit()
    both = np.average([part.n_pairs_in_both for part in found], weights=sizes)
    assert whole.n_pairs_in_both == pytest.approx(both)
    for name in ("chosen", "rated", "mean_sum", "square_sum", "right_sum", "n_trials", "n_pairs"):
        easy, hard = (
            np.average([getattr(p, name) for p in of], axis=0, weights=sizes)
            for of in ([part.easy for part in found], [part.hard for part in found])
        )
        assert getattr(whole.easy, name) == pytest.approx(easy)
        assert getattr(whole.hard, name) == pytest.approx(hard)


def test_one_member_brings_in_the_other_even_unrated() -> None:
    """The pair is chosen, but what nobody judged is not measured."""
    found = Case({(0, 0): 1, (1, 0): 1}, [[True, False]], [1, 1], [0, 0], [0.5, 0.5]).cross_fit()
    assert found.easy.chosen.tolist() == [1, 1]
    assert found.easy.rated.tolist() == [1, 0]


def test_a_pair_can_be_both() -> None:
    """One member is easy and the other hard."""
    answers = {(person, trial): 1 for person in range(2) for trial in range(2)}
    found = Case(answers, [[True, False]], [1, 0], [0, 0], [0.5, 0.5]).cross_fit()
    assert (found.easy.n_pairs, found.hard.n_pairs, found.n_pairs_in_both) == (1.0, 1.0, 1.0)


def subset_of(
    chosen: list[float], rated: list[float], mean_sum: list[float], square_sum: list[float]
) -> CrossSubset:
    arrays = [np.array(column) for column in (chosen, rated, mean_sum, square_sum)]
    return CrossSubset(arrays[0], arrays[1], arrays[2], arrays[3], arrays[2], sum(chosen), 0.0)


def test_undefined_says_why() -> None:
    """Nothing chosen, nothing measured, no variance."""
    nothing = subset_of([0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0])
    never = Undefined("no half of the people chooses any of these trials")
    q = np.array([0.1, 0.9])
    assert accuracy_on(nothing, q) == human_accuracy_on(nothing) == human_r_on(nothing, q) == never
    unmeasured = subset_of([1.0, 1.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0])
    why = Undefined("of the trials that one half of the people chooses, the other rated none")
    assert human_accuracy_on(unmeasured) == human_r_on(unmeasured, q) == why
    third = 1 / 3
    flat = subset_of([1.0, 1.0], [1.0, 1.0], [third, third], [third**2, third**2])
    assert human_r_on(flat, q) == Undefined("all human means are equal")
    assert human_r_on(flat, np.array([0.3, 0.3])) == Undefined("all probabilities are equal")


def weigh_equally(means: Floats) -> CrossSubset:
    """Choose and rate every trial in every case, with these shares of YES."""
    ones = np.ones(means.size)
    return CrossSubset(ones, ones, means, means**2, means, float(means.size), 0.0)


def test_a_straight_line_has_a_correlation_of_one_and_no_digit_more() -> None:
    """Up and down, whatever the shares: sums of squares that are rounded do not lead beyond."""
    for seed in range(60):
        means = np.random.default_rng(seed).permutation(np.arange(8)) / 7
        up, down = (human_r_on(weigh_equally(means), q) for q in (means, 1 - means))
        assert isinstance(up, float)
        assert isinstance(down, float)
        assert up == pytest.approx(1, abs=1e-12)
        assert down == pytest.approx(-1, abs=1e-12)
        assert -1 <= down < up <= 1


def test_the_smallest_difference_is_a_difference() -> None:
    """Deviations (-1, -1, 2) and (-4, -1, 5), however small the step of the probabilities."""
    subset = weigh_equally(np.array([0.1, 0.2, 0.4]))
    for low, high in ((0.0, 5e-324), (0.0, 1e-200), (0.5, math.nextafter(0.5, 1)), (0.0, 1.0)):
        found = human_r_on(subset, np.array([low, low, high]))
        assert found == pytest.approx(15 / math.sqrt(6 * 42), abs=1e-9)


def test_people_who_are_equally_good_everywhere_are_so_on_easy_and_hard() -> None:
    """Who chooses and measures on the same people finds them far better on easy trials and worse on hard."""
    rng = np.random.default_rng(20231105)
    n_people, n_trials = 8, 4000
    labels, pairs = rng.integers(0, 2, n_trials), np.repeat(np.arange(n_trials // 2), 2)
    is_right = rng.random((n_people, n_trials)) < 0.6
    said_yes = (is_right == (labels == 1)).astype(np.float64)
    n, n_yes = np.full(n_trials, n_people), said_yes.sum(axis=0).astype(np.int64)
    is_first = split_people(np.zeros(n_people, np.int64), 50, seed=1, stream=0)
    halves = Halves(is_first, Tables(np.ones(said_yes.shape), said_yes))
    found = cross_fit(halves, labels, pairs, easy=EASY, hard=HARD)
    overall = human_accuracy(n, n_yes, labels)
    assert human_accuracy_on(found.easy) == pytest.approx(overall, abs=0.01)
    assert human_accuracy_on(found.hard) == pytest.approx(overall, abs=0.01)
    right = right_counts(n, n_yes, labels)
    by_same = []
    for mask in (is_above(right, n, EASY), is_below(right, n, HARD)):
        chosen = np.isin(pairs, pairs[mask])
        by_same.append(human_accuracy(n[chosen], n_yes[chosen], labels[chosen]))
    easy, hard = by_same
    assert isinstance(easy, float)
    assert isinstance(hard, float)
    assert easy > 0.65
    assert hard < 0.5
