"""The board of a track as a terminal table, CSV, LaTeX and JSON; all from one list of columns."""

from collections.abc import Callable
from dataclasses import asdict, dataclass

from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from leaderboard.files import canonical_json, csv_text
from leaderboard.grading import Scores
from leaderboard.metrics.undefined import Undefined
from leaderboard.models import Score
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Board, Entry, Row
from leaderboard.reference import Reference
from leaderboard.report.terminal import (
    Terminal,
    format_interval,
    format_number,
    format_percent,
    new_table,
    reference_banner,
    render_tables,
)

WIDE = 150
ALPHA = 0.05
BEST_MARK = "†"
MAX_NARROW_TITLE = 8
NARROW_NOTE = "A wider terminal shows easy and hard trials and pairs too."

# With their wide forms, which spreadsheets in some languages take for the same.
_FORMULA_STARTS = (*"=+-@", *"\uff1d\uff0b\uff0d\uff20", "\t", "\r")


@dataclass(frozen=True)
class Column:
    """A score of the board: where it is found and how it is shown."""

    title: str
    metric: str
    scope: str = OVERALL
    subset: str = "all"
    show: Callable[[Score | None], str] = format_percent
    is_interval: bool = False

    @property
    def keys(self) -> list[str]:
        """Its names in CSV: metric, scope, subset where it is not all, and both ends of an interval."""
        name = ".".join(part for part in (self.metric, self.scope, self.subset) if part != "all")
        return [f"{name}.low", f"{name}.high"] if self.is_interval else [name]

    def score(self, scores: Scores) -> Score | None:
        """Look it up in a submission's or the people's scores."""
        found = scores.get(self.scope, {}).get(self.subset)
        return found.metrics.get(self.metric) if found else None


def board_columns(board: Board, reference: Reference) -> tuple[Column, ...]:
    """Choose the columns: the metric that orders the board, accuracy by property, people, pairs."""
    columns = [
        Column("accuracy", "accuracy"),
        Column("95 %", "accuracy", show=_show_interval, is_interval=True),
    ]
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
    facts = _row_facts(board, is_narrow=is_narrow)
    table = new_table(["system", *facts, *titles])
    if people:
        shown = (column.show(column.score(people)) for column in columns)
        table.add_row("   People", *("" for _ in facts), *shown, style="cyan")
        table.add_section()
    for rows, style in ((board.ranked, ""), (board.partial, ""), (board.baselines, "dim")):
        for row in rows:
            shown = (column.show(column.score(row.entry.result.scores)) for column in columns)
            table.add_row(_name_row(row), *(show(row) for show in facts.values()), *shown, style=style)
        table.add_section()
    heading = Text(board.track.title, "bold").append("\n").append(reference_banner(reference))
    notes = _board_notes(board) + ([NARROW_NOTE] if is_narrow else [])
    return render_tables([heading, "", table, *(Text(note, "dim") for note in notes)], terminal)


def _show_interval(score: Score | None) -> str:
    return format_interval(score, format_percent)


def _row_facts(board: Board, *, is_narrow: bool) -> dict[str, Callable[[Row], str]]:
    """Choose the columns that say how sure a rank is and what a system gains, as far as any row has them."""
    facts: dict[str, Callable[[Row], str]] = {}
    if any(row.standing for row in board.ranked):
        facts |= {"ranks": _show_ranks} | ({} if is_narrow else {"best, %": _show_best})
    if any(row.gain for row in board.ranked):
        facts["gain"] = _show_gain
    return facts


def _show_ranks(row: Row) -> str:
    if row.standing is None:
        return ""
    low, high = row.standing.low, row.standing.high
    return (f"{low}" if low == high else f"{low} to {high}") + (
        BEST_MARK if row.standing.is_among_best else " "
    )


def _show_best(row: Row) -> str:
    return "" if row.standing is None else f"{100 * row.standing.best_probability:.0f}"


def _show_gain(row: Row) -> str:
    if row.gain is None:
        return ""
    return f"{100 * row.gain.value:+.1f}" + ("*" if row.gain.p < ALPHA else " ")


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
    notes = [f"Shares in %. {_describe_ranks(board)} Whether two differ: leaderboard compare A B."]
    if isinstance(board.detectable, float):
        notes.append(f"A true difference of {100 * board.detectable:.1f} points is found 4 times in 5.")
    if any(row.gain for row in board.ranked):
        notes.append(f"gain: points over the system without property inference; * exact paired p < {ALPHA}.")
    if not board.ranked and not board.partial:
        notes.insert(0, "No submission on this track yet.")
    if board.partial:
        names = ", ".join(row.entry.metadata.submission.name for row in board.partial)
        notes.append(f"Not ranked, because not all properties are covered: {names}.")
    if board.baselines:
        notes.append("Below the line: baselines, for reference.")
    return notes


def _describe_ranks(board: Board) -> str:
    if not any(row.standing for row in board.ranked):
        return "Equal scores share a rank."
    return f"ranks: 95 % rank set, {BEST_MARK} not distinguishable from the best."


def render_board_csv(board: Board, reference: Reference, people: Scores) -> str:
    """Render a board as CSV with full precision; what a spreadsheet could run gets a leading apostrophe."""
    columns = board_columns(board, reference)
    header = [
        "rank",
        "rank_low",
        "rank_high",
        "kind",
        "slug",
        "name",
        "team",
        "date",
        "reference",
        *(key for column in columns for key in column.keys),
    ]
    kind = reference.manifest.kind
    rows: list[list[object]] = []
    if people:
        rows.append(["", "", "", "people", "", "People", "", "", kind, *_values(columns, people)])
    for row in board.rows:
        about = row.entry.metadata.submission
        texts = [
            row.entry.slug,
            escape_formula(about.name),
            escape_formula(about.team),
            about.date.isoformat(),
            kind,
        ]
        ranks = [row.standing.low, row.standing.high] if row.standing else ["", ""]
        rows.append(
            [row.rank or "", *ranks, row_kind(row), *texts, *_values(columns, row.entry.result.scores)]
        )
    return csv_text(header, rows)


def _values(columns: tuple[Column, ...], scores: Scores) -> list[object]:
    found = [(column.score(scores), column.is_interval) for column in columns]
    values: list[object] = []
    for score, is_interval in found:
        ends = [score.low, score.high] if score and is_interval else [None, None] if is_interval else []
        values += ends if is_interval else [score.value if score else None]
    return ["" if value is None else value for value in values]


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
            "detectable_difference": board_detectable(board),
            "rows": [row_data(row) for row in board.rows],
        }
    )


def row_data(row: Row) -> dict[str, object]:
    """Lay out a row of the board for JSON."""
    standing: dict[str, object] = {}
    if row.standing:
        standing = {
            "rank_set": [row.standing.low, row.standing.high],
            "best_probability": row.standing.best_probability,
            "among_best": row.standing.is_among_best,
        }
    gain = {"property_gain": asdict(row.gain)} if row.gain else {}
    return {"rank": row.rank, "kind": row_kind(row), **standing, **gain, **entry_data(row.entry)}


def board_detectable(board: Board) -> dict[str, object]:
    """Lay out the smallest difference in accuracy that the board's pairs can tell, or why there is none."""
    if isinstance(board.detectable, Undefined):
        return {"value": None, "why": board.detectable.why}
    return {"value": board.detectable}


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
