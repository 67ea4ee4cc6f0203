"""Metrics on every resample at once, from weighted sums over the drawn pairs."""

from collections.abc import Callable, Mapping

import numpy as np

from leaderboard.grading.draws import Weights
from leaderboard.grading.observations import Observations
from leaderboard.grading.yardstick import Cell
from leaderboard.metrics import agreement, calibration
from leaderboard.metrics.accuracy import Booleans, Floats, right_counts
from leaderboard.metrics.pairs import find_opposite_pairs, find_pairs
from leaderboard.metrics.resampling import INFLUENCE_BITS, on_grid

ROUNDING = 1e-12
"""A spread this small beside the sum of squares is what rounding leaves of none."""

Sums = Mapping[str, Floats]


def sum_resamples(o: Observations, cell: Cell, extra: Mapping[str, Floats]) -> dict[str, Floats]:
    """Sum over the drawn pairs whatever the metrics of a cell are computed from.

    Every column is on a grid, so the sums are exact and do not depend on the order of addition. What does not
    depend on the submission is summed once for all of them; halves and quarters are summed as float32.

    Parameters
    ----------
    extra : dict of (n_trials,)
        More to be summed.

    Returns
    -------
    dict of (n_resamples,)
    """
    if not cell.shared_sums:
        cell.shared_sums.update(_sum(_tabulate_reference(o), cell, cell.weights))
    halves = _sum(_tabulate_halves(o), cell, cell.small_weights)
    fine = _tabulate_fine(o) | {name: on_grid(column, INFLUENCE_BITS) for name, column in extra.items()}
    return {
        **cell.shared_sums,
        **halves,
        **_sum(fine, cell, cell.weights),
        "outranked": _count_outranked(o, cell),
    }


def _sum(columns: Mapping[str, Floats], cell: Cell, weights: Weights) -> dict[str, Floats]:
    """Sum columns over the drawn pairs, in the precision of the weights."""
    if not columns:
        return {}
    by_pair = cell.sum_by_pair(np.array(list(columns.values()))).astype(weights.dtype, copy=False)
    return dict(zip(columns, (by_pair @ weights).astype(np.float64, copy=False), strict=True))


def _tabulate_reference(o: Observations) -> dict[str, Floats]:
    """Lay out, trial by trial, what depends on the reference alone; a pair counts at its first member."""
    columns = {"n": np.ones(o.labels.size), "n_yes": o.labels.astype(np.float64)}
    for name, members in (
        ("n_pairs", find_pairs(o.pairs)),
        ("n_opposite", find_opposite_pairs(o.pairs, o.labels)),
    ):
        columns[name] = np.zeros(o.labels.size)
        columns[name][members[:, 0]] = 1
    if o.n is None or o.n_yes is None:
        return columns
    share, z = np.maximum(o.n, 1), _scaled_means(o)
    for label, is_in in _by_label(o).items():
        columns |= {f"rated_{label}": is_in.astype(np.float64), f"z_{label}": np.where(is_in, z, 0)}
    right = on_grid(right_counts(o.n, o.n_yes, o.labels) / share, INFLUENCE_BITS)
    return columns | {"zz": np.where(o.rated, z * z, 0), "human_right": right}


def _tabulate_halves(o: Observations) -> dict[str, Floats]:
    """Lay out the multiples of 1/4, of which sums are exact in float32."""
    columns = {"credit": o.credits, "answer": agreement.answers_of(o.probabilities)}
    members = find_pairs(o.pairs)
    columns["both_right"] = np.zeros(o.labels.size)
    columns["both_right"][members[:, 0]] = o.credits[members].prod(axis=1)
    members = find_opposite_pairs(o.pairs, o.labels)
    columns["in_order"] = np.zeros(o.labels.size)
    columns["in_order"][members[:, 0]] = (1 + np.sign(np.subtract(*o.probabilities[members].T))) / 2
    return columns | {"rated_credit": np.where(o.rated, o.credits, 0)}


def _tabulate_fine(o: Observations) -> dict[str, Floats]:
    """Lay out what probabilities enter; those behind correlations are centred and scaled."""
    q = on_grid(o.probabilities)
    columns = {
        "squared_error": (q - o.labels) ** 2,
        "label_excess": _excess(q - o.labels, o.probabilities),
    }
    if o.n is None or o.n_yes is None:
        return columns
    h, z = on_grid(o.n_yes / np.maximum(o.n, 1)), _scaled_means(o)
    x = on_grid(_standardize(o.probabilities, o.rated))
    return columns | {
        **{f"x_{label}": np.where(is_in, x, 0) for label, is_in in _by_label(o).items()},
        "xx": np.where(o.rated, x * x, 0),
        "xz": np.where(o.rated, x * z, 0),
        "distance": np.where(o.rated, (q - h) ** 2, 0),
        "people_excess": _excess(np.where(o.rated, q - h, 0), o.probabilities),
    }


def _by_label(o: Observations) -> dict[int, Booleans]:
    return {label: o.rated & (o.labels == label) for label in (0, 1)}


def _scaled_means(o: Observations) -> Floats:
    """Human means, centred and scaled on the grid."""
    if o.n is None or o.n_yes is None:
        return np.zeros(o.labels.size)
    return on_grid(_standardize(o.n_yes / np.maximum(o.n, 1), o.rated))


def _standardize(values: Floats, rated: Booleans) -> Floats:
    """Centre and scale to at most 1, which no correlation notices, so that the grid is fine enough."""
    if not rated.any():
        return np.zeros(values.size)
    centred: Floats = np.where(rated, values - values[rated].mean(), 0)
    return centred / (np.abs(centred).max() or 1)


def _excess(excess: Floats, probabilities: Floats) -> Floats:
    """Give each trial's excess of P(YES) the sign of its calibration bin's.

    The sum is that of the bins' absolute excesses, with the signs of the data in every resample: absolute
    values of resamples would hold the noise of single trials twice and lie above that of the data.
    """
    bins = calibration.find_bins(probabilities)
    signs = np.sign(np.bincount(bins, excess, minlength=calibration.N_BINS))
    signed: Floats = excess * signs[bins]
    return signed


def _count_outranked(o: Observations, cell: Cell) -> Floats:
    """Count, in each resample, the drawn YES and NO trials of which the YES trial has the higher P(YES).

    Ties count 1/2. With K[a, b] such counts between the YES trials of pair a and the NO trials of pair b this
    is the quadratic form w' K w, in whole numbers and halves.
    """
    yes, no = np.flatnonzero(o.labels == 1), np.flatnonzero(o.labels == 0)
    drawn = cell.small_weights
    pairs = np.arange(len(drawn))[:, None]
    outranks = (1 + np.sign(o.probabilities[yes][:, None] - o.probabilities[no])) / 2
    counts = (pairs == cell.positions[yes]).astype(drawn.dtype) @ outranks.astype(drawn.dtype)
    counts = counts @ (cell.positions[no][:, None] == pairs.T).astype(drawn.dtype)
    outranked: Floats = np.einsum("ab,ab->b", counts @ drawn, drawn).astype(np.float64)
    return outranked


def share(part: Floats, whole: Floats) -> Floats:
    """Divide; NaN where nothing was drawn."""
    with np.errstate(invalid="ignore"):  # 0 / 0
        shares: Floats = part / whole
    return shares


def correlate(moments: tuple[Floats, Floats, Floats], before: tuple[Floats, Floats]) -> Floats:
    """Correlate from sums of squares and products about the means; NaN where one side does not vary.

    Parameters
    ----------
    moments
        Centred sums of xx, zz and xz.
    before
        Sums of xx and zz before centring, beside which rounding is judged.
    """
    xx, zz, xz = moments
    varies = (xx > ROUNDING * before[0]) & (zz > ROUNDING * before[1])
    if varies.all():
        return np.clip(xz / np.sqrt(xx * zz), -1, 1)
    scale = np.sqrt(np.where(varies, xx * zz, 1))
    return np.where(varies, np.clip(xz / scale, -1, 1), np.nan)


def human_r(s: Sums) -> Floats:
    """Pearson's r on each resample."""
    n = np.maximum(s["rated_0"] + s["rated_1"], 1)
    x, z = s["x_0"] + s["x_1"], s["z_0"] + s["z_1"]
    return correlate((s["xx"] - x * x / n, s["zz"] - z * z / n, s["xz"] - x * z / n), (s["xx"], s["zz"]))


def human_r_partial(s: Sums) -> Floats:
    """The same with both centred within each label."""
    xx, zz, xz = s["xx"], s["zz"], s["xz"]
    for label in "01":
        n, x, z = np.maximum(s[f"rated_{label}"], 1), s[f"x_{label}"], s[f"z_{label}"]
        xx, zz, xz = xx - x * x / n, zz - z * z / n, xz - x * z / n
    return correlate((xx, zz, xz), (s["xx"], s["zz"]))


def rated(s: Sums) -> Floats:
    """Number of drawn trials that people judged."""
    return s["rated_0"] + s["rated_1"]


def auc(s: Sums) -> Floats:
    """Share of drawn YES and NO trials in the right order."""
    return share(s["outranked"], s["n_yes"] * (s["n"] - s["n_yes"]))


Resample = Callable[[Sums], Floats]

RESAMPLED: Mapping[str, Resample] = {
    "accuracy": lambda s: share(s["credit"], s["n"]),
    "human_r": human_r,
    "human_r_partial": human_r_partial,
    "human_rmse": lambda s: np.sqrt(share(s["distance"], rated(s))),
    "pair_accuracy": lambda s: share(s["both_right"], s["n_pairs"]),
    "pair_order": lambda s: share(s["in_order"], s["n_opposite"]),
    "auc": auc,
    "brier": lambda s: share(s["squared_error"], s["n"]),
    "ece": lambda s: np.clip(share(s["label_excess"], s["n"]), 0, 1),
    "human_ece": lambda s: share(s["people_excess"], rated(s)),
    "yes_rate": lambda s: share(s["answer"], s["n"]),
    "human_gap": lambda s: share(s["rated_credit"] - s["human_right"], rated(s)),
}
"""How a metric is computed from the sums; the kappas are their value plus the influence of what is drawn."""
