"""Boards of many rows: further pages without a script, and the rows in them as data for it."""

import json
from typing import Any

import pytest
from long_boards import N_ROWS, TRACK, build_long_board

from leaderboard.website.board_pages import BoardPage, BoardRow
from leaderboard.website.board_parts import ROWS_A_PAGE, split_board
from leaderboard.website.boards import compose_board
from leaderboard.website.material import Material
from leaderboard.website.numbers import show_exactly
from leaderboard.website.rendering import frame_of, render_page
from site_builders import parse_html


@pytest.fixture(scope="module")
def board(material: Material) -> BoardPage:
    return build_long_board(material)


@pytest.fixture(scope="module")
def parts(board: BoardPage) -> tuple[BoardPage, ...]:
    return split_board(board, TRACK)


@pytest.fixture(scope="module")
def data(parts: tuple[BoardPage, ...]) -> dict[str, Any]:
    """What the script assigns."""
    assert parts[0].rest is not None
    text = parts[0].rest.content.decode("ascii")
    found: dict[str, Any] = json.loads(text.removeprefix("var boardRows = ").removesuffix(";\n"))
    return found


def ranked_rows(page: BoardPage) -> tuple[BoardRow, ...]:
    return next(section.rows for section in page.sections if section.kind == "ranked")


def test_a_board_of_few_rows_is_one_page(material: Material) -> None:
    """Up to 200 ranked rows nothing is split, and no data is written."""
    page = compose_board(material.boards[0], material)
    assert split_board(page, TRACK) == (page,)
    full = build_long_board(material, ROWS_A_PAGE)
    assert split_board(full, TRACK) == (full,)
    assert page.rest is None


def test_every_row_stands_on_one_page(board: BoardPage, parts: tuple[BoardPage, ...]) -> None:
    """The parts together have the ranked rows once, in their order; the first one has all others."""
    assert [len(ranked_rows(part)) for part in parts] == [200, 200, 50]
    assert tuple(row for part in parts for row in ranked_rows(part)) == ranked_rows(board)
    kinds = [[section.kind for section in part.sections] for part in parts]
    assert kinds == [["people", "ranked", "partial", "baseline"], ["ranked"], ["ranked"]]


def test_parts_link_each_other(parts: tuple[BoardPage, ...]) -> None:
    """Each part links all of them by their rows and marks itself."""
    assert [part.path for part in parts] == ["index.html", "tracks/all/page-2.html", "tracks/all/page-3.html"]
    assert [part.title for part in parts[1:]] == ["With, rows 201 to 400", "With, rows 401 to 450"]
    for part in parts:
        assert [link.title for link in part.parts] == ["rows 1 to 200", "rows 201 to 400", "rows 401 to 450"]
        assert [link.target for link in part.parts] == [each.path for each in parts]
        assert [link.target for link in part.parts if link.is_current] == [part.path]


def test_only_the_first_part_has_scripts_and_figures(
    parts: tuple[BoardPage, ...], material: Material
) -> None:
    """Further pages are for readers without a script: no control and no figure is in them."""
    frame = frame_of(material.reference)
    pages = [parse_html(render_page("board.html", frame, part)) for part in parts]
    sources = [[script.get("src", "") for script in page.iter("script")] for page in pages]
    assert parts[0].rest is not None
    assert sources == [[parts[0].rest.path, *frame.scripts], [], []]
    assert [len(list(page.iter("figure"))) > 0 for page in pages] == [True, False, False]
    assert [part.has_controls for part in parts] == [True, False, False]


def test_the_data_is_named_by_its_content(parts: tuple[BoardPage, ...], material: Material) -> None:
    """Other rows have another name, the same rows the same bytes."""
    other = split_board(build_long_board(material, N_ROWS - 1), TRACK)[0].rest
    again = split_board(build_long_board(material), TRACK)[0].rest
    assert parts[0].rest == again
    assert other is not None
    assert again is not None
    assert other.path != again.path
    assert again.path.startswith("data/all.")


def test_the_data_holds_what_is_printed(board: BoardPage, data: dict[str, Any]) -> None:
    """Every text and every exact value of the other rows comes out of the columns as it went in."""
    texts = data["texts"]
    for index, row in enumerate(ranked_rows(board)[ROWS_A_PAGE:]):
        assert row.traits is not None
        assert data["rank"][index] == int(row.rank)
        assert data["place"][index] == row.traits.place
        for name in ("slug", "name", "ranks"):
            assert texts[data[name][index]] == getattr(row, name)
        for name in ("family", "inputs", "date"):
            assert texts[data[name][index]] == getattr(row.traits, name)
        for name in ("badges", "details", "facts"):
            assert tuple(texts[place] for place in data[name][index]) == getattr(row, name)
        for cell, column in zip(row.cells, data["cells"], strict=True):
            for name in ("text", "interval", "remark", "why"):
                assert texts[column[name][index] if name in column else 0] == getattr(cell, name)
            exact = [read_exactly(column.get(name), index) for name in ("value", "low", "high")]
            assert exact == [cell.exact, *(cell.ends or ("", ""))]
            counts = [column[name][index] if name in column else 0 for name in ("undefined", "note")]
            assert counts == [cell.n_undefined, cell.note]


def read_exactly(column: list[Any] | None, index: int) -> str:
    """Read a value as the script does."""
    value = None if column is None else column[index]
    return show_exactly(value / 1_000_000) if isinstance(value, int) else value or ""
