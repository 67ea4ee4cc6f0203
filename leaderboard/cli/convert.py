"""``leaderboard convert``."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, get_args

import click

from leaderboard.cli.location import Location, today
from leaderboard.converting import (
    FORMATS,
    Conversion,
    Format,
    Options,
    choose_run,
    convert_physopt,
    read_id_map,
    write_predictions,
    write_runs,
)
from leaderboard.converting.conversion import render_predictions
from leaderboard.converting.physopt import Readout, Training, split_runs
from leaderboard.files import canonical_json
from leaderboard.instance import PREDICTIONS_FILE
from leaderboard.problems import Problem
from leaderboard.reference import Reference
from leaderboard.report.conversion import conversion_data, render_conversion
from leaderboard.submission import RawFile, RawSubmission
from leaderboard.validation import validate


@click.group("convert")
def command() -> None:
    """Turn other tools' logs into predictions.csv."""


_FILES: dict[str, Any] = {
    "metavar": "FILE...",
    "nargs": -1,
    "required": True,
    "type": click.Path(exists=True, dir_okay=False, path_type=Path),
}
_OUTPUT: dict[str, Any] = {
    "type": click.Path(dir_okay=False, path_type=Path),
    "help": "Write one run's predictions to this file.",
}
_FOLDER: dict[str, Any] = {
    "type": click.Path(file_okay=False, path_type=Path),
    "help": "Write every run's to DIR/<run>/predictions.csv.",
    "metavar": "DIR",
}
_JSON: dict[str, Any] = {"is_flag": True, "help": "Print the account of the conversion as JSON."}

# What a log does not say by itself; each format takes some.
_OPTIONS: dict[str, tuple[str, dict[str, Any]]] = {
    "id_field": (
        "--id-field",
        {"metavar": "NAME", "help": "Field with the trial's name; a dot leads into an object."},
    ),
    "id_map": (
        "--id-map",
        {
            "metavar": "CSV",
            "type": click.Path(exists=True, dir_okay=False, path_type=Path),
            "help": "Table log_id,trial_id of what the log's own ids mean.",
        },
    ),
    "answer_field": ("--answer-field", {"metavar": "NAME", "help": "Field with the model's text."}),
    "probability_field": ("--probability-field", {"metavar": "NAME", "help": "Field with the number."}),
    "is_logit": ("--logit", {"is_flag": True, "help": "The numbers are logarithms of odds."}),
}


@command.command("physopt")
@click.argument("files", **_FILES)
@click.option("-o", "--output", **_OUTPUT)
@click.option("--split-runs", "folder", **_FOLDER)
@click.option("--json", "as_json", **_JSON)
@click.option(
    "--training",
    type=click.Choice(get_args(Training)),
    help="The run trained on all scenarios, or on the same one.",
)
@click.option("--readout", type=click.Choice(get_args(Readout)), help="The run's way of fitting the readout.")
@click.pass_obj
def physopt(
    location: Location,
    /,
    *,
    files: tuple[Path, ...],
    training: Training | None,
    readout: Readout | None,
    **target: Any,  # noqa: ANN401  (output, folder and as_json)
) -> None:
    """Results of physopt: one row per trial, readout and way of training.

    Reports every row that is left out and every trial that is odd; guesses nothing.
    """
    _require_target(files, **target)
    if target["folder"] is not None and (training or readout):
        raise click.UsageError("--split-runs writes all runs; --training and --readout choose one for -o")
    _, reference = location.load_reference()
    if target["folder"] is not None:
        conversions = split_runs(files, reference)
    else:
        conversion = convert_physopt(files, reference, training=training, readout=readout)
        conversions = {conversion.name: conversion}
    _spare_logs(files, target["folder"], conversions)
    _finish(conversions, reference, **target)


def _make_command(format_: Format) -> click.Command:
    """Make the command of a format, with the options that matter to it."""
    run_help = "The run to write, where the files hold several."
    named = [click.Option([_OPTIONS[name][0], name], **_OPTIONS[name][1]) for name in format_.options]
    return click.Command(
        format_.name,
        callback=_make_callback(format_),
        params=[
            click.Argument(["files"], **_FILES),
            click.Option(["-o", "--output"], **_OUTPUT),
            click.Option(["--split-runs", "folder"], **_FOLDER),
            click.Option(["--run", "wanted"], metavar="NAME", help=run_help),
            click.Option(["--json", "as_json"], **_JSON),
            *named,
        ],
        help=f"{format_.title}.\n\nReports what is left out or odd; guesses nothing. See docs/converting.md.",
        short_help=format_.title,
    )


def _make_callback(format_: Format) -> Callable[..., None]:
    @click.pass_obj
    def convert(
        location: Location,
        /,
        *,
        files: tuple[Path, ...],
        wanted: str | None,
        output: Path | None,
        folder: Path | None,
        as_json: bool,
        **values: Any,  # noqa: ANN401  (those of _OPTIONS that the format takes)
    ) -> None:
        _require_target(files, output, folder)
        if folder is not None and wanted:
            raise click.UsageError("--split-runs writes all runs; --run chooses one for -o")
        _, reference = location.load_reference()
        conversions = format_.split_runs(files, reference, _parse_options(values))
        if output is not None:
            conversion = choose_run(conversions, wanted)
            conversions = {conversion.name: conversion}
        _spare_logs(files, folder, conversions)
        _finish(conversions, reference, output=output, folder=folder, as_json=as_json)

    return convert


def _parse_options(values: Mapping[str, Any]) -> Options:
    id_map = values.get("id_map")
    given = {name: value for name, value in values.items() if name != "id_map"}
    return Options(**given, id_map=read_id_map(id_map) if id_map else {})


def _require_target(files: Sequence[Path], output: Path | None, folder: Path | None, **_: object) -> None:
    if (output is None) == (folder is None):
        raise click.UsageError("say where to: -o FILE for one run, or --split-runs DIR for all")
    if output is not None and _is_log(output, files):
        raise click.UsageError(f"-o {output} would write over the log itself: name another file")


def _spare_logs(files: Sequence[Path], folder: Path | None, names: Iterable[str]) -> None:
    """Refuse to write a run over a log: runs are named after logs, and an earlier output is one, too."""
    if folder is None:
        return
    for name in names:
        if _is_log(target := folder / name / PREDICTIONS_FILE, files):
            raise click.UsageError(f"{target} is the log itself: name another folder with --split-runs")


def _is_log(target: Path, files: Sequence[Path]) -> bool:
    return target.exists() and any(target.samefile(file) for file in files)


def _finish(
    conversions: dict[str, Conversion],
    reference: Reference,
    *,
    output: Path | None,
    folder: Path | None,
    as_json: bool,
) -> None:
    """Report first, so that whoever gets no file sees why, and then write."""
    accounts = []
    for conversion in conversions.values():
        problems = _find_problems(conversion, reference, output or Path(conversion.name) / PREDICTIONS_FILE)
        click.echo(render_conversion(conversion, problems), err=True)
        accounts.append(conversion_data(conversion, problems))
    if folder is not None:
        files = list(write_runs(conversions, folder))
    elif output is not None:
        files = [output]
        write_predictions(next(iter(conversions.values())), output)
    else:
        files = []
    if as_json:
        click.echo(canonical_json({"runs": accounts, "files": [str(file) for file in files]}), nl=False)
    else:
        for file in files:
            click.echo(f"wrote {file}")


def _find_problems(conversion: Conversion, reference: Reference, file: Path) -> tuple[Problem, ...]:
    """Validate the predictions as they will be written, for the sake of the warnings."""
    if not conversion.predictions:
        return ()
    content = render_predictions(conversion)
    raw = RawSubmission(str(file), None, (RawFile(PREDICTIONS_FILE, "file", len(content), content),))
    return validate(raw, reference, today=today()).problems


for _format in FORMATS.values():
    if _format.name not in command.commands:
        command.add_command(_make_command(_format))
