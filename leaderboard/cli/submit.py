"""``leaderboard submit``."""

import datetime as dt
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, get_args

import click

from leaderboard.cli.location import Location, current_terminal, today
from leaderboard.grading import grade_people
from leaderboard.models import metadata as fields
from leaderboard.report.problems import render_problems
from leaderboard.report.result import render_result
from leaderboard.submitting import add_submission, read_prediction_file, suggest_slug


def _choice(values: object) -> click.Choice[str]:
    return click.Choice(get_args(values))


# Each option: its key and section in submission.toml, the question asked where it is missing, its type.
# A question marks what is required.
_OPTIONS: dict[str, tuple[str, str, Any, str]] = {
    "name": ("submission", "Name of the system, as the board shows it", str, ""),
    "system": (
        "submission",
        "",
        str,
        "Short name that ties together one model's entries; from the name if left out.",
    ),
    "team": ("submission", "Team", str, ""),
    "date": ("submission", "", str, "Date, YYYY-MM-DD; today (UTC) if left out."),
    "description": ("submission", "One or two sentences on the system", str, ""),
    "training": ("protocol", "Training", _choice(fields.Training), "How it was trained."),
    "testing": ("protocol", "Testing", _choice(fields.Testing), "What it saw of a test video."),
    "training-trials": ("protocol", "", int, "Number of training trials."),
    "auxiliary": ("protocol", "", _choice(fields.Auxiliary), "How the property entered training."),
    "selection": ("protocol", "", _choice(fields.Selection), "What the model was selected on."),
    "family": ("model", "Family of models", _choice(fields.Family), ""),
    "inputs": ("model", "Inputs", _choice(fields.Inputs), "What the model takes as input."),
    "parameters": ("model", "", str, "Number of parameters, as text."),
    "pretraining": ("model", "", str, "Data of pretraining, as text."),
    "paper": ("links", "", str, "Link."),
    "code": ("links", "", str, "Link."),
    "weights": ("links", "", str, "Link."),
    "github": ("contact", "GitHub account to contact", str, ""),
}


def _add_options(function: Callable[..., None]) -> Callable[..., None]:
    for name, (_, question, type_, help_) in reversed(_OPTIONS.items()):
        required = "Required. " if question else ""
        option = click.option(f"--{name}", type=type_, help=f"{required}{help_ or question + '.'}")
        function = option(function)
    return function


@click.command("submit")
@click.argument(
    "files",
    metavar="FILE...",
    nargs=-1,
    required=True,
    type=click.Path(exists=True, dir_okay=False, path_type=Path),
)
@click.option("--slug", help="Name of the folder under submissions/; from the name if left out.")
@_add_options
@click.pass_obj
def command(
    location: Location,
    /,
    files: tuple[Path, ...],
    slug: str | None,
    **options: Any,  # noqa: ANN401  (texts and numbers, as _OPTIONS says)
) -> None:
    """Make submissions/<slug>/ from prediction files: valid and graded, or nothing.

    Several files, say one per property, are joined. On a terminal, what is required and missing is asked for.
    """
    instance, reference = location.load_reference()
    values = _complete({name: options[name.replace("-", "_")] for name in _OPTIONS})
    slug = slug or suggest_slug(values["name"])
    if not slug:
        raise click.UsageError("no slug can be made from the name: give one with --slug")
    values["system"] = values["system"] or slug
    metadata: dict[str, dict[str, object]] = {}
    for name, (section, *_) in _OPTIONS.items():
        metadata.setdefault(section, {})[name.replace("-", "_")] = values[name]
    parts = [read_prediction_file(file) for file in files]
    assessment = add_submission(instance, reference, slug, metadata=metadata, files=parts, today=today())
    if assessment.result is None or assessment.submission is None:
        click.echo(render_problems(assessment.problems, "text"), nl=False)
        click.echo("nothing was written", err=True)
        sys.exit(1)
    people = grade_people(reference)
    shown = render_result(
        assessment.result,
        reference,
        people,
        metadata=assessment.submission.metadata,
        terminal=current_terminal(),
    )
    click.echo(shown)
    click.echo(f"wrote {instance.display_path(instance.submission_dir(slug))}/")


def _complete(values: dict[str, Any]) -> dict[str, Any]:
    """Fill in what is missing: the date from the clock, the rest by asking, if there is somebody to ask."""
    values = dict(values)
    values["date"] = _parse_date(values["date"])
    missing = [name for name, (_, question, *_) in _OPTIONS.items() if question and values[name] is None]
    if missing and not sys.stdin.isatty():
        raise click.UsageError("missing " + ", ".join(f"--{name}" for name in missing))
    for name in missing:
        _, question, type_, _ = _OPTIONS[name]
        values[name] = click.prompt(question, type=type_)
    return values


def _parse_date(text: str | None) -> dt.date:
    if text is None:
        return today()
    try:
        return dt.date.fromisoformat(text)
    except ValueError:
        raise click.UsageError(f"--date {text!r} is not a date such as {today()}") from None
