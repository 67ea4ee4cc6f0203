"""``leaderboard verify``."""

import sys

import click

from leaderboard.cli.location import Location, today
from leaderboard.report.verification import render_verification, render_verification_json
from leaderboard.verifying import verify_instance


@click.command("verify")
@click.option("--json", "is_json", is_flag=True, help="Print the outcome as JSON.")
@click.pass_obj
def command(location: Location, *, is_json: bool) -> None:
    """Grade everything again and prove every committed result and the reference's digest.

    Names each difference; exit status 1 if there is one.
    """
    verification = verify_instance(location.find_instance(), today=today())
    render = render_verification_json if is_json else render_verification
    click.echo(render(verification), nl=False)
    sys.exit(0 if verification.is_proven else 1)
