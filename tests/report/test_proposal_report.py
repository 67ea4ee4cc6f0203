"""The text of a pull request shows scores and files, and what the participant wrote stays text."""

import re
from dataclasses import replace

import pytest

from builders import build_reference
from leaderboard.assessing import Assessment, assess
from leaderboard.problems import CODES, Problem
from leaderboard.reference import Reference
from leaderboard.report.proposal import (
    BEGIN_LINE,
    END_LINE,
    Outcome,
    render_outcome,
    render_plan,
    render_proposal_body,
)
from raw_submissions import SUBMISSION_TOML, TODAY, predictions_csv, raw_folder

CONTENTS = {"submissions/example/predictions.csv": b"x" * 1234, "submissions/example/result.json": b""}


@pytest.fixture(scope="module")
def reference() -> Reference:
    return build_reference()


def judge(reference: Reference, *, toml: str = SUBMISSION_TOML) -> Assessment:
    assessment = assess(raw_folder(predictions_csv(reference), toml), reference, today=TODAY)
    assert assessment.result is not None
    return assessment


def test_the_text_shows_what_is_sent(reference: Reference) -> None:
    """Who, how good, graded with what, which files; and below what only people can say."""
    body = render_proposal_body(judge(reference), reference, CONTENTS)
    lines = body.splitlines()
    assert (lines[0], lines[2]) == (BEGIN_LINE, "## Submission `example`")
    assert "name      Example" in lines
    assert "**The reference is synthetic: labels and people are simulated; no figure here is real.**" in lines
    rows = [
        line for line in lines if re.match(r"\| (overall|Alpha|Beta) \| \d+ \| \d+\.\d \| [\d.]+ to ", line)
    ]
    assert len(rows) == 3
    assert "Graded where it was made, with reference `000000000000` and version " in body
    row = next(
        line for line in lines if line.startswith("| `submissions/example/predictions.csv` | 1,234 | `")
    )
    assert re.search(r"`[0-9a-f]{64}` \|$", row)
    assert [line[:6] for line in body.partition(END_LINE)[2].splitlines() if line.startswith("-")] == [
        "- [ ] "
    ] * 2


def test_remarks_are_shown_and_cut(reference: Reference) -> None:
    """Warnings with their hints, in a fence, as many as a page takes."""
    problems = tuple(Problem(code, "::error::x ``` @all", "f", hint="h") for code in list(CODES)[:40])
    assessment = replace(judge(reference), problems=problems)
    body = render_proposal_body(assessment, reference, CONTENTS)
    assert "\nWhat validation remarks:\n\n````text\n" in body
    assert body.count("@all") == 25
    assert "... and 30 more lines" in body


@pytest.mark.parametrize(
    "name", ["<img src=x>", "[a](https://x)", "@all closes #1", "| a |", "```` x", END_LINE[:70]]
)
def test_what_the_participant_wrote_stays_in_its_fence(reference: Reference, name: str) -> None:
    """No link, mention, HTML or table cell comes of it, and it ends no part of the text."""
    toml = SUBMISSION_TOML.replace('name = "Example"', f'name = "{name}"')
    body = render_proposal_body(judge(reference, toml=toml), reference, CONTENTS)
    fenced = re.search(r"^(`{3,})text$.*?^\1$", body, re.MULTILINE | re.DOTALL)
    assert fenced is not None
    assert f"name      {name}" in fenced.group()
    assert name not in body.replace(fenced.group(), "").replace(END_LINE, "")
    assert [line for line in body.splitlines() if line == END_LINE] == [END_LINE]


def test_the_plan_names_every_file() -> None:
    """What goes where, before it goes; a path cannot write to the terminal."""
    plan = render_plan("lab/board", "submission-x", "Submit x", {**CONTENTS, "\x1b[2J": b""})
    assert plan.splitlines() == [
        "to lab/board, as one commit on a branch of yours, submission-x:",
        "  submissions/example/predictions.csv      1,234 bytes",
        "  submissions/example/result.json              0 bytes",
        "  \\x1b[2J                                      0 bytes",
        'with a pull request "Submit x"',
    ]


@pytest.mark.parametrize(
    ("outcome", "said"),
    [
        (Outcome("opened", 7, "https://x/7"), "opened pull request #7: https://x/7"),
        (Outcome("updated", 7, "https://x/7"), "updated pull request #7: https://x/7"),
        (Outcome("unchanged", 7, "https://x/7"), "pull request #7 is up to date: https://x/7"),
        (Outcome("published"), "guess is published already, just as it is here; nothing was sent"),
    ],
)
def test_the_outcome_is_said_in_a_line(outcome: Outcome, said: str) -> None:
    """With the address to look at, if there is one."""
    assert render_outcome(outcome, "guess") == said
