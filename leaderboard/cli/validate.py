"""``leaderboard validate``."""

import sys
from pathlib import Path
from typing import get_args

import click

from leaderboard.cli.location import Location, today
from leaderboard.originality import load_others
from leaderboard.problems import Problem
from leaderboard.report.problems import Format, render_problems, render_verdict
from leaderboard.submission import read_any
from leaderboard.validation import validate


@click.command("validate")
@click.argument(
    "paths", metavar="PATH...", nargs=-1, required=True, type=click.Path(exists=True, path_type=Path)
)
@click.option("--format", "format_", type=click.Choice(get_args(Format)), default="text", show_default=True)
@click.option("--json", "format_", flag_value="json", help="Same as --format json.")
@click.pass_obj
def command(location: Location, paths: tuple[Path, ...], format_: Format) -> None:
    """Check submission folders or prediction files; report every problem at once.

    Exit status 1 if any of them is refused.
    """
    instance, reference = location.load_reference(with_responses=False)
    problems: list[Problem] = []
    is_valid = True
    for path in paths:
        raw = read_any(path, instance.display_path(path))
        others = load_others(instance, raw, reference, today=today())
        validation = validate(raw, reference, today=today(), others=others)
        problems += validation.problems
        is_valid = is_valid and validation.submission is not None
        if format_ == "text":
            click.echo(render_problems(validation.problems, "text"), nl=False)
            click.echo(render_verdict(raw.location, validation.submission, validation.problems))
    if format_ != "text":
        click.echo(render_problems(tuple(problems), format_), nl=False)
    sys.exit(0 if is_valid else 1)
