"""``reviews/<model>/<benchmark>_<subset>.jsonl`` of EvalScope: what was scored, answer by answer."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from leaderboard.converting.answers import READER_VERSION, Reading, parse_answer
from leaderboard.converting.json_logs import read_json_lines
from leaderboard.converting.log import Answer, Run, name_run
from leaderboard.converting.record_files import group_by_model
from leaderboard.converting.records import (
    ID_FIELDS,
    Options,
    Record,
    choose_id_field,
    make_answer,
    name_trial,
    parse_target,
)

_SCORE, _METADATA = "sample_score.score", "sample_score.sample_metadata."


def read_runs(files: Sequence[Path], options: Options) -> list[Run]:
    """Read reviews, one run for each model; several subsets, such as one per property, are joined.

    Raises
    ------
    SourceError
        If a file is malformed, or does not name its trials.
    """
    return [
        Run(name_run(model), tuple(a for file in group for a in _read_answers(file, options)), READER_VERSION)
        for model, group in sorted(group_by_model(files, options, "index").items())
    ]


def _read_answers(file: Path, options: Options) -> Iterator[Answer]:
    id_field = ""
    for record in read_json_lines(file, may_hold_nan=True):
        id_field = id_field or _choose_id_field(record, options)
        yield make_answer(
            record,
            name_trial(record, id_field, options),
            _read_review(record),
            repeat=_name_repeat(record),
            outcome=parse_target(record.find("target")),
        )


def _choose_id_field(record: Record, options: Options) -> str:
    """Look among the sample's metadata; with a map, the group of its repeats, or its index, will do."""
    if options.id_field or any(record.has(f"{_METADATA}{name}") for name in ID_FIELDS):
        return choose_id_field(record, options, inside=_METADATA)
    if options.id_map:
        return "sample_score.group_id" if record.find("sample_score.group_id") is not None else "index"
    raise record.error(
        "its sample_metadata names no trial",
        "give --id-field, or --id-map FILE with the columns log_id (index here) and trial_id",
    )


def _name_repeat(record: Record) -> str:
    """Tell generations of one sample apart; older versions give each an index of its own."""
    generation = record.find("sample_score.generation_index")
    return f"index {record.find('index')}" if generation is None else f"generation {generation}"


def _read_review(record: Record) -> Reading:
    """Read what the model said, whatever the score made of it."""
    if not isinstance(record.find(_SCORE), dict):
        raise record.error("lacks sample_score.score, so it is no review of EvalScope")
    said = record.require_text(f"{_SCORE}.prediction")
    has_failed = record.find(f"{_SCORE}.status") in ("transport_error", "invalid_session")
    return Reading.ERROR if has_failed and not said else parse_answer(said)
