"""The trials that one score is about, with how often their pairs are drawn."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from leaderboard.grading.draws import Draws, Weights, find_run
from leaderboard.grading.observations import Ground, Observations
from leaderboard.grading.scopes import Scope
from leaderboard.metrics.accuracy import Booleans, Floats, Integers
from leaderboard.metrics.undefined import Estimate

Counts = Mapping[str, int | float]
Unsigned = NDArray[np.unsignedinteger[Any]]


@dataclass(frozen=True)
class DrawnPairs:
    """How often the pairs of a property are drawn; its cells and those of its scenarios share it.

    Attributes
    ----------
    rows : (n_pairs,)
        Which pairs of the reference, ascending.
    weights, small, whole : (n_pairs, n_resamples)
        In float64, in float32 for what is exact in it, and as whole numbers; not copied where the pairs
        follow each other.
    """

    rows: Integers
    weights: Floats
    small: Weights
    whole: Unsigned

    @classmethod
    def of(cls, draws: Draws, rows: Integers) -> Self:
        """Take the weights of some pairs."""
        chosen = find_run(rows)
        return cls(rows, draws.pairs[chosen], draws.small_pairs[chosen], draws.whole_pairs[chosen])


@dataclass(frozen=True)
class Cell:
    """The trials of one subset of one scope, and how often the pairs of their property are drawn.

    Attributes
    ----------
    scope, subset
        Which.
    mask : (n_trials,)
        The trials, among all of the reference.
    ground
        What the reference knows of them.
    drawn
        How often pairs are drawn; also those that no trial of the cell is in.
    counts
        Numbers of trials, pairs and rated trials, as in results.
    shared_sums : dict of (n_resamples,)
        Sums over the drawn pairs that all submissions share, once they are computed.
    """

    scope: Scope
    subset: str
    mask: Booleans
    ground: Ground
    drawn: DrawnPairs
    counts: Counts
    shared_sums: dict[str, Floats] = field(default_factory=dict, repr=False)

    @property
    def key(self) -> tuple[str, str]:
        """Scope and subset by name."""
        return self.scope.name, self.subset

    def observe(self, whole: Observations, *, reliability: Estimate) -> Observations:
        """See a submission in the cell, with what was found out about the ground for those before it."""
        known = vars(self.ground) | {"reliability": reliability}
        seen = Observations(
            **{item.name: known[item.name] for item in fields(Ground)},
            probabilities=whole.probabilities[self.kept],
            credits=whole.credits[self.kept],
            answered=whole.answered[self.kept],
        )
        vars(seen).update(known)
        return seen

    @cached_property
    def kept(self) -> Integers:
        """Which trials of the reference are in the cell, shape (n_cell_trials,)."""
        return np.flatnonzero(self.mask)

    @cached_property
    def positions(self) -> Integers:
        """Which of the property's pairs each trial of the cell belongs to, shape (n_cell_trials,)."""
        return np.searchsorted(self.drawn.rows, self.ground.pairs)

    @cached_property
    def span(self) -> tuple[int, int]:
        """The first and last but one of the property's pairs that matter: of a scenario, its own."""
        ends = int(self.positions.min(initial=self.drawn.rows.size)), int(self.positions.max(initial=-1)) + 1
        return ends if 2 * (ends[1] - ends[0]) <= self.drawn.rows.size else (0, self.drawn.rows.size)

    @cached_property
    def whole_weights(self) -> Unsigned:
        """The weights as whole numbers, in a type that holds the number of pairs of drawn trials."""
        n_drawn = np.bincount(self.positions, minlength=self.drawn.rows.size) @ self.drawn.weights
        kind = np.promote_types(self.drawn.whole.dtype, np.min_scalar_type(int(n_drawn.max()) ** 2))
        return self.drawn.whole.astype(kind, copy=False)

    def sum_by_pair(self, columns: Floats) -> Floats:
        """Sum columns, (n_columns, n_cell_trials), within pairs; (n_columns, n_pairs)."""
        sums = np.zeros((len(columns), self.drawn.rows.size))
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
