"""``leaderboard reference``."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import click

from leaderboard.cli.location import Location

if TYPE_CHECKING:
    from leaderboard.reference.importing import ImportReport

RECIPE_NAMES = ("physion", "physionpp")
COLUMN_KINDS = ("participant", "trial", "response", "correct", "label", "count", "n_yes")


@click.group("reference")
def command() -> None:
    """Show, check, seal, fetch, import or synthesize the reference data."""


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
@click.option("--json", "is_json", is_flag=True, help="Print it as JSON.")
@click.pass_obj
def check(location: Location, *, is_json: bool) -> None:
    """Print every assumption beside what was found, and report every departure.

    Exit status 1 if a finding is an error or a warning that errata.toml does not accept; notes only inform.
    """
    from leaderboard.cli.location import current_terminal
    from leaderboard.reference.checking import check_reference
    from leaderboard.report.datasheet import render_check, render_check_json

    verdict = check_reference(location.find_instance())
    text = render_check_json(verdict) if is_json else render_check(verdict, terminal=current_terminal())
    click.echo(text, nl=False)
    sys.exit(0 if verdict.is_sound else 1)


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


def read_columns(_: click.Context, __: click.Parameter, value: str | None) -> dict[str, str]:
    """Parse ``kind=column,kind=column``."""
    pairs = [part.partition("=") for part in (value or "").split(",") if part]
    kinds = [kind.strip() for kind, _, _ in pairs]
    unknown = [kind for kind in kinds if kind not in COLUMN_KINDS]
    if unknown:
        raise click.BadParameter(f"{unknown[0]!r} is none of {', '.join(COLUMN_KINDS)}")
    if any(not column.strip() for _, _, column in pairs) or len(set(kinds)) < len(kinds):
        raise click.BadParameter("write it as participant=COLUMN,trial=COLUMN,response=COLUMN")
    return {kind: column.strip() for kind, (_, _, column) in zip(kinds, pairs, strict=True)}


def import_options(function: Callable[..., None]) -> Callable[..., None]:
    """Add the options that reading official files has, wherever they come from."""
    options = (
        click.option(
            "--columns",
            callback=read_columns,
            metavar="KIND=COLUMN,...",
            help=f"Which columns hold human data; kinds are {', '.join(COLUMN_KINDS)}.",
        ),
        click.option(
            "--allow-unmatched", is_flag=True, help="Leave out answers that name no trial, and count them."
        ),
        click.option("--accept-change", is_flag=True, help="Replace an official reference that differs."),
    )
    for option in reversed(options):
        function = option(function)
    return function


@command.command("import")
@click.argument("recipe", type=click.Choice(RECIPE_NAMES))
@click.option(
    "--from",
    "sources",
    required=True,
    multiple=True,
    type=click.Path(exists=True, path_type=Path),
    help="A folder or zip with official files; may be given several times.",
)
@import_options
@click.pass_obj
def import_(
    location: Location,
    *,
    recipe: str,
    sources: tuple[Path, ...],
    columns: dict[str, str],
    allow_unmatched: bool,
    accept_change: bool,
) -> None:
    """Make the reference from official files on disk, and seal it as official.

    It takes the place of a simulated reference, or of an older official one with --accept-change; with --root
    NEW it makes a new instance. Exit status 1 if nothing was written although something would have changed.
    """
    from leaderboard.reference.importing import import_reference
    from leaderboard.reference.recipes import RECIPES, ImportOptions
    from leaderboard.reference.source_files import read_source_files

    report = import_reference(
        RECIPES[recipe],
        read_source_files(sources, RECIPES[recipe].is_wanted),
        location.new_instance(),
        options=ImportOptions(columns, allow_unmatched),
        accept_change=accept_change,
    )
    _print_import(report)


@command.command("fetch")
@click.argument("recipe", type=click.Choice(RECIPE_NAMES), required=False)
@click.option("--mirror", default="", metavar="URL", help="Take the files from below this address instead.")
@click.option(
    "--full-download", is_flag=True, help="Take archives of gigabytes whole, not only the lists in them."
)
@import_options
@click.pass_obj
def fetch(  # noqa: PLR0913  (one for each option)
    location: Location,
    *,
    recipe: str | None,
    mirror: str,
    full_download: bool,
    columns: dict[str, str],
    allow_unmatched: bool,
    accept_change: bool,
) -> None:
    """Fetch official files and make the reference from them, as import does.

    Without RECIPE, that of the benchmark here. Of an archive of gigabytes only the lists are transferred, and
    what was transferred before is not transferred again. Proxies and certificates are the environment's.
    """
    from leaderboard.reference.fetching.progress_bar import ProgressBar
    from leaderboard.reference.importing import FetchOptions, fetch_reference
    from leaderboard.reference.recipes import RECIPES, ImportOptions

    name = recipe or _recipe_here(location)
    report = fetch_reference(
        RECIPES[name],
        location.new_instance(),
        how=FetchOptions(mirror, full_download, progress=ProgressBar()),
        options=ImportOptions(columns, allow_unmatched),
        accept_change=accept_change,
    )
    _print_import(report)


def _recipe_here(location: Location) -> str:
    """Name the recipe of the benchmark whose instance this is."""
    from leaderboard.problems import Problems
    from leaderboard.reference.definition import read_benchmark

    found = read_benchmark(location.find_instance(), Problems())
    if found is None or found[1].name not in RECIPE_NAMES:
        raise click.UsageError(f"name a recipe: {' or '.join(RECIPE_NAMES)}")
    return found[1].name


def _print_import(report: "ImportReport") -> None:
    from leaderboard.report.importing import render_import

    click.echo(render_import(report), nl=False)
    sys.exit(1 if report.is_refused else 0)
