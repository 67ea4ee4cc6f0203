"""What each page shows, gathered before anything is written; templates only print it."""

from dataclasses import dataclass

MANY_ROWS = 25


@dataclass(frozen=True)
class Cell:
    """One printed number.

    Attributes
    ----------
    text
        As a reader sees it.
    exact
        With all digits of the result; empty where there is no value.
    why, note
        The reason why there is no value and the number of its footnote; empty and 0 where there is one.
    """

    text: str
    exact: str = ""
    why: str = ""
    note: int = 0


@dataclass(frozen=True)
class Column:
    """A column of numbers: its title, a small line below it, and the metric that explains it.

    ``direction`` says which end is better, where that is said: higher, lower, or nothing.
    """

    title: str
    below: str
    metric: str
    meaning: str
    direction: str = ""
    is_people: bool = False


@dataclass(frozen=True)
class ColumnGroup:
    """Columns under one heading."""

    title: str
    columns: tuple[Column, ...]


@dataclass(frozen=True)
class Link:
    """A link within the site (a path from its root) or out of it (a whole address)."""

    title: str
    target: str
    below: str = ""
    is_current: bool = False


@dataclass(frozen=True)
class Fact:
    """A line of a list of facts; with a target it links out of the site."""

    title: str
    text: str
    target: str = ""
    is_code: bool = False


@dataclass(frozen=True)
class BoardRow:
    """A line of a board; people have no slug."""

    slug: str
    rank: str
    name: str
    badges: tuple[str, ...]
    details: tuple[str, ...]
    cells: tuple[Cell, ...]
    facts: tuple[str, ...]


@dataclass(frozen=True)
class BoardSection:
    """Rows that belong together; ``note`` stands in for them if there are none."""

    kind: str
    title: str
    rows: tuple[BoardRow, ...]
    note: str = ""


@dataclass(frozen=True)
class Page:
    """What every page has: where it is, what it is called, and what it is about."""

    path: str
    title: str
    summary: str

    @property
    def up(self) -> str:
        """The way from this page to the root of the site, so that links work from any place."""
        return "../" * self.path.count("/")


@dataclass(frozen=True)
class BoardPage(Page):
    """The board of one track."""

    tracks: tuple[Link, ...]
    caption: str
    groups: tuple[ColumnGroup, ...]
    fact_titles: tuple[str, ...]
    sections: tuple[BoardSection, ...]
    footnotes: tuple[str, ...]
    remarks: tuple[Fact, ...]
    elsewhere: tuple[Link, ...]

    @property
    def n_columns(self) -> int:
        """Number of the table's columns."""
        return 2 + sum(len(group.columns) for group in self.groups) + len(self.fact_titles)

    @property
    def is_long(self) -> bool:
        """Whether the table had better scroll in a box of its own, under headings that stay."""
        return sum(len(section.rows) for section in self.sections) > MANY_ROWS


@dataclass(frozen=True)
class Tile:
    """A headline number of a submission, with a line of comparison."""

    title: str
    cell: Cell
    unit: str
    below: str


@dataclass(frozen=True)
class ScopeRow:
    """The scores of one scope; ``level`` is 0 for overall, 1 for a property, 2 for a scenario."""

    title: str
    level: int
    counts: tuple[str, ...]
    cells: tuple[Cell, ...]


@dataclass(frozen=True)
class ScoreTable:
    """All scores of one subset; ``omitted`` are metrics that have no value anywhere in it, by reason."""

    subset: str
    title: str
    caption: str
    count_titles: tuple[str, ...]
    columns: tuple[Column, ...]
    rows: tuple[ScopeRow, ...]
    footnotes: tuple[str, ...]
    omitted: tuple[Fact, ...]


@dataclass(frozen=True)
class SubmissionPage(Page):
    """Everything about one submission."""

    slug: str
    team: str
    badges: tuple[str, ...]
    standing: str
    board: Link
    tiles: tuple[Tile, ...]
    checks: tuple[Fact, ...]
    tables: tuple[ScoreTable, ...]
    about: tuple[Fact, ...]
    downloads: tuple[Link, ...]
    provenance: tuple[Fact, ...]


@dataclass(frozen=True)
class MetricEntry:
    """What a reader should know of a metric."""

    name: str
    title: str
    meaning: str
    direction: str
    range: str
    chance: str


@dataclass(frozen=True)
class MethodPage(Page):
    """What every number means."""

    metrics: tuple[MetricEntry, ...]
    terms: tuple[Fact, ...]


@dataclass(frozen=True)
class FeedItem:
    """A submission as news."""

    id: str
    slug: str
    title: str
    author: str
    updated: str
    summary: str


@dataclass(frozen=True)
class Feed:
    """The news feed."""

    id: str
    title: str
    updated: str
    entries: tuple[FeedItem, ...]


@dataclass(frozen=True)
class Frame:
    """What surrounds every page: title, synthetic or not, navigation and provenance of the numbers."""

    title: str
    is_synthetic: bool
    benchmark: str
    reference_kind: str
    reference_digest: str
    grader: str
    metrics_version: int
    stylesheet: str
    icon: str
