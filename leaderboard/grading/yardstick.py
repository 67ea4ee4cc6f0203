"""What a reference gives to every grade, made once and used for all submissions."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import groupby
from typing import Self

import numpy as np

from leaderboard.grading.cells import Cell, DrawnPairs
from leaderboard.grading.crossfitted import CrossCell, cross_cells
from leaderboard.grading.draws import Draws, find_run
from leaderboard.grading.observations import Ground, lay_ground
from leaderboard.grading.panels import Panel, find_panels
from leaderboard.grading.scopes import SUBSETS, Scope, list_scopes, subset_masks
from leaderboard.metrics.accuracy import Booleans, Floats, Integers
from leaderboard.metrics.influence import gather_people
from leaderboard.metrics.pairs import find_pairs
from leaderboard.metrics.reliability import Reliability
from leaderboard.metrics.resampling import INFLUENCE_BITS, on_grid
from leaderboard.metrics.undefined import Undefined
from leaderboard.models.benchmark import OVERALL
from leaderboard.reference import Reference


@dataclass(frozen=True)
class Yardstick:
    """A reference with its resamples, its cells, and how well people agree with each other."""

    reference: Reference
    draws: Draws
    _cells: dict[tuple[str, str], Cell] = field(default_factory=dict, repr=False)
    _cross_cells: dict[tuple[str, str], tuple[CrossCell, ...]] = field(default_factory=dict, repr=False)
    _drawn: dict[int, DrawnPairs] = field(default_factory=dict, repr=False)
    _people: dict[str, tuple[Integers, Floats]] = field(default_factory=dict, repr=False)
    _ceilings: dict[tuple[str, str], Floats] = field(default_factory=dict, repr=False)

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

    def find_cross_cells(self, cell: Cell) -> tuple[CrossCell, ...]:
        """Give the cross-fitted subsets of a cell, if it is a whole property with single responses."""
        if cell.key not in self._cross_cells:
            panel = self.find_panel(cell)
            crossfit = panel.crossfit if panel else None
            self._cross_cells[cell.key] = cross_cells(cell, crossfit) if crossfit else ()
        return self._cross_cells[cell.key]

    def resample_reliability(self, reliability: Reliability, cell: Cell) -> Floats:
        """Give a reliability on every resample, to first order; (n_resamples,)."""
        if isinstance(reliability.value, Undefined):
            raise TypeError(reliability.value.why)
        by_pair = cell.sum_by_pair(on_grid(reliability.trial_influence[None], INFLUENCE_BITS))
        n_people, n_trials = reliability.response_influence.shape
        persons = np.repeat(np.arange(n_people), n_trials)
        by_person = on_grid(gather_people(reliability.response_influence.ravel(), persons), INFLUENCE_BITS)
        moved: Floats = (by_pair @ cell.drawn.weights)[0] - by_pair.sum() + reliability.value
        if by_person.size:
            moved += by_person @ self.draw_people(cell)[1]
        return np.minimum(moved, 1, out=moved)

    def resample_ceiling(self, cell: Cell) -> Floats | None:
        """Give the root of the reliability of the human means on every resample; NaN where there is none.

        None where the cell is no whole property, or people's reliability has no value there.
        """
        found = self.find_reliability(cell)
        if found is None or isinstance(found.value, Undefined):
            return None
        if cell.key not in self._ceilings:
            self._ceilings[cell.key] = root(self.resample_reliability(found, cell))
        return self._ceilings[cell.key]

    def list_cells(self, covered: Booleans) -> list[Cell]:
        """List the subsets of the properties and scenarios that are wholly covered, in order.

        Overall is no cell, since its values are averaged from those of the properties.
        """
        scopes = [scope for scope in list_scopes(self.reference, covered) if scope.name != OVERALL]
        return [
            self._find_cell(scope, subset) for scope in scopes for subset in subsets_of(scope, self.masks)
        ]

    def group_cells(self, covered: Booleans) -> list[list[Cell]]:
        """List the same, the cells of each property and of its scenarios together."""
        cells = self.list_cells(covered)
        return [list(group) for _, group in groupby(cells, key=lambda cell: self._find_property(cell.scope))]

    def _find_property(self, scope: Scope) -> int:
        """Number the property that a scope is or belongs to."""
        return int(self.reference.properties[np.argmax(scope.mask)])

    def _find_cell(self, scope: Scope, subset: str) -> Cell:
        key = (scope.name, subset)
        if key not in self._cells:
            mask = scope.mask & self.masks[subset]
            drawn, ground = self._draw_pairs(scope), self._ground.select(mask)
            self._cells[key] = Cell(scope, subset, mask, ground, drawn, self._count(scope, subset))
        return self._cells[key]

    @cached_property
    def _ground(self) -> Ground:
        return lay_ground(self.reference)

    def _draw_pairs(self, scope: Scope) -> DrawnPairs:
        """Give the drawn pairs of the property that a scope is or belongs to."""
        number = self._find_property(scope)
        if number not in self._drawn:
            rows = np.unique(self.reference.pairs[self.reference.properties == number])
            self._drawn[number] = DrawnPairs.of(self.draws, rows)
        return self._drawn[number]

    def _count(self, scope: Scope, subset: str) -> dict[str, int]:
        mask, people = scope.mask & self.masks[subset], self.reference.people
        counts = {"n": int(mask.sum()), "n_pairs": _count_pairs(self.reference, mask)}
        counts["n_rated"] = int((people.n[mask] > 0).sum()) if people else 0
        if subset != "all":
            both = scope.mask & self.masks["easy"] & self.masks["hard"]
            counts["n_pairs_in_both"] = _count_pairs(self.reference, both)
        return counts

    def draw_people(self, cell: Cell) -> tuple[Integers, Floats]:
        """Find the people who judged a cell's property, and how often each is drawn, less 1.

        Returns
        -------
        people : (n_people,), weights : (n_people, n_resamples); empty where single responses are unknown
        """
        further = self.draws.further_people
        if further is None or not cell.mask.any():
            return np.zeros(0, np.int64), np.zeros((0, self.draws.pairs.shape[1]))
        name = self.properties[self._find_property(cell.scope)]
        if name not in self._people:
            people = self.panels[name].people
            self._people[name] = people, further[find_run(people)]
        return self._people[name]

    def draw_effects(self, cell: Cell, pulls: Sequence[Floats]) -> Floats:
        """Sum what drawn people add to metrics: their pull times how often they are drawn, less 1.

        Parameters
        ----------
        cell
            That of the metrics, or one of several of the same property, none of them empty.
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
        effects: Floats = on_grid(stacked[:, people], INFLUENCE_BITS) @ weights
        return effects


def root(reliability: Floats) -> Floats:
    """Take square roots; NaN where there is none, since the reliability is not above 0."""
    roots: Floats = np.sqrt(np.where(reliability > 0, reliability, np.nan))
    return roots


def subsets_of(scope: Scope, masks: dict[str, Booleans]) -> tuple[str, ...]:
    """Name the subsets that are scored in a scope: scenarios have only all."""
    return ("all",) if scope.kind == "scenario" else tuple(name for name in SUBSETS if name in masks)


def _count_pairs(reference: Reference, mask: Booleans) -> int:
    """Count the pairs with both members; a trial with a pair id of its own is no pair."""
    return len(find_pairs(reference.pairs[mask]))
