"""``leaderboard reference``."""

import sys
from pathlib import Path

import click

from leaderboard.cli.location import Location
from leaderboard.reference.recipes import RECIPES
from leaderboard.report.importing import render_import
from leaderboard.report.problems import render_problems


@click.group("reference")
def command() -> None:
    """Show, check, seal, import or synthesize the reference data."""


@command.command("show")
@click.option("--json", "is_json", is_flag=True, help="Print it as JSON.")
@click.pass_obj
def show(location: Location, *, is_json: bool) -> None:
    """Print what the reference holds: trials, pairs, people, easy and hard."""
    from leaderboard.cli.location import current_terminal
    from leaderboard.reference.describing import describe_reference
    from leaderboard.report.reference import render_description, render_description_json

    _, reference = location.load_reference()
    description = describe_reference(reference)
    if is_json:
        click.echo(render_description_json(description), nl=False)
    else:
        click.echo(render_description(description, reference, terminal=current_terminal()), nl=False)


@command.command("check")
@click.option("--json", "is_json", is_flag=True, help="Print the findings as JSON.")
@click.pass_obj
def check(location: Location, *, is_json: bool) -> None:
    """Report every departure from what the definition expects.

    Exit status 1 if a finding is an error or a warning; notes only inform.
    """
    from leaderboard.problems import Severity
    from leaderboard.reference.checking import check_reference

    findings = check_reference(location.find_instance())
    click.echo(render_problems(findings, "json" if is_json else "text"), nl=False)
    is_sound = all(finding.severity is Severity.NOTE for finding in findings)
    if not is_json:
        click.echo("the reference is sound" if is_sound else "the reference departs from its definition")
    sys.exit(0 if is_sound else 1)


@command.command("seal")
@click.option(
    "--kind", type=click.Choice(["official", "synthetic"]), required=True, help="What the data are."
)
@click.pass_obj
def seal(location: Location, *, kind: str) -> None:
    """Write manifest.json for the files as they are."""
    from leaderboard.reference.sealing import seal_reference

    manifest = seal_reference(location.find_instance(), "official" if kind == "official" else "synthetic")
    click.echo(f"sealed {len(manifest.files)} files as {manifest.kind}, digest {manifest.digest}")


@command.command("synthesize")
@click.option("--seed", type=click.IntRange(0), required=True, help="Seed of the simulation.")
@click.pass_obj
def synthesize(location: Location, *, seed: int) -> None:
    """Simulate trials, labels and people for the benchmark that benchmark.toml defines.

    Writes over the trial lists and human data of the instance and seals them as synthetic.
    """
    from leaderboard.reference.synthesizing import synthesize_reference

    manifest = synthesize_reference(location.find_instance(), seed)
    click.echo(f"wrote and sealed {len(manifest.files)} files, digest {manifest.digest}")


@command.command("import")
@click.argument("recipe", type=click.Choice(sorted(RECIPES)))
@click.option(
    "--from",
    "source",
    required=True,
    type=click.Path(exists=True, file_okay=False, path_type=Path),
    help="The folder with the official files.",
)
@click.pass_obj
def import_(location: Location, *, recipe: str, source: Path) -> None:
    """Make a new instance, in the folder that --root names, from official files."""
    report = RECIPES[recipe].run(source, location.new_instance())
    click.echo(render_import(report), nl=False)
