"""``leaderboard site``."""

from pathlib import Path

import click

from leaderboard.cli.location import Location
from leaderboard.website import build_site, serve_site


@click.group("site")
def command() -> None:
    """Build or serve the website."""


@command.command("build")
@click.option(
    "--out", type=click.Path(file_okay=False, path_type=Path), help="Folder to write; site/dist without it."
)
@click.pass_obj
def build(location: Location, out: Path | None) -> None:
    """Write the website as plain files that work from any path and from file://."""
    report = build_site(location.find_instance(), out)
    click.echo(f"{report.n_pages} pages; open {report.path / 'index.html'}")


@command.command("serve")
@click.option("--port", default=8000, show_default=True, type=click.IntRange(0, 65535))
@click.pass_obj
def serve(location: Location, port: int) -> None:
    """Build the website and serve it on this machine until interrupted."""
    report = build_site(location.find_instance(), None)
    serve_site(report.path, port)
