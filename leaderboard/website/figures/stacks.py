"""Stacked bars: how a whole falls into parts, row by row, with the numbers beside the bar."""

from collections.abc import Sequence
from dataclasses import dataclass

from leaderboard.website.figures import palette
from leaderboard.website.figures.lettering import cut
from leaderboard.website.figures.marks import WIDTH, Box, Drawing, Numbers, Sketch, Text, tidy
from leaderboard.website.figures.palette import SMALL_SIZE, TEXT_SIZE, Ink

ROW_HEIGHT = 22
HEADER_HEIGHT = 30
LABEL_WIDTH = 92.0
COLUMN_WIDTH = 38.0
GAP = 8.0
BAR_HEIGHT = 12.0
SWATCH = 10.0

INKS: tuple[Ink, ...] = (palette.FULL_BAR, palette.BAR, palette.EMPTY_BAR, palette.PEOPLE_BAR)
"""Of the first part, the second and so on: ever less of one colour, then another."""


@dataclass(frozen=True)
class StackRow:
    """A whole and the sizes of its parts; ``level`` 0 stands out."""

    title: str
    level: int
    sizes: tuple[int, ...]


@dataclass(frozen=True)
class Stack:
    """What stacked bars are to show; ``parts`` are the names of the parts, in one or two words."""

    key: str
    title: str
    caption: str
    unit: str
    parts: tuple[str, ...]
    rows: tuple[StackRow, ...]
    warning: str = ""


def draw_stack(stack: Stack) -> Drawing:
    """Compute where everything of stacked bars is."""
    sketch = Sketch(bottom=HEADER_HEIGHT)
    ends = [WIDTH - COLUMN_WIDTH * (len(stack.parts) - 1 - index) for index in range(len(stack.parts))]
    bar_end = ends[0] - COLUMN_WIDTH if ends else WIDTH
    for part, end, ink in zip(stack.parts, ends, INKS, strict=False):
        sketch.add(ink, Box(tidy(end - SWATCH - 1), 3, SWATCH, SWATCH))
        sketch.add(
            palette.SMALL_VALUE, Text(end, HEADER_HEIGHT - 4, cut(part, COLUMN_WIDTH, SMALL_SIZE), part)
        )
    for row in stack.rows:
        _draw_row(sketch, stack, row, (LABEL_WIDTH, bar_end), ends)
    sketch.bottom += 4
    sketch.warn(stack.warning)
    return sketch.finish(
        stack.key,
        stack.title,
        caption=stack.caption,
        description=_describe(stack),
        numbers=_list_numbers(stack),
    )


def _draw_row(
    sketch: Sketch, stack: Stack, row: StackRow, ends: tuple[float, float], columns: Sequence[float]
) -> None:
    y = sketch.bottom + ROW_HEIGHT / 2
    label = cut(row.title, LABEL_WIDTH - GAP, TEXT_SIZE)
    text, value = (palette.TEXT, palette.VALUE) if row.level else (palette.BOLD, palette.BOLD_VALUE)
    sketch.add(text, Text(0, y + 4, label, row.title if label != row.title else ""))
    left, total = ends[0], sum(row.sizes)
    for part, size, ink, column in zip(stack.parts, row.sizes, INKS, columns, strict=False):
        sketch.add(value, Text(column, y + 4, f"{size:,}"))
        if size:
            width = (ends[1] - ends[0]) * size / total
            title = f"{row.title}: {size:,} of {total:,} {stack.unit} {part}"
            sketch.add(ink, Box(tidy(left), y - BAR_HEIGHT / 2, tidy(width), BAR_HEIGHT, title))
            left += width
    sketch.bottom += ROW_HEIGHT


def _list_numbers(stack: Stack) -> Numbers:
    parts = {part: [row.sizes[number] for row in stack.rows] for number, part in enumerate(stack.parts)}
    return {"name": [row.title for row in stack.rows], **parts}


def _describe(stack: Stack) -> str:
    rows = [
        f"{row.title}: "
        + ", ".join(f"{size:,} {part}" for part, size in zip(stack.parts, row.sizes, strict=True))
        for row in stack.rows
    ]
    return f"{stack.title}. {'; '.join(rows)}. {stack.warning}".strip()
