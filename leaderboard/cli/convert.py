"""``leaderboard convert``."""

from pathlib import Path
from typing import get_args

import click

from leaderboard.cli.location import Location
from leaderboard.converting import Conversion, convert_physopt, write_predictions, write_runs
from leaderboard.converting.physopt import Readout, Training, split_runs
from leaderboard.report.conversion import render_conversion


@click.group("convert")
def command() -> None:
    """Turn other tools' logs into predictions.csv."""


@command.command("physopt")
@click.argument(
    "files",
    metavar="FILE...",
    nargs=-1,
    required=True,
    type=click.Path(exists=True, dir_okay=False, path_type=Path),
)
@click.option(
    "-o",
    "--output",
    type=click.Path(dir_okay=False, path_type=Path),
    help="Write one run's predictions to this file.",
)
@click.option(
    "--split-runs",
    "folder",
    type=click.Path(file_okay=False, path_type=Path),
    help="Write every run's to DIR/<run>/predictions.csv.",
    metavar="DIR",
)
@click.option(
    "--training",
    type=click.Choice(get_args(Training)),
    help="The run trained on all scenarios, or on the same one.",
)
@click.option("--readout", type=click.Choice(get_args(Readout)), help="The run's way of fitting the readout.")
@click.pass_obj
def physopt(
    location: Location,
    *,
    files: tuple[Path, ...],
    output: Path | None,
    folder: Path | None,
    training: Training | None,
    readout: Readout | None,
) -> None:
    """Results of physopt: one row per trial, readout and way of training.

    Reports every row that is left out and every trial that is odd; guesses nothing.
    """
    if (output is None) == (folder is None):
        raise click.UsageError("say where to: -o FILE for one run, or --split-runs DIR for all")
    if folder is not None and (training or readout):
        raise click.UsageError("--split-runs writes all runs; --training and --readout choose one for -o")
    _, reference = location.load_reference()
    if output is not None:
        conversion = convert_physopt(files, reference, training=training, readout=readout)
        write_predictions(conversion, output)
        _report([conversion], [output])
    elif folder is not None:
        runs = split_runs(files, reference)
        _report(list(runs.values()), list(write_runs(runs, folder)))


def _report(conversions: list[Conversion], files: list[Path]) -> None:
    for conversion in conversions:
        click.echo(render_conversion(conversion), err=True)
    for file in files:
        click.echo(f"wrote {file}")
