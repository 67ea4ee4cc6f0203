"""``leaderboard baselines``."""

import datetime as dt

import click

from leaderboard.baselines import add_baselines
from leaderboard.cli.location import Location, today


@click.command("baselines")
@click.option(
    "--date",
    type=click.DateTime(["%Y-%m-%d"]),
    help="The date to write into their metadata; without it, today's (UTC).",
)
@click.pass_obj
def command(location: Location, date: dt.datetime | None) -> None:
    """Write the baselines (chance, always YES, human mean, label oracle) as submissions.

    A baseline that exists already is written anew, so that it fits the reference as it is now.
    """
    instance, reference = location.load_reference()
    for slug in add_baselines(instance, reference, date=date.date() if date else None, today=today()):
        click.echo(f"wrote submissions/{slug}")
