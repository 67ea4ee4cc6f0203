"""The square that probabilities are drawn in: percent on both axes."""

from leaderboard.website.figures import palette
from leaderboard.website.figures.marks import WIDTH, Line, Sketch, Text
from leaderboard.website.figures.scales import Scale

AXIS_LEFT, AXIS_RIGHT = 34.0, 310.0
TICKS = (0, 0.25, 0.5, 0.75, 1)


def square_scales(top: float, bottom: float) -> tuple[Scale, Scale]:
    """Lay shares from 0 to 1 across the figure, and upward between two heights."""
    return Scale(0, 1, AXIS_LEFT, AXIS_RIGHT), Scale(0, 1, bottom, top)


def draw_square(sketch: Sketch, scales: tuple[Scale, Scale], titles: tuple[str, str]) -> None:
    """Draw grid, numbers and titles of the axes, across and upward, and move to below them."""
    across, upward = scales
    top, bottom = upward.end, upward.start
    for tick in TICKS:
        x, y = across.place(tick), upward.place(tick)
        sketch.add(palette.GRID, Line(x, top, x, bottom), Line(across.start, y, across.end, y))
        sketch.add(palette.TICK, Text(x, bottom + 13, f"{100 * tick:g}"))
        sketch.add(palette.SMALL_VALUE, Text(across.start - 5, y + 4, f"{100 * tick:g}"))
    sketch.add(palette.SMALL, Text(0, top - 9, titles[1]))
    sketch.add(palette.SMALL_VALUE, Text(WIDTH, bottom + 27, titles[0]))
    sketch.bottom = bottom + 32
