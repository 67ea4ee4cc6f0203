"""Figures as files of their own: SVG in literal colours, PNG, and the numbers that they were drawn from."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import repeat
from pathlib import PurePosixPath

import numpy as np

from leaderboard.files import csv_text
from leaderboard.report.board import escape_formula
from leaderboard.website.figure_files import Export
from leaderboard.website.figures.lettering import wrap
from leaderboard.website.figures.marks import WIDTH, Drawing, Sketch, Text, tidy
from leaderboard.website.figures.palette import BOLD, HEADING, ON_THEIR_OWN, SMALL, Ink
from leaderboard.website.pages import Frame, Page
from leaderboard.website.rasterizing import FAMILIES, render_png
from leaderboard.website.rendering import environment

MARGIN = 16
GUTTER = 28
LEADING = 1.35
"""How far apart lines are, in sizes of their letters."""

ENLARGED, ENLARGED_ROW = 2, 1
"""How many pixels wide a unit is: figures on pages are as narrow as a telephone, several abreast are not."""

N_DECIMALS = 6
"""As many as results have."""

N_DIGITS = 12
"""How many digits of the reference's digest tell which one it is."""


@dataclass(frozen=True)
class Placed:
    """A drawing and its upper left corner."""

    x: float
    y: float
    drawing: Drawing


@dataclass(frozen=True)
class Picture:
    """Drawings that stand alone; ``around`` them are heading, titles, captions and origin.

    ``enlarged`` is how many pixels wide a unit is.
    """

    around: Drawing
    placed: tuple[Placed, ...]
    enlarged: float = ENLARGED


def render_figures(frame: Frame, pages: Iterable[Page]) -> Iterator[tuple[str, bytes]]:
    """Render all figures that can be had as files, each as its path in the site and its bytes."""
    for page in pages:
        folder = PurePosixPath(page.path).parent / page.figures_dir
        for export in page.exports:
            svg = render_svg(compose_picture(export, page.title, describe_origin(frame)))
            for ending in export.formats:
                yield f"{folder / export.name}.{ending}", _render(ending, svg, export)


def _render(ending: str, svg: str, export: Export) -> bytes:
    if ending == "csv":
        return render_numbers(export.drawings).encode()
    return render_png(svg) if ending == "png" else svg.encode()


def describe_origin(frame: Frame) -> str:
    """Say where a figure's numbers are from, which nothing but the figure itself tells where it is shown."""
    digest = frame.reference_digest[:N_DIGITS]
    reference = f"{frame.benchmark}, {frame.reference_kind} reference {digest}"
    return f"{reference}; grader {frame.grader}, metrics version {frame.metrics_version}."


def compose_picture(export: Export, heading: str, origin: str) -> Picture:
    """Compute where drawings lie below a heading, row by row, each below its title and caption."""
    drawings = export.drawings
    n_abreast = min(export.n_abreast, len(drawings))
    width = 2 * MARGIN + n_abreast * WIDTH + (n_abreast - 1) * GUTTER
    sketch, placed = Sketch(bottom=MARGIN), []
    write_words(sketch, HEADING, heading, (MARGIN, width - 2 * MARGIN))
    for first in range(0, len(drawings), n_abreast):
        row = _place_row(sketch, drawings[first : first + n_abreast])
        sketch.bottom = max(place.y + place.drawing.height for place in row) + SMALL.size
        placed += row
    write_words(sketch, SMALL, origin, (MARGIN, width - 2 * MARGIN))
    sketch.bottom += MARGIN
    around = sketch.finish(
        export.name,
        f"{heading}: {drawings[0].title}" if len(drawings) == 1 else heading,
        caption="",
        description=" ".join(drawing.description for drawing in drawings),
        numbers={},
    )
    enlarged = ENLARGED_ROW if n_abreast > 1 else ENLARGED
    return Picture(replace(around, width=width, palette=ON_THEIR_OWN), tuple(placed), enlarged)


def _place_row(sketch: Sketch, drawings: Sequence[Drawing]) -> list[Placed]:
    """Write titles and captions of drawings that stand abreast, and place these below the longest."""
    top, bottoms, lefts = sketch.bottom + SMALL.size / 2, [], []
    for number, drawing in enumerate(drawings):
        sketch.bottom, left = top, MARGIN + number * (WIDTH + GUTTER)
        write_words(sketch, BOLD, drawing.title, (left, WIDTH))
        write_words(sketch, SMALL, drawing.caption, (left, WIDTH))
        bottoms.append(sketch.bottom)
        lefts.append(left)
    y = tidy(max(bottoms) + SMALL.size)
    shown = (replace(drawing, palette=ON_THEIR_OWN) for drawing in drawings)
    return [Placed(left, y, drawing) for left, drawing in zip(lefts, shown, strict=True)]


def write_words(sketch: Sketch, ink: Ink, words: str, place: tuple[float, float]) -> None:
    """Write words from a left edge within a width, on as many lines as they take."""
    left, width = place
    for line in wrap(words, width, ink.size):
        sketch.bottom += LEADING * ink.size
        sketch.add(ink, Text(left, tidy(sketch.bottom - (LEADING - 1) * ink.size), line))


def render_svg(picture: Picture) -> str:
    """Render a picture as a file that needs no other."""
    template = environment().get_template("figure.svg")
    return template.render(picture=picture, families=FAMILIES)


def render_numbers(drawings: Sequence[Drawing]) -> str:
    """Render what drawings of one kind were drawn from as CSV, of several with the title of each.

    Text that a spreadsheet could run as a formula gets a leading apostrophe; numbers have six decimals.
    """
    titles = ["figure"] if len(drawings) > 1 else []
    return csv_text([*titles, *drawings[0].numbers], _list_rows(drawings))


def _list_rows(drawings: Sequence[Drawing]) -> Iterator[tuple[object, ...]]:
    for drawing in drawings:
        columns = [_show_column(values) for values in drawing.numbers.values()]
        titles = [repeat(escape_formula(drawing.title), len(columns[0]))] if len(drawings) > 1 else []
        yield from zip(*titles, *columns, strict=True)


def _show_column(values: Iterable[object]) -> list[object]:
    cells = values.tolist() if isinstance(values, np.ndarray) else list(values)
    return [_show_cell(cell) for cell in cells]


def _show_cell(cell: object) -> object:
    if isinstance(cell, str):
        return escape_formula(cell)
    return round(cell, N_DECIMALS) if isinstance(cell, float) else cell
