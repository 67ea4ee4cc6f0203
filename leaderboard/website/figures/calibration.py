"""Reliability diagrams: submitted probabilities in bins against what happened, or what people said."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from leaderboard.models import Bin
from leaderboard.website.describing import count_of
from leaderboard.website.figures import palette
from leaderboard.website.figures.marks import Box, Drawing, Line, Numbers, Point, Shape, Sketch, Text, tidy
from leaderboard.website.figures.palette import Ink
from leaderboard.website.figures.scales import Scale
from leaderboard.website.figures.squares import draw_square, square_scales
from leaderboard.website.numbers import show_ends, show_percent

Interval = tuple[float, float] | None

COUNTS_HIGH = 30
MIN_WHISKER = 1
INKS: tuple[Ink, Ink, Shape] = (palette.POINT, palette.INTERVAL, "dot")
PEOPLE_INKS: tuple[Ink, Ink, Shape] = (palette.PEOPLE_POINT, palette.PEOPLE_INTERVAL, "diamond")
SIDE = (24.0, 224.0)
"""Top and bottom of the diagram."""


@dataclass(frozen=True)
class Diagram:
    """What a reliability diagram is to show.

    Attributes
    ----------
    intervals
        Of each bin the interval of its observed mean, or None.
    axis
        What stands upward.
    is_people
        Whether that is the share of people.
    """

    key: str
    title: str
    caption: str
    bins: tuple[Bin, ...]
    intervals: Sequence[Interval]
    axis: str
    warning: str = ""
    is_people: bool = False


def draw_diagram(diagram: Diagram) -> Drawing:
    """Compute where everything of a reliability diagram is."""
    sketch = Sketch()
    across, upward = scales = square_scales(*SIDE)
    draw_square(sketch, scales, ("submitted P(YES), %", f"{diagram.axis}, %"))
    sketch.add(palette.REFERENCE_LINE, Line(across.start, upward.start, across.end, upward.end))
    point, bar, shape = PEOPLE_INKS if diagram.is_people else INKS
    for predicted, observed, interval, words in _read_bins(diagram):
        x = across.place(predicted)
        if interval:
            top, bottom = upward.place(interval[1]), upward.place(interval[0])
            sketch.add(bar, Box(tidy(x - 3.5), top, 7, tidy(max(bottom - top, MIN_WHISKER))))
        sketch.add(point, Point(x, upward.place(observed), shape, words))
    _draw_counts(sketch, diagram, across)
    sketch.warn(diagram.warning)
    return sketch.finish(
        diagram.key,
        diagram.title,
        caption=diagram.caption,
        description=_describe(diagram),
        numbers=_list_numbers(diagram),
    )


def _draw_counts(sketch: Sketch, diagram: Diagram, across: Scale) -> None:
    """Draw below the diagram how many trials each bin holds."""
    floor = sketch.bottom + COUNTS_HIGH + 14
    most = max((bin_.n for bin_ in diagram.bins), default=0)
    width = (across.end - across.start) / max(len(diagram.bins), 1)
    for number, bin_ in enumerate(diagram.bins):
        left = across.start + number * width
        height = COUNTS_HIGH * bin_.n / most if most else 0
        if height:
            sketch.add(
                palette.COUNT_BAR, Box(tidy(left + 2), tidy(floor - height), tidy(width - 4), tidy(height))
            )
        sketch.add(palette.TICK, Text(tidy(left + width / 2), tidy(floor - height - 3), f"{bin_.n:,}"))
    sketch.add(palette.GRID, Line(across.start, floor, across.end, floor))
    sketch.add(palette.SMALL, Text(0, floor - 2, "trials"))
    sketch.bottom = floor + 4


def _read_bins(diagram: Diagram) -> Iterator[tuple[float, float, Interval, str]]:
    """Give both means of each bin that holds trials, the interval of the observed one, and all in words."""
    for bin_, interval in zip(diagram.bins, diagram.intervals, strict=True):
        if bin_.predicted is None or bin_.observed is None:
            continue
        sure = ""
        if interval:
            ends = show_ends(show_percent(interval[0]), show_percent(interval[1]))
            sure = f" (95 % interval {ends})"
        means = f"{show_percent(bin_.predicted)} % submitted, {show_percent(bin_.observed)} % observed{sure}"
        yield bin_.predicted, bin_.observed, interval, f"{means}, {count_of(bin_.n, 'trial')}"


def _list_numbers(diagram: Diagram) -> Numbers:
    bins, intervals = diagram.bins, [interval or (None, None) for interval in diagram.intervals]
    return {
        "bin": range(1, len(bins) + 1),
        "trials": [bin_.n for bin_ in bins],
        "submitted": [bin_.predicted for bin_ in bins],
        "observed": [bin_.observed for bin_ in bins],
        "low": [low for low, _ in intervals],
        "high": [high for _, high in intervals],
    }


def _describe(diagram: Diagram) -> str:
    readings = [words for _, _, _, words in _read_bins(diagram)]
    found = "; ".join(readings) + "." if readings else "no trials."
    return f"{diagram.title}. Mean probability and {diagram.axis} by bin: {found} {diagram.warning}".strip()
