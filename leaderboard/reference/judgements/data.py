"""What is made of files of human data: responses, counts, and an account of every row."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class JudgementOptions:
    """How to read files of human data that leave something open.

    Attributes
    ----------
    columns
        Names of columns by what they hold: ``participant``, ``trial``, ``response``, ``correct``, ``label``,
        ``count`` or ``n_yes``. What is not named is recognised by content. Where ``response`` or ``correct``
        is named, the other of the two is used only if it is named as well.
    allow_unmatched
        Whether answers that name no trial or several, or are neither YES nor NO, are left out instead of
        refused.
    """

    columns: Mapping[str, str] = field(default_factory=dict)
    allow_unmatched: bool = False


@dataclass(frozen=True)
class Response:
    """One person's answer to one trial."""

    participant_id: str
    trial_id: str
    is_yes: bool


@dataclass(frozen=True)
class Rating:
    """How many people judged a trial, and how many of them said YES."""

    n: int
    n_yes: int


@dataclass(frozen=True)
class FileAccount:
    """What became of the answers in one file; of the rows, where it holds counts.

    Attributes
    ----------
    file
        How messages name it.
    layout
        What it was taken for, in words.
    n_rows
        Answers or counts that the file holds; each is in exactly one of the numbers below.
    n_practice
        To practice trials.
    n_empty
        Without an answer, or about no trial.
    n_unmatched, n_ambiguous
        About a name that fits no trial, or several.
    n_unclear
        Neither YES nor NO; of counts, those that do not fit together.
    n_anonymous
        Without a participant where the others have one.
    n_used
        All others.
    """

    file: str
    layout: str
    n_rows: int
    n_practice: int = 0
    n_empty: int = 0
    n_unmatched: int = 0
    n_ambiguous: int = 0
    n_unclear: int = 0
    n_anonymous: int = 0
    n_used: int = 0

    @property
    def n_named(self) -> int:
        """Answers that name a trial or should, which is what the match rate is of."""
        return self.n_rows - self.n_practice - self.n_empty

    @property
    def n_matched(self) -> int:
        """Answers that name exactly one trial."""
        return self.n_named - self.n_unmatched - self.n_ambiguous


@dataclass(frozen=True)
class Account:
    """What became of the files, and of answers that were given more than once.

    Attributes
    ----------
    files
        Those that hold human data, by name.
    other_files
        Those that hold none.
    n_repeated, n_changed
        Further answers of a person to the same trial that are equal to the first, or differ from it.
    n_participants
        People with at least one answer; 0 if only counts are known.
    """

    files: tuple[FileAccount, ...]
    other_files: tuple[str, ...]
    n_repeated: int
    n_changed: int
    n_participants: int


@dataclass(frozen=True)
class Judgements:
    """People's answers as a reference holds them.

    Attributes
    ----------
    responses
        By participant, then in the order of the trials; None if only counts are known of some trials.
    ratings
        Counts of each judged trial, in the order of the trials; of the responses where these are known.
    account
        What became of the files and their rows.
    """

    responses: tuple[Response, ...] | None
    ratings: Mapping[str, Rating]
    account: Account
