"""What each page shows, gathered before anything is written; templates only print it."""

from dataclasses import dataclass

MANY_ROWS = 25
FEW_COLUMNS = 5


@dataclass(frozen=True)
class Cell:
    """One printed number.

    Attributes
    ----------
    text
        As a reader sees it.
    exact
        With all digits of the result; empty where there is no value.
    interval, ends
        Its 95 % interval as a reader sees it, and both ends with all digits; empty where there is none.
    remark
        Words below the number.
    why
        The reason why there is no value; empty where there is one.
    n_undefined
        Resamples without a value, which the interval leaves out.
    note
        The number of the footnote that tells of either; 0 without one.
    """

    text: str
    exact: str = ""
    interval: str = ""
    ends: tuple[str, ...] = ()
    remark: str = ""
    why: str = ""
    n_undefined: int = 0
    note: int = 0

    @property
    def title(self) -> str:
        """The exact value, for a pointer that rests on it."""
        parts = [self.exact]
        if self.ends:
            parts.append(f"95 % interval {' to '.join(self.ends)}")
        if self.n_undefined:
            parts.append(f"{self.n_undefined:,} resamples without a value")
        return ", ".join(parts)


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
    """A line of a board; people have no slug. ``ranks`` are those that it could have as well."""

    slug: str
    rank: str
    ranks: str
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
    def has_ranks(self) -> bool:
        """Whether any row says which ranks it could have as well."""
        return any(row.ranks for section in self.sections for row in section.rows)

    @property
    def is_long(self) -> bool:
        """Whether the table had better scroll in a box of its own, under headings that stay."""
        return sum(len(section.rows) for section in self.sections) > MANY_ROWS


@dataclass(frozen=True)
class Tile:
    """A headline number of a submission, with lines of comparison."""

    title: str
    cell: Cell
    unit: str
    below: tuple[str, ...]


@dataclass(frozen=True)
class ScopeRow:
    """The scores of one scope; ``level`` is 0 for overall, 1 for a property or a bin, 2 for a scenario."""

    title: str
    level: int
    counts: tuple[str, ...]
    cells: tuple[Cell, ...]


@dataclass(frozen=True)
class ScoreTable:
    """A table of numbers under explained columns, such as all scores of one subset.

    ``key`` names it within its page; ``omitted`` are metrics that have no value anywhere in it, by reason.
    """

    key: str
    title: str
    caption: str
    row_title: str
    count_titles: tuple[str, ...]
    columns: tuple[Column, ...]
    rows: tuple[ScopeRow, ...]
    footnotes: tuple[str, ...]
    omitted: tuple[Fact, ...] = ()

    @property
    def is_narrow(self) -> bool:
        """Whether it had better not be stretched over the whole page."""
        return len(self.columns) <= FEW_COLUMNS


@dataclass(frozen=True)
class GainLine:
    """What a system gains from inferring properties: words, the submission without, and how sure it is."""

    before: str
    without: Link
    after: str


@dataclass(frozen=True)
class SubmissionPage(Page):
    """Everything about one submission."""

    slug: str
    team: str
    badges: tuple[str, ...]
    standing: str
    gain: GainLine | None
    board: Link
    tiles: tuple[Tile, ...]
    checks: tuple[Fact, ...]
    tables: tuple[ScoreTable, ...]
    calibrations: tuple[ScoreTable, ...]
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
    others: tuple[MetricEntry, ...]
    people: ScoreTable | None
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
