"""``leaderboard submit``."""

import datetime as dt
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_args

import click

from leaderboard.assessing import Assessment
from leaderboard.cli.location import Location, current_terminal, today
from leaderboard.grading import grade_people
from leaderboard.instance import RESULT_FILE, Instance
from leaderboard.models import metadata as fields
from leaderboard.reference import Reference
from leaderboard.report.problems import render_problems
from leaderboard.report.result import render_result
from leaderboard.report.translation import render_translations
from leaderboard.submitting import (
    Metadata,
    add_submission,
    draft_submission,
    read_metadata,
    read_prediction_file,
    suggest_slug,
    translate_files,
)


def _choice(values: object) -> click.Choice[str]:
    return click.Choice(get_args(values))


# Each option: its key and section in submission.toml, the question asked where it is missing, its type.
# A question marks what is required.
_OPTIONS: dict[str, tuple[str, str, Any, str]] = {
    "name": ("submission", "Name of the system, as the board shows it", str, ""),
    "system": (
        "submission",
        "",
        str,
        "Short name that ties together one model's entries; from the name if left out.",
    ),
    "team": ("submission", "Team", str, ""),
    "date": ("submission", "", str, "Date, YYYY-MM-DD; today (UTC) if left out."),
    "description": ("submission", "One or two sentences on the system", str, ""),
    "training": ("protocol", "Training", _choice(fields.Training), "How it was trained."),
    "testing": ("protocol", "Testing", _choice(fields.Testing), "What it saw of a test video."),
    "training-trials": ("protocol", "", int, "Number of training trials."),
    "auxiliary": ("protocol", "", _choice(fields.Auxiliary), "How the property entered training."),
    "selection": ("protocol", "", _choice(fields.Selection), "What the model was selected on."),
    "answer-reader": ("protocol", "", int, "Version of the reader of YES and NO, as convert reports it."),
    "family": ("model", "Family of models", _choice(fields.Family), ""),
    "inputs": ("model", "Inputs", _choice(fields.Inputs), "What the model takes as input."),
    "parameters": ("model", "", str, "Number of parameters, as text."),
    "pretraining": ("model", "", str, "Data of pretraining, as text."),
    "paper": ("links", "", str, "Link."),
    "code": ("links", "", str, "Link."),
    "weights": ("links", "", str, "Link."),
    "github": ("contact", "GitHub account to contact", str, ""),
}


def _add_options(function: Callable[..., None]) -> Callable[..., None]:
    for name, (_, question, type_, help_) in reversed(_OPTIONS.items()):
        required = "Required. " if question else ""
        option = click.option(f"--{name}", type=type_, help=f"{required}{help_ or question + '.'}")
        function = option(function)
    return function


@dataclass(frozen=True)
class _Sending:
    """Whether and where to send it, and whether only to say so."""

    pr: bool
    dry_run: bool
    repository: str | None
    api_url: str


@click.command("submit")
@click.argument(
    "files",
    metavar="FILE...",
    nargs=-1,
    required=True,
    type=click.Path(exists=True, path_type=Path),
)
@click.option("--slug", help="Name of the folder under submissions/; from the name if left out.")
@click.option(
    "--metadata",
    "metadata_file",
    metavar="TOML",
    type=click.Path(exists=True, dir_okay=False, path_type=Path),
    help="File like submission.toml, whole or in part; options count before it.",
)
@_add_options
@click.option(
    "--pr", is_flag=True, help="Send it to GitHub as a pull request, or bring the open one up to date."
)
@click.option("--dry-run", is_flag=True, help="Only say what would be written and sent.")
@click.option(
    "--repository",
    metavar="OWNER/NAME",
    help="Who takes the pull request; from the git remote upstream or origin if left out.",
)
@click.option(
    "--api-url",
    metavar="URL",
    envvar="GITHUB_API_URL",
    default="https://api.github.com",
    show_default=True,
    help="GitHub's API; for GitHub Enterprise https://HOST/api/v3.",
)
@click.pass_obj
def command(
    location: Location,
    /,
    files: tuple[Path, ...],
    slug: str | None,
    metadata_file: Path | None,
    **options: Any,  # noqa: ANN401  (texts and numbers, as _OPTIONS says)
) -> None:
    """Make submissions/<slug>/ from prediction files: valid and graded, or nothing.

    Several files, say one per property, are joined. Names that other tools and files use for a trial, such as
    the path of its video, become its id. On a terminal, what is required and missing is asked for.

    With --pr it is then sent to GitHub as a pull request, with the token in GITHUB_TOKEN or GH_TOKEN, or that
    of gh. Whatever interrupts it, the same command goes on from there. FILE may then also be
    submissions/<slug>, made before.
    """
    sending = _Sending(**{name: options.pop(name) for name in ("pr", "dry_run", "repository", "api_url")})
    instance, reference = location.load_reference()
    if any(file.is_dir() for file in files):
        from leaderboard.github.made import load_made

        assessment = load_made(instance, reference, _find_slug(instance, files, sending), today=today())
    else:
        given = _gather_metadata(read_metadata(metadata_file) if metadata_file else {}, options)
        assessment = _make(instance, reference, files, slug=slug, given=given, sending=sending)
    if assessment.result is None or assessment.submission is None:
        click.echo(render_problems(assessment.problems, "text"), nl=False)
        click.echo(f"nothing was {'sent' if sending.pr else 'written'}", err=True)
        sys.exit(1)
    people = grade_people(reference)
    metadata, terminal = assessment.submission.metadata, current_terminal()
    click.echo(render_result(assessment.result, reference, people, metadata=metadata, terminal=terminal))
    done = "would write" if sending.dry_run else "wrote"
    if assessment.raw.find(RESULT_FILE) is None:  # it was made just now
        click.echo(f"{done} {assessment.raw.location}/")
    if sending.pr:
        _send(instance, reference, assessment, sending)


def _find_slug(instance: Instance, files: tuple[Path, ...], sending: _Sending) -> str:
    """Name the one submission whose folder is given."""
    folder = files[0].absolute()
    if len(files) > 1 or folder.parent.resolve() != instance.submissions_dir.resolve():
        raise click.UsageError("give prediction files, or with --pr one folder of submissions/")
    if not sending.pr:
        raise click.UsageError(
            f"{files[0]} is made already: send it with --pr, or grade it with leaderboard grade"
        )
    return folder.name


def _make(
    instance: Instance,
    reference: Reference,
    files: tuple[Path, ...],
    *,
    slug: str | None,
    given: Metadata,
    sending: _Sending,
) -> Assessment:
    is_dated = given["submission"].get("date") is not None
    metadata = _complete(given)
    slug = slug or suggest_slug(str(metadata["submission"]["name"]))
    if not slug:
        raise click.UsageError("no slug can be made from the name: give one with --slug")
    if metadata["submission"]["system"] is None:
        metadata["submission"]["system"] = slug
    parts, names = translate_files([read_prediction_file(file) for file in files], reference)
    if names:
        click.echo(render_translations(names), err=True)
    if sending.pr:
        from leaderboard.github.made import is_made, load_made

        if is_made(instance, slug, metadata=metadata, files=parts, is_dated=is_dated):
            return load_made(instance, reference, slug, today=today())
    make = draft_submission if sending.dry_run else add_submission
    return make(instance, reference, slug, metadata=metadata, files=parts, today=today())


def _gather_metadata(written: Metadata, options: dict[str, Any]) -> Metadata:
    """Take each key from its option, else from the file; None where neither gives it."""
    metadata = {section: dict(keys) for section, keys in written.items()}
    for name, (section, *_) in _OPTIONS.items():
        key = name.replace("-", "_")
        keys = metadata.setdefault(section, {})
        keys[key] = keys.get(key) if options[key] is None else options[key]
    return metadata


def _send(instance: Instance, reference: Reference, assessment: Assessment, sending: _Sending) -> None:
    """Show what goes where and send it; what needs the network is loaded only then."""
    from leaderboard.github.addresses import check_api_url, choose_repository, web_host
    from leaderboard.github.proposals import draft_proposal
    from leaderboard.report.proposal import render_outcome, render_plan

    api_url = check_api_url(sending.api_url)
    repository = choose_repository(instance, sending.repository, api_url)
    proposal = draft_proposal(instance, reference, assessment)
    verb = "would send" if sending.dry_run else "sending"
    click.echo(f"{verb} {render_plan(repository, proposal.branch, proposal.title, proposal.contents)}")
    if sending.dry_run:
        click.echo(f"\n{proposal.body}", nl=False)
        return
    from leaderboard.github.client import Client
    from leaderboard.github.proposing import propose
    from leaderboard.github.tokens import find_token

    token = find_token(os.environ, web_host(api_url))
    with Client(api_url, token, tell=lambda line: click.echo(line, err=True)) as client:
        outcome = propose(client, proposal, repository, is_named=sending.repository is not None)
    click.echo(render_outcome(outcome, proposal.slug))


def _complete(given: Metadata) -> dict[str, dict[str, object]]:
    """Fill in what is missing: the date from the clock, the rest by asking, if there is somebody to ask."""
    metadata = {section: dict(keys) for section, keys in given.items()}
    metadata["submission"]["date"] = _parse_date(metadata["submission"]["date"])
    missing = [
        name
        for name, (section, question, *_) in _OPTIONS.items()
        if question and metadata[section][name.replace("-", "_")] is None
    ]
    if missing and not sys.stdin.isatty():
        raise click.UsageError("missing " + ", ".join(f"--{name}" for name in missing))
    for name in missing:
        section, question, type_, _ = _OPTIONS[name]
        metadata[section][name.replace("-", "_")] = click.prompt(question, type=type_)
    return metadata


def _parse_date(value: object) -> object:
    """Read the text of an option; TOML has dates of its own, and what else it holds is judged later."""
    if not isinstance(value, str):
        return today() if value is None else value
    try:
        return dt.date.fromisoformat(value)
    except ValueError:
        raise click.UsageError(f"--date {value!r} is not a date such as {today()}") from None
