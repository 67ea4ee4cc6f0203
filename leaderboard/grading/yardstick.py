"""What a reference gives to every grade, made once and used for all submissions."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Self

import numpy as np

from leaderboard.grading.draws import Draws, Weights
from leaderboard.grading.panels import Panel, find_panels
from leaderboard.grading.scopes import SUBSETS, Scope, list_scopes, subset_masks
from leaderboard.metrics.accuracy import Booleans, Floats, Integers
from leaderboard.metrics.crossfit import CrossFit
from leaderboard.metrics.influence import gather_people
from leaderboard.metrics.pairs import find_pairs
from leaderboard.metrics.reliability import Reliability
from leaderboard.metrics.resampling import INFLUENCE_BITS, on_grid
from leaderboard.metrics.undefined import Undefined
from leaderboard.models.benchmark import OVERALL
from leaderboard.reference import Reference


@dataclass(frozen=True)
class Cell:
    """The trials of one subset of one scope, and how often each of their pairs is drawn.

    Attributes
    ----------
    scope, subset
        Which.
    mask : (n_trials,)
        The trials, among all of the reference.
    positions : (n_cell_trials,)
        Which of the cell's pairs each of its trials belongs to.
    weights, small_weights : (n_cell_pairs, n_resamples)
        In float64, and in float32 for what is exact in it; also of some pairs that no trial of the cell is
        in, where that saves a copy.
    counts
        Numbers of trials, pairs and rated trials, as in results.
    shared_sums : dict of (n_resamples,)
        Sums over the drawn pairs that all submissions share, once they are computed.
    """

    scope: Scope
    subset: str
    mask: Booleans
    positions: Integers
    weights: Floats
    small_weights: Weights
    counts: Mapping[str, int]
    shared_sums: dict[str, Floats] = field(default_factory=dict, repr=False)

    @property
    def key(self) -> tuple[str, str]:
        """Scope and subset by name."""
        return self.scope.name, self.subset

    def sum_by_pair(self, columns: Floats) -> Floats:
        """Sum columns, (n_columns, n_cell_trials), within pairs; (n_columns, n_cell_pairs)."""
        sums = np.zeros((len(columns), len(self.weights)))
        if self.positions.size:
            order, starts, pairs = self._runs
            sums[:, pairs] = np.add.reduceat(columns[:, order], starts, axis=1)
        return sums

    @cached_property
    def _runs(self) -> tuple[Integers, Integers, Integers]:
        """Bring the trials of a pair together, and say where each pair begins and which it is."""
        order = np.argsort(self.positions, kind="stable")
        starts = np.flatnonzero(np.diff(self.positions[order], prepend=-1))
        return order, starts, self.positions[order][starts]


@dataclass(frozen=True)
class Yardstick:
    """A reference with its resamples, its cells, and how well people agree with each other."""

    reference: Reference
    draws: Draws
    _cells: dict[tuple[str, str], Cell] = field(default_factory=dict, repr=False)
    _people: dict[str, tuple[Integers, Floats]] = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, reference: Reference) -> Self:
        """Prepare a reference for grading."""
        return cls(reference, Draws.of(reference))

    @cached_property
    def masks(self) -> dict[str, Booleans]:
        """The trials of each subset, shape (n_trials,) each."""
        return subset_masks(self.reference)

    @cached_property
    def panels(self) -> Mapping[str, Panel]:
        """The people who judged each property; none without human data."""
        return find_panels(self.reference)

    @property
    def properties(self) -> tuple[str, ...]:
        """The names of the properties, in order."""
        return tuple(property_.name for property_ in self.reference.benchmark.properties)

    def find_panel(self, cell: Cell) -> Panel | None:
        """Give the people who judged a cell, if it is a whole property."""
        return self.panels.get(cell.scope.name) if cell.subset == "all" else None

    def find_reliability(self, cell: Cell) -> Reliability | None:
        """Give the reliability of the human means on a cell, if it is a whole property."""
        panel = self.find_panel(cell)
        return panel.reliability if panel else None

    def find_crossfit(self, cell: Cell) -> CrossFit | None:
        """Give the cross-fitted subsets of a cell, if it is a whole property with single responses."""
        panel = self.find_panel(cell)
        return panel.crossfit if panel else None

    def resample_reliability(self, reliability: Reliability, cell: Cell) -> Floats:
        """Give a reliability on every resample, to first order; (n_resamples,)."""
        if isinstance(reliability.value, Undefined):
            raise TypeError(reliability.value.why)
        by_pair = cell.sum_by_pair(on_grid(reliability.trial_influence[None], INFLUENCE_BITS))
        n_people, n_trials = reliability.response_influence.shape
        persons = np.repeat(np.arange(n_people), n_trials)
        by_person = on_grid(gather_people(reliability.response_influence.ravel(), persons), INFLUENCE_BITS)
        moved: Floats = (by_pair @ cell.weights)[0] - by_pair.sum() + reliability.value
        if by_person.size:
            moved += by_person @ self.draw_people(cell)[1] - by_person.sum()
        return np.minimum(moved, 1, out=moved)

    def list_cells(self, covered: Booleans) -> list[Cell]:
        """List the subsets of the properties and scenarios that are wholly covered, in order.

        Overall is no cell, since its values are averaged from those of the properties.
        """
        scopes = [scope for scope in list_scopes(self.reference, covered) if scope.name != OVERALL]
        return [
            self._find_cell(scope, subset) for scope in scopes for subset in subsets_of(scope, self.masks)
        ]

    def _find_cell(self, scope: Scope, subset: str) -> Cell:
        key = (scope.name, subset)
        if key not in self._cells:
            mask = scope.mask & self.masks[subset]
            chosen, positions = _choose_rows(self.reference.pairs[mask])
            weights, small = self.draws.pairs[chosen], self.draws.small_pairs[chosen]
            self._cells[key] = Cell(
                scope, subset, mask, positions, weights, small, self._count(scope, subset)
            )
        return self._cells[key]

    def _count(self, scope: Scope, subset: str) -> dict[str, int]:
        mask, people = scope.mask & self.masks[subset], self.reference.people
        counts = {"n": int(mask.sum()), "n_pairs": _count_pairs(self.reference, mask)}
        counts["n_rated"] = int((people.n[mask] > 0).sum()) if people else 0
        if subset != "all":
            both = scope.mask & self.masks["easy"] & self.masks["hard"]
            counts["n_pairs_in_both"] = _count_pairs(self.reference, both)
        return counts

    def draw_people(self, cell: Cell) -> tuple[Integers, Floats]:
        """Find the people who judged a cell's property, and how often each is drawn.

        Returns
        -------
        people : (n_people,), weights : (n_people, n_resamples); empty where single responses are unknown
        """
        if self.draws.people is None or not cell.mask.any():
            return np.zeros(0, np.int64), np.zeros((0, self.draws.pairs.shape[1]))
        name = self.properties[int(self.reference.properties[np.argmax(cell.mask)])]
        if name not in self._people:
            people = self.panels[name].people
            self._people[name] = people, self.draws.people[people]
        return self._people[name]

    def draw_effects(self, cell: Cell, pulls: Sequence[Floats]) -> Floats:
        """Sum what drawn people add to metrics of a cell: their pull times how often they are drawn, less 1.

        Parameters
        ----------
        pulls : n_metrics of (at most n_participants,)
            Derivatives by the weight of each person, as far as there are any.

        Returns
        -------
        (n_metrics, n_resamples), 0 where single responses are unknown
        """
        people, weights = self.draw_people(cell)
        stacked = np.zeros((len(pulls), int(people.max(initial=-1)) + 1))
        for row, pull in zip(stacked, pulls, strict=True):
            row[: pull.size] = pull
        chosen = on_grid(stacked[:, people], INFLUENCE_BITS)
        effects: Floats = chosen @ weights - chosen.sum(axis=1, keepdims=True)
        return effects


def subsets_of(scope: Scope, masks: dict[str, Booleans]) -> tuple[str, ...]:
    """Name the subsets that are scored in a scope: scenarios have only all."""
    return ("all",) if scope.kind == "scenario" else tuple(name for name in SUBSETS if name in masks)


def _choose_rows(pairs: Integers) -> tuple[slice | Integers, Integers]:
    """Choose the rows of some pairs' weights and say where each pair is among them.

    Where pairs lie close together the rows are a slice, which needs no copy, with some others in between.
    """
    different, positions = np.unique(pairs, return_inverse=True)
    if different.size and 2 * different.size > different[-1] - different[0]:
        return slice(different[0], different[-1] + 1), pairs - different[0]
    return different, positions


def _count_pairs(reference: Reference, mask: Booleans) -> int:
    """Count the pairs with both members; a trial with a pair id of its own is no pair."""
    return len(find_pairs(reference.pairs[mask]))
