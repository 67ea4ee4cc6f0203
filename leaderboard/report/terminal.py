"""Tables for terminals, rendered to text: what all of them share."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from io import StringIO

from rich.box import SIMPLE_HEAD
from rich.console import Console, RenderableType
from rich.measure import measure_renderables
from rich.table import Table
from rich.text import Text

from leaderboard.models import Score
from leaderboard.reference import Reference
from leaderboard.report.problems import defuse_commands, escape_line

MIN_NAME_WIDTH = 22
ABSENT = "\N{EN DASH}"


@dataclass(frozen=True)
class Terminal:
    """What the text is for: how wide it may be and whether it may have colours."""

    width: int = 100
    has_colour: bool = False


def render_tables(parts: Iterable[RenderableType], terminal: Terminal) -> str:
    """Render rich tables and texts, one after the other, without trailing blanks.

    No line is a command to GitHub, whatever a submission is called.

    What cannot be made narrow enough is wider than the terminal: a number is never cut.
    """
    console = Console(
        file=StringIO(),
        width=terminal.width,
        force_terminal=terminal.has_colour,
        color_system="standard" if terminal.has_colour else None,
        highlight=False,
        markup=False,
        emoji=False,
        legacy_windows=False,
    )
    with console.capture() as capture:
        for part in parts:
            needed = _protect_numbers(part, console) if isinstance(part, Table) else 0
            console.width = max(terminal.width, needed)
            console.print(part)
    show = defuse_commands if terminal.has_colour else escape_line
    return "\n".join(show(line.rstrip()) for line in capture.get().splitlines()) + "\n"


def _protect_numbers(table: Table, console: Console) -> int:
    """Keep columns of numbers as wide as their cells, names up to a limit; return the width needed."""
    needed = 1
    for index, column in enumerate(table.columns):
        cells = [column.header, *column.cells]
        width = measure_renderables(console, console.options, cells).maximum
        column.min_width = width if index else min(width, MIN_NAME_WIDTH)
        needed += column.min_width + 2  # its padding, and the edge or gap beside it
    return needed


def new_table(columns: Iterable[str]) -> Table:
    """Start a table whose first column is text, which may wrap, and whose others are numbers."""
    table = Table(box=SIMPLE_HEAD, pad_edge=False, padding=(0, 0, 0, 1))
    for index, column in enumerate(columns):
        table.add_column(column, justify="right" if index else "left", no_wrap=bool(index), overflow="fold")
    return table


def reference_banner(reference: Reference) -> Text:
    """Name the reference, and say loudly if labels and people are simulated."""
    benchmark = reference.benchmark
    line = Text(f"{benchmark.title} {benchmark.version}, reference {reference.manifest.digest[:12]}")
    if reference.is_synthetic:
        line.append(
            "\nSYNTHETIC reference: labels and people are simulated; no figure here is real.", "bold yellow"
        )
    return line


def format_percent(score: Score | None) -> str:
    """Show a share as percent with one decimal, and what is undefined or absent as a dash.

    >>> format_percent(Score(value=0.58854)), format_percent(None) == ABSENT
    ('58.9', True)
    """
    return ABSENT if score is None or score.value is None else f"{100 * score.value:.1f}"


def format_interval(score: Score | None, show: Callable[[Score | None], str]) -> str:
    """Show the ends of a 95 % interval as the value is shown, and a dash where there is none.

    >>> format_interval(Score(value=0.5, low=0.45, high=0.548), format_percent)
    '45.0 to 54.8'
    """
    if score is None or score.low is None or score.high is None:
        return ABSENT
    return " to ".join(show(Score(value=end)) for end in (score.low, score.high))


def format_number(score: Score | None, digits: int = 3) -> str:
    """Show a number with a fixed count of decimals, and what is undefined or absent as a dash.

    >>> format_number(Score(value=-0.1234)), format_number(Score(value=None, why="no labels")) == ABSENT
    ('-0.123', True)
    """
    return ABSENT if score is None or score.value is None else f"{score.value:.{digits}f}"


def format_p(score: Score | None) -> str:
    """Show a p-value with three decimals, and smaller ones as a bound.

    >>> format_p(Score(value=0.0123)), format_p(Score(value=1e-9))
    ('0.012', '<0.001')
    """
    smallest = 0.001
    if score is None or score.value is None:
        return ABSENT
    return f"{score.value:.3f}" if score.value >= smallest else "<0.001"
