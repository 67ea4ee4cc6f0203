"""``leaderboard audit``."""

from pathlib import Path

import click

from leaderboard.auditing import audit
from leaderboard.cli.location import Location, current_terminal
from leaderboard.errors import InstanceError
from leaderboard.instance import PUBLISHED_FILE
from leaderboard.reference.published import read_published
from leaderboard.report.audit import render_audit, render_audit_json


@click.command("audit")
@click.argument("file", required=False, type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--json", "is_json", is_flag=True, help="Print every row with what was found as JSON.")
@click.pass_obj
def command(location: Location, file: Path | None, *, is_json: bool) -> None:
    """Check whether published numbers are possible, consistent and better than chance.

    FILE has the columns of reference/published.csv, which is taken without it. Flags are findings about other
    people's figures, not errors of the file: the exit status is 1 only if FILE cannot be read.
    """
    audited = audit(read_published(file or _find_published(location)))
    text = render_audit_json(audited) if is_json else render_audit(audited, terminal=current_terminal())
    click.echo(text, nl=False)


def _find_published(location: Location) -> Path:
    file = location.find_instance().reference_file(PUBLISHED_FILE)
    if not file.is_file():
        raise InstanceError(
            f"this leaderboard has no reference/{PUBLISHED_FILE}", "name a file: leaderboard audit FILE"
        )
    return file
