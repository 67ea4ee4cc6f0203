"""What checking a reference found, for a terminal and as JSON: assumptions, errata, and what is left."""

from collections.abc import Iterator
from dataclasses import replace

from rich.box import SIMPLE_HEAD
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from leaderboard.files import canonical_json
from leaderboard.reference.checking import Datasheet, Finding, Row, Section, Status, Verdict
from leaderboard.report.problems import escape_line, problems_data, render_problems
from leaderboard.report.terminal import ABSENT, Terminal, render_tables

STYLES = {Status.OK: "green", Status.DEPARTS: "bold red", Status.NOTE: "dim", Status.ACCEPTED: "yellow"}
EXPECTED_WIDTH = 10
MAX_WIDTH = 100


def render_check(verdict: Verdict, *, terminal: Terminal | None = None) -> str:
    """Tabulate every assumption, then list what errata drop and accept, and what is left."""
    wide = terminal or Terminal()
    narrow = replace(wide, width=min(wide.width, MAX_WIDTH))
    sections = verdict.datasheet.sections if verdict.datasheet is not None else ()
    parts = [part for section in sections for part in _render_section(section)]
    tables = render_tables(parts, narrow) if parts else ""
    errata = "".join(f"{escape_line(line)}\n" for line in _say_errata(verdict))
    problems = render_problems(verdict.problems)
    outcome = "the reference is sound" if verdict.is_sound else "the reference departs from its definition"
    return f"{tables}{errata}{problems}{outcome}\n"


def render_check_json(verdict: Verdict) -> str:
    """Render the verdict for programs: what `validate --json` has, with errata and datasheet beside it."""
    reference, datasheet = verdict.reference, verdict.datasheet
    data = {
        "sound": verdict.is_sound,
        **problems_data(verdict.problems),
        "accepted": [_accepted_data(finding) for finding in verdict.accepted],
        "dropped": dict(reference.dropped) if reference is not None else {},
        "datasheet": None if datasheet is None else datasheet_data(datasheet),
    }
    return canonical_json(data)


def datasheet_data(datasheet: Datasheet) -> list[dict[str, object]]:
    """Lay out the sections of a datasheet; what is not expected or not found is an empty text."""
    return [
        {"title": section.title, "note": section.note, "rows": [_row_data(row) for row in section.rows]}
        for section in datasheet.sections
    ]


def _row_data(row: Row) -> dict[str, object]:
    return {
        "assumption": row.assumption,
        "expected": row.expected,
        "found": row.found,
        "status": row.status.value,
        "code": row.code,
    }


def _accepted_data(finding: Finding) -> dict[str, object]:
    problem = finding.problem
    return {
        "code": problem.code,
        "message": problem.message,
        "file": problem.file,
        "line": problem.line,
        "reason": finding.reason,
    }


def _render_section(section: Section) -> Iterator[RenderableType]:
    table = Table(box=SIMPLE_HEAD, pad_edge=False, padding=(0, 0, 0, 1), expand=True)
    table.add_column(section.title, ratio=4)
    table.add_column("expected", min_width=EXPECTED_WIDTH)
    table.add_column("found", ratio=3)
    table.add_column("", no_wrap=True)
    for row in section.rows:
        status = Text(row.status.value, STYLES[row.status])
        table.add_row(row.assumption, row.expected or ABSENT, row.found, status)
    yield Group(table)  # in a group, because its columns are text, which may wrap
    if section.note:
        yield Text(f"{section.note}\n", "dim")


def _say_errata(verdict: Verdict) -> Iterator[str]:
    dropped = verdict.reference.dropped if verdict.reference is not None else {}
    for trial_id, reason in dropped.items():
        yield f"dropped: {trial_id}: {reason}"
    for finding in verdict.accepted:
        problem = finding.problem
        place = problem.file if problem.line is None else f"{problem.file}:{problem.line}"
        yield f"accepted: {place}: {problem.code}: {problem.message}: {finding.reason}"
