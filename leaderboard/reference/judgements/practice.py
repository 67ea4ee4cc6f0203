"""Telling practice from what counts: by the row's condition, a flag beside it, or the trial's name."""

import re
from collections.abc import Iterable

from leaderboard.reference.judgements.answers import parse_answer
from leaderboard.reference.judgements.columns import CONDITIONS, simplify
from leaderboard.reference.judgements.matching import TrialMatcher
from leaderboard.reference.source_tables import SourceRow

_WORDS = re.compile(
    r"practi[cs]e|familiari[sz]|warm.?up|tutorial|instruction|attention|catch"
    r"|(?:^|[^a-z])(?:fam|demo|example|train|training)(?:[^a-z]|$)"
)
_FLAG = re.compile(r"(?:is)?(?:practi[cs]e|familiari[sz]ation|fam|catch|attentioncheck)(?:trial)?")


def is_practice_name(text: str) -> bool:
    """Tell whether a name or condition says that it is not of the test itself.

    >>> is_practice_name("familiarization_prediction"), is_practice_name("prediction")
    (True, False)
    """
    return _WORDS.search(text.casefold()) is not None


def is_practice(name: str, matcher: TrialMatcher) -> bool:
    """Tell whether a name says that it is of no test trial; one that means a test trial never does."""
    return is_practice_name(name) and matcher.find(name) is None


class PracticeMarks:
    """Finds the rows of a table that are marked as practice.

    Parameters
    ----------
    header
        The table's columns, of which some may hold conditions or flags.
    """

    def __init__(self, header: Iterable[str]) -> None:
        columns = [(column, simplify(column)) for column in header]
        self._conditions = [column for column, name in columns if name in CONDITIONS]
        self._flags = [column for column, name in columns if _is_flag(name)]

    def are_on(self, row: SourceRow) -> bool:
        """Tell whether a row is marked."""
        return any(is_practice_name(row[column]) for column in self._conditions) or any(
            parse_answer(row[column]) is True for column in self._flags
        )


def _is_flag(name: str) -> bool:
    return (
        re.fullmatch(r"(?:is)?(?:practice|familiari[sz]ation|fam|catch|attentioncheck)(?:trial)?", name)
        is not None
    )
