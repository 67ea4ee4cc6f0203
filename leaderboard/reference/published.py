"""Reading ``published.csv``: numbers of papers, as printed."""

import re
from pathlib import Path

from pydantic import ValidationError

from leaderboard.models.published import PublishedNumber
from leaderboard.reference.cells import quote
from leaderboard.reference.source_tables import SourceRow, read_source_table

PUBLISHED_HEADER = tuple(PublishedNumber.model_fields)
SIZE_LIMIT = 5_000_000

_COUNTS = ("training_trials", "n")
_COUNT = re.compile(r"0|[1-9][0-9]{0,12}")


def read_published(path: Path) -> tuple[PublishedNumber, ...]:
    """Read a file of published numbers; empty cells are unknown values.

    Raises
    ------
    SourceError
        If it has no such columns or a row breaks a rule; the message names file, line and column.
    """
    table = read_source_table(path, PUBLISHED_HEADER, limit=SIZE_LIMIT)
    return tuple(_parse_row(row) for row in table.rows)


def _parse_row(row: SourceRow) -> PublishedNumber:
    cells: dict[str, str | int] = {name: row[name] for name in PUBLISHED_HEADER if row[name]}
    for name in _COUNTS:
        if not _COUNT.fullmatch(row[name] or "0"):
            raise row.error(f"{name} is {quote(row[name])}; it must be a whole number or empty")
        if row[name]:
            cells[name] = int(row[name])
    try:
        return PublishedNumber.model_validate(cells)
    except ValidationError as error:
        raise row.error(_say(error, row)) from None


def _say(error: ValidationError, row: SourceRow) -> str:
    first = error.errors(include_url=False)[0]
    column = ".".join(map(str, first["loc"]))
    if first["type"] == "missing":
        return f"{column} is empty"
    what = first["msg"].removeprefix("Value error, ")
    return f"{column} is {quote(row[column])}: {what}" if column else what
