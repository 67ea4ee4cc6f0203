"""From values to places along an axis."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import count
from math import ceil, floor, isfinite

from leaderboard.website.figures.marks import tidy

STEPS = (1, 2, 5)
MAX_STEPS = 6
SMALLEST_STEP = 0.05
"""So that a hair's breadth does not look like a difference."""

SLACK = 1e-9
"""What rounding may do to a value that lies at a tick."""


@dataclass(frozen=True)
class Scale:
    """An axis from ``low`` at the place ``start`` to ``high`` at the place ``end``.

    >>> Scale(0, 1, 100, 200).place(0.25)
    125
    """

    low: float
    high: float
    start: float
    end: float
    ticks: tuple[float, ...] = ()

    def place(self, value: float) -> float:
        """Find the place of a value; what lies beyond an end is placed at it."""
        inside = min(max(value, self.low), self.high)
        share = (inside - self.low) / (self.high - self.low)
        return tidy(self.start + share * (self.end - self.start))

    def beyond(self, value: float) -> int:
        """Tell on which side a value lies beyond the axis: -1, +1, or 0 where it is on it.

        >>> [Scale(0, 1, 0, 9).beyond(value) for value in (-0.1, 0.0, 1.1)]
        [-1, 0, 1]
        """
        return (value > self.high) - (value < self.low)


def fit_scale(values: Iterable[float], limits: tuple[float, float], start: float, end: float) -> Scale:
    """Choose the shortest axis with round ends that holds the values, as far as they lie within limits.

    Parameters
    ----------
    values
        What to show; without any the axis shows the limits, or 0 to 1 where these are infinite.
    limits
        What the axis never reaches beyond; may be infinite.

    Examples
    --------
    >>> fit_scale([0.52, 0.71], (0, 1), 0, 100).ticks
    (0.5, 0.55, 0.6, 0.65, 0.7, 0.75)
    """
    inside = [min(max(value, limits[0]), limits[1]) for value in values]
    if not inside:
        inside = [limit if isfinite(limit) else end for limit, end in zip(limits, (0, 1), strict=True)]
    low, high = min(inside), max(inside)
    steps = (factor * 10.0**exponent for exponent in count(-2) for factor in STEPS)
    step, first, last = next(
        fitted for fitted in (_span(low, high, step) for step in steps) if _is_calm(*fitted)
    )
    ticks = tuple(round(number * step, 9) for number in range(first, last + 1))
    return Scale(ticks[0], ticks[-1], start, end, ticks)


def _span(low: float, high: float, step: float) -> tuple[float, int, int]:
    """Count the steps from 0 to the ticks around some values; two more where these are one."""
    first, last = floor(low / step + SLACK), ceil(high / step - SLACK)
    return (step, first, last) if first < last else (step, first - 1, first + 1)


def _is_calm(step: float, first: int, last: int) -> bool:
    return step >= SMALLEST_STEP - SLACK and last - first <= MAX_STEPS
