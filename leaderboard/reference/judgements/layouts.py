"""How a table of human data is laid out, recognised by what its cells hold."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

from leaderboard.reference.judgements.answers import is_empty, is_number, parse_answer, parse_count
from leaderboard.reference.judgements.columns import find_columns, is_known, name_column
from leaderboard.reference.judgements.evidence import (
    answered_rows,
    find_answer_column,
    find_correct_column,
    find_label_column,
    find_participant_column,
    find_trial_column,
    guess_answer_column,
)
from leaderboard.reference.judgements.matching import TrialMatcher
from leaderboard.reference.source_tables import SourceRow, SourceTable
from leaderboard.trial_names import Unknown

_MIN_TRIAL_COLUMNS = 2
_MIN_PEOPLE = 3  # one or two columns of 0 and 1 may be anything


class Shape(StrEnum):
    """What a row of a table is."""

    ANSWERS = "one row for each answer"
    TRIALS = "one row for each trial and one column for each person"
    PEOPLE = "one row for each person and one column for each trial"
    COUNTS = "one row for each trial, with counts of people"


@dataclass(frozen=True)
class Layout:
    """How to read a table.

    Attributes
    ----------
    shape
        What a row is.
    columns
        Names of columns by what they hold.
    spread
        The columns that are people, or trials, where there are such.
    """

    shape: Shape
    columns: Mapping[str, str]
    spread: tuple[str, ...] = ()

    @property
    def answer(self) -> str:
        """The column with answers or, where there is none, with their correctness."""
        return _name_answers(self.columns)

    @property
    def hits(self) -> str:
        """What a file of counts is about: ``n_yes``, or the share of ``response`` YES or of ``correct``."""
        return next(role for role in ("n_yes", "response", "correct") if role in self.columns)

    def describe(self, header: Sequence[str]) -> str:
        """Say what it is and where everything was found, without names that are people's."""
        places = [f"{role} from {name_column(header, column)}" for role, column in self.columns.items()]
        if self.spread:
            noun = "people" if self.shape is Shape.TRIALS else "trials"
            places.append(f"{noun} from {len(self.spread):,} columns")
        return f"{self.shape}: {', '.join(places)}"


def recognise_layout(table: SourceTable, matcher: TrialMatcher, named: Mapping[str, str]) -> Layout | str:
    """Recognise how a table is laid out.

    Parameters
    ----------
    table
        Any table.
    matcher
        Knows the trials.
    named
        Columns of this table that are given, by what they hold.

    Returns
    -------
    Layout or str
        The layout; where there are no human data in the table, why it seems so.
    """
    by_person = _recognise_people(table, matcher, named)
    if by_person is not None:
        return by_person
    trial = named.get("trial") or find_trial_column(table, matcher)
    if trial is None:
        return _recognise_foreign(table, matcher, named)
    named = {**named, "trial": trial}
    return (
        _recognise_answers(table, matcher, named)
        or _recognise_counts(table, matcher, named)
        or _recognise_trials(table, named)
        or _recognise_anonymous(table, matcher, named)
        or _explain(table)
    )


def _recognise_people(table: SourceTable, matcher: TrialMatcher, named: Mapping[str, str]) -> Layout | None:
    trials = [column for column in table.header if not isinstance(matcher.resolve(column), Unknown)]
    if len(trials) < _MIN_TRIAL_COLUMNS or "trial" in named:
        return None
    columns = {}
    candidates = find_columns(table.header, "participant")
    participant = named.get("participant") or find_participant_column(table.rows, candidates, None)
    if participant is not None:
        columns["participant"] = participant
    # A column of answers under an unknown name is a trial, too: practice, or one that does not match.
    others = [
        column
        for column in table.header
        if column not in trials and not is_known(column) and _holds_answers(table, column)
    ]
    spread = tuple(
        column for column in table.header if column in {*trials, *others} and column != participant
    )
    return Layout(Shape.PEOPLE, columns, spread)


def _recognise_foreign(table: SourceTable, matcher: TrialMatcher, named: Mapping[str, str]) -> Layout | str:
    """Recognise human data none of which is about a known trial, by the names of columns."""
    trials = find_columns(table.header, "trial")
    if not trials:
        return "no column names trials"
    named = {**named, "trial": trials[0]}
    layout = _recognise_answers(table, matcher, named)
    if layout is not None and answered_rows(table.rows, layout.answer):
        return layout
    return _recognise_counts(table, matcher, named) or "no cell names a trial"


def _recognise_answers(table: SourceTable, matcher: TrialMatcher, named: Mapping[str, str]) -> Layout | None:
    columns = _find_answer_columns(table, matcher, named)
    if columns is None:
        return None
    participant = named.get("participant")
    if participant is None:
        rows = answered_rows(table.rows, _name_answers(columns))
        candidates = [c for c in find_columns(table.header, "participant") if c not in columns.values()]
        participant = find_participant_column(rows, candidates, columns["trial"])
    return None if participant is None else Layout(Shape.ANSWERS, {"participant": participant, **columns})


def _find_answer_columns(
    table: SourceTable, matcher: TrialMatcher, named: Mapping[str, str]
) -> dict[str, str] | None:
    """Find trial, response, correctness and label; None if neither of the middle two is there."""
    trial = named["trial"]
    rows = [row for row in table.rows if matcher.find(row[trial]) is not None] or table.rows
    columns = {"trial": trial}
    correct = named.get("correct") or (None if "response" in named else find_correct_column(table, rows))
    response = named.get("response")
    if response is None and "correct" not in named:
        has_other = correct is not None
        response = find_answer_column(table, rows, trial, matcher, has_other=has_other)
        if response is None and correct is None:
            response = guess_answer_column(table, rows, trial, matcher)
    found = {"response": response, "correct": correct}
    columns |= {role: column for role, column in found.items() if column is not None}
    if len(columns) == 1:
        return None
    label = named.get("label") or find_label_column(table, rows)
    return columns if label is None else {**columns, "label": label}


def _recognise_counts(table: SourceTable, matcher: TrialMatcher, named: Mapping[str, str]) -> Layout | None:
    rows = [row for row in table.rows if matcher.find(row[named["trial"]]) is not None] or table.rows
    count = named.get("count") or _find_filled(table, rows, "count", _is_count)
    if count is None:
        return None
    for role, fits in (("n_yes", _is_count), ("response", is_number), ("correct", is_number)):
        if role not in named and named.keys() & {"n_yes", "response", "correct"}:
            continue
        column = named.get(role) or _find_filled(table, rows, role, fits)
        if column is not None:
            label = named.get("label") or find_label_column(table, rows)
            columns = {"trial": named["trial"], role: column, "count": count}
            return Layout(Shape.COUNTS, columns if label is None else {**columns, "label": label})
    return None


def _recognise_trials(table: SourceTable, named: Mapping[str, str]) -> Layout | None:
    taken = set(named.values())
    people = tuple(
        column
        for column in table.header
        if column not in taken and not is_known(column) and _holds_answers(table, column)
    )
    if len(people) < _MIN_PEOPLE:
        return None
    label = named.get("label") or find_label_column(table, table.rows)
    columns = {"trial": named["trial"]}
    return Layout(Shape.TRIALS, columns if label is None else {**columns, "label": label}, people)


def _recognise_anonymous(
    table: SourceTable, matcher: TrialMatcher, named: Mapping[str, str]
) -> Layout | None:
    """Recognise answers without participants: only where trials repeat, else the rows may be a model's."""
    columns = _find_answer_columns(table, matcher, named)
    if columns is None:
        return None
    rows = answered_rows(table.rows, _name_answers(columns))
    names = [row[columns["trial"]] for row in rows]
    return Layout(Shape.ANSWERS, columns) if len(set(names)) < len(names) else None


def _name_answers(columns: Mapping[str, str]) -> str:
    return columns["response"] if "response" in columns else columns["correct"]


def _explain(table: SourceTable) -> str:
    if find_columns(table.header, "correct") or find_columns(table.header, "response"):
        return "no column says who answered or how many people did"
    return "no column holds answers"


def _find_filled(
    table: SourceTable, rows: Sequence[SourceRow], role: str, fits: Callable[[str], bool]
) -> str | None:
    """Find the first column for this in which every cell fits or is empty, and one is not empty."""
    for column in find_columns(table.header, role):
        cells = [row[column] for row in rows if not is_empty(row[column])]
        if cells and all(map(fits, cells)):
            return column
    return None


def _holds_answers(table: SourceTable, column: str) -> bool:
    """Tell whether most of what a column holds is YES or NO; what is not will be refused, not passed over."""
    filled = [row[column] for row in table.rows if not is_empty(row[column])]
    n_answers = sum(parse_answer(cell) is not None for cell in filled)
    return 2 * n_answers > len(filled)


def _is_count(text: str) -> bool:
    return parse_count(text) is not None
