"""``*_samples_*.jsonl`` of lmms-eval, which drops the document and with it the trial's name."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from leaderboard.converting.answers import READER_VERSION
from leaderboard.converting.json_logs import read_json_lines
from leaderboard.converting.log import Answer, Run, name_run
from leaderboard.converting.record_files import group_by_model
from leaderboard.converting.records import (
    Options,
    Record,
    make_answer,
    name_trial,
    parse_target,
    parse_texts,
)
from leaderboard.reference.cells import quote


def read_runs(files: Sequence[Path], options: Options) -> list[Run]:
    """Read samples, one run for each model; several tasks, such as one per property, are joined.

    A run that is begun again appends to its file. The same answer twice counts once; answers that differ
    count for nothing.

    Raises
    ------
    SourceError
        If a file is malformed, or does not name its trials.
    """
    return [
        Run(name_run(model), tuple(_read_answers(group, options)), READER_VERSION)
        for model, group in sorted(group_by_model(files, options, "doc_id").items())
    ]


def _read_answers(files: Sequence[Path], options: Options) -> Iterator[Answer]:
    for file in files:
        for record in read_json_lines(file, may_hold_nan=True):
            yield from _convert_sample(record, options)


def _convert_sample(record: Record, options: Options) -> Iterator[Answer]:
    trial_name = _name_sample(record, options)
    outcome = parse_target(record.find("target"))
    for repeat, reading in parse_texts(_list_texts(record), record):
        yield make_answer(record, trial_name, reading, repeat=repeat, outcome=outcome)


def _list_texts(record: Record) -> list[object]:
    """List the answers to one trial: of several a filter may keep the first, and only ``resps`` has all."""
    if not record.has("filtered_resps"):
        raise record.error("lacks filtered_resps, so it is no sample of lmms-eval")
    chosen, given = record.find("filtered_resps"), record.find("resps")
    texts = given if isinstance(chosen, str) and isinstance(given, list) and len(given) > 1 else chosen
    return texts if isinstance(texts, list) else [texts]


def _name_sample(record: Record, options: Options) -> str:
    """Name the trial by a field or by doc_id and a map; else by the one file that the model was shown."""
    if options.id_field or options.id_map:
        return name_trial(record, options.id_field or "doc_id", options)
    media = record.find("input_media")
    if isinstance(media, list) and len(media) == 1 and isinstance(media[0], str):
        return media[0]
    found = "no input_media" if media is None else f"the input_media {quote(repr(media))}"
    raise record.error(
        f"has {found}, where one file would name the trial",
        "give --id-map FILE with the columns log_id (doc_id here) and trial_id, or --id-field",
    )
