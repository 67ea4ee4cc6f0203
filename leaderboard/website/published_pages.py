"""What the page of published numbers shows."""

from dataclasses import dataclass

from leaderboard.website.pages import Fact, Page


@dataclass(frozen=True)
class PublishedCell:
    """A figure as printed; ``details`` says what it can stand for, ``flags`` are words with footnotes.

    All are empty where the source prints nothing.
    """

    printed: str = ""
    details: tuple[str, ...] = ()
    flags: tuple[str, ...] = ()


@dataclass(frozen=True)
class PublishedRow:
    """A system and its figures, one for each column."""

    system: str
    cells: tuple[PublishedCell, ...]


@dataclass(frozen=True)
class PublishedTable:
    """What one source prints of one protocol; ``key`` names it within the page."""

    key: str
    title: str
    note: str
    columns: tuple[str, ...]
    rows: tuple[PublishedRow, ...]


@dataclass(frozen=True)
class PublishedSource:
    """A source and its tables; ``target`` is empty where it has no address."""

    title: str
    target: str
    tables: tuple[PublishedTable, ...]


@dataclass(frozen=True)
class PublishedPage(Page):
    """Numbers that cannot be graded again; ``flags`` explains every flag that is set."""

    sources: tuple[PublishedSource, ...]
    flags: tuple[Fact, ...]
