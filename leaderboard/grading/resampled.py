"""Metrics on every resample at once, from weighted sums over the drawn pairs."""

from collections.abc import Callable, Mapping

import numpy as np

from leaderboard.grading.sums import Sums, about_means, spread
from leaderboard.metrics.accuracy import Floats


def limit(values: Floats, low: float, high: float) -> Floats:
    """Clip in place, NaN staying what it is."""
    np.maximum(values, low, out=values)
    return np.minimum(values, high, out=values)


def correlate(xx: Floats, zz: Floats, xz: Floats) -> Floats:
    """Correlate from sums of squares and products about the means; NaN where one side does not vary.

    Parameters
    ----------
    xx, zz : (n_resamples,)
        From ``spread``.
    xz : (n_resamples,)
    """
    r = xx * zz
    np.sqrt(r, out=r)
    return limit(np.divide(xz, r, out=r), -1, 1)


def human_r(s: Sums) -> Floats:
    """Pearson's r on each resample."""
    n, x, z = s["n_rated"], s["x_0"] + s["x_1"], s["z"]
    return correlate(spread(s["xx"], (x, n)), s["zz"], about_means(s["xz"], (x, z, n)))


def human_r_partial(s: Sums) -> Floats:
    """The same with both centred within each label."""
    x, z, n = ([s[f"{name}_{label}"] for label in "01"] for name in ("x", "z", "n"))
    products = about_means(s["xz"], *zip(x, z, n, strict=True))
    return correlate(spread(s["xx"], *zip(x, n, strict=True)), s["zz_within"], products)


def human_gap(s: Sums) -> Floats:
    """Accuracy minus people's on each resample."""
    gap = s.get("rated_credit", s["credit"]) - s["human_right"]
    return np.divide(gap, s["rated"], out=gap)


Resample = Callable[[Sums], Floats]

RESAMPLED: Mapping[str, Resample] = {
    "accuracy": lambda s: s["credit"] / s["n"],
    "human_r": human_r,
    "human_r_partial": human_r_partial,
    "human_rmse": lambda s: np.sqrt(s["distance"] / s["rated"]),
    "pair_accuracy": lambda s: s["both_right"] / s["n_pairs"],
    "pair_order": lambda s: s["in_order"] / s["n_opposite"],
    "auc": lambda s: s["outranked"] / s["orders"],
    "brier": lambda s: s["squared_error"] / s["n"],
    "ece": lambda s: limit(s["label_excess"] / s["n"], 0, 1),
    "human_ece": lambda s: s["people_excess"] / s["rated"],
    "yes_rate": lambda s: s["answer"] / s["n"],
    "human_gap": human_gap,
}
"""How a metric is computed from the sums, 0 / 0 being NaN; kappas are their value plus what is drawn."""
