"""What the pages of a property and of a scenario show."""

from dataclasses import dataclass

from leaderboard.website.figures.marks import Drawing
from leaderboard.website.pages import Fact, Link, Page, ScoreTable


@dataclass(frozen=True)
class PropertyPage(Page):
    """One property, or one scenario of it, and everybody's scores on it, a table for each track.

    Attributes
    ----------
    whole
        The property, on the page of a scenario.
    siblings
        Pages of the same kind: all properties, or all scenarios of one.
    parts
        Scenarios of the property that have pages, and how many trials each has.
    trials
        The list of its trials.
    """

    whole: Link | None
    siblings_title: str
    siblings: tuple[Link, ...]
    parts: tuple[Link, ...]
    drawings: tuple[Drawing, ...]
    tables: tuple[ScoreTable, ...]
    facts: tuple[Fact, ...]
    trials: Link

    @property
    def figures(self) -> tuple[Drawing, ...]:
        """What is drawn on it."""
        return self.drawings
