"""Boards of many rows: pages of 200 for readers without a script, and for the script the rest as data."""

from dataclasses import replace

from leaderboard.files import sha256_hex
from leaderboard.website.board_pages import BoardPage, BoardRow, BoardSection
from leaderboard.website.board_rows import render_rows
from leaderboard.website.pages import DataFile, Link
from leaderboard.website.rendering import N_HASH_DIGITS

ROWS_A_PAGE = 200
"""As many as a browser still sorts at once."""


def split_board(page: BoardPage, track_id: str) -> tuple[BoardPage, ...]:
    """Split a board into pages of at most 200 ranked rows; the first has all that is not ranked as well."""
    ranked = [row for section in page.sections if section.kind == "ranked" for row in section.rows]
    if len(ranked) <= ROWS_A_PAGE:
        return (page,)
    starts = range(0, len(ranked), ROWS_A_PAGE)
    links = tuple(_link_part(page, track_id, start, len(ranked)) for start in starts)
    pages = [_lead(page, links, track_id, ranked)]
    for link, start in zip(links[1:], starts[1:], strict=True):
        pages.append(_follow(page, links, link, tuple(ranked[start : start + ROWS_A_PAGE])))
    return tuple(pages)


def _link_part(page: BoardPage, track_id: str, start: int, n: int) -> Link:
    number = start // ROWS_A_PAGE + 1
    path = page.path if number == 1 else f"tracks/{track_id}/page-{number}.html"
    return Link(f"rows {start + 1:,} to {min(start + ROWS_A_PAGE, n):,}", path)


def _lead(page: BoardPage, links: tuple[Link, ...], track_id: str, ranked: list[BoardRow]) -> BoardPage:
    content = render_rows(page, ranked[ROWS_A_PAGE:])
    name = f"{track_id}.{sha256_hex(content)[:N_HASH_DIGITS]}.js"
    sections = (
        replace(section, rows=section.rows[:ROWS_A_PAGE]) if section.kind == "ranked" else section
        for section in page.sections
    )
    parts = _mark(links, links[0])
    return replace(page, sections=tuple(sections), parts=parts, rest=DataFile(f"data/{name}", content))


def _follow(page: BoardPage, links: tuple[Link, ...], link: Link, rows: tuple[BoardRow, ...]) -> BoardPage:
    return replace(
        page,
        path=link.target,
        title=f"{page.title}, {link.title}",
        sections=(BoardSection("ranked", "", rows),),
        drawings=(),
        pairs=(),
        parts=_mark(links, link),
        is_first=False,
    )


def _mark(links: tuple[Link, ...], current: Link) -> tuple[Link, ...]:
    return tuple(replace(link, is_current=link is current) for link in links)
