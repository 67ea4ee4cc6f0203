"""Cross-fitted subsets in results: one half of the people chooses, the other is measured."""

from itertools import product

import numpy as np
import pytest

from builders import build_reference, build_submission, shuffle_pairs
from leaderboard.grading import Yardstick, grade, grade_people, tally_scores
from leaderboard.grading.crossfitted import resample_people_crossfit
from leaderboard.grading.draws import Draws
from leaderboard.grading.observations import Observations
from leaderboard.grading.panels import N_CROSSFIT_SPLITS
from leaderboard.grading.scopes import CROSSFIT_SUBSETS

REFERENCE = build_reference(6, seed=4, n_people=16)
PROBABILITIES = np.random.default_rng(8).random(REFERENCE.n_trials)
EVERYTHING = np.ones(REFERENCE.n_trials, bool)


def test_scores_equal_a_loop_over_splits_and_directions() -> None:
    """Every case put together trial by trial: who chooses, what is chosen, who is measured."""
    yardstick = Yardstick.of(REFERENCE)
    mask, panel = REFERENCE.in_property("Alpha"), yardstick.panels["Alpha"]
    assert panel.halves is not None
    labels, pairs = REFERENCE.labels[mask], REFERENCE.pairs[mask]
    q = PROBABILITIES[mask]
    credits = (q > 0.5) == (labels == 1)
    credit, own, right, count, shares = [], [], [], [], []
    for split, chooser in product(range(N_CROSSFIT_SPLITS), (0, 1)):
        n, n_yes = panel.halves.n[:, split], panel.halves.n_yes[:, split]
        n_right = np.where(labels == 1, n_yes, n - n_yes)
        easy = {pairs[t] for t in range(q.size) if 3 * n_right[chooser][t] > 2 * n[chooser][t]}
        chosen = [t for t in range(q.size) if pairs[t] in easy]
        count.append(len(chosen))
        credit += [credits[t] for t in chosen]
        for t in chosen:
            if n[1 - chooser][t]:
                own.append((q[t], credits[t]))
                right.append(n_right[1 - chooser][t] / n[1 - chooser][t])
                shares.append(n_yes[1 - chooser][t] / n[1 - chooser][t])
    scores = grade(build_submission(REFERENCE, PROBABILITIES.tolist()), REFERENCE).scores["Alpha"][
        "easy_crossfit"
    ]
    assert scores.n == pytest.approx(np.mean(count), abs=1e-6)
    assert scores.metrics["accuracy"].value == pytest.approx(np.mean(credit), abs=1e-6)
    drawn = np.array(own, float)
    assert scores.metrics["human_r"].value == pytest.approx(np.corrcoef(drawn[:, 0], shares)[0, 1], abs=1e-6)
    assert scores.metrics["human_gap"].value == pytest.approx(drawn[:, 1].mean() - np.mean(right), abs=1e-6)
    people = grade_people(REFERENCE)["Alpha"]["easy_crossfit"].metrics["accuracy"].value
    assert people == pytest.approx(np.mean(right), abs=1e-6)


def test_drawing_every_pair_once_gives_the_values_and_people_are_not_drawn() -> None:
    """However often people are drawn, who is in which half stays."""
    draws = Draws(np.ones((len(REFERENCE.pair_ids), 2)), np.array([[0.0, 2.0]] * 16))
    submission = build_submission(REFERENCE, PROBABILITIES.tolist())
    tally = tally_scores(Observations.of(submission, REFERENCE), EVERYTHING, Yardstick(REFERENCE, draws))
    for scope, subset, metric in product(
        ("Alpha", "overall"), CROSSFIT_SUBSETS, ("accuracy", "human_r", "human_gap")
    ):
        value = tally.estimates[scope][subset][metric]
        assert tally.resampled[scope, subset, metric] == pytest.approx(value, abs=2e-6)


def test_resamples_of_people_do_not_depend_on_the_order_of_pairs() -> None:
    """To the last bit, as those of submissions."""
    yardstick = Yardstick.of(REFERENCE)
    shuffled, place = shuffle_pairs(REFERENCE, 3)
    other = Yardstick(shuffled, Draws(yardstick.draws.pairs[np.argsort(place)], yardstick.draws.people))
    for plain, turned in zip(yardstick.list_cells(EVERYTHING), other.list_cells(EVERYTHING), strict=True):
        crosses = yardstick.find_cross_cells(plain), other.find_cross_cells(turned)
        assert len(crosses[0]) == (2 if plain.key in (("Alpha", "all"), ("Beta", "all")) else 0)
        for mine, theirs in zip(*crosses, strict=True):
            assert np.array_equal(resample_people_crossfit(mine), resample_people_crossfit(theirs))


def test_without_single_responses_there_are_no_cross_fitted_subsets() -> None:
    """Counts cannot be split by people."""
    counts = build_reference(4, responses=False)
    result = grade(build_submission(counts, [0.7] * counts.n_trials), counts)
    assert set(result.scores["overall"]) == set(grade_people(counts)["overall"]) == {"all", "easy", "hard"}
