"""What the page of a board shows."""

from dataclasses import dataclass

from leaderboard.website.figure_files import PICTURED
from leaderboard.website.figures.marks import Drawing
from leaderboard.website.pages import Cell, Column, DataFile, Fact, Link, Page

MANY_ROWS = 25


@dataclass(frozen=True)
class BoardColumn(Column):
    """A column of a board.

    ``key`` names it in addresses and downloads; ``first`` is the order that has the best on top, ``asc`` or
    ``desc``, which is what sorting by it does first.
    """

    key: str = ""
    first: str = "desc"


@dataclass(frozen=True)
class ColumnGroup:
    """Columns under one heading."""

    title: str
    columns: tuple[BoardColumn, ...]


@dataclass(frozen=True)
class Traits:
    """What rows are found and sorted by besides numbers; ``place`` is the name's in alphabetical order."""

    place: int
    family: str
    inputs: str
    date: str


@dataclass(frozen=True)
class BoardRow:
    """A line of a board; people have no slug. ``ranks`` are those that it could have as well."""

    slug: str
    rank: str
    ranks: str
    name: str
    badges: tuple[str, ...]
    details: tuple[str, ...]
    cells: tuple[Cell, ...]
    facts: tuple[str, ...]
    traits: Traits | None = None


@dataclass(frozen=True)
class BoardSection:
    """Rows that belong together; ``note`` stands in for them if there are none."""

    kind: str
    title: str
    rows: tuple[BoardRow, ...]
    note: str = ""


@dataclass(frozen=True)
class BoardPage(Page):
    """The board of one track, or a part of it, of which the first one has everything but the other rows.

    Attributes
    ----------
    pairs
        Submissions, A and B, that have a ready-made comparison.
    parts
        All parts, for readers without a script; empty where one page is enough.
    rest
        The rows of the other parts, for the script of the first one.
    """

    tracks: tuple[Link, ...]
    caption: str
    groups: tuple[ColumnGroup, ...]
    fact_titles: tuple[str, ...]
    sections: tuple[BoardSection, ...]
    footnotes: tuple[str, ...]
    drawings: tuple[Drawing, ...]
    figure: Link
    remarks: tuple[Fact, ...]
    comparisons: Link | None
    pairs: tuple[str, ...]
    elsewhere: tuple[Link, ...]
    has_citation: bool
    parts: tuple[Link, ...] = ()
    rest: DataFile | None = None
    is_first: bool = True

    @property
    def figures(self) -> tuple[Drawing, ...]:
        """At a glance."""
        return self.drawings

    @property
    def data_files(self) -> tuple[DataFile, ...]:
        """Rows that are in other pages."""
        return (self.rest,) if self.rest else ()

    @property
    def formats(self) -> tuple[str, ...]:
        """As pictures too: there are few boards."""
        return PICTURED

    @property
    def n_columns(self) -> int:
        """Number of the table's columns."""
        return 2 + sum(len(group.columns) for group in self.groups) + len(self.fact_titles)

    @property
    def has_ranks(self) -> bool:
        """Whether any row says which ranks it could have as well."""
        return any(row.ranks for section in self.sections for row in section.rows)

    @property
    def has_controls(self) -> bool:
        """Whether there is anything to sort, find or choose."""
        return self.is_first and any(
            section.rows for section in self.sections if section.kind in ("ranked", "partial")
        )

    @property
    def is_long(self) -> bool:
        """Whether the table had better scroll in a box of its own, under headings that stay."""
        return sum(len(section.rows) for section in self.sections) > MANY_ROWS
