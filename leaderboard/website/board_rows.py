"""Rows of a board as a script: column by column, whole numbers and places in a list of distinct texts."""

import json
from collections.abc import Sequence

from leaderboard.website.board_pages import BoardPage, BoardRow, Traits
from leaderboard.website.pages import Cell

N_DECIMALS = 6
MILLION = 10**N_DECIMALS
LARGEST = 2**53
"""Up to here a browser counts without a gap."""

Column = list[int] | list[int | str | None] | list[list[int]]


class _Texts:
    """Distinct texts in the order in which they are met; the empty one has place 0."""

    def __init__(self) -> None:
        self.places = {"": 0}

    def place(self, text: str) -> int:
        return self.places.setdefault(text, len(self.places))

    def places_of(self, texts: Sequence[str]) -> list[int]:
        return [self.place(text) for text in texts]


def render_rows(page: BoardPage, rows: Sequence[BoardRow]) -> bytes:
    """Render submissions of a board as a script that does nothing but assign ``boardRows``.

    It is a script because a page that was opened as a file may load nothing else. Texts stay as they are
    printed; exact values are millionths, or texts where that would lose digits.
    """
    texts = _Texts()
    content: dict[str, object] = {
        "rank": [int(row.rank or 0) for row in rows],
        "badges": [texts.places_of(row.badges) for row in rows],
        "details": [texts.places_of(row.details) for row in rows],
        "facts": [texts.places_of(row.facts) for row in rows],
        "cells": [
            _list_cells([row.cells[index] for row in rows], texts) for index in range(_count_cells(page))
        ],
    }
    content |= _list_traits([row.traits for row in rows if row.traits], texts)
    for name in ("slug", "name", "ranks"):
        content[name] = texts.places_of([getattr(row, name) for row in rows])
    content["texts"] = list(texts.places)
    return f"var boardRows = {json.dumps(content, separators=(',', ':'))};\n".encode()


def _count_cells(page: BoardPage) -> int:
    return sum(len(group.columns) for group in page.groups)


def _list_traits(traits: Sequence[Traits], texts: _Texts) -> dict[str, list[int]]:
    return {
        "place": [each.place for each in traits],
        "family": texts.places_of([each.family for each in traits]),
        "inputs": texts.places_of([each.inputs for each in traits]),
        "date": texts.places_of([each.date for each in traits]),
    }


def _list_cells(cells: Sequence[Cell], texts: _Texts) -> dict[str, Column]:
    """List the cells of a column by what they consist of, without what none of them has."""
    ends = [cell.ends or ("", "") for cell in cells]
    values = {
        "value": [_shorten(cell.exact) for cell in cells],
        "low": [_shorten(low) for low, _ in ends],
        "high": [_shorten(high) for _, high in ends],
    }
    counts = {"undefined": [cell.n_undefined for cell in cells], "note": [cell.note for cell in cells]}
    for name in ("text", "interval", "remark", "why"):
        counts[name] = texts.places_of([getattr(cell, name) for cell in cells])
    said: dict[str, Column] = {name: column for name, column in counts.items() if any(column)}
    return said | {name: exact for name, exact in values.items() if set(exact) != {None}}


def _shorten(exact: str) -> int | str | None:
    """Write a value with six decimals as millionths; leave any other as it is.

    >>> _shorten("0.588542"), _shorten("-0.100000"), _shorten("1.5e-09"), _shorten("")
    (588542, -100000, '1.5e-09', None)
    """
    if not exact:
        return None
    millionths = round(float(exact) * MILLION)
    is_whole = abs(millionths) < LARGEST and f"{millionths / MILLION:.{N_DECIMALS}f}" == exact
    return millionths if is_whole else exact
