"""First derivatives of metrics by the weights of trials and people, against differences of brute force."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.metrics.agreement import human_r, human_r_partial, mean_kappa
from leaderboard.metrics.influence import (
    correlation_slopes,
    gather_people,
    kappa_influences,
    spread_to_responses,
)

STEP = 1e-6
SEEDS = st.integers(0, 2**32)


def derive(function: Callable[[np.ndarray], float], at: np.ndarray) -> np.ndarray:
    """Differentiate by central differences, one variable at a time."""
    steps = STEP * np.eye(at.size)
    return np.array([(function(at + step) - function(at - step)) / (2 * STEP) for step in steps])


@given(SEEDS)
def test_moving_a_human_mean_moves_r_by_its_slope(seed: int) -> None:
    """For the plain and the partial correlation."""
    rng = np.random.default_rng(seed)
    predicted, observed, labels = rng.random(12), rng.random(12), rng.permutation(np.arange(12) % 2)
    slopes = correlation_slopes(predicted, observed, np.zeros(12, np.int64))
    expected = derive(lambda h: float(human_r(predicted, h)), observed)  # type: ignore[arg-type]
    assert slopes == pytest.approx(expected, abs=1e-6)
    slopes = correlation_slopes(predicted, observed, labels)
    expected = derive(lambda h: float(human_r_partial(predicted, h, labels)), observed)  # type: ignore[arg-type]
    assert slopes == pytest.approx(expected, abs=1e-6)


def test_perfect_agreement_cannot_rise() -> None:
    """At r = 1 every slope is 0."""
    values = np.array([0.1, 0.4, 0.9])
    assert correlation_slopes(values, 2 * values, np.zeros(3, np.int64)) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("label", [0, 1])
def test_one_trial_of_a_label_is_its_own_mean(label: int) -> None:
    """Nothing is left of it, so moving it moves nothing; the others move the partial r as they should."""
    rng = np.random.default_rng(3)
    predicted, observed, labels = rng.random(6), rng.random(6), np.full(6, 1 - label)
    labels[2] = label
    slopes = correlation_slopes(predicted, observed, labels)
    expected = derive(lambda h: float(human_r_partial(predicted, h, labels)), observed)  # type: ignore[arg-type]
    assert slopes == pytest.approx(expected, abs=1e-6)
    assert slopes[2] == pytest.approx(0, abs=1e-12)


@given(SEEDS)
def test_weighing_a_person_moves_human_means_and_so_the_metric(seed: int) -> None:
    """The chain rule from people's weights to human means to any function of them."""
    rng = np.random.default_rng(seed)
    judged = rng.random((5, 4)) < 0.7
    judged[0] = True
    persons, trials = np.nonzero(judged)
    answers = rng.integers(0, 2, persons.size)
    n, n_yes = judged.sum(axis=0), np.bincount(trials, answers, minlength=4).astype(np.int64)
    slopes = rng.normal(size=4)

    def weigh(u: np.ndarray) -> float:
        means = np.bincount(trials, u[persons] * answers) / np.bincount(trials, u[persons])
        return float(slopes @ means)

    pulls = spread_to_responses(slopes, (trials, persons, answers), n, n_yes)
    found = np.bincount(persons, pulls)
    assert found == pytest.approx(derive(weigh, np.ones(5))[: found.size], abs=1e-6)


@given(st.lists(st.tuples(st.integers(0, 3), st.floats(-1, 1)), min_size=1, max_size=20))
def test_gathered_people_leave_out_what_drawing_trials_accounts_for(pulls: list[tuple[int, float]]) -> None:
    """Their sum of squares is that of people less that of single responses, and their proportions stay."""
    persons, values = np.array([p for p, _ in pulls]), np.array([v for _, v in pulls])
    sums, found = np.bincount(persons, values), gather_people(values, persons)
    assert (found**2).sum() == pytest.approx(max((sums**2).sum() - (values**2).sum(), 0), abs=1e-9)
    assert found * np.abs(sums).max() == pytest.approx(sums * np.abs(found).max(), abs=1e-9)


def weigh_kappas(
    predicted: np.ndarray, responses: tuple[np.ndarray, np.ndarray, np.ndarray], w: np.ndarray, u: np.ndarray
) -> float:
    """Mean kappa with weights for trials and people, from its definition as agreement beyond chance."""
    trials, persons, values = responses
    total = weight = 0.0
    for person in set(persons.tolist()):
        mine = persons == person
        a, b, v = predicted[trials[mine]], values[mine], w[trials[mine]]
        p1, p2 = np.average(a, weights=v), np.average(b, weights=v)
        agreement = np.average(1 - np.abs(a - b), weights=v)
        chance = p1 * p2 + (1 - p1) * (1 - p2)
        if mine.sum() > 1 and chance < 1 - 1e-9:
            total += u[person] * (agreement - chance) / (1 - chance)
            weight += u[person]
    return total / weight


@given(SEEDS)
def test_kappa_moves_with_trials_and_people_as_its_influences_say(seed: int) -> None:
    """Both sets of derivatives equal differences of the weighted definition, which at 1 is the metric."""
    rng = np.random.default_rng(seed)
    persons, trials = np.nonzero(rng.random((6, 8)) < 0.7)
    responses = (trials, persons, rng.integers(0, 2, persons.size))
    predicted = rng.choice([0.0, 0.5, 1.0], 8)
    w, u = np.ones(8), np.ones(6)
    by_trial, by_person = kappa_influences(predicted, responses)
    value = mean_kappa(predicted[trials], responses[2], persons)
    if isinstance(value, float):
        assert weigh_kappas(predicted, responses, w, u) == pytest.approx(value)
        expected = derive(lambda v: weigh_kappas(predicted, responses, v, u), w)
        assert by_trial == pytest.approx(expected, abs=1e-5)
        expected = derive(lambda v: weigh_kappas(predicted, responses, w, v), u)[: by_person.size]
        assert by_person * np.abs(expected).max() == pytest.approx(
            expected * np.abs(by_person).max(), abs=1e-5
        )
        assert np.abs(by_person).max() <= np.abs(expected).max() + 1e-5
    assert by_trial.sum() == pytest.approx(0, abs=1e-12)
    assert by_person.sum() == pytest.approx(0, abs=1e-12)


def test_influences_on_kappa_of_a_case_by_hand() -> None:
    """Kappas 1 and -1 on two trials, of which the model has 1 on one: each person moves their mean by 1/2.

    With weights v and w of a person's two responses, agreement is 1 or 0 at any weights, and so is kappa:
    no response moves anything, and nothing is left out of the sums over people.
    """
    trials, persons, values = np.array([0, 1, 0, 1]), np.array([0, 0, 1, 1]), np.array([1, 0, 0, 1])
    by_trial, by_person = kappa_influences(np.array([1.0, 0.0]), (trials, persons, values))
    assert by_person.tolist() == [0.5, -0.5]
    assert by_trial.tolist() == [0, 0]


def test_a_half_value_beside_two_zeros_has_a_kappa() -> None:
    """Values (1/2, 0) against (0, 0): agreement 3/4 and chance 3/4 give 0, beside another person's 1.

    Weights v of the first person's responses give no other kappa than 0, since chance is 1 - p1 as is
    agreement; each person moves the mean by 1/4.
    """
    trials, persons, values = np.array([0, 1, 2, 3]), np.array([0, 0, 1, 1]), np.array([0, 0, 1, 0])
    by_trial, by_person = kappa_influences(np.array([0.5, 0.0, 1.0, 0.0]), (trials, persons, values))
    assert by_person.tolist() == [-0.25, 0.25]
    assert by_trial == pytest.approx(0, abs=1e-15)


@pytest.mark.parametrize("n_people", [1, 2, 5])
def test_people_who_are_left_out_change_nothing_for_the_others(n_people: int) -> None:
    """One with a single trial and one for whom chance is 1 are as if they were not there."""
    rng = np.random.default_rng(n_people)
    predicted = np.concatenate([rng.permutation([0.0, 0.5, 1.0, 1.0, 0.0, 1.0]), [1.0, 1.0]])
    persons, trials = np.repeat(np.arange(n_people), 6), np.tile(np.arange(6), n_people)
    values = rng.integers(0, 2, persons.size)
    by_trial, by_person = kappa_influences(predicted, (trials, persons, values))
    expected = derive(
        lambda w: weigh_kappas(predicted, (trials, persons, values), w, np.ones(n_people)), np.ones(8)
    )
    assert by_trial == pytest.approx(expected, abs=1e-5)
    more = (
        np.concatenate([trials, [0, 6, 7]]),
        np.concatenate([persons, n_people + np.array([0, 1, 1])]),
        np.concatenate([values, [1, 1, 1]]),
    )
    with_more = kappa_influences(predicted, more)
    assert with_more[0].tolist() == by_trial.tolist()
    assert with_more[1].tolist() == [*by_person.tolist(), 0, 0]


def test_people_without_a_kappa_have_no_influence() -> None:
    """One who saw a single trial and one for whom chance is 1 pull nothing."""
    predicted = np.array([1.0, 1.0, 0.0, 1.0])
    trials, persons = np.array([0, 0, 1, 0, 2, 3]), np.array([0, 1, 1, 2, 2, 2])
    by_trial, by_person = kappa_influences(predicted, (trials, persons, np.array([1, 1, 1, 1, 1, 0])))
    assert by_person[:2].tolist() == [0, 0]
    assert by_trial[1] == 0
