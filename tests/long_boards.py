"""A board of hundreds of rows, made of the rows of a small one instead of grading hundreds of submissions."""

from dataclasses import replace

import numpy as np

from leaderboard.website.board_pages import BoardPage, BoardRow, Traits
from leaderboard.website.boards import compose_board
from leaderboard.website.material import Material
from site_builders import HOSTILE_NAME

N_ROWS = 450
TRACK = "all"
FAMILIES = ("video", "vlm", "object-centric")
INPUTS = ("rgb", "rgb+masks")


def build_long_board(material: Material, n: int = N_ROWS) -> BoardPage:
    """Compose the first board with many ranked rows; each number is one of its column's, by lot."""
    page = compose_board(material.boards[0], material)
    (ranked,) = [section for section in page.sections if section.kind == "ranked"]
    rng = np.random.default_rng(21)
    rows = tuple(_vary(ranked.rows, index, rng) for index in range(n))
    sections = (replace(each, rows=rows) if each is ranked else each for each in page.sections)
    return replace(page, sections=tuple(sections))


def _vary(rows: tuple[BoardRow, ...], index: int, rng: np.random.Generator) -> BoardRow:
    """Names have two digits with others behind, so that their order is not that of the ranks."""
    row, family, inputs = rows[index % len(rows)], FAMILIES[index % 3], INPUTS[index % 2]
    place, date = 37 * index % 1000, f"2026-{index % 12 + 1:02d}-{index % 28 + 1:02d}"
    cells = zip(*(each.cells for each in rows), strict=True)
    return replace(
        row,
        slug=f"copy-{index:03d}",
        rank=str(index // 3 * 3 + 1),
        name=HOSTILE_NAME if index == N_ROWS - 1 else f"Copy {place:03d}",
        cells=tuple(column[rng.integers(len(column))] for column in cells),
        facts=(f"{family}, {inputs}", date),
        traits=Traits(place, family, inputs, date),
    )
