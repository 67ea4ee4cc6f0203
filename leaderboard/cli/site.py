"""``leaderboard site``."""

import re
from pathlib import Path

import click

from leaderboard.cli.location import Location


@click.group("site")
def command() -> None:
    """Build or serve the website."""


def _check_commit(_context: click.Context, _parameter: click.Parameter, value: str) -> str:
    if value and not re.fullmatch("[0-9a-f]{7,64}", value):
        raise click.BadParameter("give 7 to 64 of the hexadecimal digits of a commit's id")
    return value


@command.command("build")
@click.option(
    "--out", type=click.Path(file_okay=False, path_type=Path), help="Folder to write; site/dist without it."
)
@click.option(
    "--commit", default="", callback=_check_commit, metavar="SHA", help="Id of the commit, for the footer."
)
@click.pass_obj
def build(location: Location, out: Path | None, commit: str) -> None:
    """Write the website as plain files that work from any path and from file://."""
    from leaderboard.website import build_site

    report = build_site(location.find_instance(), out, commit=commit)
    note = ", as they were: nothing has changed" if report.was_current else ""
    click.echo(f"{report.n_pages} pages{note}; open {report.path / 'index.html'}")


@command.command("serve")
@click.option("--port", default=8000, show_default=True, type=click.IntRange(0, 65535))
@click.pass_obj
def serve(location: Location, port: int) -> None:
    """Build the website and serve it on this machine until interrupted."""
    from leaderboard.website import build_site, serve_site

    report = build_site(location.find_instance(), None)
    serve_site(report.path, port)
