"""How a share is distributed over trials, as a cumulative curve: without bins, whose edges would matter."""

from dataclasses import dataclass

from leaderboard.website.describing import count_of
from leaderboard.website.figures import palette
from leaderboard.website.figures.marks import Drawing, Line, Point, Sketch, Steps, Text, tidy
from leaderboard.website.figures.squares import draw_square, square_scales
from leaderboard.website.numbers import show_percent

SIDE = (24.0, 224.0)
"""Top and bottom of the diagram."""


@dataclass(frozen=True)
class Threshold:
    """A line at a value: its words, how many trials lie to the left of it, and on which side they stand."""

    value: float
    words: str
    n_left: int
    side: int


@dataclass(frozen=True)
class Distribution:
    """What a cumulative curve is to show.

    Attributes
    ----------
    values
        The distinct shares, ascending, each with the number of trials that have it.
    thresholds
        Where trials count as something else.
    """

    key: str
    title: str
    caption: str
    axis: str
    values: tuple[tuple[float, int], ...]
    thresholds: tuple[Threshold, ...]
    statement: str
    warning: str = ""


def draw_distribution(distribution: Distribution) -> Drawing:
    """Compute where everything of a cumulative curve is."""
    sketch = Sketch()
    across, upward = scales = square_scales(*SIDE)
    draw_square(sketch, scales, (f"{distribution.axis}, %", "trials with at most that, %"))
    n_trials = sum(count for _, count in distribution.values)
    places, so_far = [(across.start, upward.start)], 0
    for value, count in distribution.values:
        so_far += count
        places.append((across.place(value), upward.place(so_far / n_trials)))
    sketch.add(palette.PEOPLE_LINE, Steps((*places, (across.end, upward.end))))
    for threshold in distribution.thresholds:
        x, y = across.place(threshold.value), upward.place(threshold.n_left / max(n_trials, 1))
        sketch.add(palette.REFERENCE_LINE, Line(x, upward.end, x, upward.start))
        ink = palette.REASON if threshold.side > 0 else palette.REASON_END
        height = upward.start - 8 if threshold.side > 0 else upward.end + 14  # where the curve is not
        sketch.add(ink, Text(tidy(x + 6 * threshold.side), height, threshold.words))
        title = (
            f"{count_of(threshold.n_left, 'trial')}, {show_percent(threshold.n_left / max(n_trials, 1))} %"
        )
        sketch.add(palette.PEOPLE_POINT, Point(x, y, "diamond", f"left of the line: {title}"))
    sketch.warn(distribution.warning)
    description = f"{distribution.title}. {distribution.statement} {distribution.warning}".strip()
    return sketch.finish(
        distribution.key,
        distribution.title,
        caption=distribution.caption,
        description=description,
        numbers={
            "share": [value for value, _ in distribution.values],
            "trials": [count for _, count in distribution.values],
        },
    )
