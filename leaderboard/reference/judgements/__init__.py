"""People's answers from files of unknown layout: recognised by content, checked, counted, made anonymous."""

from leaderboard.reference.judgements.data import (
    Account,
    FileAccount,
    JudgementOptions,
    Judgements,
    Rating,
    Response,
)
from leaderboard.reference.judgements.parsing import parse_judgements

__all__ = [
    "Account",
    "FileAccount",
    "JudgementOptions",
    "Judgements",
    "Rating",
    "Response",
    "parse_judgements",
]
