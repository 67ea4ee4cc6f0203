"""Sums over the drawn pairs, and what is made of them."""

from collections.abc import Mapping, Sequence

import numpy as np

from leaderboard.grading.cells import Cell
from leaderboard.grading.draws import Weights
from leaderboard.metrics.accuracy import Floats

ROUNDING = 1e-12
"""A spread this small beside the sum of squares is what rounding leaves of none."""

Columns = Mapping[str, Floats]
Sums = Mapping[str, Floats]


def sum_columns(cells: Sequence[Cell], tables: Sequence[Columns]) -> list[dict[str, Floats]]:
    """Sum columns over the drawn pairs, in few matrix products: one of few rows takes as long as one of more.

    Parameters
    ----------
    cells
        All of one property.
    tables : n_cells dicts of (n_cell_trials,)
        On a grid, so that the sums are exact and do not depend on the order of addition.

    Returns
    -------
    n_cells dicts of (n_resamples,)
    """
    return _multiply(cells, tables, cells[0].drawn.weights) if cells else []


def sum_halves(cells: Sequence[Cell], tables: Sequence[Columns]) -> list[dict[str, Floats]]:
    """Do the same with multiples of 1/4, in float32 where that is exact."""
    return _multiply(cells, tables, cells[0].drawn.small) if cells else []


def share(part: Floats, whole: Floats) -> Floats:
    """Divide; NaN where nothing was drawn."""
    with np.errstate(invalid="ignore"):  # 0 / 0
        shares: Floats = part / whole
    return shares


def about_means(total: Floats, *groups: tuple[Floats, Floats, Floats]) -> Floats:
    """Centre a sum of products: total less the sums of either factor, multiplied and divided by n.

    Parameters
    ----------
    total : (n_resamples,)
    groups
        The sums of both factors and n, for every group of trials with a mean of its own.
    """
    for x, z, n in groups:
        product = x * z
        product /= n
        total = np.subtract(total, product, out=product)
    return total


def spread(squares: Floats, *groups: tuple[Floats, Floats]) -> Floats:
    """Centre a sum of squares; NaN where what is left is but rounding, so that nothing varies."""
    about = about_means(squares, *((x, x, n) for x, n in groups))
    about[about <= ROUNDING * squares] = np.nan
    return about


def _multiply(cells: Sequence[Cell], tables: Sequence[Columns], weights: Weights) -> list[dict[str, Floats]]:
    """Multiply columns by weights, in their precision; one product for the cells of each span of pairs."""
    sums: list[dict[str, Floats]] = [{} for _ in cells]
    spans: dict[tuple[int, int], list[int]] = {}
    for number, (cell, table) in enumerate(zip(cells, tables, strict=True)):
        if table:
            spans.setdefault(cell.span, []).append(number)
    for (start, stop), numbers in spans.items():
        pairs = [cells[i].sum_by_pair(np.array(list(tables[i].values())))[:, start:stop] for i in numbers]
        rows = iter(np.concatenate(pairs, dtype=weights.dtype) @ weights[start:stop])
        for number in numbers:
            sums[number] = {name: next(rows) for name in tables[number]}
    return sums
