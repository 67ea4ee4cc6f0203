"""What each page shows, gathered before anything is written; templates only print it."""

from dataclasses import dataclass

from leaderboard.website.figure_files import MAX_PICTURE, Export
from leaderboard.website.figures.marks import Drawing

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
class DataFile:
    """Data for a page's script: where the file is, and its bytes."""

    path: str
    content: bytes


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

    @property
    def figures(self) -> tuple[Drawing, ...]:
        """What is drawn on it."""
        return ()

    @property
    def data_files(self) -> tuple[DataFile, ...]:
        """What its script loads besides the page."""
        return ()

    @property
    def figures_dir(self) -> str:
        """Where the files of its figures are, seen from the page."""
        stem = self.path.rpartition("/")[2].removesuffix(".html")
        return "figures/" if stem == "index" else f"figures/{stem}/"

    @property
    def formats(self) -> tuple[str, ...]:
        """In which formats its figures can be had; a PNG takes as long as a hundred SVGs."""
        return ("svg", "csv")

    def formats_of(self, drawing: Drawing) -> tuple[str, ...]:
        """In which formats a figure can be had: a list of hundreds is no picture."""
        is_picture = drawing.height <= MAX_PICTURE
        return tuple(ending for ending in self.formats if is_picture or ending != "png")

    @property
    def exports(self) -> tuple[Export, ...]:
        """What of its figures can be had as files of their own."""
        return tuple(Export(drawing.key, (drawing,), self.formats_of(drawing)) for drawing in self.figures)


@dataclass(frozen=True)
class Tile:
    """A headline number of a submission, with lines of comparison."""

    title: str
    cell: Cell
    unit: str
    below: tuple[str, ...]


@dataclass(frozen=True)
class ScopeRow:
    """Scores of one scope, or of one submission, which then has a page as its target.

    ``level`` is 0 for overall or people, 1 for a property, a bin or a submission, 2 for a scenario.
    """

    title: str
    level: int
    counts: tuple[str, ...]
    cells: tuple[Cell, ...]
    target: str = ""


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
class Disagreement:
    """A trial, its label, and what a submission and the n people who judged it say of it."""

    trial: Link
    probability: str
    exact: str
    people: str
    n: str
    label: str
    verdict: str


@dataclass(frozen=True)
class Badge:
    """A badge as it is drawn: two fields side by side, the words of each and how wide it is.

    ``back`` is the colour behind the message, dark enough for white letters.
    """

    label: str
    message: str
    label_width: float
    message_width: float
    back: str

    @property
    def width(self) -> float:
        """How wide the badge is."""
        return self.label_width + self.message_width

    @property
    def words(self) -> str:
        """What it says, for whoever cannot see it."""
        return f"{self.label}: {self.message}"


@dataclass(frozen=True)
class SubmissionPage(Page):
    """Everything about one submission."""

    slug: str
    team: str
    badges: tuple[str, ...]
    standing: str
    gain: GainLine | None
    comparisons: tuple[Link, ...]
    board: Link
    tiles: tuple[Tile, ...]
    checks: tuple[Fact, ...]
    drawings: tuple[Drawing, ...]
    trials: Link
    disagreements: tuple[Disagreement, ...]
    tables: tuple[ScoreTable, ...]
    diagrams: tuple[Drawing, ...]
    calibrations: tuple[ScoreTable, ...]
    about: tuple[Fact, ...]
    downloads: tuple[Link, ...]
    provenance: tuple[Fact, ...]
    history: tuple[Fact, ...]
    citation: str
    badge: Badge
    snippets: tuple[Fact, ...]
    has_address: bool

    @property
    def figures(self) -> tuple[Drawing, ...]:
        """At a glance, and calibration."""
        return (*self.drawings, *self.diagrams)


@dataclass(frozen=True)
class Frame:
    """What surrounds every page: title, synthetic or not, navigation and provenance of the numbers.

    ``properties`` is the path of the first property's page, which leads to the others; ``scripts`` are what
    enhances a board, ``comparer`` is what compares; ``logo`` is empty without one,
    ``site`` is where the site is served, empty where that is not known, and ``preview`` a picture of it.
    """

    title: str
    properties: str
    is_synthetic: bool
    benchmark: str
    reference_kind: str
    reference_digest: str
    commit: str
    grader: str
    metrics_version: int
    stylesheet: str
    icon: str
    logo: str
    site: str
    preview: str
    scripts: tuple[str, ...]
    comparer: str
