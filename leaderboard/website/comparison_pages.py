"""What the pages show that compare two submissions, and the page that lists them."""

from dataclasses import dataclass

from leaderboard.website.figures.marks import Drawing
from leaderboard.website.pages import DataFile, Fact, Link, Page, ScoreTable


@dataclass(frozen=True)
class Side:
    """One of the two: the letter that stands for it, its page, and where it stands."""

    letter: str
    link: Link


@dataclass(frozen=True)
class TrialLine:
    """A trial, its label, and P(YES) of A, of B and of people; each as printed and with all digits."""

    trial: Link
    label: str
    probabilities: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class ComparisonPage(Page):
    """Two submissions side by side; ``has_people`` says whether trials tell what people answered."""

    board: Link
    sides: tuple[Side, ...]
    verdict: str
    drawings: tuple[Drawing, ...]
    tables: tuple[ScoreTable, ...]
    trials: tuple[TrialLine, ...]
    has_people: bool
    notes: tuple[Fact, ...]

    @property
    def figures(self) -> tuple[Drawing, ...]:
        """What tells the two apart."""
        return self.drawings


@dataclass(frozen=True)
class Choice:
    """A submission that can be chosen, and the file of its answers."""

    slug: str
    name: str
    file: DataFile


@dataclass(frozen=True)
class ComparisonsPage(Page):
    """Any two to six submissions, by a script; and the ready-made comparisons, a table for each board.

    Attributes
    ----------
    choices
        Who can be compared.
    ground
        What the script needs of the reference.
    """

    tables: tuple[ScoreTable, ...]
    choices: tuple[Choice, ...]
    ground: DataFile

    @property
    def data_files(self) -> tuple[DataFile, ...]:
        """All that the script loads."""
        return (self.ground, *(choice.file for choice in self.choices))
