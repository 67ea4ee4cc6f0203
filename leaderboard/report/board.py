"""The board of a track as a terminal table, CSV, LaTeX and JSON; all from one list of columns."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from leaderboard.files import canonical_json, csv_text
from leaderboard.models import Score, SubsetScores
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Board, Entry, Row
from leaderboard.reference import Reference
from leaderboard.report.terminal import (
    ABSENT,
    Terminal,
    format_number,
    format_percent,
    new_table,
    reference_banner,
    render_tables,
)

Scores = Mapping[str, Mapping[str, SubsetScores]]

WIDE = 118
MAX_NARROW_TITLE = 8
NARROW_NOTE = "A wider terminal shows easy and hard trials and pairs too."

_LATEX_SPECIAL = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    **{character: f"\\{character}" for character in "&%$#_{}"},
}
_FORMULA_STARTS = ("=", "+", "-", "@", "\t", "\r")


@dataclass(frozen=True)
class Column:
    """A score of the board: where it is found and how it is shown."""

    title: str
    metric: str
    scope: str = OVERALL
    subset: str = "all"
    show: Callable[[Score | None], str] = format_percent

    @property
    def key(self) -> str:
        """Its name in CSV: metric, scope and subset where they are not the usual ones."""
        return ".".join(part for part in (self.metric, self.scope, self.subset) if part != "all")

    def score(self, scores: Scores) -> Score | None:
        """Look it up in a submission's or the people's scores."""
        found = scores.get(self.scope, {}).get(self.subset)
        return found.metrics.get(self.metric) if found else None


def board_columns(board: Board, reference: Reference) -> tuple[Column, ...]:
    """Choose the columns: the metric that orders the board, accuracy by property, people, pairs."""
    columns = [Column("accuracy", "accuracy")]
    if board.metric != "accuracy":
        columns.insert(0, Column(board.metric, board.metric, show=format_number))
    columns += [Column(p.name, "accuracy", scope=p.name) for p in reference.benchmark.properties]
    if reference.people is not None:
        columns += [Column("easy", "accuracy", subset="easy"), Column("hard", "accuracy", subset="hard")]
        columns += [Column("human r", "human_r", show=format_number)]
    return (*columns, Column("both right", "pair_accuracy"))


def render_board(
    board: Board, reference: Reference, people: Scores, *, terminal: Terminal | None = None
) -> str:
    """Render a board for a terminal: people on top, ranked, partial, and baselines as reference lines.

    Numbers are never cut: a narrow terminal gets fewer columns and is told so.
    """
    terminal = terminal or Terminal()
    columns = board_columns(board, reference)
    is_narrow = terminal.width < WIDE
    if is_narrow:
        columns = tuple(column for column in columns if column.subset == "all")[:-1]
    titles = [_shorten(column.title) if is_narrow else column.title for column in columns]
    table = new_table(["system", *titles])
    if people:
        table.add_row("   People", *(column.show(column.score(people)) for column in columns), style="cyan")
        table.add_section()
    for rows, style in ((board.ranked, ""), (board.partial, ""), (board.baselines, "dim")):
        for row in rows:
            shown = (column.show(column.score(row.entry.result.scores)) for column in columns)
            table.add_row(_name_row(row), *shown, style=style)
        table.add_section()
    heading = Text(board.track.title, "bold").append("\n").append(reference_banner(reference))
    notes = _board_notes(board) + ([NARROW_NOTE] if is_narrow else [])
    return render_tables([heading, "", table, *(Text(note, "dim") for note in notes)], terminal)


def _shorten(title: str) -> str:
    return title if len(title) <= MAX_NARROW_TITLE else f"{title[: MAX_NARROW_TITLE - 1]}."


def _name_row(row: Row) -> RenderableType:
    """Put the rank before the name, so that a long name wraps beside it and not below."""
    name = Table.grid(padding=(0, 1, 0, 0))
    name.add_column(justify="right", width=2)
    name.add_column()
    name.add_row("" if row.rank is None else str(row.rank), row.entry.metadata.submission.name)
    return name


def _board_notes(board: Board) -> list[str]:
    notes = ["Shares in %. Equal scores share a rank. How sure a difference is: leaderboard compare A B."]
    if not board.ranked and not board.partial:
        notes.insert(0, "No submission on this track yet.")
    if board.partial:
        names = ", ".join(row.entry.metadata.submission.name for row in board.partial)
        notes.append(f"Not ranked, because not all properties are covered: {names}.")
    if board.baselines:
        notes.append("Below the line: baselines, for reference.")
    return notes


def render_board_csv(board: Board, reference: Reference, people: Scores) -> str:
    """Render a board as CSV with full precision; what a spreadsheet could run gets a leading apostrophe."""
    columns = board_columns(board, reference)
    header = [
        "rank",
        "kind",
        "slug",
        "name",
        "team",
        "date",
        "reference",
        *(column.key for column in columns),
    ]
    kind = reference.manifest.kind
    rows: list[list[object]] = []
    if people:
        rows.append(["", "people", "", "People", "", "", kind, *_values(columns, people)])
    for row in board.rows:
        about = row.entry.metadata.submission
        texts = [
            row.entry.slug,
            escape_formula(about.name),
            escape_formula(about.team),
            about.date.isoformat(),
            kind,
        ]
        rows.append([row.rank or "", row_kind(row), *texts, *_values(columns, row.entry.result.scores)])
    return csv_text(header, rows)


def _values(columns: tuple[Column, ...], scores: Scores) -> list[object]:
    found = [column.score(scores) for column in columns]
    return ["" if score is None or score.value is None else score.value for score in found]


def row_kind(row: Row) -> str:
    """Say in a word why a row has a rank or none: ranked, partial, undefined or baseline."""
    if row.entry.is_baseline:
        return "baseline"
    if not row.entry.is_complete:
        return "partial"
    return "undefined" if row.rank is None else "ranked"


def escape_formula(text: str) -> str:
    """Keep a spreadsheet from running a text as a formula.

    >>> escape_formula("=1+1"), escape_formula("ALOE")
    ("'=1+1", 'ALOE')
    """
    return f"'{text}" if text.startswith(_FORMULA_STARTS) else text


def render_board_latex(board: Board, reference: Reference, people: Scores) -> str:
    """Render a board as a LaTeX table with booktabs rules."""
    columns = board_columns(board, reference)
    blocks = [[_latex_row(["", "System", *(column.title for column in columns)])]]
    if people:
        blocks.append(
            [_latex_row(["", "People", *(column.show(column.score(people)) for column in columns)])]
        )
    groups = (board.ranked, board.partial, board.baselines)
    blocks += [[_latex_entry(row, columns) for row in rows] for rows in groups]
    lines = [*_latex_comments(board, reference), rf"\begin{{tabular}}{{rl{'r' * len(columns)}}}", r"\toprule"]
    lines.append("\n\\midrule\n".join("\n".join(block) for block in blocks if block))
    return "\n".join([*lines, r"\bottomrule", r"\end{tabular}", ""])


def _latex_comments(board: Board, reference: Reference) -> list[str]:
    title, track = escape_latex(reference.benchmark.title), escape_latex(board.track.title)
    comments = [f"% {title}, {track}, reference {reference.manifest.digest}"]
    if reference.is_synthetic:
        comments.append("% SYNTHETIC reference: labels and people are simulated; no figure here is real.")
    return comments


def _latex_entry(row: Row, columns: tuple[Column, ...]) -> str:
    shown = [column.show(column.score(row.entry.result.scores)) for column in columns]
    return _latex_row(["" if row.rank is None else str(row.rank), row.entry.metadata.submission.name, *shown])


def _latex_row(cells: list[str]) -> str:
    return " & ".join("--" if cell == ABSENT else escape_latex(cell) for cell in cells) + r" \\"


def escape_latex(text: str) -> str:
    r"""Write a text so that LaTeX prints it and runs nothing.

    >>> print(escape_latex("50% of $x_1$"))
    50\% of \$x\_1\$
    """
    return "".join(_LATEX_SPECIAL.get(character, character) for character in text)


def render_board_json(board: Board, reference: Reference, people: Scores) -> str:
    """Render a board as JSON with all scores of every row."""
    return canonical_json(
        {
            "benchmark": reference.benchmark.name,
            "version": reference.benchmark.version,
            "reference": {"kind": reference.manifest.kind, "digest": reference.manifest.digest},
            "track": board.track.id,
            "metric": board.metric,
            "people": scores_data(people),
            "rows": [row_data(row) for row in board.rows],
        }
    )


def row_data(row: Row) -> dict[str, object]:
    """Lay out a row of the board for JSON."""
    return {"rank": row.rank, "kind": row_kind(row), **entry_data(row.entry)}


def entry_data(entry: Entry) -> dict[str, object]:
    """Lay out a submission for JSON: what it says of itself and all its scores."""
    metadata = entry.metadata.model_dump(mode="json", exclude_none=True)
    return {
        "slug": entry.slug,
        "metadata": metadata,
        "result": entry.result.model_dump(mode="json", by_alias=True),
    }


def scores_data(scores: Scores) -> dict[str, object]:
    """Lay out scores by scope and subset for JSON."""
    return {
        scope: {name: subset.model_dump() for name, subset in subsets.items()}
        for scope, subsets in scores.items()
    }
