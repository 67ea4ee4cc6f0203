"""Which column holds what, judged by its cells where its name leaves it open."""

from collections import Counter
from collections.abc import Iterable, Sequence
from fractions import Fraction

from leaderboard.reference.judgements.answers import is_empty, is_number, parse_answer
from leaderboard.reference.judgements.columns import find_columns, has_digits, is_known
from leaderboard.reference.judgements.matching import TrialMatcher
from leaderboard.reference.source_tables import SourceRow, SourceTable
from leaderboard.trial_names import Ambiguous

# A column of people has at most one in ten answers to a trial that the person has answered already.
_MAX_REPEATED = Fraction(1, 10)
# So many people who all gave the label as their answer are none: the column is the label.
_MIN_ANSWERS = 8


def find_trial_column(table: SourceTable, matcher: TrialMatcher) -> str | None:
    """Find the column of which most cells mean a trial; None if no cell does."""
    by_name = find_columns(table.header, "trial")
    best, best_score = None, (0, 0, 0)
    for column in table.header:
        cells = Counter(row[column] for row in table.rows)
        resolved = sum(n for cell, n in cells.items() if matcher.find(cell) is not None)
        ambiguous = sum(n for cell, n in cells.items() if isinstance(matcher.resolve(cell), Ambiguous))
        score = (resolved, ambiguous, -by_name.index(column) if column in by_name else -len(by_name))
        if resolved + ambiguous and score > best_score:
            best, best_score = column, score
    return best


def answered_rows(rows: Iterable[SourceRow], column: str) -> list[SourceRow]:
    """List the rows with YES or NO in a column."""
    return [row for row in rows if parse_answer(row[column]) is not None]


def find_participant_column(
    rows: Sequence[SourceRow], candidates: Sequence[str], trial: str | None
) -> str | None:
    """Find the column that groups rows into people.

    Parameters
    ----------
    rows
        Those with answers.
    candidates
        Columns that may name people, the better ones first.
    trial
        The column of trials; None if each row is one person.

    Returns
    -------
    str or None
        The first that names a person in every row, hardly ever one twice for a trial, and not another one
        in every row; else the one that comes nearest to it. None if all are empty.
    """
    scores = {}
    for place, column in enumerate(candidates):
        cells = [row[column].strip() for row in rows]
        missing = sum(is_empty(cell) for cell in cells)
        if missing == len(cells):
            continue
        keys = cells if trial is None else list(zip(cells, (row[trial] for row in rows), strict=True))
        repeated = len(keys) - len(set(keys))
        is_row_number = trial is not None and len(cells) > 1 and len(set(cells)) == len(cells)
        is_good = not missing and not is_row_number and repeated <= _MAX_REPEATED * len(cells)
        scores[column] = (0, 0, 0, place) if is_good else (1 + is_row_number, missing, repeated, place)
    return min(scores, key=scores.__getitem__, default=None)


def find_answer_column(
    table: SourceTable, rows: Sequence[SourceRow], trial: str, matcher: TrialMatcher, *, has_other: bool
) -> str | None:
    """Find the column with people's answers among those named so: the one with most cells of YES or NO.

    Columns that only repeat the label are passed over if there is another column or, as ``has_other`` says,
    correctness; columns of which most cells are neither are passed over in favour of correctness.
    """
    shares = {}
    for column in find_columns(table.header, "response"):
        known, unknown = _count_answers(rows, column)
        if known + unknown:
            shares[column] = Fraction(known, known + unknown)
    own = {
        column: share for column, share in shares.items() if not _repeats_label(rows, column, trial, matcher)
    }
    shares = own if own or has_other else shares
    best = max(shares, key=shares.__getitem__, default=None)
    if best is None or (has_other and shares[best] < Fraction(1, 2)):
        return None
    return best


def guess_answer_column(
    table: SourceTable, rows: Sequence[SourceRow], trial: str, matcher: TrialMatcher
) -> str | None:
    """Find the one column with answers in words under an unknown name; None if there are none or several."""
    found = []
    for column in table.header:
        known, unknown = _count_answers(rows, column)
        is_wordy = not any(is_number(row[column]) for row in rows)
        may_be_id = is_known(column) or has_digits(column)
        if known and not unknown and is_wordy and not may_be_id:
            found.append(column)
    found = [column for column in found if not _repeats_label(rows, column, trial, matcher)]
    return found[0] if len(found) == 1 else None


def find_correct_column(table: SourceTable, rows: Sequence[SourceRow]) -> str | None:
    """Find the first column named for correctness that holds nothing but right and wrong."""
    return _find_binary(rows, find_columns(table.header, "correct"))


def find_label_column(table: SourceTable, rows: Sequence[SourceRow]) -> str | None:
    """Find the first column named for the label that holds nothing but YES and NO."""
    return _find_binary(rows, find_columns(table.header, "label"))


def _find_binary(rows: Sequence[SourceRow], columns: Iterable[str]) -> str | None:
    for column in columns:
        known, unknown = _count_answers(rows, column)
        if known and not unknown:
            return column
    return None


def _count_answers(rows: Sequence[SourceRow], column: str) -> tuple[int, int]:
    """Count the cells of YES or NO, and those that are neither nor empty."""
    cells = Counter(row[column] for row in rows)
    known = sum(n for cell, n in cells.items() if parse_answer(cell) is not None)
    empty = sum(n for cell, n in cells.items() if is_empty(cell))
    return known, len(rows) - known - empty


def _repeats_label(rows: Sequence[SourceRow], column: str, trial: str, matcher: TrialMatcher) -> bool:
    answers = [(parse_answer(row[column]), matcher.find(row[trial])) for row in rows]
    known = [(answer, matcher.labels[name]) for answer, name in answers if answer is not None and name]
    return len(known) >= _MIN_ANSWERS and all(answer == label for answer, label in known)
