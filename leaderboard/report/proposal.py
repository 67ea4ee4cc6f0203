"""A submission on its way to a pull request: the text that goes with it, what would be sent, what was done.

The text is Markdown on the host's pages. As in the verdict on a branch, whatever the participant wrote stands
inside a code fence that nothing in it can close.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

from leaderboard.assessing import Assessment
from leaderboard.files import sha256_hex
from leaderboard.problems import Problem
from leaderboard.reference import Reference
from leaderboard.report.changes import describe_metadata, fence, render_score_table
from leaderboard.report.problems import escape_line, render_problems

# Each alone on its line, which nothing that the participant wrote can be: it follows a word or is indented.
BEGIN_LINE = (
    "<!-- up to the next line like this, the text is written anew when the submission is sent again -->"
)
END_LINE = "<!-- what follows is yours -->"
MAX_SHOWN = 50  # lines of warnings: the host takes 65,536 characters

_DECLARATIONS = (
    "To be ticked by whoever sends it:\n\n"
    "- [ ] labels and human data of the test trials were not used to train or to choose the model, "
    "or the description says how\n"
    "- [ ] the predictions may be published with the rest of this repository"
)


@dataclass(frozen=True)
class Outcome:
    """What became of a submission that was sent; it has no pull request if it was published already."""

    done: Literal["opened", "updated", "unchanged", "published"]
    number: int = 0
    url: str = ""


def render_proposal_body(assessment: Assessment, reference: Reference, contents: Mapping[str, bytes]) -> str:
    """Render the text of a pull request.

    Parameters
    ----------
    assessment
        Of a valid submission, with its result.
    reference
        What it was graded with.
    contents
        Paths of the files that are sent, and their bytes.
    """
    own = [BEGIN_LINE, *_render_own_parts(assessment, reference, contents), END_LINE]
    return "\n\n".join([*own, _DECLARATIONS]) + "\n"


def render_plan(repository: str, branch: str, title: str, contents: Mapping[str, bytes]) -> str:
    """Say what is sent where."""
    width = max(map(len, contents), default=0)
    files = [f"  {escape_line(path):{width}}  {len(data):>9,} bytes" for path, data in contents.items()]
    lines = [
        f"to {repository}, as one commit on a branch of yours, {branch}:",
        *files,
        f'with a pull request "{title}"',
    ]
    return "\n".join(lines)


def render_outcome(outcome: Outcome, slug: str) -> str:
    """Say what was done.

    >>> print(render_outcome(Outcome("opened", 7, "https://example.com/7"), "guess"))
    opened pull request #7: https://example.com/7
    """
    if outcome.done == "published":
        return f"{slug} is published already, just as it is here; nothing was sent"
    if outcome.done == "unchanged":
        return f"pull request #{outcome.number} is up to date: {outcome.url}"
    return f"{outcome.done} pull request #{outcome.number}: {outcome.url}"


def _render_own_parts(
    assessment: Assessment, reference: Reference, contents: Mapping[str, bytes]
) -> Iterator[str]:
    yield f"## Submission `{assessment.raw.slug}`"
    if assessment.submission is not None and assessment.submission.metadata is not None:
        yield fence(describe_metadata(assessment.submission.metadata))
    if reference.is_synthetic:
        yield "**The reference is synthetic: labels and people are simulated; no figure here is real.**"
    if assessment.result is not None:
        yield render_score_table(assessment.result, reference)
        digest, version = reference.manifest.digest[:12], assessment.result.metrics_version
        yield f"Graded where it was made, with reference `{digest}` and version {version} of the metrics."
    yield _render_files(contents)
    if assessment.problems:
        yield "What validation remarks:"
        yield fence(_render_remarks(assessment.problems))


def _render_files(contents: Mapping[str, bytes]) -> str:
    rows = [("file", "bytes", "SHA-256"), ("---", "---:", "---")]
    rows += [(f"`{path}`", f"{len(data):,}", f"`{sha256_hex(data)}`") for path, data in contents.items()]
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)


def _render_remarks(problems: tuple[Problem, ...]) -> str:
    lines = render_problems(problems).rstrip("\n").split("\n")
    rest = len(lines) - MAX_SHOWN
    return "\n".join([*lines[:MAX_SHOWN], *([f"... and {rest} more lines"] if rest > 0 else [])])
