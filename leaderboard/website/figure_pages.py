"""What the pages of the paper's figure and of people show."""

from dataclasses import dataclass

from leaderboard.website.figure_files import PICTURED, Export
from leaderboard.website.figures.marks import Drawing
from leaderboard.website.pages import Fact, Link, Page, ScoreTable


@dataclass(frozen=True)
class FigurePage(Page):
    """The figure of the paper for one track: panels in rows of three."""

    tracks: tuple[Link, ...]
    panels: tuple[Drawing, ...]

    @property
    def figures(self) -> tuple[Drawing, ...]:
        """Its panels."""
        return self.panels

    @property
    def sheet(self) -> Export:
        """All panels together, as in the paper."""
        return Export("panels", self.panels, PICTURED, n_abreast=3)

    @property
    def exports(self) -> tuple[Export, ...]:
        """Each panel, and all together."""
        return (*super().exports, self.sheet) if self.panels else ()


@dataclass(frozen=True)
class PeoplePage(Page):
    """What people did; no drawings and no table without human data."""

    facts: tuple[Fact, ...]
    drawings: tuple[Drawing, ...]
    table: ScoreTable | None

    @property
    def figures(self) -> tuple[Drawing, ...]:
        """What people did, drawn."""
        return self.drawings

    @property
    def formats(self) -> tuple[str, ...]:
        """As pictures too: there is one such page."""
        return PICTURED
