"""``leaderboard grade``."""

import sys
from pathlib import Path

import click

from leaderboard.assessing import Assessment, assess
from leaderboard.cli.location import Location, current_terminal, today
from leaderboard.files import canonical_json, remove_leftovers, write_atomic
from leaderboard.grading import Yardstick, grade_people, result_bytes
from leaderboard.instance import RESULT_FILE
from leaderboard.models import Result
from leaderboard.report.problems import escape_line, render_problems
from leaderboard.submission import RawSubmission, read_any
from leaderboard.verifying import list_differences


@click.command("grade")
@click.argument(
    "paths", metavar="PATH...", nargs=-1, required=True, type=click.Path(exists=True, path_type=Path)
)
@click.option("--check", "is_check", is_flag=True, help="Write nothing; exit 1 if result.json would differ.")
@click.option("--json", "is_json", is_flag=True, help="Print the results as JSON instead of tables.")
@click.option(
    "--output", type=click.Path(dir_okay=False, path_type=Path), help="Write the result to this file."
)
@click.pass_obj
def command(
    location: Location, paths: tuple[Path, ...], *, is_check: bool, is_json: bool, output: Path | None
) -> None:
    """Validate and score submission folders or prediction files.

    Prints the scores and writes result.json into each submission's folder; for a bare predictions file only
    with --output. If anything is refused, its problems are printed and the exit status is 1.
    """
    if output and len(paths) > 1:
        raise click.UsageError("--output takes the result of one path, not of several")
    if output and is_check:
        raise click.UsageError("--check writes nothing, so --output has no meaning with it")
    instance, reference = location.load_reference()
    yardstick = Yardstick.of(reference)
    results: list[Result] = []
    is_fine = True
    for path in paths:
        raw = read_any(path, instance.display_path(path))
        assessment = assess(raw, reference, today=today(), yardstick=yardstick)
        if assessment.result is None:
            click.echo(render_problems(assessment.problems, "text"), err=True, nl=False)
            is_fine = False
            continue
        results.append(assessment.result)
        if not is_json:
            _print_result(assessment, assessment.result, yardstick)
        is_fine = _store(raw, path, assessment.result, output, is_check=is_check) and is_fine
    if is_json:
        data = [result.model_dump(mode="json", by_alias=True) for result in results]
        click.echo(canonical_json(data if len(paths) > 1 else data[0]) if data else "null\n", nl=False)
    sys.exit(0 if is_fine else 1)


def _print_result(assessment: Assessment, result: Result, yardstick: Yardstick) -> None:
    from leaderboard.report.result import render_result

    metadata = assessment.submission.metadata if assessment.submission else None
    reference = yardstick.reference
    people = grade_people(reference, yardstick=yardstick)
    text = render_result(result, reference, people, metadata=metadata, terminal=current_terminal())
    click.echo(text)


def _store(raw: RawSubmission, path: Path, result: Result, output: Path | None, *, is_check: bool) -> bool:
    """Write or compare the result; return whether all is as it should be."""
    content = result_bytes(result)
    target = output or (path / RESULT_FILE if raw.slug is not None else None)
    if target is None:
        return True
    if not is_check:
        if output is None:  # another folder may hold what is not ours
            remove_leftovers(target.parent)
        write_atomic(target, content)
        click.echo(escape_line(f"wrote {target}"), err=True)
        return True
    committed = raw.find(RESULT_FILE)
    differences = list_differences(committed.content if committed else None, content)
    for difference in differences:
        click.echo(escape_line(f"{raw.path_of(RESULT_FILE)}: {difference}"), err=True)
    if not differences:
        click.echo(escape_line(f"{raw.path_of(RESULT_FILE)}: equal to a fresh grade"), err=True)
    return not differences
