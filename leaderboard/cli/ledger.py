"""``leaderboard ledger``."""

import datetime as dt
import sys

import click

from leaderboard.cli.location import Location, today
from leaderboard.report.problems import escape_line, render_problems


@click.group("ledger")
def command() -> None:
    """Check or extend the ledger, the public record of what was published."""


@command.command("check")
@click.pass_obj
def check(location: Location) -> None:
    """Check that the ledger is well formed, was only appended to, and is true of the submissions.

    What was published before is read from the repository's history. Exit status 1 if anything is wrong.
    """
    from leaderboard.recording import check_ledger, open_history

    instance = location.find_instance()
    history = open_history(instance)
    found = check_ledger(instance, history)
    click.echo(render_problems(found.problems), nl=False)
    if found.is_sound and found.ledger is not None:
        n_slugs = len(found.ledger.latest)
        past = "" if history else "; there is no history to compare it with"
        click.echo(f"the ledger is sound: lines {len(found.ledger.lines)}, submissions {n_slugs}{past}")
    sys.exit(0 if found.is_sound else 1)


@command.command("update")
@click.option(
    "--date",
    type=click.DateTime(["%Y-%m-%d"]),
    help="The date of the new lines; without it, today's (UTC).",
)
@click.pass_obj
def update(location: Location, date: dt.datetime | None) -> None:
    """Append a line for each new submission and for each result that was graded anew.

    Refused, and nothing is written, if a published number changed though neither the metrics nor the
    reference did, or if a published submission is gone.
    """
    from leaderboard.files import hold_folder, remove_leftovers, write_atomic
    from leaderboard.ledger import render_ledger
    from leaderboard.recording import open_history, update_ledger

    instance = location.find_instance()
    history = open_history(instance)
    with hold_folder(instance.submissions_dir):
        found = update_ledger(
            instance,
            history.find_result if history else lambda _slug, _sha256: None,
            today=date.date() if date else today(),
        )
        if found.is_allowed and found.added:
            remove_leftovers(instance.submissions_dir)
            write_atomic(instance.ledger_file, found.content)
    click.echo(render_problems(found.problems), nl=False)
    if not found.is_allowed:
        click.echo("nothing was written to the ledger")
        sys.exit(1)
    for line in render_ledger(found.added, has_header=False).splitlines():
        click.echo(escape_line(line))
    click.echo(f"{len(found.added)} new in {instance.display_path(instance.ledger_file)}")
