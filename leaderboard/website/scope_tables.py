"""Everybody's scores on one property or scenario, a table for each board."""

from collections.abc import Sequence
from dataclasses import dataclass

from leaderboard.grading.observations import NOT_A_PROPERTY
from leaderboard.ranking import Board, Row
from leaderboard.website.boards import NOT_COVERED, NOT_FOR_PEOPLE
from leaderboard.website.describing import submission_path
from leaderboard.website.material import Material
from leaderboard.website.numbers import Footnotes, unit_of
from leaderboard.website.pages import Cell, Column, ScopeRow, ScoreTable
from leaderboard.website.quantities import Described, find_quantity

CEILING = find_quantity("ceiling")


@dataclass(frozen=True)
class ScopeColumn:
    """A score of everybody: which one, on what, and under which title."""

    title: str
    quantity: Described
    scope: str
    subset: str = "all"

    def describe(self) -> Column:
        """Give the heading of the column."""
        unit = unit_of(self.quantity)
        return Column(self.title, unit, self.quantity.name, self.quantity.meaning, self.quantity.direction)


@dataclass(frozen=True)
class Scoped:
    """A property or a scenario: its name in results, what it is, and the columns that it is shown with."""

    name: str
    kind: str
    columns: Sequence[ScopeColumn]


def compose_scope_table(scoped: Scoped, board: Board, material: Material) -> ScoreTable:
    """Tabulate everybody's scores on a property or a scenario."""
    footnotes = Footnotes()
    rows = [_compose_people(scoped, material, footnotes)] if material.people else []
    rows += [_compose_row(row, scoped.columns, footnotes) for row in order_rows(scoped.name, board)]
    return ScoreTable(
        key=board.track.id,
        title=board.track.title,
        caption=(
            f"In order of accuracy on this {scoped.kind}; partial submissions and baselines are not ranked."
        ),
        row_title="Submission",
        count_titles=(),
        columns=tuple(column.describe() for column in scoped.columns),
        rows=tuple(rows),
        footnotes=footnotes.texts,
    )


def order_rows(scope: str, board: Board) -> list[Row]:
    """Put those that cover a property or scenario in the order of their accuracy on it, baselines last."""
    rows = (*board.ranked, *board.partial, *board.baselines)
    covering = (row for row in rows if scope in row.entry.result.scores)
    return sorted(covering, key=lambda row: _place_of(row, scope))


def _place_of(row: Row, scope: str) -> tuple[bool, float, str]:
    score = row.entry.score("accuracy", scope, "all")
    value = score.value if score and score.value is not None else -1.0
    return (row.entry.is_baseline, -value, row.entry.slug)


def _compose_row(row: Row, columns: Sequence[ScopeColumn], footnotes: Footnotes) -> ScopeRow:
    entry = row.entry
    cells = tuple(
        footnotes.cell(c.quantity, entry.score(c.quantity.name, c.scope, c.subset), absent=NOT_COVERED)
        for c in columns
    )
    title = entry.metadata.submission.name + (" (baseline)" if entry.is_baseline else "")
    return ScopeRow(title, 1, (), cells, submission_path(entry.slug))


def _compose_people(scoped: Scoped, material: Material, footnotes: Footnotes) -> ScopeRow:
    """Print people; where submissions have their human r, people have its ceiling."""
    cells = tuple(_print_people(column, scoped, material, footnotes) for column in scoped.columns)
    return ScopeRow("People", 0, (), cells, "people.html")


def _print_people(column: ScopeColumn, scoped: Scoped, material: Material, footnotes: Footnotes) -> Cell:
    if column.quantity.name == "human_r":
        ceiling = material.people_score(CEILING.name, column.scope, column.subset)
        absent = NOT_FOR_PEOPLE if scoped.kind == "property" else f"undefined: {NOT_A_PROPERTY.why}"
        return footnotes.cell(CEILING, ceiling, absent=absent, remark="ceiling")
    score = material.people_score(column.quantity.name, column.scope, column.subset)
    return footnotes.cell(column.quantity, score, absent=NOT_FOR_PEOPLE)
