"""A number that somebody published (one row of ``published.csv``)."""

import re
from fractions import Fraction
from typing import Annotated, Self

from pydantic import AfterValidator, Field, model_validator

from leaderboard.metrics.published import Figure
from leaderboard.models.metadata import Auxiliary, Link, NameText, Testing, Text, Training
from leaderboard.models.strict import StrictModel

ACCURACY = "accuracy"
MAX_TRIALS = 100_000

_DECIMAL = re.compile(r"(?P<number>-?[0-9]+(?:\.(?P<decimals>[0-9]+))?)(?P<percent> ?%)?")
_RATIO = re.compile(r"(?P<k>[0-9]+)/(?P<n>[1-9][0-9]*)")


def parse_figure(printed: str) -> Figure:
    """Read a printed figure as a share or another number in [-1, 1].

    One rule for the unit: ``229/384`` is an exact share; a number with the sign ``%``, or above 1 (or below
    -1) without it, is a percentage; any other number is taken as it stands. So 52.6 and 60% are percentages,
    0.526 is the share that 52.6 is, and 0.12 is a correlation.

    Raises
    ------
    ValueError
        If it is no figure, or lies outside -1 to 1.

    Examples
    --------
    >>> parse_figure("52.6")
    Figure(value=Fraction(263, 500), step=Fraction(1, 1000))
    >>> parse_figure("229/384")
    Figure(value=Fraction(229, 384), step=Fraction(0, 1))
    """
    if ratio := _RATIO.fullmatch(printed):
        figure = Figure(Fraction(int(ratio["k"]), int(ratio["n"])), Fraction(0))
    elif decimal := _DECIMAL.fullmatch(printed):
        value = Fraction(decimal["number"])
        unit = 100 if decimal["percent"] or abs(value) > 1 else 1
        figure = Figure(value / unit, Fraction(1, unit * 10 ** len(decimal["decimals"] or "")))
    else:
        raise ValueError("must be a number such as 52.6, 60% or 0.12, or a share such as 229/384")
    if abs(figure.value) > 1:
        raise ValueError("is more than the whole")
    return figure


def _check_figure(printed: str) -> str:
    parse_figure(printed)
    return printed


Metric = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$", max_length=40)]
PrintedText = Annotated[str, Field(max_length=20), AfterValidator(_check_figure)]


class PublishedNumber(StrictModel):
    """A figure of a paper that cannot be graded again, exactly as printed; what is unknown is None.

    ``scope`` is ``overall``, a property, or the paper's own subset; ``n`` the trials behind the figure.
    """

    source: NameText
    url: Link | None = None
    system: NameText
    training: Training | None = None
    testing: Testing | None = None
    training_trials: int | None = Field(default=None, ge=0, le=1_000_000_000_000)
    auxiliary: Auxiliary | None = None
    scope: NameText
    metric: Metric
    printed: PrintedText
    n: int | None = Field(default=None, ge=1, le=MAX_TRIALS)
    note: Text = ""

    @model_validator(mode="after")
    def _check_printed(self) -> Self:
        if self.metric == ACCURACY and self.figure.value < 0:
            raise ValueError(f"printed is {self.printed}: an accuracy is not negative")
        if ratio := _RATIO.fullmatch(self.printed):
            if int(ratio["n"]) > MAX_TRIALS:
                raise ValueError(f"printed is {self.printed}: more than {MAX_TRIALS:,} trials")
            if self.n not in (None, int(ratio["n"])):
                raise ValueError(f"printed is {self.printed}, but n is {self.n}")
        return self

    @property
    def figure(self) -> Figure:
        """What is printed, as a number; see `parse_figure` for the unit."""
        return parse_figure(self.printed)

    @property
    def n_trials(self) -> int | None:
        """The trials behind the figure: ``n``, or what a printed share is a share of; None if unknown."""
        ratio = _RATIO.fullmatch(self.printed)
        return int(ratio["n"]) if ratio else self.n
