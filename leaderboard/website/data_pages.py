"""What the page of the data shows."""

from dataclasses import dataclass

from leaderboard.website.pages import Fact, Page


@dataclass(frozen=True)
class SheetRow:
    """An assumption: what is expected, what was found, how it fares, and the code of its findings."""

    assumption: str
    expected: str
    found: str
    status: str
    code: str


@dataclass(frozen=True)
class Sheet:
    """A table of assumptions; ``key`` names it within the page, ``note`` explains it."""

    key: str
    title: str
    rows: tuple[SheetRow, ...]
    note: str


@dataclass(frozen=True)
class SourceRow:
    """An official file; ``target`` is empty where its address is no web link."""

    what: str
    url: str
    target: str
    member: str
    sha256: str
    modified: str


@dataclass(frozen=True)
class FindingRow:
    """A finding: its code, what was found where, and why it is accepted (empty where it is not)."""

    code: str
    message: str
    place: str
    reason: str


@dataclass(frozen=True)
class DataPage(Page):
    """What the data are, where they come from, and whether they are as they should be."""

    about: tuple[Fact, ...]
    sources: tuple[SourceRow, ...]
    no_sources: str
    files: tuple[Fact, ...]
    sheets: tuple[Sheet, ...]
    findings: tuple[FindingRow, ...]
    n_unlisted: int
    accepted: tuple[FindingRow, ...]
    dropped: tuple[Fact, ...]
