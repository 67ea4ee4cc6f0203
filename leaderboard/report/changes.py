"""The verdict on a branch as a Markdown page and as JSON.

The page is shown on the host that runs the check. Whatever the branch's author wrote stands inside a code
fence that nothing in it can close, so that it is no link, no image, no mention and no HTML.
"""

from collections.abc import Iterator, Sequence

from leaderboard.changes import ChangeCheck
from leaderboard.files import canonical_json
from leaderboard.ids import is_slug
from leaderboard.models import Metadata, Result
from leaderboard.models.benchmark import OVERALL
from leaderboard.problems import Problem
from leaderboard.reference import Reference
from leaderboard.report.problems import escape_line, problems_data, render_problems
from leaderboard.report.terminal import format_interval, format_number, format_percent

# At most 4 bytes a character, so half of the 1 MiB that GitHub shows for a step.
MAX_LINE = 300
MAX_LINES = 400

_COLUMNS = ("scope", "trials", "accuracy", "95 %", "human r", "95 %")


def render_change_summary(check: ChangeCheck, reference: Reference) -> str:
    """Render the verdict with the scores that grading gives and everything that was found, as Markdown."""
    return "\n\n".join(_render_parts(check, reference)) + "\n"


def render_change_json(check: ChangeCheck) -> str:
    """Render the verdict for programs: slug, commit, problems, and the result that grading gives."""
    result = check.assessment.result if check.assessment else None
    return canonical_json(
        {
            "slug": _known_slug(check),
            "head": check.head,
            "fine": check.is_fine,
            **problems_data(check.problems),
            "result": None if result is None else result.model_dump(by_alias=True, mode="json"),
        }
    )


def fence(text: str) -> str:
    """Put a text into a code fence that is longer than any run of backticks in it.

    Lines are cut, and so is the text; what cannot be printed is escaped.

    >>> print(fence("a ```` b"))
    `````text
    a ```` b
    `````
    """
    lines = [_cut(escape_line(line)) for line in text.split("\n")]
    kept = [
        *lines[:MAX_LINES],
        *([f"... and {len(lines) - MAX_LINES} more lines"] * (len(lines) > MAX_LINES)),
    ]
    body = "\n".join(kept)
    ticks = "`" * max(3, _longest_run(body) + 1)
    return f"{ticks}text\n{body}\n{ticks}"


def _render_parts(check: ChangeCheck, reference: Reference) -> Iterator[str]:
    slug = _known_slug(check)
    name = f"`{slug}`" if slug else "The branch"
    yield f"## {name} {'may be merged' if check.is_fine else 'must not be merged as it is'}"
    digest = reference.manifest.digest[:12]
    yield f"Commit `{check.head[:12]}`, judged with the base branch's grader and reference `{digest}`."
    if reference.is_synthetic:
        yield "**The reference is synthetic: labels and people are simulated; no figure here is real.**"
    if check.assessment and check.assessment.submission and check.assessment.submission.metadata:
        yield fence(describe_metadata(check.assessment.submission.metadata))
    if check.assessment and check.assessment.result:
        yield render_score_table(check.assessment.result, reference)
    if check.problems:
        yield f"### Found: {_count(check.problems)}"
        yield fence(render_problems(check.problems).rstrip("\n"))
    yield "This is advice: what counts is graded again from the merged files before anything is published."


def _known_slug(check: ChangeCheck) -> str | None:
    """The slug if it is one: a folder may be called anything."""
    return check.slug if check.slug is not None and is_slug(check.slug) else None


def describe_metadata(metadata: Metadata) -> str:
    """Say in lines of plain text what a submission is; to be shown inside a fence."""
    about, protocol = metadata.submission, metadata.protocol
    return "\n".join(
        [
            f"name      {about.name}",
            f"team      {about.team}",
            f"system    {about.system}",
            f"protocol  training {protocol.training}, testing {protocol.testing}",
            f"contact   {metadata.contact.github}",
        ]
    )


def render_score_table(result: Result, reference: Reference) -> str:
    """Tabulate accuracy and agreement, overall and by property, as Markdown."""
    scopes = [OVERALL, *(p.name for p in reference.benchmark.properties)]
    rows = [_COLUMNS, tuple("---" for _ in _COLUMNS)]
    rows += [_row(scope, result) for scope in scopes if scope in result.scores]
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)


def _row(scope: str, result: Result) -> tuple[str, ...]:
    scores = result.scores[scope]["all"]
    accuracy, human_r = scores.metrics.get("accuracy"), scores.metrics.get("human_r")
    return (
        scope,
        str(scores.n),
        format_percent(accuracy),
        format_interval(accuracy, format_percent),
        format_number(human_r),
        format_interval(human_r, format_number),
    )


def _count(problems: Sequence[Problem]) -> str:
    n_errors = sum(problem.is_error for problem in problems)
    return f"errors {n_errors}, others {len(problems) - n_errors}"


def _cut(line: str) -> str:
    return line if len(line) <= MAX_LINE else line[: MAX_LINE - 3] + "..."


def _longest_run(text: str) -> int:
    longest = run = 0
    for character in text:
        run = run + 1 if character == "`" else 0
        longest = max(longest, run)
    return longest
