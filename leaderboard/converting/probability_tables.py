"""Probabilities, or logits, in any JSON lines or table: an id and a number for each."""

import math
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from leaderboard.converting.answer_tables import find_status
from leaderboard.converting.log import Answer, Run, list_runs
from leaderboard.converting.record_files import read_records
from leaderboard.converting.records import (
    Options,
    Record,
    choose_field,
    choose_id_field,
    find_model,
    find_truth,
    name_trial,
)
from leaderboard.reference.cells import quote
from leaderboard.submission import Status

PROBABILITY_FIELDS = ("probability", "p_yes", "prob_yes", "prob")
LOGIT_FIELDS = ("logit", "logit_yes")

_NUMBER = re.compile(r"[+-]?(?:[0-9]{1,40}(?:\.[0-9]{0,60})?|\.[0-9]{1,60})(?:[eE][+-]?[0-9]{1,4})?")


def read_runs(files: Sequence[Path], options: Options) -> list[Run]:
    """Read files of probabilities as one run, named after the first file; several models make as many.

    Raises
    ------
    SourceError
        If a file is malformed, or it is not clear which fields are meant.
    """
    answers = (answer for file in files for answer in _read_answers(file, options))
    return list_runs(answers, files[0].stem)


def to_probability(logit: float) -> float:
    """Turn the logarithm of the odds into a probability, whatever its size.

    >>> to_probability(0.0), to_probability(-1000.0), round(to_probability(2.0), 6)
    (0.5, 0.0, 0.880797)
    """
    if logit >= 0:
        return 1 / (1 + math.exp(-logit))
    return math.exp(logit) / (1 + math.exp(logit))


def _read_answers(file: Path, options: Options) -> Iterator[tuple[str, Answer]]:
    usual = LOGIT_FIELDS if options.is_logit else PROBABILITY_FIELDS
    id_field = number_field = ""
    for record in read_records(file):
        if not id_field:
            id_field = choose_id_field(record, options)
            number_field = choose_field(record, options.probability_field, usual, "--probability-field")
        reading = find_status(record)
        answer = Answer(
            file=record.file,
            line=record.line,
            trial_name=name_trial(record, id_field, options),
            scenario_name="",
            probability="" if reading else _parse_number(record, number_field, is_logit=options.is_logit),
            outcome=find_truth(record, number_field),
            status=reading.status if reading else Status.ANSWERED,
            unit=record.unit,
        )
        yield find_model(record), answer


def _parse_number(record: Record, field: str, *, is_logit: bool) -> str:
    """Return P(YES); a probability keeps its digits."""
    value = record.find(field)
    text = str(value) if isinstance(value, int | float | str) and not isinstance(value, bool) else ""
    number = float(text) if _NUMBER.fullmatch(text) else math.nan
    if is_logit and math.isfinite(number):
        return repr(to_probability(number))
    if not is_logit and 0 <= number <= 1:
        return text
    rule = "a finite number" if is_logit else "a number from 0 to 1"
    hint = "" if is_logit or not math.isfinite(number) else "give --logit if these are logarithms of odds"
    raise record.error(f"{field} is {quote(str(value))}, not {rule}", hint)
