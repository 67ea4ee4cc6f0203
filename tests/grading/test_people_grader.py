"""The scores of people themselves on single resamples: both ends of an interval are then its value."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from builders import build_reference
from leaderboard.grading import Yardstick, grade_people
from leaderboard.grading.draws import Draws
from leaderboard.models import Score
from leaderboard.reference import Reference, Responses

Floats = NDArray[np.float64]


def _leave_gaps(reference: Reference) -> Reference:
    """Let nobody judge every fifth trial, and only one person each after it."""
    people = reference.people
    assert people is not None
    assert people.responses is not None
    r = people.responses
    first = np.unique(r.trials, return_index=True)[1]
    kept = (r.trials % 5 > 1) | ((r.trials % 5 == 1) & np.isin(np.arange(r.trials.size), first))
    responses = replace(r, participants=r.participants[kept], trials=r.trials[kept], answers=r.answers[kept])
    n = np.bincount(responses.trials, minlength=reference.n_trials)
    n_yes = np.bincount(responses.trials, responses.answers, minlength=reference.n_trials).astype(np.int64)
    return replace(reference, people=replace(people, n=n, n_yes=n_yes, responses=responses))


REFERENCE = _leave_gaps(build_reference(6, seed=4, n_people=16))
N_PAIRS, N_PEOPLE = len(REFERENCE.pair_ids), 16
ONCE = np.ones((N_PAIRS, 1)), np.ones((N_PEOPLE, 1))
SCOPES = [("Alpha", "all"), ("Alpha", "easy"), ("Alpha", "hard"), ("alpha_two", "all"), ("Beta", "all")]


def responses_of(reference: Reference) -> Responses:
    assert reference.people is not None
    assert reference.people.responses is not None
    return reference.people.responses


def draw(pairs: Floats = ONCE[0], people: Floats = ONCE[1]) -> dict[tuple[str, str, str], Score]:
    """Score people with these draws."""
    found = grade_people(REFERENCE, yardstick=Yardstick(REFERENCE, Draws(pairs, people)))
    return {
        (scope, subset, name): score
        for scope, subsets in found.items()
        for subset, scores in subsets.items()
        for name, score in scores.metrics.items()
    }


def mask_of(scope: str, subset: str) -> NDArray[np.bool_]:
    whole = REFERENCE.in_scenario(scope) if "_" in scope else REFERENCE.in_property(scope)
    return whole & Yardstick.of(REFERENCE).masks[subset]


def weigh(name: str, mask: NDArray[np.bool_], w: Floats, v: Floats) -> float:
    """Average over rated trials of weight w the share who were right, or said YES; v weighs responses."""
    r = responses_of(REFERENCE)
    is_right = r.answers == REFERENCE.labels[r.trials]
    counted = is_right if name == "accuracy" else r.answers == 1
    shares, weights = [], []
    for trial in np.flatnonzero(mask):
        mine = r.trials == trial
        if mine.any():
            shares.append((v[mine] * counted[mine]).sum() / v[mine].sum())
            weights.append(w[trial])
    return float(np.average(shares, weights=weights))


def derive(function: Callable[[Floats], float], size: int) -> Floats:
    """Differentiate at 1 by central differences, one variable at a time."""
    step, one = 1e-6, np.ones(size)
    return np.array([(function(one + d) - function(one - d)) / (2 * step) for d in step * np.eye(size)])


@pytest.mark.parametrize(("scope", "subset"), SCOPES)
@pytest.mark.parametrize("name", ["accuracy", "yes_rate"])
def test_trials_weigh_as_often_as_their_pair_is_drawn(name: str, scope: str, subset: str) -> None:
    """Those that one person judged as those of many, those of nobody not at all; by a loop over trials."""
    mask, v = mask_of(scope, subset), np.ones(responses_of(REFERENCE).trials.size)
    value = weigh(name, mask, np.ones(REFERENCE.n_trials), v)
    for seed in range(4):
        drawn = np.random.default_rng(seed).integers(0, 4, (N_PAIRS, 1)).astype(np.float64)
        found = draw(drawn)[scope, subset, name]
        expected = weigh(name, mask, drawn[REFERENCE.pairs, 0], v)
        assert (found.value, found.low) == pytest.approx((value, expected), abs=1e-6)
        assert found.low == found.high


@pytest.mark.parametrize(("scope", "subset"), SCOPES)
@pytest.mark.parametrize("name", ["accuracy", "yes_rate"])
def test_drawn_people_move_their_scores_to_first_order(name: str, scope: str, subset: str) -> None:
    """By the derivative by each person's weight, less what drawing trials accounts for already."""
    mask, persons = mask_of(scope, subset), responses_of(REFERENCE).participants
    slopes = derive(lambda v: weigh(name, mask, np.ones(REFERENCE.n_trials), v), persons.size)
    by_person = np.bincount(persons, slopes, minlength=N_PEOPLE)
    scale = np.sqrt(max(0, 1 - (slopes**2).sum() / (by_person**2).sum()))
    for seed in range(4):
        drawn = np.random.default_rng(seed).integers(0, 4, (N_PEOPLE, 1)).astype(np.float64)
        found = draw(people=drawn)[scope, subset, name]
        assert found.value is not None
        expected = min(max(found.value + scale * by_person @ (drawn[:, 0] - 1), 0), 1)
        assert found.low == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize("name", ["accuracy", "yes_rate"])
def test_shares_stay_between_nothing_and_all(name: str) -> None:
    """However often somebody is drawn who is mostly right, or mostly wrong."""
    ends = set()
    for person in range(N_PEOPLE):
        drawn = ONCE[1].copy()
        drawn[person] = 1e6
        found = draw(people=drawn)
        ends |= {found[scope, subset, name].low or 0 for scope, subset in SCOPES}
    assert (min(ends), max(ends)) == (0, 1)


@pytest.mark.parametrize("scope", ["Alpha", "Beta"])
@pytest.mark.parametrize("subset", ["easy", "hard"])
def test_crossfitted_trials_weigh_as_they_were_chosen_and_drawn(scope: str, subset: str) -> None:
    """Of the trials that the other half rated, by the pairs that are drawn; people stay as they are."""
    crossfit = Yardstick.of(REFERENCE).panels[scope].crossfit
    assert crossfit is not None
    weighed = getattr(crossfit, subset)
    drawn = np.random.default_rng(5).integers(0, 4, (N_PAIRS, 1)).astype(np.float64)
    w = drawn[REFERENCE.pairs[REFERENCE.in_property(scope)], 0]
    found = draw(drawn, np.full((N_PEOPLE, 1), 3.0))[scope, f"{subset}_crossfit", "accuracy"]
    expected = (weighed.right_sum @ w) / (weighed.rated @ w)
    value = weighed.right_sum.sum() / weighed.rated.sum()
    assert (found.value, found.low) == pytest.approx((value, expected), abs=1e-6)


def test_agreement_moves_with_pairs_and_people_to_first_order() -> None:
    """A reliability is its value and its influences times how often is drawn, less 1, and at most 1."""
    panel = Yardstick.of(REFERENCE).panels["Alpha"]
    assert panel.split_half is not None
    rng = np.random.default_rng(6)
    drawn = rng.integers(0, 4, (N_PAIRS, 1)).astype(np.float64)
    w = drawn[REFERENCE.pairs[REFERENCE.in_property("Alpha")], 0]
    people = rng.integers(0, 3, (N_PEOPLE, 1)).astype(np.float64)
    estimates = {
        "split_half_r": panel.split_half.split_half_r,
        "reliability": panel.split_half.reliability,
        "reliability_from_counts": panel.from_counts,
    }
    by_pairs, by_people = draw(drawn), draw(people=people)
    for name, estimate in estimates.items():
        assert isinstance(estimate.value, float)
        expected = min(estimate.value + estimate.trial_influence @ (w - 1), 1)
        assert by_pairs["Alpha", "all", name].low == pytest.approx(expected, abs=1e-5)
        of_people = estimate.person_influence
        scale = np.sqrt(max(0, 1 - (estimate.response_influence**2).sum() / (of_people**2).sum()))
        expected = min(estimate.value + scale * of_people @ (people[panel.people, 0] - 1), 1)
        assert by_people["Alpha", "all", name].low == pytest.approx(expected, abs=1e-5)


def test_the_ceiling_is_the_root_on_every_resample() -> None:
    """Where a resample's reliability is not above 0 it has no ceiling, which is counted."""
    rng = np.random.default_rng(7)
    drawn = rng.integers(0, 9, (N_PAIRS, 400)).astype(np.float64)
    found = draw(drawn, np.ones((N_PEOPLE, 400)))
    ceiling, reliability = (found["Alpha", "all", name] for name in ("ceiling", "reliability"))
    assert reliability.value is not None
    assert ceiling.value == pytest.approx(reliability.value**0.5, abs=1e-6)
    panel = Yardstick.of(REFERENCE).panels["Alpha"]
    w = drawn[REFERENCE.pairs[REFERENCE.in_property("Alpha")]]
    resampled = np.minimum(reliability.value + panel.reliability.trial_influence @ (w - 1), 1)
    roots = np.sqrt(resampled[resampled > 0])
    assert 0 < roots.size < 400
    assert ceiling.undefined_resamples == 400 - roots.size
    assert (ceiling.low, ceiling.high) == pytest.approx(tuple(np.quantile(roots, [0.025, 0.975])), abs=1e-5)
