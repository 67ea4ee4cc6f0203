"""``leaderboard check-changes``."""

import sys
from pathlib import Path
from typing import get_args

import click

from leaderboard.changes import check_changes
from leaderboard.cli.location import Location, today
from leaderboard.files import write_atomic
from leaderboard.report.changes import render_change_json, render_change_summary
from leaderboard.report.problems import Format, escape_line, render_problems


@click.command("check-changes")
@click.argument("base")
@click.argument("head")
@click.option("--author", help="Login of whoever sent the branch; a published submission is its contact's.")
@click.option("--format", "format_", type=click.Choice(get_args(Format)), default="text", show_default=True)
@click.option("--json", "format_", flag_value="json", help="Same as --format json.")
@click.option(
    "--summary",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Append the verdict, the scores and all problems to this file, as Markdown.",
)
@click.option(
    "--result",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Write the verdict, all problems and the result that grading gives to this file, as JSON.",
)
@click.pass_obj
def command(
    location: Location, /, base: str, head: str, *, author: str | None, format_: Format, **files: Path | None
) -> None:
    """Check what a branch changes: one submission, by its contact, with the right result.

    BASE is the published side, HEAD the branch. The branch is never checked out: its files are read as git
    objects and judged with this folder's engine and reference. Exit status 1 if it must not be merged.
    """
    instance, reference = location.load_reference()
    check = check_changes(instance, reference, (base, head), author=author or None, today=today())
    if (summary := files["summary"]) is not None:
        with summary.open("a", encoding="utf-8") as stream:  # the host gives one file to all steps of a job
            stream.write(render_change_summary(check, reference))
    if (result := files["result"]) is not None:
        write_atomic(result, render_change_json(check).encode())
    click.echo(render_problems(check.problems, format_), nl=False)
    if format_ == "text":
        verdict = "may be merged" if check.is_fine else "must not be merged as it is"
        click.echo(escape_line(f"{check.slug or 'the branch'} at {check.head[:12]} {verdict}"))
    sys.exit(0 if check.is_fine else 1)
