"""From the text of ``predictions.csv`` to its rows, each with its line number."""

import csv
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from leaderboard.problems import Problems
from leaderboard.reference.cells import FIRST_LINE
from leaderboard.validation.quoting import quote_briefly

HEADERS = (("trial_id", "probability"), ("trial_id", "probability", "status"))
HEADER_RULE = "the first line must be trial_id,probability or trial_id,probability,status"
MAX_SURPLUS = 10_000

_SEPARATORS = {";": "a semicolon", "\t": "a tab", "|": "a bar"}
_MAX_ID_CELLS = 30  # of an id torn at its commas; an id has at most 200 characters


@dataclass(frozen=True)
class Row:
    """A row of predictions: its line, and its cells as text; ``status`` is empty where it is not given."""

    line: int
    trial_id: str
    probability: str
    status: str


def parse_rows(text: str, known: Collection[str], file: str, problems: Problems) -> list[Row]:
    """Parse the table and report every line that is not a row of it.

    Parameters
    ----------
    text
        The whole file; lines end in LF or CRLF.
    known
        The trial ids of the benchmark. Rows far beyond as many are counted and not judged.
    file
        How messages name it.
    problems
        Where faults are collected.

    Returns
    -------
    list of Row
        The rows that are well formed; empty if the header is not understood.
    """
    lines = text.replace("\r\n", "\n").split("\n")
    if lines[-1] == "":
        lines.pop()
    if not any(line.strip() for line in lines):
        problems.add("empty-file", "is empty", file, hint=HEADER_RULE)
        return []
    parser = _Parser(known, file, problems)
    width = 0 if parser.report_blank_top(lines) else parser.parse_header(lines[0])
    if not width:
        return []
    rows = parser.parse_lines(parser.cut_surplus(lines), width)
    return [Row(line, *cells, *[""] * (3 - len(cells))) for line, cells in rows]


@dataclass(frozen=True)
class _Parser:
    """What parsing one file needs to know, and where it reports."""

    known: Collection[str]
    file: str
    problems: Problems

    def report_blank_top(self, lines: Sequence[str]) -> bool:
        """Report empty lines where the header should be; whether there are any."""
        n_blank = next(number for number, line in enumerate(lines) if line.strip())
        if n_blank:
            hint = f"remove the empty line{'s' if n_blank > 1 else ''} above the header"
            self._report("wrong-header", "the first line is empty", 1, hint)
        return n_blank > 0

    def parse_header(self, line: str) -> int:
        """Count the columns, 0 if they are not understood; report a header that is not as it must be."""
        header = tuple(_split(line) or ())
        if header in HEADERS:
            return len(header)
        separator = _find_separator(line) if "," not in line else None
        is_row = _count_torn(header, self.known) > 0
        repeated = [name for name, count in Counter(header).items() if count > 1 and not is_row]
        if separator is not None:
            message = f"columns are separated by {separator}, not by a comma"
            self._report("wrong-separator", message, 1, "export it with commas")
        elif repeated:
            message = f"column {quote_briefly(repeated[0])} appears twice"
            self._report("duplicate-column", message, 1, HEADER_RULE)
        else:
            hint = _hint_header(header, self.known)
            self._report("wrong-header", f"the header is {quote_briefly(line)}", 1, hint)
        return len(header) if _tidy(header) in HEADERS else 0

    def cut_surplus(self, lines: Sequence[str]) -> Sequence[str]:
        """Take the lines after the header, not absurdly many of them."""
        last = 1 + len(self.known) + MAX_SURPLUS
        if len(lines) == 1:
            self._report("no-rows", "has a header but no rows", 1, "give one row per trial")
        elif len(lines) > last:
            message = f"has {len(lines) - 1:,} rows; the benchmark has {len(self.known):,} trials"
            hint = f"give one row per trial; what stands after line {last:,} was not judged"
            self._report("too-many-rows", message, None, hint)
        return lines[1:last]

    def parse_lines(self, lines: Sequence[str], width: int) -> Iterator[tuple[int, list[str]]]:
        """Yield number and cells of each line that is a row; report the others."""
        numbered = enumerate(lines, FIRST_LINE)
        for is_blank, run in groupby(numbered, key=lambda pair: not pair[1].strip(", \t")):
            if is_blank:
                self._report_blank(list(run))
                continue
            for line, text in run:
                cells = text.split(",") if '"' not in text else _split(text)
                if cells is not None and len(cells) == width and _tidy(cells) not in HEADERS:
                    yield line, cells
                else:
                    self._report_line(line, text, cells, width)

    def _report_blank(self, run: Sequence[tuple[int, str]]) -> None:
        """Report a run of lines without content once."""
        first, last = run[0][0], run[-1][0]
        what = "is empty but for blanks or commas" if any(text for _, text in run) else "is empty"
        if first == last:
            self._report("blank-line", f"the line {what}", first, "remove it")
        else:
            self._report("blank-line", f"each of lines {first:,} to {last:,} {what}", first, "remove them")

    def _report_line(self, line: int, text: str, cells: Sequence[str] | None, width: int) -> None:
        """Report a line whose quotes are broken, that repeats the header, or has too many or few cells."""
        if cells is None:
            hint = 'quote a cell whole, as in "a,b", and double a quote inside it'
            fault = "do not close" if text.count('"') % 2 else "are misplaced"
            self._report("malformed-quotes", f"the quotes {fault} in {quote_briefly(text)}", line, hint)
        elif _tidy(cells) in HEADERS:
            hint = "keep one header; were two files joined?"
            self._report("repeated-header", "the header stands here again", line, hint)
        else:
            n_cells = f"{len(cells):,} cell{'' if len(cells) == 1 else 's'}"
            message = f"the row has {n_cells}, the header has {width}"
            self._report("ragged-row", message, line, _hint_ragged(cells, width, self.known))

    def _report(self, code: str, message: str, line: int | None, hint: str) -> None:
        self.problems.add(code, message, self.file, line=line, hint=hint)


def _split(line: str) -> list[str] | None:
    """Split a line of CSV; None if its quotes are broken. No cell spans lines, since no id does."""
    try:
        return next(csv.reader([line], strict=True), [])
    except csv.Error:
        return None


def _tidy(header: Sequence[str]) -> tuple[str, ...]:
    return tuple(name.strip().lower() for name in header)


def _find_separator(text: str) -> str | None:
    return next((name for mark, name in _SEPARATORS.items() if mark in text), None)


def _count_torn(cells: Sequence[str], known: Collection[str]) -> int:
    """Count the cells at a line's beginning that make up a trial's id with its commas; 0 if none do."""
    lengths = range(1, min(len(cells), _MAX_ID_CELLS))
    return next((n for n in lengths if ",".join(cells[:n]) in known), 0)


def _hint_header(header: Sequence[str], known: Collection[str]) -> str:
    """Say what is wrong with a header, as far as that can be told."""
    tidy = _tidy(header)
    if tidy in HEADERS:
        return f"{HEADER_RULE}, without blanks and in small letters"
    if tidy[1:] in HEADERS and tidy[0] in ("", "index"):
        return "leave out the first column, which numbers the rows (in pandas: index=False)"
    if sorted(tidy) in [sorted(allowed) for allowed in HEADERS]:
        return f"{HEADER_RULE}, in this order"
    if _count_torn(header, known):
        return f"the rows begin at once, without a header: {HEADER_RULE}"
    return HEADER_RULE


def _hint_ragged(cells: Sequence[str], width: int, known: Collection[str]) -> str:
    """Say why a row has too few or too many cells: another separator, an id with commas, a decimal comma."""
    if len(cells) < width:
        separator = _find_separator(cells[0])
        if separator:
            return f"separate cells by a comma, not by {separator}"
        lacks_status = len(cells) == width - 1 == len(HEADERS[0])
        return f"give each column a cell{': an empty status too has its comma' if lacks_status else ''}"
    n_torn = _count_torn(cells, known) or 1
    hints = ['put the trial id in double quotes, since it holds commas: "..."'] if n_torn > 1 else []
    rest = [cell.strip() for cell in cells[n_torn:]]
    if len(rest) == width and rest[0].isdecimal() and rest[1].isdecimal():
        hints.append("write the probability with a point, 0.5, not 0,5")
    return "; ".join(hints) or "remove what is too much; a cell that holds commas needs double quotes"
