"""Answers in any JSON lines or table: an id and a text for each."""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from leaderboard.converting.answers import READER_VERSION, Reading, parse_answer
from leaderboard.converting.log import Answer, Run, list_runs
from leaderboard.converting.record_files import read_records
from leaderboard.converting.records import (
    Options,
    Record,
    choose_field,
    choose_id_field,
    find_model,
    find_truth,
    make_answer,
    name_trial,
)
from leaderboard.reference.cells import quote

ANSWER_FIELDS = ("answer", "response", "prediction", "output", "model_output", "raw_response", "text")
REPEAT_FIELDS = ("repeat", "epoch")

_STATUSES = {"": None, "answered": None} | {
    reading.value: reading for reading in Reading if not reading.probability
}


def read_runs(files: Sequence[Path], options: Options) -> list[Run]:
    """Read files of answers as one run, named after the first file; rows of several models make as many.

    Rows of one trial are repeats: those of an own ``repeat`` or ``epoch``, or, without such a field, all.

    Raises
    ------
    SourceError
        If a file is malformed, or it is not clear which fields are meant.
    """
    answers = (answer for file in files for answer in _read_answers(file, options))
    return list_runs(answers, files[0].stem, READER_VERSION)


def make_run(trial_names: Iterable[object], texts: Iterable[object], name: str = "run") -> Run:
    """Make a run of two columns, such as those of a data frame; rows of one trial are repeats.

    Parameters
    ----------
    trial_names
        The trial of each row, by its id or by a name that files and tools give it.
    texts
        What the model said; None, or a data frame's NaN, where it said nothing.
    name
        The run's.

    Raises
    ------
    ValueError
        If one column is longer than the other, or an answer is no text.
    """
    rows = enumerate(zip(trial_names, texts, strict=True), 1)
    answers = (
        make_answer(Record(name, row, {}, "row"), str(trial), _parse_cell(text, row), repeat=str(row))
        for row, (trial, text) in rows
    )
    return Run(name, tuple(answers), READER_VERSION)


def _parse_cell(text: object, row: int) -> Reading:
    if isinstance(text, str):
        return parse_answer(text)
    if text is None or str(text) in ("nan", "<NA>"):  # of pandas, whose NA cannot even be compared
        return parse_answer("")
    raise ValueError(f"the answer in row {row} is {text!r}, not a text")


def _read_answers(file: Path, options: Options) -> Iterator[tuple[str, Answer]]:
    fields: tuple[str, str, str | None] | None = None
    for record in read_records(file):
        if fields is None:
            fields = _choose_fields(record, options)
        id_field, answer_field, repeat_field = fields
        repeat = record.find(repeat_field) if repeat_field else f"{record.file}:{record.line}"
        answer = make_answer(
            record,
            name_trial(record, id_field, options),
            find_status(record) or parse_answer(record.require_text(answer_field)),
            repeat=str(repeat),
            outcome=find_truth(record, answer_field),
        )
        yield find_model(record), answer


def _choose_fields(record: Record, options: Options) -> tuple[str, str, str | None]:
    answer = choose_field(record, options.answer_field, ANSWER_FIELDS, "--answer-field")
    repeat = next((name for name in REPEAT_FIELDS if name in record.fields), None)
    return choose_id_field(record, options), answer, repeat


def find_status(record: Record) -> Reading | None:
    """Return why a record holds no answer, if its field ``status`` says so.

    Raises
    ------
    SourceError
        If it says something else.
    """
    status = record.find_text("status")
    if status in _STATUSES:
        return _STATUSES[status]
    raise record.error(f"status {quote(status)} is unknown", "write answered, refused, unparsable or error")
