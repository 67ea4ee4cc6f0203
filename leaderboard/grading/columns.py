"""Trial by trial what is summed over the drawn pairs, on grids on which the sums are exact."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from leaderboard.grading.cells import Cell
from leaderboard.grading.observations import Ground, Observations
from leaderboard.grading.sums import Sums, spread, sum_columns, sum_halves
from leaderboard.metrics import agreement, calibration
from leaderboard.metrics.accuracy import Floats, Integers, right_counts
from leaderboard.metrics.resampling import INFLUENCE_BITS, on_grid


def share_sums(cells: Sequence[Cell]) -> None:
    """Sum what depends on the reference alone, and compute what follows from these sums.

    Parameters
    ----------
    cells
        All of one property.
    """
    grounds = [cell.ground for cell in cells]
    fine = sum_columns(cells, [_tabulate_people(ground) for ground in grounds])
    whole = sum_halves(cells, [_tabulate_counts(ground) for ground in grounds])
    for cell, of_fine, of_whole in zip(cells, fine, whole, strict=True):
        s = {name: total.astype(np.float64) for name, total in of_whole.items()}
        s.setdefault("n_opposite", s["n_pairs"])
        cell.shared_sums.update(of_fine | s | {"orders": s["n_yes"] * (s["n"] - s["n_yes"])})
        if of_fine:
            cell.shared_sums.update(_derive_people(cell.shared_sums))


def _derive_people(s: Sums) -> dict[str, Floats]:
    """Compute what correlations with people's means need: numbers, at least 1, and centred squares."""
    rated_0, rated_1 = s.get("rated_0", s["n"] - s["n_yes"]), s.get("rated_1", s["n_yes"])
    rated, z = rated_0 + rated_1, s["z_0"] + s["z_1"]
    n_0, n_1, n_rated = (np.maximum(n, 1) for n in (rated_0, rated_1, rated))
    squares = {
        "zz": spread(s["zz"], (z, n_rated)),
        "zz_within": spread(s["zz"], (s["z_0"], n_0), (s["z_1"], n_1)),
    }
    return {"n_0": n_0, "n_1": n_1, "n_rated": n_rated, "rated": rated, "z": z, **squares}


def _tabulate_counts(ground: Ground) -> dict[str, Floats]:
    """Lay out, trial by trial, what the reference counts; a pair counts at its first member.

    Where all pairs have opposite labels, or people judged all trials, these are no columns of their own.
    """
    columns = {"n": np.ones(ground.labels.size), "n_yes": ground.labels.astype(np.float64)}
    columns["n_pairs"] = _at_first(ground.members, 1, ground)
    if len(ground.opposites) < len(ground.members):
        columns["n_opposite"] = _at_first(ground.opposites, 1, ground)
    if ground.n is not None and not ground.rated.all():
        columns |= {f"rated_{label}": is_in.astype(np.float64) for label, is_in in ground.by_label.items()}
    return columns


def _tabulate_people(ground: Ground) -> dict[str, Floats]:
    """Lay out people's means and how often they were right."""
    if ground.n is None or ground.n_yes is None:
        return {}
    z, right = ground.scaled_means, right_counts(ground.n, ground.n_yes, ground.labels)
    return {
        **{f"z_{label}": np.where(is_in, z, 0) for label, is_in in ground.by_label.items()},
        "zz": np.where(ground.rated, z * z, 0),
        "human_right": on_grid(right / np.maximum(ground.n, 1), INFLUENCE_BITS),
    }


def tabulate_halves(o: Observations) -> dict[str, Floats]:
    """Lay out the multiples of 1/4, of which sums are exact in float32.

    Where people judged all trials, the credit of rated ones is no column of its own.
    """
    in_order = (1 + np.sign(np.subtract(*o.probabilities[o.opposites].T))) / 2
    columns = {
        "credit": o.credits,
        "answer": agreement.answers_of(o.probabilities),
        "both_right": _at_first(o.members, o.credits[o.members].prod(axis=1), o),
        "in_order": _at_first(o.opposites, in_order, o),
    }
    return columns if o.rated.all() else columns | {"rated_credit": np.where(o.rated, o.credits, 0)}


def _at_first(members: NDArray[np.intp], values: Floats | int, ground: Ground) -> Floats:
    """Give each pair's value to its first member, and 0 to all other trials."""
    column = np.zeros(ground.labels.size)
    column[members[:, 0]] = values
    return column


def tabulate_fine(o: Observations) -> dict[str, Floats]:
    """Lay out what probabilities enter; those behind correlations are centred and scaled."""
    q = on_grid(o.probabilities)
    bins = calibration.find_bins(o.probabilities)
    columns = {"squared_error": (q - o.labels) ** 2, "label_excess": _sign(q - o.labels, bins)}
    if o.n is None:
        return columns
    x = on_grid(o.standardize(o.probabilities))
    distances = np.where(o.rated, q - o.gridded_means, 0)
    return columns | {
        **{f"x_{label}": np.where(is_in, x, 0) for label, is_in in o.by_label.items()},
        "xx": np.where(o.rated, x * x, 0),
        "xz": np.where(o.rated, x * o.scaled_means, 0),
        "distance": distances**2,
        "people_excess": _sign(distances, bins),
    }


def _sign(excess: Floats, bins: Integers) -> Floats:
    """Give each trial's excess of P(YES) the sign of its calibration bin's.

    The sum is that of the bins' absolute excesses, with the signs of the data in every resample: absolute
    values of resamples would hold the noise of single trials twice and lie above that of the data.
    """
    signed: Floats = excess * np.sign(np.bincount(bins, excess, minlength=calibration.N_BINS))[bins]
    return signed
