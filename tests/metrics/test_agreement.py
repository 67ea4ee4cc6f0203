"""Correlation with the human mean, and agreement with single people."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.metrics.agreement import (
    answers_of,
    human_r,
    human_r_normalized,
    human_r_partial,
    human_rmse,
    mean_kappa,
)
from leaderboard.metrics.undefined import Undefined

PEOPLE = np.array([0.1, 0.2, 0.4])
R_OF_LAST = 5 / math.sqrt(28)  # of (0, 0, 1) with PEOPLE: deviations (-1, -1, 2)/3 and (-4, -1, 5)/30


def test_human_r_of_a_case_by_hand() -> None:
    """Deviations (-1, -1, 2) and (-4, -1, 5): 15 / sqrt(6 x 42)."""
    assert human_r(np.array([0.0, 0.0, 1.0]), PEOPLE) == pytest.approx(15 / math.sqrt(6 * 42), abs=1e-15)
    assert pytest.approx(15 / math.sqrt(6 * 42)) == R_OF_LAST


def test_human_r_is_one_for_people_themselves_and_minus_one_for_their_opposite() -> None:
    """A straight line up or down, with no digit beyond."""
    assert human_r(PEOPLE, PEOPLE) == 1
    assert human_r(1 - PEOPLE, PEOPLE) == pytest.approx(-1, abs=1e-15)


def test_no_rounding_leads_beyond_a_straight_line() -> None:
    """Up and down, with many digits or few."""
    for seed in range(60):
        people = np.random.default_rng(seed).random(9).round(1 + seed % 3)
        up, down = human_r(0.1 + 0.7 * people, people), human_r(0.8 - 0.7 * people, people)
        assert isinstance(up, float)
        assert isinstance(down, float)
        assert up == pytest.approx(1, abs=1e-12)
        assert down == pytest.approx(-1, abs=1e-12)
        assert -1 <= down < up <= 1


@pytest.mark.parametrize(
    ("low", "high"),
    [
        (0.0, 5e-324),
        (0.0, 1e-200),
        (0.1, math.nextafter(0.1, 1)),
        (0.5, math.nextafter(0.5, 1)),
        (1e-300, 2e-300),
    ],
)
def test_the_smallest_difference_is_a_difference(low: float, high: float) -> None:
    """Correlation does not see how small a step is, down to neighbouring numbers."""
    assert human_r(np.array([low, low, high]), PEOPLE) == pytest.approx(R_OF_LAST, abs=1e-12)
    assert human_r(PEOPLE, np.array([low, low, high])) == pytest.approx(R_OF_LAST, abs=1e-12)


@pytest.mark.parametrize("value", [0.0, 0.1, 1 / 3, 1.0])
@pytest.mark.parametrize("size", [2, 3, 49, 192])
def test_equal_values_are_seen_as_equal(value: float, size: int) -> None:
    """Even where the mean of equal numbers is not that number: rounding errors are not correlated."""
    constant, varying = np.full(size, value), np.linspace(0, 1, size)
    assert human_r(constant, varying) == Undefined("all probabilities are equal")
    assert human_r(varying, constant) == Undefined("all human means are equal")
    assert human_r(constant, constant) == Undefined("all probabilities are equal")


@pytest.mark.parametrize("size", [0, 1])
def test_correlation_needs_two_trials(size: int) -> None:
    """One point has no line."""
    values, labels = np.full(size, 0.3), np.zeros(size, np.int64)
    assert human_r(values, values) == Undefined("fewer than two rated trials")
    assert human_r_partial(values, values, labels) == Undefined("fewer than two rated trials")


def test_partialling_out_takes_away_what_the_label_gives() -> None:
    """Within NO trials and within YES trials the model goes up where people go down, despite r near 1."""
    model, people = np.array([0.0, 0.1, 0.9, 1.0]), np.array([0.1, 0.0, 1.0, 0.9])
    labels = np.array([0, 0, 1, 1])
    plain = human_r(model, people)
    assert isinstance(plain, float)
    assert plain > 0.95
    assert human_r_partial(model, people, labels) == pytest.approx(-1, abs=1e-12)


def test_partial_correlation_of_a_case_by_hand() -> None:
    """Residuals (-1, 1, 0; -1, 1) / 10 and (-1, 0, 1; -2, 2) / 10: (1 + 4) / sqrt(4 x 10)."""
    model, people = np.array([0.2, 0.4, 0.3, 0.6, 0.8]), np.array([0.1, 0.2, 0.3, 0.5, 0.9])
    labels = np.array([0, 0, 0, 1, 1])
    assert human_r_partial(model, people, labels) == pytest.approx(5 / math.sqrt(40), abs=1e-12)


def test_a_constant_label_leaves_nothing_to_partial_out() -> None:
    """The partial correlation is then the plain one."""
    model = np.array([0.3, 0.9, 0.2])
    for label in (0, 1):
        assert human_r_partial(model, PEOPLE, np.full(3, label)) == human_r(model, PEOPLE)


@pytest.mark.parametrize(
    ("no", "yes"), [(0.0, 1.0), (0.1, 0.7), (1 / 3, 2 / 3), (0.5, math.nextafter(0.5, 1))]
)
def test_a_perfect_oracle_is_not_human_like_by_being_right(no: float, yes: float) -> None:
    """Values that depend on the label alone leave nothing, and not a correlation of rounding errors."""
    labels = np.tile([0, 1], 50)
    oracle, varying = np.where(labels == 1, yes, no), np.linspace(0, 1, 100)
    expected = Undefined("probabilities do not vary apart from the label")
    assert human_r_partial(oracle, varying, labels) == expected
    assert human_r_partial(varying, oracle, labels) == Undefined(
        "human means do not vary apart from the label"
    )
    assert human_r_partial(oracle, oracle, labels) == expected


@pytest.mark.parametrize("labels", [[0, 0, 1, 1], [1, 1, 0, 0], [0, 1, 0, 1], [1, 0, 1, 0]], ids=str)
@pytest.mark.parametrize("step", [1e-13, 1e-200, 5e-324])
def test_small_variation_apart_from_the_label_is_still_variation(labels: list[int], step: float) -> None:
    """An oracle that hedges by a trillionth, or far less, says something beyond the label."""
    groups = np.array(labels)
    for label in (0, 1):
        model, people = np.full(4, 1.0), np.full(4, 0.4)
        model[groups == label], people[groups == label] = (step, 2 * step), (0.1, 0.2)
        assert human_r_partial(model, people, groups) == pytest.approx(1, abs=1e-12)


def test_partial_correlation_gives_the_reasons_of_the_plain_one() -> None:
    """What does not vary at all is said to be equal, not to follow the label."""
    labels, varying, constant = np.array([0, 1, 1]), PEOPLE, np.full(3, 0.2)
    assert human_r_partial(constant, varying, labels) == Undefined("all probabilities are equal")
    assert human_r_partial(varying, constant, labels) == Undefined("all human means are equal")


def test_the_ceiling_divides_r_where_there_is_one() -> None:
    """By its root, above 1 too; none where the reliability is 0 or less, and r's own reason comes first."""
    assert human_r_normalized(0.6, 0.25) == 1.2
    assert human_r_normalized(-0.5, 2.0**-1074) == -(2.0**536)
    not_reliable = Undefined("people agree no more than chance would have it, so there is no ceiling")
    assert human_r_normalized(0.6, 0.0) == human_r_normalized(0.6, -0.5) == not_reliable
    assert human_r_normalized(0.6, Undefined("b")) == Undefined("b")
    assert human_r_normalized(Undefined("a"), Undefined("b")) == Undefined("a")


def test_human_rmse_of_a_case_by_hand() -> None:
    """Differences 0.3, 0 and -0.4: sqrt(0.25 / 3)."""
    expected = math.sqrt(0.25 / 3)
    assert human_rmse(np.array([0.4, 0.2, 0.0]), PEOPLE) == pytest.approx(expected, abs=1e-15)


def test_human_rmse_needs_no_variation_but_a_trial() -> None:
    """Constant probabilities have a distance; no trials have none."""
    assert human_rmse(np.full(2, 0.5), np.full(2, 0.5)) == 0
    assert human_rmse(np.array([]), np.array([])) == Undefined("nobody rated these trials")


def _kappa(*people: tuple[list[float], list[int]]) -> float | Undefined:
    """Agree with each person in turn: the model's values and the person's on the same trials."""
    persons = [number for number, (model, _) in enumerate(people) for _ in model]
    model = [value for values, _ in people for value in values]
    answers = [value for _, values in people for value in values]
    return mean_kappa(np.array(model, float), np.array(answers, np.int64), np.array(persons, np.int64))


@pytest.mark.parametrize(
    ("model", "person", "kappa"),
    [
        ([1, 0], [1, 0], 1),
        ([1, 0], [0, 1], -1),
        ([1, 1], [1, 0], 0),  # agreement 1/2, chance 1/2
        ([1, 1, 1, 0], [1, 1, 0, 0], 0.5),  # agreement 3/4, chance 3/8 + 1/8
        ([1, 1, 1, 0], [0, 1, 1, 1], -1 / 3),  # agreement 1/2, chance 9/16 + 1/16
        ([1, 1], [0, 0], 0),  # agreement 0, chance 0: never together, as expected
        ([0.5, 0.5], [1, 0], 0),  # agreement 1/2, chance 1/4 + 1/4
        ([1, 0.5], [1, 0], 0.5),  # agreement 3/4, chance 3/8 + 1/8
    ],
)
def test_kappa_of_one_person_by_hand(model: list[float], person: list[int], kappa: float) -> None:
    """(agreement - chance) / (1 - chance), half values entering as probabilities."""
    assert _kappa((model, person)) == pytest.approx(kappa, abs=1e-15)


def test_people_weigh_the_same_however_many_trials_they_saw() -> None:
    """The mean is over people, not over responses."""
    assert _kappa(([1, 0], [1, 0]), ([1, 0, 1, 0, 1, 0], [0, 1, 0, 1, 0, 1])) == pytest.approx(0, abs=1e-15)


def test_people_with_one_trial_are_left_out() -> None:
    """One trial shows no agreement beyond chance; with nobody else there is no value."""
    assert _kappa(([1, 0], [1, 0]), ([1], [0])) == 1
    assert _kappa(([1], [0]), ([1], [1])) == Undefined("no person rated two of these trials")


@pytest.mark.parametrize("size", [2, 3, 7, 49])
@pytest.mark.parametrize("value", [0, 1])
def test_people_for_whom_chance_is_one_are_left_out(size: int, value: int) -> None:
    """Both always right, or both always wrong: nothing is left for agreement to exceed."""
    certain = ([float(value)] * size, [value] * size)
    assert _kappa(certain, ([1, 0], [0, 1])) == -1
    assert _kappa(certain, ([1], [0])) == Undefined(
        "for every person, chance alone already gives full agreement"
    )


def test_people_need_not_be_numbered_without_gaps() -> None:
    """In a subset of the trials some people have no response; they are not counted."""
    model, person = np.array([1.0, 0.0, 1.0, 0.0]), np.array([1, 0, 0, 1])
    assert mean_kappa(model, person, np.array([9, 9, 4, 4])) == 0


def test_without_responses_there_is_no_kappa() -> None:
    """The reason is that nobody rated."""
    nothing = np.array([], np.int64)
    assert mean_kappa(np.array([]), nothing, nothing) == Undefined("nobody rated these trials")


@given(
    st.lists(st.tuples(st.sampled_from([0.0, 0.5, 1.0]), st.integers(0, 1), st.integers(0, 5)), min_size=1)
)
def test_kappa_depends_on_who_not_on_when(responses: list[tuple[float, int, int]]) -> None:
    """Responses in another order, and people with other numbers, agree as much."""
    model, answers, persons = (np.array(column) for column in zip(*responses, strict=True))
    plain = mean_kappa(model, answers, persons)
    turned = mean_kappa(model[::-1], answers[::-1], 7 - persons[::-1])
    assert turned == (plain if isinstance(plain, Undefined) else pytest.approx(plain, abs=1e-12))
    assert isinstance(plain, Undefined) or -1 <= plain <= 1


def test_answers_are_sides_of_one_half() -> None:
    """Above is YES, below is NO, and the middle is half of each."""
    values = np.array([0.0, math.nextafter(0.5, 0), 0.5, math.nextafter(0.5, 1), 1.0])
    assert answers_of(values).tolist() == [0, 0, 0.5, 1, 1]
