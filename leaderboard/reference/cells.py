"""A strict reader of the reference's CSV tables, and of the few kinds of cells that they have."""

import csv
import io
import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from leaderboard.ids import MAX_ID_LENGTH, is_id
from leaderboard.problems import Problems
from leaderboard.reference.data import Integers

FIRST_LINE = 2  # of the rows: the header is line 1
ID_RULE = f"an id has 1 to {MAX_ID_LENGTH} printable ASCII characters without blanks and quotes"

_COUNT = re.compile(r"0|[1-9][0-9]{0,8}")
_MAX_SHOWN = 80


@dataclass(frozen=True)
class Table:
    """A CSV file as read: how messages name it, and its cells by column.

    Every row is one line, so row ``i`` (from 0) is on line ``i + 2``.
    """

    file: str
    columns: dict[str, tuple[str, ...]]

    def __getitem__(self, column: str) -> tuple[str, ...]:
        """Return the cells of a column."""
        return self.columns[column]


def parse_table(content: bytes, header: Sequence[str], file: str, problems: Problems) -> Table | None:
    """Read a CSV file that has exactly this header and at least one row.

    Lines end in LF or CRLF, and one byte-order mark is accepted. Nothing else is: no blank lines, no rows of
    another length, no cells over several lines.

    Returns
    -------
    Table or None
        None, and problems, if it is not such a file.
    """
    text = _decode(content, file, problems)
    if text is None:
        return None
    reader = csv.reader(io.StringIO(text, newline=""), strict=True)
    try:
        found = next(reader, [])
        rows = list(reader)
    except csv.Error as error:
        problems.add("reference-malformed", f"malformed CSV: {error}", file, line=max(reader.line_num, 1))
        return None
    if found != list(header):
        message = f"the header is {quote(','.join(found))}; it must be {','.join(header)}"
        problems.add("reference-header", message, file, line=1)
        return None
    if not _is_regular(rows, reader.line_num, len(header), file, problems):
        return None
    return Table(file, dict(zip(header, zip(*rows, strict=True), strict=True)))


def parse_ids(table: Table, column: str, problems: Problems) -> tuple[str, ...] | None:
    """Return a column of ids; None and problems if one breaks the rule for ids."""
    cells = table[column]
    allowed = {cell for cell in set(cells) if is_id(cell)}
    return cells if _all_allowed(table, column, allowed, ID_RULE, problems) else None


def parse_binary(table: Table, column: str, problems: Problems) -> Integers | None:
    """Turn a column of 0 and 1 into integers, shape (n_rows,); None and problems if a cell is neither."""
    if not _all_allowed(table, column, {"0", "1"}, "it must be 0 or 1", problems):
        return None
    return np.array([cell == "1" for cell in table[column]], np.int64)


def parse_counts(
    table: Table, column: str, problems: Problems, *, may_be_empty: bool = False
) -> Integers | None:
    """Turn a column of whole numbers into integers, shape (n_rows,); None and problems if a cell is none.

    A number is written without sign or leading zeros and has at most 9 digits. Empty cells, where they are
    allowed, become -1.
    """
    allowed = {cell for cell in set(table[column]) if _COUNT.fullmatch(cell)}
    allowed |= {""} if may_be_empty else set()
    rule = f"it must be a whole number{' or empty' if may_be_empty else ''}"
    if not _all_allowed(table, column, allowed, rule, problems):
        return None
    return np.array([int(cell or -1) for cell in table[column]], np.int64)


def quote(text: str) -> str:
    r"""Show a text from a file in a message: in quotes, escaped, and shortened if long.

    >>> print(quote("tab\there"))
    'tab\there'
    """
    return ascii(text if len(text) <= _MAX_SHOWN else text[:_MAX_SHOWN] + "...")


def _all_allowed(table: Table, column: str, allowed: set[str], rule: str, problems: Problems) -> bool:
    cells = table[column]
    if set(cells) <= allowed:
        return True
    for line, cell in enumerate(cells, FIRST_LINE):
        if cell not in allowed:
            problems.add("reference-value", f"{column} is {quote(cell)}; {rule}", table.file, line=line)
    return False


def _decode(content: bytes, file: str, problems: Problems) -> str | None:
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        message = f"is not UTF-8 text (byte 0x{content[error.start]:02x})"
        problems.add("reference-unreadable", message, file, line=line)
        return None
    text = text.replace("\r\n", "\n")
    for character, name in (("\0", "a NUL character"), ("\r", "a carriage return inside a line")):
        where = text.find(character)
        if where >= 0:
            line = text.count("\n", 0, where) + 1
            problems.add("reference-malformed", f"holds {name}", file, line=line)
            return None
    return text


def _is_regular(rows: list[list[str]], n_lines: int, width: int, file: str, problems: Problems) -> bool:
    if not rows:
        problems.add("reference-malformed", "has a header but no rows", file)
        return False
    if {*map(len, rows)} == {width} and n_lines == len(rows) + 1:
        return True
    for line, row in enumerate(rows, FIRST_LINE):
        if any("\n" in cell for cell in row):
            problems.add("reference-malformed", "a cell runs over several lines", file, line=line)
            break
        if len(row) != width:
            n_cells = f"{len(row)} cell{'' if len(row) == 1 else 's'}"
            message = f"has {n_cells}, not {width}" if row else "is blank"
            problems.add("reference-malformed", f"the line {message}", file, line=line)
    return False
