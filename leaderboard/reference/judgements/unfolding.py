"""Tables of answers in any layout, as one list of single answers."""

from collections.abc import Iterator
from dataclasses import dataclass

from leaderboard.reference.judgements.answers import is_empty, parse_count
from leaderboard.reference.judgements.columns import find_order_columns
from leaderboard.reference.judgements.layouts import Layout, Shape
from leaderboard.reference.judgements.practice import PracticeMarks
from leaderboard.reference.source_tables import SourceTable


@dataclass(frozen=True)
class RawAnswer:
    """One answer as its file has it.

    Attributes
    ----------
    line
        Where it is.
    person
        Who gave it, empty if the file does not say; None if it does so for nobody.
    name
        What it is about.
    response, correct, label
        The cells; None without such a column.
    is_practice
        Whether its row is marked as practice.
    place
        When the person gave it, as far as the file says; orders the answers of one person in one file.
    """

    line: int
    person: str | None
    name: str
    response: str | None
    correct: str | None
    label: str | None
    is_practice: bool
    place: tuple[int, int] = (0, 0)


def unfold_answers(table: SourceTable, layout: Layout) -> Iterator[RawAnswer]:
    """Yield the answers of a table row by row.

    Where trials or people are columns, cells without an answer are none: most people see few trials.
    """
    match layout.shape:
        case Shape.PEOPLE:
            return _unfold_people(table, layout)
        case Shape.TRIALS:
            return _unfold_trials(table, layout)
        case _:
            return _unfold_rows(table, layout)


def _unfold_rows(table: SourceTable, layout: Layout) -> Iterator[RawAnswer]:
    marks = PracticeMarks(table.header)
    participant, response, correct, label = (
        layout.columns.get(role) for role in ("participant", "response", "correct", "label")
    )
    times = _number_rows(table)
    for time, row in zip(times, table.rows, strict=True):
        person = None if participant is None else row[participant].strip()
        yield RawAnswer(
            row.line,
            "" if person is not None and is_empty(person) else person,
            row[layout.columns["trial"]].strip(),
            None if response is None else row[response],
            None if correct is None else row[correct],
            None if label is None else row[label],
            marks.are_on(row),
            (time, row.line),
        )


def _number_rows(table: SourceTable) -> list[int]:
    """Number rows by the order of answering: by a column that says so, otherwise all alike."""
    for column in find_order_columns(table.header):
        times = [parse_count(row[column].strip()) for row in table.rows]
        if None not in times:
            return [time for time in times if time is not None]
    return [0] * len(table.rows)


def _unfold_trials(table: SourceTable, layout: Layout) -> Iterator[RawAnswer]:
    marks, label = PracticeMarks(table.header), layout.columns.get("label")
    for row in table.rows:
        name, is_practice = row[layout.columns["trial"]].strip(), marks.are_on(row)
        told = None if label is None else row[label]
        for person in layout.spread:
            if not is_empty(row[person]):
                yield RawAnswer(row.line, person.strip(), name, row[person], None, told, is_practice)


def _unfold_people(table: SourceTable, layout: Layout) -> Iterator[RawAnswer]:
    participant = layout.columns.get("participant")
    for row in table.rows:
        # Without ids every row is a person: of this very content, so that the same file is the same people.
        person = f"\0{table.sha256} {row.line}" if participant is None else row[participant].strip()
        person = "" if is_empty(person) else person
        for name in layout.spread:
            if not is_empty(row[name]):
                yield RawAnswer(row.line, person, name.strip(), row[name], None, None, is_practice=False)
