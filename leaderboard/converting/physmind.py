"""PhysMind's ``predictions.json``, or ``run.json`` around it: one object per video, with its question."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from leaderboard.converting.answers import READER_VERSION, Reading, parse_answer
from leaderboard.converting.json_logs import as_record, read_json
from leaderboard.converting.log import Answer, Run, name_run
from leaderboard.converting.record_files import list_records
from leaderboard.converting.records import Options, Record, make_answer, name_trial, parse_target
from leaderboard.errors import SourceError
from leaderboard.reference.cells import quote

_STATUSES = ("correct", "wrong_answer", "parse_error", "request_error")


def read_runs(files: Sequence[Path], options: Options) -> list[Run]:
    """Read the files of one run, named after the folder of the first.

    Raises
    ------
    SourceError
        If a file is malformed.
    """
    answers = tuple(answer for file in files for answer in _read_answers(file, options))
    return [Run(name_run(files[0].absolute().parent.name), answers, READER_VERSION)]


def _read_answers(file: Path, options: Options) -> Iterator[Answer]:
    content = read_json(file)
    if isinstance(content, dict) and "predictions" not in content:
        raise SourceError(f"{file}: has no predictions, so it is no run of PhysMind")
    scenes = content["predictions"] if isinstance(content, dict) else content
    for scene in list_records(scenes, str(file), unit="scene"):
        questions = scene.find_items("questions")
        if len(questions) != 1:
            raise scene.error(f"has {len(questions)} questions where one is needed")
        question = as_record(questions[0], scene.file, scene.line, unit=scene.unit)
        yield _convert_question(scene, question, options)


def _convert_question(scene: Record, question: Record, options: Options) -> Answer:
    """Read what the model said; PhysMind's own reading, of the first tag, counts only without that text."""
    status = question.find_text("status")
    if status not in _STATUSES:
        raise scene.error(f"status {quote(status)} is none of {', '.join(_STATUSES)}")
    own = parse_answer(question.require_text("normalized_prediction"))
    text = question.find_text("raw_prediction")
    reading = parse_answer(text) if text else own
    if status == "request_error":
        reading = Reading.ERROR
    answer = make_answer(
        scene,
        _name_scene(scene, options),
        reading,
        outcome=parse_target(question.find("normalized_expected_answer")),
        scenario_name=scene.find_text("scenario"),
    )
    if own.outcome is not None and own is not reading:
        says = "neither YES nor NO" if reading.outcome is None else reading.name
        answer = replace(answer, doubts=(f"says {says}, and was read as {own.name} by PhysMind",))
    return answer


def _name_scene(scene: Record, options: Options) -> str:
    """Name the trial by its pair and copy, since a stimulus_id may lack the copy."""
    pair, scenario, copy = (scene.find_text(key) for key in ("pair_id", "scenario", "copy_name"))
    if options.id_field or not (pair and scenario and copy) or not pair.startswith(f"{scenario}/"):
        return name_trial(scene, options.id_field or "stimulus_id", options)
    return f"{scenario}-{copy}/{pair.removeprefix(scenario + '/')}"
