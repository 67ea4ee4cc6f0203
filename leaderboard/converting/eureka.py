"""``inference_result.jsonl`` of Eureka ML Insights: the data's own columns beside the model's output."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from leaderboard.converting.answers import READER_VERSION, Reading, parse_answer
from leaderboard.converting.json_logs import read_json_lines
from leaderboard.converting.log import Answer, Run, name_run
from leaderboard.converting.records import Options, Record, choose_id_field, make_answer, name_trial
from leaderboard.reference.cells import quote


def read_runs(files: Sequence[Path], options: Options) -> list[Run]:
    """Read results of one model as one run, named after the first file.

    ``data_repeat_id`` tells repeats apart.

    Raises
    ------
    SourceError
        If a file is malformed.
    """
    answers = tuple(answer for file in files for answer in _read_answers(file, options))
    return [Run(name_run(files[0].stem), answers, READER_VERSION)]


def _read_answers(file: Path, options: Options) -> Iterator[Answer]:
    id_field = ""
    for record in read_json_lines(file, may_hold_nan=True):
        id_field = id_field or choose_id_field(record, options)
        yield make_answer(
            record,
            name_trial(record, id_field, options),
            _read_output(record),
            repeat=str(record.find("data_repeat_id") or ""),
        )


def _read_output(record: Record) -> Reading:
    is_valid = record.find("is_valid")
    if is_valid is None:
        raise record.error("lacks is_valid, which says whether the model gave an output")
    if not isinstance(is_valid, bool):
        raise record.error(f"is_valid is {quote(repr(is_valid))}, neither true nor false")
    return parse_answer(record.require_text("model_output")) if is_valid else Reading.ERROR
