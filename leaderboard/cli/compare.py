"""``leaderboard compare``."""

from pathlib import Path

import click

from leaderboard.cli.location import Location, current_terminal, today
from leaderboard.comparing import compare
from leaderboard.errors import LeaderboardError
from leaderboard.ids import find_nearest, is_slug
from leaderboard.instance import Instance
from leaderboard.reference import Reference
from leaderboard.report.comparison import render_comparison, render_comparison_json
from leaderboard.submission import Submission, read_any
from leaderboard.validation import validate


@click.command("compare")
@click.argument("a")
@click.argument("b")
@click.option("--json", "is_json", is_flag=True, help="Print the comparison as JSON.")
@click.pass_obj
def command(location: Location, *, a: str, b: str, is_json: bool) -> None:
    """Compare two submissions by pairs: differences with intervals and exact tests.

    A and B are slugs, submission folders or predictions files.
    """
    instance, reference = location.load_reference()
    two = [_load(instance, reference, name) for name in (a, b)]
    comparison = compare(two[0], two[1], reference)
    if is_json:
        click.echo(render_comparison_json(comparison), nl=False)
        return
    names = {s.slug: s.metadata.submission.name for s in two if s.slug and s.metadata}
    click.echo(render_comparison(comparison, reference, names, terminal=current_terminal()), nl=False)


def _load(instance: Instance, reference: Reference, name: str) -> Submission:
    """Load a valid submission by its slug or path."""
    folder = instance.submission_dir(name) if is_slug(name) else Path(name)
    path = folder if folder.exists() else Path(name)
    if not path.exists():
        near = find_nearest(name, [known.name for known in instance.submission_dirs()])
        hint = f"did you mean {near}?" if near else "give a slug, a submission's folder or a predictions file"
        raise LeaderboardError(f"there is no submission {name!a}", hint)
    location = instance.display_path(path)
    submission = validate(read_any(path, location), reference, today=today()).submission
    if submission is None:
        raise LeaderboardError(f"{location} is not valid", f"see: leaderboard validate {location}")
    return submission
