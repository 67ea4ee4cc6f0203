"""Scores on easy and hard trials that one half of the people chooses and the other half is measured on."""

from collections.abc import Mapping

import numpy as np

from leaderboard.grading.observations import Observations
from leaderboard.grading.resampled import correlate, share
from leaderboard.grading.scopes import CROSSFIT_SUBSETS
from leaderboard.grading.tally import Counts
from leaderboard.grading.yardstick import Cell
from leaderboard.metrics.accuracy import Floats
from leaderboard.metrics.crossfit import CrossFit, CrossSubset, accuracy_on, human_accuracy_on, human_r_on
from leaderboard.metrics.resampling import on_grid
from leaderboard.metrics.undefined import Estimate, Undefined

BITS = 20
DECIMALS = 6


def cross_subsets(crossfit: CrossFit) -> dict[str, tuple[CrossSubset, Counts]]:
    """Name both subsets, with the mean numbers of their trials and pairs."""
    both = round(crossfit.n_pairs_in_both, DECIMALS)
    subsets = dict(zip(CROSSFIT_SUBSETS, (crossfit.easy, crossfit.hard), strict=True))
    return {
        name: (
            subset,
            {
                "n": round(subset.n_trials, DECIMALS),
                "n_pairs": round(subset.n_pairs, DECIMALS),
                "n_rated": round(float(subset.rated.sum()), DECIMALS),
                "n_pairs_in_both": both,
            },
        )
        for name, subset in subsets.items()
    }


def estimate_crossfit(o: Observations, subset: CrossSubset) -> dict[str, Estimate]:
    """Compute the metrics of a submission on the trials of a property, weighted as they are chosen.

    ``human_gap`` is the accuracy of the submission minus that of the half that did not choose, both over the
    trials that this half rated.
    """
    people = human_accuracy_on(subset)
    gap: Estimate = people
    if not isinstance(people, Undefined):
        gap = float((subset.rated * o.credits).sum() / subset.rated.sum()) - people
    return {
        "accuracy": accuracy_on(subset, o.credits),
        "human_r": human_r_on(subset, o.probabilities),
        "human_gap": gap,
    }


def resample_crossfit(
    o: Observations, subset: CrossSubset, cell: Cell, estimates: Mapping[str, Estimate]
) -> dict[str, Floats]:
    """Compute the defined ones on every resample of pairs; the people and their halves stay as they are.

    Drawn people could be in both halves at once, which would undo the separation, so they are not drawn.
    """
    s = dict(zip(_COLUMNS, cell.sum_by_pair(_tabulate(o, subset)) @ cell.weights, strict=True))
    n = np.maximum(s["rated"], 2.0**-BITS)
    x, z = s["x"], s["z"]
    moments = (s["xx"] - x * x / n, s["zz"] - z * z / n, s["xz"] - x * z / n)
    resampled = {
        "accuracy": share(s["credit"], s["chosen"]),
        "human_r": correlate(moments, (s["xx"], s["zz"])),
        "human_gap": share(s["rated_credit"] - s["right"], s["rated"]),
    }
    return {name: resampled[name] for name, value in estimates.items() if not isinstance(value, Undefined)}


def resample_people_crossfit(subset: CrossSubset, cell: Cell) -> Floats:
    """Compute people's accuracy on every resample of pairs."""
    columns = on_grid(np.array([subset.right_sum, subset.rated]), 2 * BITS)
    right, rated = cell.sum_by_pair(columns) @ cell.weights
    return share(right, rated)


_COLUMNS = ("chosen", "credit", "rated", "rated_credit", "right", "x", "xx", "z", "zz", "xz")


def _tabulate(o: Observations, subset: CrossSubset) -> Floats:
    """Lay out the sums by trial: first moments on a coarse grid, so that products stay exact."""
    chosen, rated, means, right = (
        on_grid(values) for values in (subset.chosen, subset.rated, subset.mean_sum, subset.right_sum)
    )
    centred = o.probabilities - o.probabilities.mean()
    x = on_grid(centred / (np.abs(centred).max() or 1))
    squares = on_grid(subset.square_sum, 2 * BITS)
    xx = on_grid(rated * on_grid(x * x), 2 * BITS)
    return np.array(
        [
            chosen,
            chosen * o.credits,
            rated,
            rated * o.credits,
            right,
            rated * x,
            xx,
            means,
            squares,
            x * means,
        ]
    )
