"""What a reference gives to every grade: cells, drawn people, reliability and ceilings."""

from dataclasses import replace

import numpy as np
import pytest

from builders import build_reference
from leaderboard.grading import Yardstick, subset_masks
from leaderboard.grading.draws import Draws
from leaderboard.grading.yardstick import root
from leaderboard.metrics.reliability import Reliability
from leaderboard.metrics.undefined import Undefined
from leaderboard.reference import Reference

REFERENCE = build_reference(6, seed=4, n_people=16)
COUNTS = build_reference(6, seed=4, n_people=16, responses=False)
BARE = build_reference(6, seed=4, n_people=0)
EVERYTHING = np.ones(REFERENCE.n_trials, bool)
YARDSTICK = Yardstick.of(REFERENCE)
CELLS = {cell.key: cell for cell in YARDSTICK.list_cells(EVERYTHING)}
PROPERTY_CELLS = [(name, subset) for name in ("Alpha", "Beta") for subset in ("all", "easy", "hard")]


def test_cells_are_subsets_of_properties_and_whole_scenarios_in_order() -> None:
    """Each property before its scenarios; overall is none, and what is not covered wholly is none either."""
    alpha, beta = PROPERTY_CELLS[:3], PROPERTY_CELLS[3:]
    scenarios = [("alpha_one", "all"), ("alpha_two", "all")]
    assert list(CELLS) == [*alpha, *scenarios, *beta, ("beta_one", "all")]
    keys = [[cell.key for cell in group] for group in YARDSTICK.group_cells(EVERYTHING)]
    assert keys == [[*alpha, *scenarios], [*beta, ("beta_one", "all")]]
    part = YARDSTICK.list_cells(~REFERENCE.in_scenario("alpha_two"))
    assert [cell.key for cell in part] == [("alpha_one", "all"), *beta, ("beta_one", "all")]
    assert [cell.key for cell in Yardstick.of(BARE).list_cells(EVERYTHING)] == [
        (scope, "all") for scope in ("Alpha", "alpha_one", "alpha_two", "Beta", "beta_one")
    ]


def test_a_cell_holds_the_trials_of_its_scope_and_subset() -> None:
    """With the ground beneath them, and the same cell every time."""
    masks = subset_masks(REFERENCE)
    for (scope, subset), cell in CELLS.items():
        whole = REFERENCE.in_scenario(scope) if "_" in scope else REFERENCE.in_property(scope)
        assert cell.mask.tolist() == (whole & masks[subset]).tolist()
        assert cell.ground.labels.tolist() == REFERENCE.labels[cell.mask].tolist()
    again = YARDSTICK.list_cells(EVERYTHING)
    assert all(cell is CELLS[cell.key] for cell in again)


def test_a_cell_counts_trials_pairs_and_those_that_people_judged() -> None:
    """A pair counts with both members; easy and hard say how many pairs are in both, by a loop over pairs."""
    people = REFERENCE.people
    assert people is not None
    n = people.n.copy()
    n[::7] = 0
    n[1::7] = 1
    pairs = REFERENCE.pairs.copy()
    pairs[5] = len(REFERENCE.pair_ids)
    gaps = replace(
        REFERENCE,
        pairs=pairs,
        pair_ids=(*REFERENCE.pair_ids, "single"),
        people=replace(people, n=n, n_yes=np.minimum(n, people.n_yes), responses=None),
    )
    masks = subset_masks(gaps)

    def count_pairs(mask: np.ndarray) -> int:
        inside = pairs[mask].tolist()
        return sum(inside.count(pair) == 2 for pair in set(inside))

    cells = Yardstick.of(gaps).list_cells(EVERYTHING)
    assert len(cells) == 9
    for cell in cells:
        expected = {
            "n": int(cell.mask.sum()),
            "n_pairs": count_pairs(cell.mask),
            "n_rated": int((n[cell.mask] >= 1).sum()),
        }
        if cell.subset != "all":
            expected["n_pairs_in_both"] = count_pairs(cell.scope.mask & masks["easy"] & masks["hard"])
        assert cell.counts == expected
    assert {cell.counts["n_pairs"] for cell in cells if cell.key == ("Alpha", "all")} == {11}
    bare = Yardstick.of(BARE).list_cells(EVERYTHING)
    assert [cell.counts["n_rated"] for cell in bare] == [0] * 5


def test_people_and_what_is_made_of_them_belong_to_whole_properties() -> None:
    """Easy and hard trials, scenarios, and references without people have none of them."""
    for key, cell in CELLS.items():
        is_property = key in {("Alpha", "all"), ("Beta", "all")}
        assert YARDSTICK.find_panel(cell) is (YARDSTICK.panels[key[0]] if is_property else None)
        reliability = YARDSTICK.find_reliability(cell)
        assert reliability is (YARDSTICK.panels[key[0]].reliability if is_property else None)
        assert (YARDSTICK.resample_ceiling(cell) is not None) is is_property
        crossed = YARDSTICK.find_cross_cells(cell)
        assert [cross.key for cross in crossed] == (
            [(key[0], "easy_crossfit"), (key[0], "hard_crossfit")] if is_property else []
        )
        assert YARDSTICK.find_cross_cells(cell) is crossed
    counts, bare = Yardstick.of(COUNTS), Yardstick.of(BARE)
    for yardstick in (counts, bare):
        assert not any(yardstick.find_cross_cells(cell) for cell in yardstick.list_cells(EVERYTHING))
    assert counts.find_reliability(counts.list_cells(EVERYTHING)[0]) is not None
    assert bare.find_panel(bare.list_cells(EVERYTHING)[0]) is None


@pytest.mark.parametrize("reference", [REFERENCE, COUNTS], ids=["responses", "counts"])
def test_a_reliability_is_resampled_to_first_order(reference: Reference) -> None:
    """Its value, and what drawn pairs and, where they are known, drawn people add; at most 1."""
    yardstick = Yardstick.of(reference)
    for cell in yardstick.list_cells(EVERYTHING):
        found = yardstick.find_reliability(cell)
        if found is None:
            continue
        assert isinstance(found.value, float)
        resampled = yardstick.resample_reliability(found, cell)
        w = yardstick.draws.pairs[reference.pairs[cell.mask]]
        expected = found.value + found.trial_influence @ (w - 1)
        if yardstick.draws.people is not None:
            people = yardstick.panels[cell.scope.name].people
            of_people = found.person_influence
            share = 1 - (found.response_influence**2).sum() / (of_people**2).sum()
            expected += max(share, 0) ** 0.5 * of_people @ (yardstick.draws.people[people] - 1)
        assert resampled == pytest.approx(np.minimum(expected, 1), abs=1e-6)
        ceiling = yardstick.resample_ceiling(cell)
        assert ceiling is not None
        assert ceiling == pytest.approx(root(resampled), nan_ok=True)
        assert yardstick.resample_ceiling(cell) is ceiling


def test_reliabilities_that_are_resampled_stop_at_one() -> None:
    """First order knows no bound, whatever the influences; a root of what is not above 0 is none."""
    cell = CELLS["Alpha", "all"]
    influence = np.arange(-4, 20) / 64
    resampled = YARDSTICK.resample_reliability(Reliability(0.5, influence, np.zeros((0, 24))), cell)
    unbounded = 0.5 + influence @ (YARDSTICK.draws.pairs[REFERENCE.pairs[cell.mask]] - 1)
    assert resampled == pytest.approx(np.minimum(unbounded, 1), abs=1e-6)
    assert resampled.min() < 0
    assert unbounded.max() > 1
    roots = root(np.array([-0.5, 0.0, 0.25, 1.0]))
    assert np.isnan(roots[:2]).all()
    assert roots[2:].tolist() == [0.5, 1]


def test_no_reliability_has_no_resamples() -> None:
    """Neither has its ceiling: where people do not vary, the reason is told instead."""
    nothing = Reliability(Undefined("nobody varies"), np.zeros(24), np.zeros((0, 24)))
    with pytest.raises(TypeError, match=r"^nobody varies$"):
        YARDSTICK.resample_reliability(nothing, CELLS["Alpha", "all"])
    people = COUNTS.people
    assert people is not None
    alike = replace(COUNTS, people=replace(people, n=np.full(36, 4), n_yes=np.full(36, 3)))
    yardstick = Yardstick.of(alike)
    assert yardstick.resample_ceiling(yardstick.list_cells(EVERYTHING)[0]) is None


def test_drawn_people_pull_as_often_as_they_are_drawn_beyond_once() -> None:
    """Sums over the people of the property, however many pulls there are; by a loop."""
    rng = np.random.default_rng(2)
    people = rng.integers(0, 4, (16, 5)).astype(np.float64)
    yardstick = Yardstick(REFERENCE, Draws(np.ones((len(REFERENCE.pair_ids), 5)), people))
    cell = yardstick.list_cells(EVERYTHING)[0]
    pulls = [rng.integers(-9, 9, size).astype(np.float64) / 8 for size in (16, 9, 0)]
    expected = [sum((p * (people[k] - 1) for k, p in enumerate(pull)), np.zeros(5)) for pull in pulls]
    assert yardstick.draw_effects(cell, pulls).tolist() == [row.tolist() for row in expected]
    assert yardstick.draw_effects(cell, []).shape == (0, 5)


def test_only_people_who_judged_a_property_are_drawn_for_it() -> None:
    """Of people who saw one property each, those of the other pull nothing."""
    people = REFERENCE.people
    assert people is not None
    assert people.responses is not None
    r, alpha = people.responses, REFERENCE.in_property("Alpha")
    kept = alpha[r.trials] == (r.participants % 2 == 0)
    single = replace(r, participants=r.participants[kept], trials=r.trials[kept], answers=r.answers[kept])
    n = np.bincount(single.trials, minlength=REFERENCE.n_trials)
    n_yes = np.bincount(single.trials, single.answers, minlength=REFERENCE.n_trials).astype(np.int64)
    apart = replace(REFERENCE, people=replace(people, n=n, n_yes=n_yes, responses=single))
    drawn = np.arange(16.0)[:, None]
    yardstick = Yardstick(apart, Draws(np.ones((len(REFERENCE.pair_ids), 1)), drawn))
    for cell in yardstick.list_cells(EVERYTHING):
        if cell.mask.any():  # of an empty cell nobody is asked
            persons, weights = yardstick.draw_people(cell)
            expected = range(0, 16, 2) if alpha[cell.mask].all() else range(1, 16, 2)
            assert persons.tolist() == list(expected)
            assert weights[:, 0].tolist() == [k - 1 for k in expected]
            found = yardstick.draw_effects(cell, [np.ones(expected[-1] + 1)])
            assert found.tolist() == [[sum(k - 1 for k in expected)]]


def test_where_nobody_is_known_nobody_is_drawn() -> None:
    """With counts only, and for a cell without trials, effects are 0 in every resample."""
    yardstick = Yardstick.of(COUNTS)
    cell = yardstick.list_cells(EVERYTHING)[0]
    persons, weights = yardstick.draw_people(cell)
    assert (persons.tolist(), weights.shape) == ([], (0, 200))
    assert yardstick.draw_effects(cell, [np.zeros(0), np.zeros(0)]).tolist() == [[0.0] * 200] * 2
    empty = replace(CELLS["Alpha", "hard"], mask=~EVERYTHING)
    persons, weights = YARDSTICK.draw_people(empty)
    assert (persons.tolist(), weights.shape) == ([], (0, 200))
