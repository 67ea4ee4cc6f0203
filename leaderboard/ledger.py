"""The ledger: the public record of what was published, regraded or withdrawn, only ever appended to."""

import csv
import datetime as dt
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from pydantic import ValidationError

from leaderboard.errors import InstanceError
from leaderboard.files import csv_text, read_regular
from leaderboard.instance import Instance
from leaderboard.models.ledger import LedgerLine
from leaderboard.problems import Problems

HEADER = tuple(LedgerLine.model_fields)
SIZE_LIMIT = 10_000_000

_HEADER_LINE = ",".join(HEADER)
_MAX_SHOWN = 80


@dataclass(frozen=True)
class Ledger:
    """The lines of a ledger in their order, which is that of time."""

    lines: tuple[LedgerLine, ...] = ()

    @cached_property
    def latest(self) -> dict[str, LedgerLine]:
        """The last line of each slug."""
        return {line.slug: line for line in self.lines}

    @property
    def withdrawn(self) -> frozenset[str]:
        """The slugs that left the board."""
        return frozenset(slug for slug, line in self.latest.items() if line.event == "withdrawn")


def parse_ledger(content: bytes, file: str, problems: Problems) -> Ledger | None:
    """Read a ledger strictly: what is appended to must be in the one form that appending writes.

    Parameters
    ----------
    content
        The file's bytes.
    file
        How messages name it.
    problems
        Receives everything that is wrong.

    Returns
    -------
    Ledger or None
        None, and problems, if anything is wrong with it.
    """
    found = Problems()
    rows = _split_lines(content, file, found)
    lines = [_parse_line(text, number, file, found) for number, text in enumerate(rows, 2)]
    whole = tuple(line for line in lines if line is not None)
    if not found.has_errors:
        _judge_order(whole, file, found)
    problems.found += found
    return None if found.has_errors else Ledger(whole)


def read_ledger(instance: Instance, problems: Problems) -> Ledger | None:
    """Read an instance's ledger; one that is not there has no lines yet."""
    file = instance.display_path(instance.ledger_file)
    content = read_ledger_bytes(instance, problems)
    return Ledger() if content == b"" else parse_ledger(content, file, problems) if content else None


def read_ledger_bytes(instance: Instance, problems: Problems) -> bytes | None:
    """Read the bytes of an instance's ledger: none if it is not there, None and a problem if unreadable."""
    path = instance.ledger_file
    file = instance.display_path(path)
    try:
        content = read_regular(path, SIZE_LIMIT)
    except FileNotFoundError:
        return b""
    except OSError as error:
        problems.add("ledger-unreadable", f"cannot be read: {error.strerror or error}", file)
        return None
    if content is None:
        problems.add("ledger-unreadable", f"is larger than {SIZE_LIMIT:,} bytes", file)
    elif not content:
        problems.add("ledger-malformed", "is empty", file, hint=f"its first line is {_HEADER_LINE}")
        return None
    return content


def render_ledger(lines: Iterable[LedgerLine], *, has_header: bool = True) -> str:
    """Render lines as a ledger holds them, or only what is appended to one."""
    rows = [[str(getattr(line, name)) for name in HEADER] for line in lines]
    text = csv_text(HEADER, rows)
    return text if has_header else text.removeprefix(f"{_HEADER_LINE}\n")


def load_ledger(instance: Instance) -> Ledger:
    """Read an instance's ledger where no page can be made without it.

    Raises
    ------
    InstanceError
        If it cannot be understood: then nobody knows what left the board.
    """
    problems = Problems()
    ledger = read_ledger(instance, problems)
    if ledger is None:
        first = next(iter(problems))
        place = first.file if first.line is None else f"{first.file}:{first.line}"
        raise InstanceError(f"{place}: {first.message}", "see: leaderboard ledger check")
    return ledger


def published_dirs(instance: Instance) -> list[Path]:
    """List the folders of all submissions but those that the ledger withdraws, by slug.

    Raises
    ------
    InstanceError
        If the ledger cannot be understood.
    """
    ledger = load_ledger(instance)
    return [folder for folder in instance.submission_dirs() if folder.name not in ledger.withdrawn]


def _split_lines(content: bytes, file: str, problems: Problems) -> list[str]:
    """Split a file into the lines below its header; none, and a problem, if it has another form."""
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        problems.add("ledger-unreadable", "is not UTF-8 text", file, line=line)
        return []
    if "\r" in text or "\0" in text:
        line = text.count("\n", 0, min(text.find(c) for c in "\r\0" if c in text)) + 1
        hint = "lines end in LF, without a carriage return"
        problems.add("ledger-malformed", "holds a carriage return or NUL", file, line=line, hint=hint)
        return []
    header, *rows = text.split("\n")
    if header != _HEADER_LINE:
        message = f"the first line is {_quote(header)}; it must be {_HEADER_LINE}"
        problems.add("ledger-malformed", message, file, line=1)
        return []
    if rows[-1:] != [""]:
        problems.add("ledger-malformed", "the last line does not end", file, line=len(rows) + 1)
        return []
    return rows[:-1]


def _parse_line(text: str, number: int, file: str, problems: Problems) -> LedgerLine | None:
    try:
        cells = next(csv.reader([text], strict=True), [])
    except csv.Error as error:
        problems.add("ledger-malformed", f"malformed CSV: {error}", file, line=number)
        return None
    if len(cells) != len(HEADER):
        n_cells = f"{len(cells)} cell{'' if len(cells) == 1 else 's'}"
        message = f"has {n_cells}, not {len(HEADER)}" if text else "is blank"
        problems.add("ledger-malformed", f"the line {message}", file, line=number)
        return None
    line = _build_line(dict(zip(HEADER, cells, strict=True)), number, file, problems)
    if line is not None and render_ledger([line], has_header=False) != f"{text}\n":
        hint = "quotes stand only where a cell needs them"
        problems.add("ledger-malformed", "is written in another form", file, line=number, hint=hint)
        return None
    return line


def _build_line(cells: dict[str, str], number: int, file: str, problems: Problems) -> LedgerLine | None:
    date = _parse_date(cells["date"])
    if date is None:
        message = f"date is {_quote(cells['date'])}; it must be a day such as 2026-11-21"
        problems.add("ledger-value", message, file, line=number)
    try:
        line = LedgerLine.model_validate({**cells, "date": date or dt.date.min})
    except ValidationError as error:
        for fault in error.errors(include_url=False):
            column = str(fault["loc"][0])
            rule = fault["msg"].removeprefix("Value error, ")
            problems.add("ledger-value", f"{column} is {_quote(cells[column])}: {rule}", file, line=number)
        return None
    return None if date is None else line


def _parse_date(text: str) -> dt.date | None:
    try:
        date = dt.date.fromisoformat(text)
    except ValueError:
        return None
    return date if date.isoformat() == text else None


def _judge_order(lines: tuple[LedgerLine, ...], file: str, problems: Problems) -> None:
    """Report lines that contradict those before them."""
    latest: dict[str, LedgerLine] = {}
    day = dt.date.min
    for number, line in enumerate(lines, 2):
        faults = [*_find_faults(line, latest.get(line.slug))]
        if line.date < day:
            faults.append(f"is dated {line.date}, before the line above it ({day})")
        for fault in faults:
            problems.add("ledger-order", fault, file, line=number)
        latest[line.slug] = line
        day = max(day, line.date)


def _find_faults(line: LedgerLine, before: LedgerLine | None) -> Iterator[str]:
    if before is None:
        if line.event != "added":
            yield f"{line.slug} is {line.event} before it was added"
    elif line.event == "added":
        yield f"{line.slug} is added a second time"
    elif before.event == "withdrawn":
        yield f"{line.slug} is {line.event} after it was withdrawn"
    elif (line.event == "regraded") == (line.result_sha256 == before.result_sha256):
        kept = "the result that it had before" if line.event == "regraded" else "another result than before"
        yield f"{line.slug} is {line.event} with {kept}"


def _quote(text: str) -> str:
    return ascii(text if len(text) <= _MAX_SHOWN else text[:_MAX_SHOWN] + "...")
