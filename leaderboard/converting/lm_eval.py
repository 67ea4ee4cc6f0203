"""``samples_*.jsonl`` of lm-evaluation-harness: texts, or log-likelihoods of YES and NO."""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from leaderboard.converting.answers import READER_VERSION, Reading, parse_answer
from leaderboard.converting.json_logs import read_json_lines
from leaderboard.converting.log import Answer, Run, name_run
from leaderboard.converting.probability_tables import to_probability
from leaderboard.converting.records import (
    Options,
    Record,
    choose_id_field,
    make_answer,
    name_trial,
    parse_target,
    parse_texts,
)
from leaderboard.reference.cells import quote
from leaderboard.submission import Status

_RAW = "none"  # the name of the filter that changes nothing
_GREEDY = (
    ["True"],
    ["False"],
    [True],
    [False],
)  # is the choice what the model would say? Older files have flags


def read_runs(files: Sequence[Path], options: Options) -> list[Run]:
    """Read samples, one run for each model and filter; several tasks, such as one per property, are joined.

    The filter ``none`` passes every response on: several are repeats. Another filter chooses one.

    Raises
    ------
    SourceError
        If a file is malformed.
    """
    answers: dict[str, list[Answer]] = {}
    is_text = False
    for file in files:
        id_field = ""
        model = file.absolute().parent.name  # the harness makes a folder for each
        for record in read_json_lines(file, may_hold_nan=True):
            id_field = id_field or choose_id_field(record, options, inside="doc.")
            trial_name = name_trial(record, id_field, options)
            found = answers.setdefault(f"{model}-{record.find_text('filter') or _RAW}", [])
            if _has_likelihoods(record):
                found.append(_compare_likelihoods(record, trial_name))
            else:
                is_text = True
                found.extend(_convert_texts(record, trial_name))
    reader = READER_VERSION if is_text else None
    return [Run(name_run(name), tuple(answers[name]), reader) for name in sorted(answers)]


def _has_likelihoods(record: Record) -> bool:
    """Tell by the shape: a response is a text, or a log-likelihood with whether it is the likeliest."""
    responses = record.find_items("filtered_resps")
    return bool(responses) and all(
        isinstance(response, list) and response[1:] in _GREEDY for response in responses
    )


def _convert_texts(record: Record, trial_name: str) -> Iterator[Answer]:
    texts = record.find_items("filtered_resps")
    if record.find_text("filter") in ("", _RAW):
        texts = record.find_items("resps")
    while len(texts) == 1 and isinstance(texts[0], list):  # one list for each request, of which there is one
        texts = texts[0]
    outcome = parse_target(record.find("target"))
    for repeat, reading in parse_texts(texts, record):
        yield make_answer(record, trial_name, reading, repeat=repeat, outcome=outcome)


def _compare_likelihoods(record: Record, trial_name: str) -> Answer:
    """P(YES) among YES and NO, by their log-likelihoods."""
    choices = _list_choices(record)
    responses = record.find_items("filtered_resps")
    readings = [parse_answer(choice) for choice in choices]
    if sorted(readings) != [Reading.NO, Reading.YES] or len(responses) != len(readings):
        raise record.error(f"the choices are {quote(', '.join(choices))}; they must be one YES and one NO")
    likelihoods = dict(zip(readings, (_parse_likelihood(r, record) for r in responses), strict=True))
    return Answer(
        file=record.file,
        line=record.line,
        trial_name=trial_name,
        scenario_name="",
        probability=repr(to_probability(likelihoods[Reading.YES] - likelihoods[Reading.NO])),
        outcome=_find_outcome(record, readings),
        status=Status.ANSWERED,
    )


def _list_choices(record: Record) -> list[str]:
    """List the continuations whose likelihoods were computed, in the order of the responses."""
    choices: list[str] = []
    while (choice := record.find(f"arguments.gen_args_{len(choices)}.arg_1")) is not None:
        choices.append(str(choice))
    return choices


def _parse_likelihood(response: object, record: Record) -> float:
    value = response[0] if isinstance(response, list) else None
    try:
        number = float(value) if isinstance(value, str | float | int) else math.nan
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise record.error(f"the log-likelihood {quote(str(value))} is no finite number")
    return number


def _find_outcome(record: Record, readings: Sequence[Reading]) -> bool | None:
    """Understand a target in words, or by its position among the choices."""
    target = record.find("target")
    if target in ("0", "1"):
        return readings[int(str(target))].outcome
    return parse_target(target)
