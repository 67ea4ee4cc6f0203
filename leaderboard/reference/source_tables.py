"""Reading other people's CSV files strictly: nothing is skipped, and every complaint names file and line."""

import csv
import io
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from leaderboard.errors import SourceError
from leaderboard.files import read_regular
from leaderboard.reference.source_files import SourceFile

SIZE_LIMIT = 100_000_000
SEPARATORS = ",;\t"


@dataclass(frozen=True)
class SourceRow:
    """One row: where it is, and its cells by the name of their column."""

    file: str
    line: int
    cells: dict[str, str]

    def __getitem__(self, column: str) -> str:
        """Return the cell of a column."""
        return self.cells[column]

    def error(self, message: str, hint: str = "") -> SourceError:
        """Make the exception that says what is wrong with this row."""
        return SourceError(f"{self.file}:{self.line}: {message}", hint)


@dataclass(frozen=True)
class SourceTable:
    """A CSV file as read: how messages name it, the checksum of its bytes, its columns and its rows."""

    file: str
    sha256: str
    header: tuple[str, ...]
    rows: tuple[SourceRow, ...]


def read_source_table(path: Path, columns: Sequence[str], *, limit: int = SIZE_LIMIT) -> SourceTable:
    """Read a CSV file that has at least these columns.

    Parameters
    ----------
    path
        Where it is; a symbolic link is followed, since the file is the caller's own.
    columns
        Names that its header must hold, in any order; further columns are kept.
    limit
        Size in bytes beyond which the file is refused.

    Raises
    ------
    SourceError
        If it cannot be read, is too large, or for what `parse_source_table` refuses.
    """
    return parse_source_table(SourceFile(path.name, str(path), _read_bytes(path, limit)), columns)


def parse_source_table(file: SourceFile, columns: Sequence[str] = ()) -> SourceTable:
    """Understand a CSV file that has at least these columns.

    Cells are separated by commas, or by what the header has instead of commas: semicolons or tabs. Blank
    lines at the end are no rows.

    Raises
    ------
    SourceError
        If it is not UTF-8, is no regular CSV, lacks a column or has no rows.
    """
    text = _decode(file.content, file.origin)
    lines = csv.reader(io.StringIO(text, newline=""), delimiter=_find_separator(text), strict=True)
    try:
        header = next(lines, [])
        _check_header(header, columns, file.origin)
        numbered = [(lines.line_num, cells) for cells in lines]
    except csv.Error as error:
        raise SourceError(f"{file.origin}:{lines.line_num}: malformed CSV: {error}") from None
    while numbered and not numbered[-1][1]:
        numbered.pop()
    rows = tuple(_make_row(header, cells, file.origin, line) for line, cells in numbered)
    if not rows:
        raise SourceError(f"{file.origin}: holds a header but no rows")
    return SourceTable(file.origin, file.sha256, tuple(header), rows)


def _find_separator(text: str) -> str:
    header = text.partition("\n")[0]
    return next((separator for separator in SEPARATORS if separator in header), ",")


def _read_bytes(path: Path, limit: int) -> bytes:
    try:
        content = read_regular(path.resolve(), limit)
    except (OSError, RuntimeError) as error:  # RuntimeError: links that run in a circle
        reason = getattr(error, "strerror", None) or str(error)
        raise SourceError(f"{path}: cannot be read: {reason}") from None
    if content is None:
        raise SourceError(f"{path}: is larger than {limit:,} bytes", "is it the right file?")
    return content


def _decode(content: bytes, file: str) -> str:
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise SourceError(f"{file}:{line}: is not UTF-8 text (byte 0x{content[error.start]:02x})") from None
    if "\0" in text:
        line = text.count("\n", 0, text.index("\0")) + 1
        raise SourceError(f"{file}:{line}: holds a NUL byte, so it is not a CSV file")
    return text


def _check_header(header: Sequence[str], columns: Sequence[str], file: str) -> None:
    missing = [column for column in columns if column not in header]
    if missing:
        noun = "column" if len(missing) == 1 else "columns"
        found = ", ".join(header) or "nothing"
        raise SourceError(f"{file}:1: lacks the {noun} {', '.join(missing)}; found {found}")
    repeated = [column for column, count in Counter(header).items() if count > 1]
    if repeated:
        # By number: where each person has a column, its name must not be told.
        first, second = [place for place, column in enumerate(header, 1) if column == repeated[0]][:2]
        raise SourceError(f"{file}:1: columns {first} and {second} have the same name")


def _make_row(header: Sequence[str], cells: Sequence[str], file: str, line: int) -> SourceRow:
    if not cells:
        raise SourceError(f"{file}:{line}: the line is blank")
    if len(cells) != len(header):
        n_cells = f"{len(cells)} cell{'' if len(cells) == 1 else 's'}"
        raise SourceError(f"{file}:{line}: has {n_cells} where the header has {len(header)}")
    return SourceRow(file, line, dict(zip(header, cells, strict=True)))
