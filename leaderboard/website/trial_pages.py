"""What the list of trials and the page of a trial show."""

from dataclasses import dataclass

from leaderboard.website.pages import Fact, Link, Page


@dataclass(frozen=True)
class TrialCell:
    """A trial in the list: its page, its label, how many percent of how many people said YES.

    ``people`` and ``n`` are empty where nobody judged it.
    """

    target: str
    label: str
    people: str
    n: str


@dataclass(frozen=True)
class TrialRow:
    """A pair, or a trial without a twin, and how many ranked submissions got how many of it right."""

    key: str
    name: str
    members: tuple[TrialCell, ...]
    counts: tuple[str, ...]


@dataclass(frozen=True)
class TrialTable:
    """Pairs of a scenario, or its trials without a twin."""

    key: str
    title: str
    caption: str
    row_title: str
    member_titles: tuple[str, ...]
    count_titles: tuple[str, ...]
    rows: tuple[TrialRow, ...]


@dataclass(frozen=True)
class TrialGroup:
    """A scenario and its tables; ``key`` names it within the page."""

    key: str
    title: str
    tables: tuple[TrialTable, ...]


@dataclass(frozen=True)
class TrialSection:
    """A property, its page, and its scenarios."""

    title: str
    target: str
    groups: tuple[TrialGroup, ...]


@dataclass(frozen=True)
class TrialChoices:
    """Lists of trials that are chosen by one thing, such as the property."""

    title: str
    lists: tuple[Link, ...]


@dataclass(frozen=True)
class TrialListPage(Page):
    """A list of trials: of one property, or with something in common."""

    choices: tuple[TrialChoices, ...]
    has_people: bool
    note: str
    sections: tuple[TrialSection, ...]


@dataclass(frozen=True)
class GridCell:
    """A pair, or a trial without a twin, as a square.

    Attributes
    ----------
    target
        Its row in a list.
    text
        How much of it is right.
    level
        The same from 0 to 4, as a shade; nothing where nobody said anything.
    title
        Its name, and what the text counts.
    """

    target: str
    text: str
    level: str
    title: str


@dataclass(frozen=True)
class GridRow:
    """A scenario, the list of its trials, and a square for each row of that."""

    link: Link
    cells: tuple[GridCell, ...]


@dataclass(frozen=True)
class GridSection:
    """A property and its scenarios; ``key`` names it within the page."""

    key: str
    title: str
    rows: tuple[GridRow, ...]


@dataclass(frozen=True)
class GridPage(Page):
    """All trials at a glance: for people, or, with a way back to its page, for a submission.

    ``legend`` is levels and what they stand for, lowest first; ``table`` is the same trials as data.
    """

    back: Link | None
    choices: tuple[TrialChoices, ...]
    note: str
    legend: tuple[tuple[str, str], ...]
    sections: tuple[GridSection, ...]
    table: Link | None = None


@dataclass(frozen=True)
class Said:
    """P(YES) of one trial as printed and with all digits, and whether it is right, as a sign and in words.

    ``exact`` is empty where there is no answer.
    """

    probability: str
    exact: str
    mark: str
    verdict: str


@dataclass(frozen=True)
class Answer:
    """What somebody says of a trial, and of its twin, if it has one."""

    who: Link
    said: tuple[Said, ...]


@dataclass(frozen=True)
class TrialPage(Page):
    """Everything about one trial; ``twin`` is the other trial of its pair, ``people`` one answer or none."""

    row: Link
    property: Link
    scenario: Link
    facts: tuple[Fact, ...]
    twin: Link | None
    people: tuple[Answer, ...]
    answers: tuple[Answer, ...]
    note: str
