"""Scores on easy and hard trials that one half of the people chooses and the other half is measured on."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from leaderboard.grading.cells import Cell, Counts
from leaderboard.grading.observations import Observations
from leaderboard.grading.resampled import correlate
from leaderboard.grading.scopes import CROSSFIT_SUBSETS
from leaderboard.grading.sums import Sums, about_means, share, spread, sum_columns
from leaderboard.metrics.accuracy import Floats
from leaderboard.metrics.crossfit import CrossFit, CrossSubset, accuracy_on, human_accuracy_on, human_r_on
from leaderboard.metrics.resampling import on_grid
from leaderboard.metrics.undefined import Estimate, Undefined

BITS = 20
DECIMALS = 6


@dataclass(frozen=True)
class CrossCell:
    """The trials of a property as one cross-fitted subset weighs them.

    Attributes
    ----------
    name
        That of the subset.
    cell
        The whole property.
    weighed
        What the people chose, and how the others judged it.
    counts
        Mean numbers of trials and pairs, as in results.
    """

    name: str
    cell: Cell
    weighed: CrossSubset
    counts: Counts

    @property
    def key(self) -> tuple[str, str]:
        """Scope and subset by name."""
        return self.cell.scope.name, self.name

    @cached_property
    def columns(self) -> Mapping[str, Floats]:
        """What is weighed, trial by trial: first moments on a coarse grid, so that products stay exact."""
        subset = self.weighed
        return {
            "chosen": on_grid(subset.chosen),
            "rated": on_grid(subset.rated),
            "right": on_grid(subset.right_sum),
            "z": on_grid(subset.mean_sum),
            "zz": on_grid(subset.square_sum, 2 * BITS),
        }

    @cached_property
    def shared_sums(self) -> Sums:
        """Their sums over the drawn pairs, (n_resamples,), which all submissions share."""
        (s,) = sum_columns([self.cell], [self.columns])
        n = np.maximum(s["rated"], 2.0**-BITS)
        return s | {"n_rated": n, "zz": spread(s["zz"], (s["z"], n))}


def cross_cells(cell: Cell, crossfit: CrossFit) -> tuple[CrossCell, ...]:
    """Name both subsets, with the mean numbers of their trials and pairs."""
    both = round(crossfit.n_pairs_in_both, DECIMALS)
    subsets = zip(CROSSFIT_SUBSETS, (crossfit.easy, crossfit.hard), strict=True)
    return tuple(
        CrossCell(
            name,
            cell,
            subset,
            {
                "n": round(subset.n_trials, DECIMALS),
                "n_pairs": round(subset.n_pairs, DECIMALS),
                "n_rated": round(float(subset.rated.sum()), DECIMALS),
                "n_pairs_in_both": both,
            },
        )
        for name, subset in subsets
    )


@dataclass(frozen=True)
class CrossMeasured:
    """A submission on one cross-fitted subset.

    People and their halves stay as they are on every resample of pairs: drawn people could be in both halves
    at once, which would undo the separation.
    """

    cross: CrossCell
    observed: Observations

    @cached_property
    def estimates(self) -> dict[str, Estimate]:
        """The metrics on the trials of the property, weighted as they are chosen.

        ``human_gap`` is the accuracy of the submission minus that of the half that did not choose, both over
        the trials that this half rated.
        """
        o, subset = self.observed, self.cross.weighed
        people = human_accuracy_on(subset)
        gap: Estimate = people
        if not isinstance(people, Undefined):
            gap = float((subset.rated * o.credits).sum() / subset.rated.sum()) - people
        return {
            "accuracy": accuracy_on(subset, o.credits),
            "human_r": human_r_on(subset, o.probabilities),
            "human_gap": gap,
        }

    @property
    def columns(self) -> dict[str, Floats]:
        """What is summed over the drawn pairs, trial by trial."""
        o = self.observed
        chosen, rated, z = (self.cross.columns[name] for name in ("chosen", "rated", "z"))
        centred = o.probabilities - o.probabilities.mean()
        x = on_grid(centred / (np.abs(centred).max() or 1))
        return {
            "credit": chosen * o.credits,
            "rated_credit": rated * o.credits,
            "x": rated * x,
            "xx": on_grid(rated * on_grid(x * x), 2 * BITS),
            "xz": x * z,
        }

    def resample(self, sums: Sums) -> dict[str, Floats]:
        """Compute the defined metrics on every resample, from the sums of ``columns``; (n_resamples,)."""
        s = {**sums, **self.cross.shared_sums}
        values = self.estimates.items()
        return {name: RESAMPLED[name](s) for name, value in values if not isinstance(value, Undefined)}


def resample_people_crossfit(cross: CrossCell) -> Floats:
    """Compute people's accuracy on every resample of pairs."""
    columns = on_grid(np.array([cross.weighed.right_sum, cross.weighed.rated]), 2 * BITS)
    right, rated = cross.cell.sum_by_pair(columns) @ cross.cell.drawn.weights
    return share(right, rated)


def _human_r(s: Sums) -> Floats:
    x, z, n = s["x"], s["z"], s["n_rated"]
    return correlate(spread(s["xx"], (x, n)), s["zz"], about_means(s["xz"], (x, z, n)))


RESAMPLED: Mapping[str, Callable[[Sums], Floats]] = {
    "accuracy": lambda s: share(s["credit"], s["chosen"]),
    "human_r": _human_r,
    "human_gap": lambda s: share(s["rated_credit"] - s["right"], s["rated"]),
}
