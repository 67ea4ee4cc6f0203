"""A line of the public record of what was published (``ledger.csv``)."""

import datetime as dt
from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from leaderboard.ids import SLUG_RULE, is_slug
from leaderboard.models.benchmark import Sha256
from leaderboard.models.metadata import Text, check_not_blank
from leaderboard.models.strict import StrictModel

Event = Literal["added", "regraded", "superseded", "flagged", "withdrawn"]

MAX_REASON_LENGTH = 300

_FORMULA_STARTS = "=+-@"  # spreadsheets compute what starts so


def _check_slug(text: str) -> str:
    if not is_slug(text):
        raise ValueError(f"is no slug, which is {SLUG_RULE}")
    return text


def _check_reason(text: str) -> str:
    if text.startswith(tuple(_FORMULA_STARTS)):
        raise ValueError("must not start as a formula does, with =, +, - or @")
    return text


Reason = Annotated[
    Text, Field(max_length=MAX_REASON_LENGTH), AfterValidator(check_not_blank), AfterValidator(_check_reason)
]


class LedgerLine(StrictModel):
    """What happened to a submission, when and why.

    ``result_sha256`` is that of the result which the event made or is about.
    """

    date: dt.date
    slug: Annotated[str, AfterValidator(_check_slug)]
    event: Event
    reason: Reason
    result_sha256: Sha256
