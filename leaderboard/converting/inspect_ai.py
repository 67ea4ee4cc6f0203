"""Logs of Inspect AI: ``.json`` by itself, ``.eval`` through the package ``inspect_ai``."""

import importlib
from collections.abc import Iterator, Sequence
from pathlib import Path

from leaderboard.converting.answers import READER_VERSION, Reading, parse_answer
from leaderboard.converting.json_logs import as_record, parse_json, read_json
from leaderboard.converting.log import Answer, Run, name_run
from leaderboard.converting.record_files import list_records
from leaderboard.converting.records import Options, Record, make_answer, name_trial, parse_target
from leaderboard.errors import SourceError
from leaderboard.reference.cells import quote

_HINT = "pip install inspect_ai, or: inspect log convert --to json --output-dir DIR LOG"


def read_runs(files: Sequence[Path], options: Options) -> list[Run]:
    """Read logs, one run for each model; several logs of a model, such as one per property, are joined.

    Raises
    ------
    SourceError
        If a log is malformed or of an evaluation that did not succeed, or ``inspect_ai`` is needed and not
        there.
    """
    answers: dict[str, list[Answer]] = {}
    for file in files:
        log = as_record(_read_log(file), str(file), 1)
        model = log.find("eval.model")
        if not isinstance(model, str) or "samples" not in log.fields:
            raise SourceError(f"{file}: has no eval.model or no samples, so it is no log of Inspect AI")
        _require_success(log)
        samples = list_records(log.fields["samples"], str(file), unit="sample")
        answers.setdefault(model, []).extend(_convert_samples(samples, options))
    return [Run(name_run(model), tuple(found), READER_VERSION) for model, found in sorted(answers.items())]


def _require_success(log: Record) -> None:
    hint = "run it again until it succeeds: inspect eval-retry"
    status = log.find_text("status")
    if status != "success":
        raise SourceError(f"{log.file}: the evaluation has the status {quote(status)}, not success", hint)
    if log.find("invalidated"):
        raise SourceError(f"{log.file}: samples of the evaluation were marked as invalid", hint)


def _read_log(file: Path) -> object:
    if file.suffix.lower() != ".eval":
        return read_json(file, may_hold_nan=True)
    try:
        library = importlib.import_module("inspect_ai.log")
    except ImportError:
        raise SourceError(f"{file}: a log in the format eval needs the package inspect_ai", _HINT) from None
    try:
        content: str = library.read_eval_log(str(file)).model_dump_json()
    except Exception as error:  # whatever that package raises for a broken file
        raise SourceError(f"{file}: inspect_ai cannot read it: {quote(str(error))}") from error
    return parse_json(content.encode(), str(file), 1, may_hold_nan=True)


def _convert_samples(samples: Iterator[Record], options: Options) -> Iterator[Answer]:
    for sample in samples:
        yield make_answer(
            sample,
            name_trial(sample, options.id_field or "id", options),
            _read_sample(sample),
            repeat=f"epoch {sample.find('epoch')}",
            outcome=parse_target(sample.find("target")),
        )


def _read_sample(sample: Record) -> Reading:
    if sample.find("error") is not None:
        return Reading.ERROR
    choices = sample.find("output.choices")
    first = choices[0] if isinstance(choices, list) and choices else None
    if isinstance(first, dict) and first.get("stop_reason") == "content_filter":
        return Reading.REFUSED
    return parse_answer(sample.require_text("output.completion"))
