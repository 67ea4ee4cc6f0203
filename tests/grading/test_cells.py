"""Cells: the trials of a score, seen through a submission and drawn with their property's pairs."""

from dataclasses import fields

import numpy as np

from builders import build_reference, build_submission, shuffle_pairs
from leaderboard.grading import Yardstick
from leaderboard.grading.draws import Draws
from leaderboard.grading.observations import NOT_A_PROPERTY, Observations

REFERENCE = build_reference(6, seed=2)
EVERYTHING = np.ones(REFERENCE.n_trials, bool)
PROBABILITIES = np.random.default_rng(3).random(REFERENCE.n_trials)
YARDSTICK = Yardstick.of(REFERENCE)
CELLS = YARDSTICK.list_cells(EVERYTHING)
WHOLE = Observations.of(build_submission(REFERENCE, PROBABILITIES.tolist()), REFERENCE)


def test_a_submission_seen_in_a_cell_is_the_selection_of_its_trials() -> None:
    """Field by field, also when something is known of the ground already."""
    for cell in CELLS:
        assert cell.ground.rated.size == cell.kept.size
        seen, selected = cell.observe(WHOLE, reliability=NOT_A_PROPERTY), WHOLE.select(cell.mask)
        for item in fields(Observations):
            mine, expected = getattr(seen, item.name), getattr(selected, item.name)
            assert np.array_equal(mine, expected)
        assert np.array_equal(seen.rated, selected.rated)


def test_cells_of_a_property_share_how_often_its_pairs_are_drawn() -> None:
    """The weights of all resamples are the largest thing in memory, and are there once."""
    for group in YARDSTICK.group_cells(EVERYTHING):
        assert len({id(cell.drawn) for cell in group}) == 1
        assert np.shares_memory(group[0].drawn.weights, YARDSTICK.draws.pairs)


def test_sums_by_pair_are_those_of_a_loop() -> None:
    """Each trial counts for its pair, and pairs outside the cell's span have nothing."""
    for cell in CELLS:
        column = np.arange(1.0, cell.kept.size + 1)
        expected = np.zeros(cell.drawn.rows.size)
        for value, pair in zip(column, REFERENCE.pairs[cell.mask], strict=True):
            expected[list(cell.drawn.rows).index(pair)] += value
        assert cell.sum_by_pair(column[None]).tolist() == [expected.tolist()]
        start, stop = cell.span
        assert not expected[:start].any()
        assert not expected[stop:].any()


def test_a_scenario_spans_its_own_pairs_and_a_property_all() -> None:
    """In the small reference Alpha has two scenarios and Beta one."""
    spans = {cell.key: cell.span for cell in CELLS if cell.subset == "all"}
    n = YARDSTICK.list_cells(EVERYTHING)[0].drawn.rows.size
    assert spans["Alpha", "all"] == (0, n)
    assert spans["alpha_one", "all"] == (0, n // 2)
    assert spans["alpha_two", "all"] == (n // 2, n)


def test_scattered_pairs_are_found_too() -> None:
    """Where the pairs of a property do not follow each other, their weights are copied."""
    scattered, _ = shuffle_pairs(REFERENCE, 1)
    draws = Draws.of(scattered)
    for cell in Yardstick(scattered, draws).list_cells(EVERYTHING):
        assert (cell.drawn.weights == draws.pairs[cell.drawn.rows]).all()
        assert (cell.drawn.rows[cell.positions] == scattered.pairs[cell.mask]).all()


def test_whole_weights_hold_the_number_of_pairs_of_drawn_trials() -> None:
    """A type twice as wide where 16 bits are too few."""
    often = Draws(np.full((len(REFERENCE.pair_ids), 1), 20.0), None)
    kinds = {
        cell.key: cell.whole_weights.dtype for cell in Yardstick(REFERENCE, often).list_cells(EVERYTHING)
    }
    assert kinds["Alpha", "all"] == np.uint32  # 480 trials drawn
    assert kinds["alpha_one", "all"] == np.uint16  # 240
