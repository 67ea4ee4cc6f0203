"""How far people's means can be trusted: values, what moves them, and the truth behind simulated people."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from leaderboard.metrics.agreement import human_r
from leaderboard.metrics.reliability import (
    Reliability,
    ceiling_of,
    count_reliability,
    split_half_reliability,
)
from leaderboard.metrics.splits import Halves, Tables, count_halves, split_people
from leaderboard.metrics.undefined import Undefined

Floats = NDArray[np.float64]
STEP = 1e-5


@dataclass(frozen=True)
class Case:
    """Some answers and splits of the people."""

    persons: list[int]
    trials: list[int]
    answers: list[int]
    splits: list[list[bool]]
    n_trials: int

    @property
    def n_people(self) -> int:
        return len(self.splits[0])

    def halves(self) -> Halves:
        persons, trials, answers = (
            np.array(column, np.int64) for column in (self.persons, self.trials, self.answers)
        )
        return count_halves(np.array(self.splits), persons, trials, answers, self.n_trials)


def simulate(seed: int, *, n_people: int = 7, n_trials: int = 6, n_splits: int = 9) -> Case:
    """Two sets of people, answers at random, and one of four missing, so that halves may lack trials."""
    rng = np.random.default_rng(seed)
    probabilities = rng.random(n_trials)
    cells = [(p, t) for p in range(n_people) for t in range(n_trials) if rng.random() < 0.75]
    answers = [int(rng.random() < probabilities[t]) for _, t in cells]
    splits = split_people(np.arange(n_people) % 2, n_splits, seed=seed, stream=0).tolist()
    return Case([p for p, _ in cells], [t for _, t in cells], answers, splits, n_trials)


def twin_split_half(case: Case, w: Sequence[float], u: Sequence[float]) -> tuple[float | None, int]:
    """Mean weighted correlation of the halves in plain loops, and how many splits have none."""
    correlations = []
    for is_first in case.splits:
        means: list[dict[int, float]] = []
        for half in (True, False):
            sums: dict[int, list[float]] = {}
            for person, trial, answer in zip(case.persons, case.trials, case.answers, strict=True):
                if is_first[person] is half:
                    total = sums.setdefault(trial, [0.0, 0.0])
                    total[0] += u[person] * answer
                    total[1] += u[person]
            means.append({trial: total[0] / total[1] for trial, total in sums.items()})
        shared = sorted(means[0].keys() & means[1].keys())
        r = twin_r([means[0][t] for t in shared], [means[1][t] for t in shared], [w[t] for t in shared])
        correlations += [r] if r is not None else []
    n_undefined = len(case.splits) - len(correlations)
    return (sum(correlations) / len(correlations) if correlations else None), n_undefined


def twin_r(a: Sequence[float], b: Sequence[float], w: Sequence[float]) -> float | None:
    if len(set(a)) < 2 or len(set(b)) < 2:
        return None
    mean_a = sum(x * v for x, v in zip(a, w, strict=True)) / sum(w)
    mean_b = sum(x * v for x, v in zip(b, w, strict=True)) / sum(w)
    products = [
        (v * (x - mean_a) ** 2, v * (y - mean_b) ** 2, v * (x - mean_a) * (y - mean_b))
        for x, y, v in zip(a, b, w, strict=True)
    ]
    aa, bb, ab = (sum(column) for column in zip(*products, strict=True))
    return float(ab / math.sqrt(aa * bb))


def twin_counts(case: Case, w: Sequence[float], u: Sequence[float]) -> float | None:
    """Reliability from counts in plain loops; weights of trials are scaled to sum to their number."""
    values = []
    for trial in range(case.n_trials):
        rows = [k for k, t in enumerate(case.trials) if t == trial]
        if len(rows) >= 2:
            n = sum(u[case.persons[k]] for k in rows)
            h = sum(u[case.persons[k]] * case.answers[k] for k in rows) / n
            values.append((h, h * (1 - h) / (n - 1), w[trial]))
    if len({h for h, _, _ in values}) < 2:
        return None
    scale = len(values) / sum(v for _, _, v in values)
    mean = sum(scale * v * h for h, _, v in values) / len(values)
    variance = sum(scale * v * (h - mean) ** 2 for h, _, v in values) / (len(values) - 1)
    return 1 - sum(scale * v * noise for _, noise, v in values) / len(values) / variance


def differentiate(
    twin: Callable[[list[float], list[float]], float | None], case: Case
) -> tuple[list[float], list[float]]:
    """Central differences by every weight at 1; ``twin`` maps weights of trials and people to a value."""
    slopes: tuple[list[float], list[float]] = ([], [])
    for which, size in enumerate((case.n_trials, case.n_people)):
        for index in range(size):
            ends = []
            for sign in (1, -1):
                weights = ones(case)
                weights[which][index] += sign * STEP
                end = twin(*weights)
                assert end is not None
                ends.append(end)
            slopes[which].append((ends[0] - ends[1]) / (2 * STEP))
    return slopes


def number(found: Reliability) -> float:
    assert isinstance(found.value, float)
    return found.value


def ones(case: Case) -> tuple[list[float], list[float]]:
    return [1.0] * case.n_trials, [1.0] * case.n_people


@pytest.mark.parametrize("seed", range(8))
def test_split_half_equals_plain_loops(seed: int) -> None:
    """Value, stepped-up value and the number of splits without one; trials that a half lacks are left out."""
    case = simulate(seed, n_people=4, n_trials=4)
    found = split_half_reliability(case.halves())
    r, n_undefined = twin_split_half(case, *ones(case))
    assert found.n_undefined == n_undefined
    if r is None:
        assert found.split_half_r.value == Undefined(
            "in no split of the people do the means of both halves vary"
        )
    else:
        assert found.split_half_r.value == pytest.approx(r, abs=1e-11)
        assert found.reliability.value == pytest.approx(2 * r / (1 + r), abs=1e-9)


def test_the_cases_of_plain_loops_have_splits_with_and_without_r() -> None:
    """So that the comparison above is one."""
    undefined = [
        split_half_reliability(simulate(seed, n_people=4, n_trials=4).halves()).n_undefined
        for seed in range(8)
    ]
    assert 0 in undefined
    assert any(0 < n < 9 for n in undefined)


@pytest.mark.parametrize("seed", range(4))
def test_split_half_influences_are_numerical_derivatives(seed: int) -> None:
    """Of the mean r and of the reliability, by the weights of trials and of people."""
    case = simulate(seed)
    found = split_half_reliability(case.halves())

    def mean_r(w: list[float], u: list[float]) -> float:
        r, _ = twin_split_half(case, w, u)
        assert r is not None
        return r

    def stepped_up(w: list[float], u: list[float]) -> float:
        r = mean_r(w, u)
        return 2 * r / (1 + r)

    for twin, estimate in ((mean_r, found.split_half_r), (stepped_up, found.reliability)):
        by_trial, by_person = differentiate(twin, case)
        assert estimate.trial_influence == pytest.approx(np.array(by_trial), abs=1e-6)
        assert estimate.person_influence == pytest.approx(np.array(by_person), abs=1e-6)
        assert estimate.trial_influence.sum() == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_count_influences_are_numerical_derivatives(seed: int) -> None:
    """By the weights of trials and of people, who move the numbers of answers as well as their means."""
    case = simulate(seed)
    tables = case.halves().tables
    n, n_yes = (table.sum(axis=0).astype(np.int64) for table in (tables.judged, tables.said_yes))
    found = count_reliability(n, n_yes, tables)
    by_trial, by_person = differentiate(partial(twin_counts, case), case)
    assert found.value == pytest.approx(twin_counts(case, *ones(case)), abs=1e-11)
    assert found.trial_influence == pytest.approx(np.array(by_trial), abs=1e-6)
    assert found.person_influence == pytest.approx(np.array(by_person), abs=1e-6)
    assert found.trial_influence.sum() == pytest.approx(0, abs=1e-12)
    assert count_reliability(n, n_yes).person_influence.size == 0


def test_a_split_by_hand() -> None:
    """Halves (0, 0, 1, 1) and (0, 1, 0, 1) of two people each correlate at 0, so no reliability is left."""
    persons, trials = (grid.ravel() for grid in np.mgrid[:2, :4])
    halves = count_halves(np.array([[True, False]]), persons, trials, np.array([0, 0, 1, 1, 0, 1, 0, 1]), 4)
    found = split_half_reliability(halves)
    assert (found.split_half_r.value, found.reliability.value, found.n_undefined) == (0.0, 0.0, 0)


def test_counts_by_hand() -> None:
    """Shares 0, 1/2 and 1 of four people each: noise (0 + 1/12 + 0) / 3, variance 1/4."""
    found = count_reliability(np.array([4, 4, 4]), np.array([0, 2, 4]))
    assert found.value == pytest.approx(1 - (1 / 36) / (1 / 4))


def test_two_trials_of_two_people_are_enough() -> None:
    """Shares 1/4 and 3/4 of four each: noise (1/16 + 1/16) / 2, variance 1/8; beside one that is left out."""
    assert count_reliability(np.array([4, 4]), np.array([1, 3])).value == pytest.approx(0.5)
    assert count_reliability(np.array([4, 1, 4]), np.array([1, 1, 3])).value == pytest.approx(0.5)
    pair = count_reliability(np.array([2, 2]), np.array([0, 1]))  # shares 0, 1/2: noise 1/8, variance 1/8
    assert pair.value == pytest.approx(0.0)


@pytest.mark.parametrize("n_yes", [[0, 1], [1, 1]], ids=["too few trials", "no variance"])
def test_without_value_nothing_moves_it_for_as_many_people_as_there_are(n_yes: list[int]) -> None:
    """A number for each person who is known and none where single responses are unknown."""
    said_yes = np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]])[:, n_yes]
    tables = Tables(np.ones((3, 2)), said_yes)
    n = np.array([3, 1] if n_yes == [0, 1] else [3, 3])
    with_people, alone = (
        count_reliability(n, np.array([1, 1]), tables),
        count_reliability(n, np.array([1, 1])),
    )
    assert isinstance(with_people.value, Undefined)
    assert with_people.value == alone.value
    assert with_people.person_influence.tolist() == [0, 0, 0]
    assert with_people.response_influence.shape == (3, 2)
    assert alone.response_influence.shape == (0, 2)


def test_trials_of_fewer_than_two_people_are_no_part_of_counts() -> None:
    """One answer tells nothing of the noise of answers."""
    found = count_reliability(np.array([4, 1, 4, 0, 4]), np.array([0, 1, 2, 0, 4]))
    assert found.value == count_reliability(np.array([4, 4, 4]), np.array([0, 2, 4])).value
    assert found.trial_influence[[1, 3]].tolist() == [0, 0]


def test_counts_without_value_say_why() -> None:
    """Too few trials, or no variance: never 0 and never NaN, and nothing moves it."""
    few = count_reliability(np.array([5, 1]), np.array([2, 1]))
    assert few.value == Undefined("fewer than two trials were rated by two people")
    constant = count_reliability(np.array([3, 6, 9]), np.array([1, 2, 3]))
    assert constant.value == Undefined("all human means are equal")
    assert constant.trial_influence.tolist() == [0, 0, 0]


@pytest.mark.parametrize("n_trials", [2, 5, 9, 14, 49, 101])
@pytest.mark.parametrize("n_half", [3, 7, 11])
def test_people_without_variance_have_no_split_half_r(n_half: int, n_trials: int) -> None:
    """Thirds that are equal are equal however they are rounded; the splits are counted."""
    persons, trials = (grid.ravel() for grid in np.mgrid[: 2 * n_half, :n_trials])
    answers = (persons % n_half == 0).astype(np.int64)
    is_first = np.array([[True] * n_half + [False] * n_half] * 3)
    found = split_half_reliability(count_halves(is_first, persons, trials, answers, n_trials))
    assert isinstance(found.split_half_r.value, Undefined)
    assert isinstance(found.reliability.value, Undefined)
    assert found.n_undefined == 3
    assert not found.reliability.trial_influence.any()
    assert found.reliability.person_influence.tolist() == [0] * 2 * n_half


def test_nobody_has_no_split_half_r() -> None:
    """A property that nobody judged is undefined like one without variance."""
    none = np.zeros(0, np.int64)
    halves = count_halves(split_people(none, 4, seed=0, stream=0), none, none, none, 3)
    assert isinstance(split_half_reliability(halves).reliability.value, Undefined)


def test_opposed_halves_have_no_reliability() -> None:
    """The formula of Spearman and Brown would divide by 0."""
    persons, trials = (grid.ravel() for grid in np.mgrid[:2, :3])
    halves = count_halves(np.array([[True, False]]), persons, trials, np.array([1, 0, 0, 0, 1, 1]), 3)
    found = split_half_reliability(halves)
    assert found.split_half_r.value == -1
    assert found.reliability.value == Undefined("the halves of the people are perfectly opposed")


def test_the_ceiling_is_the_root_of_the_reliability() -> None:
    """Where there is none, or it is not above 0, there is no ceiling."""
    assert ceiling_of(0.49) == pytest.approx(0.7)
    assert ceiling_of(Undefined("x")) == Undefined("x")
    for reliability in (0.0, -0.2):
        assert ceiling_of(reliability) == Undefined(
            "people agree no more than chance would have it, so there is no ceiling"
        )


@given(seed=st.integers(0, 999))
def test_reliability_does_not_depend_on_names(seed: int) -> None:
    """Neither on which half is the first nor on which answer is YES."""
    case = simulate(seed, n_people=5, n_trials=4, n_splits=3)
    found = split_half_reliability(case.halves())
    swapped = [[not is_first for is_first in split] for split in case.splits]
    other = Case(case.persons, case.trials, [1 - answer for answer in case.answers], swapped, case.n_trials)
    renamed = split_half_reliability(other.halves())
    assert found.n_undefined == renamed.n_undefined
    if isinstance(found.split_half_r.value, Undefined):
        assert found.split_half_r.value == renamed.split_half_r.value
    else:
        assert found.split_half_r.value == pytest.approx(renamed.split_half_r.value, abs=1e-11)
        assert -1 <= found.split_half_r.value <= 1
        by_trial = found.split_half_r.trial_influence
        assert by_trial == pytest.approx(renamed.split_half_r.trial_influence, abs=1e-11)
        by_person = found.split_half_r.person_influence
        assert by_person == pytest.approx(renamed.split_half_r.person_influence, abs=1e-11)


def simulate_people(rng: np.random.Generator, n_people: int, probabilities: Floats) -> Tables:
    """Let everyone judge every trial."""
    said_yes = (rng.random((n_people, probabilities.size)) < probabilities).astype(np.float64)
    return Tables(np.ones(said_yes.shape), said_yes)


def test_estimates_are_right_where_the_truth_is_known() -> None:
    """With true shares from Beta(2, 2), 20 people give var / (var + mean p (1 - p) / 20) = .05 / .06."""
    rng = np.random.default_rng(20231105)
    is_first = split_people(np.zeros(20, np.int64), 60, seed=1, stream=0)
    estimates = []
    for _ in range(60):
        tables = simulate_people(rng, 20, rng.beta(2, 2, 300))
        n, n_yes = (table.sum(axis=0).astype(np.int64) for table in (tables.judged, tables.said_yes))
        half = split_half_reliability(Halves(is_first, tables))
        estimates.append([number(half.reliability), number(count_reliability(n, n_yes))])
    means = np.mean(estimates, axis=0)
    errors = np.std(estimates, axis=0, ddof=1) / math.sqrt(60)
    assert (np.abs(means - 5 / 6) < 3 * errors).all(), (means, errors)
    assert errors.max() < 0.004


def test_the_ceiling_is_what_the_truth_itself_reaches() -> None:
    """The true shares correlate with the people's means at the ceiling, far above the split-half r."""
    rng = np.random.default_rng(20231105)
    probabilities = rng.beta(2, 2, 5000)
    tables = simulate_people(rng, 6, probabilities)
    is_first = split_people(np.zeros(6, np.int64), 20, seed=1, stream=0)
    found = split_half_reliability(Halves(is_first, tables))
    r = human_r(probabilities, tables.said_yes.mean(axis=0))
    assert r == pytest.approx(ceiling_of(found.reliability.value), abs=0.015)
    assert number(found.split_half_r) < number(found.reliability) - 0.1 < number(found.reliability) < 0.65


def estimate_both(is_first: NDArray[np.bool_], tables: Tables) -> tuple[Reliability, Reliability]:
    n, n_yes = (table.sum(axis=0).astype(np.int64) for table in (tables.judged, tables.said_yes))
    return split_half_reliability(Halves(is_first, tables)).reliability, count_reliability(n, n_yes, tables)


def test_trial_influences_give_the_standard_error_of_a_real_bootstrap() -> None:
    """Trials drawn anew, and everything computed anew, move the estimates as far as the influences say."""
    rng = np.random.default_rng(20231105)
    tables = simulate_people(rng, 20, rng.beta(1, 1, 200))
    is_first = split_people(np.zeros(20, np.int64), 30, seed=1, stream=0)
    resampled = []
    for _ in range(400):
        drawn = rng.integers(0, 200, 200)
        again = Tables(tables.judged[:, drawn], tables.said_yes[:, drawn])
        resampled.append([number(found) for found in estimate_both(is_first, again)])
    expected = [np.sqrt((found.trial_influence**2).sum()) for found in estimate_both(is_first, tables)]
    assert np.std(resampled, axis=0) == pytest.approx(np.array(expected), rel=0.15)


def test_person_influences_give_the_standard_error_over_new_people() -> None:
    """Other people, of whom some guess more than others, move the estimates as far as the influences say.

    Drawing the same people again is no yardstick here: whoever is drawn twice agrees with himself, and the
    halves hold fewer different people than they did.
    """
    rng = np.random.default_rng(20231105)
    probabilities = rng.beta(1, 1, 150)
    is_first = split_people(np.zeros(60, np.int64), 50, seed=1, stream=0)
    estimates, expected = [], []
    for _ in range(300):
        guessing = rng.random((60, 1))
        said_yes = rng.random((60, 150)) < (1 - guessing) * probabilities + guessing / 2
        found = estimate_both(is_first, Tables(np.ones((60, 150)), said_yes.astype(np.float64)))
        estimates.append([number(one) for one in found])
        expected.append([np.std(one.person_influence) * np.sqrt(60) for one in found])
    assert np.std(estimates, axis=0) == pytest.approx(np.mean(expected, axis=0), rel=0.2)
