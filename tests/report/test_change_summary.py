"""The verdict on a branch as a page: what its author wrote stays text, and the page stays small."""

import datetime as dt
import json
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from builders import build_reference
from hostile_texts import outside_of_fences
from leaderboard.assessing import assess
from leaderboard.changes import ChangeCheck
from leaderboard.problems import CODES, Problem
from leaderboard.reference import Reference
from leaderboard.report.changes import fence, render_change_json, render_change_summary
from raw_submissions import SUBMISSION_TOML, predictions_csv, raw_folder

HEAD = "abcdef0123456789" * 2
HOSTILE = [
    "```\n# Title",
    "``````````",
    "[link](https://example.com) ![image](https://example.com/x.png)",
    "@everyone closes #1",
    "<script>alert(1)</script><img src=x onerror=alert(1)>",
    "::error::x",
    "\n::stop-commands::x",
    "\x1b[2J\u202e\u200b\0",
    "| a | b |",
    "x" * 10_000,
    "\udcff",
]


@pytest.fixture(scope="module")
def reference() -> Reference:
    return build_reference()


def judge(reference: Reference, *problems: Problem, toml: str = SUBMISSION_TOML) -> ChangeCheck:
    raw = raw_folder(predictions_csv(reference), toml)
    assessment = assess(raw, reference, today=dt.date(2026, 6, 1))
    assert assessment.result is not None
    return ChangeCheck("example", HEAD, problems, assessment)


def test_the_page_shows_verdict_scores_and_reference(reference: Reference) -> None:
    """What is decided, about which commit, by which reference, with intervals."""
    page = render_change_summary(judge(reference), reference)
    lines = page.splitlines()
    assert lines[0] == "## `example` may be merged"
    assert (
        lines[2]
        == "Commit `abcdef012345`, judged with the base branch's grader and reference `000000000000`."
    )
    assert "**The reference is synthetic: labels and people are simulated; no figure here is real.**" in lines
    assert "name      Example" in lines
    assert "| scope | trials | accuracy | 95 % | human r | 95 % |" in lines
    rows = [
        line for line in lines if re.match(r"\| (overall|Alpha|Beta) \| \d+ \| \d+\.\d \| [\d.]+ to ", line)
    ]
    assert len(rows) == 3
    assert lines[-1].startswith("This is advice: what counts is graded again")


def test_problems_are_listed_below(reference: Reference) -> None:
    """With their hints, and the verdict that they lead to."""
    problem = Problem("change-outside", "this changes 'x' too", "x", hint="send it on its own")
    page = render_change_summary(judge(reference, problem), reference)
    assert page.startswith("## `example` must not be merged as it is\n")
    assert (
        "### Found: errors 1, others 0\n\n```text\nx: change-outside: this changes 'x' too\n    send it"
        in page
    )


def test_without_a_submission_there_is_still_a_page(reference: Reference) -> None:
    """A branch that changes nothing, or too much, has no slug and no scores."""
    problem = Problem("change-nothing", "the two commits do not differ", ".")
    page = render_change_summary(ChangeCheck(None, HEAD, (problem,), None), reference)
    assert page.startswith("## The branch must not be merged as it is\n")
    assert "| scope |" not in page


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_what_the_author_wrote_stays_in_fences(reference: Reference, text: str) -> None:
    """Slug, paths, messages and hints: none of it is Markdown, and no line is a command to the host."""
    clean = render_change_summary(ChangeCheck(None, HEAD, (), None), reference)
    problem = Problem("unexpected-file", text, text, 3, text)
    page = render_change_summary(ChangeCheck(text, HEAD, (problem,), None), reference)
    left = outside_of_fences(page).replace("### Found: errors 1, others 0\n\n\n", "")
    assert left == clean.replace("may be merged", "must not be merged as it is")
    assert all(line.isprintable() and len(line) <= 300 for line in page.split("\n"))
    assert not any(line.lstrip().startswith("::") for line in page.split("\n"))


@given(st.text())
def test_no_text_leaves_its_fence(text: str) -> None:
    """Whatever it is, the fence ends at its end and nowhere before."""
    assert outside_of_fences(f"{fence(text)}\nafter") == "after"


@pytest.mark.parametrize("text", ["@everyone ``` <b>x</b>", "[a](https://example.com)"])
def test_names_are_text_too(reference: Reference, text: str) -> None:
    """A system may be called anything."""
    toml = SUBMISSION_TOML.replace('name = "Example"', f'name = "{text}"')
    page = render_change_summary(judge(reference, toml=toml), reference)
    assert text in page
    assert text not in outside_of_fences(page)


def test_a_page_is_never_larger_than_the_host_shows(reference: Reference) -> None:
    """Thousands of problems of every kind, each as long as can be, stay below one megabyte."""
    problems = [Problem(code, "\U0001d54f" * 5000, "x" * 5000) for code in CODES for _ in range(50)]
    page = render_change_summary(judge(reference, *problems), reference)
    assert len(page.encode()) < 1_000_000
    assert " more lines\n```" in page


def test_programs_get_all_of_it(reference: Reference) -> None:
    """Every problem and the result that grading gives, as JSON."""
    problem = Problem("change-contact", "the contact is a, but the change is b's", "x")
    found = json.loads(render_change_json(judge(reference, problem)))
    assert (found["slug"], found["head"], found["fine"], found["valid"]) == ("example", HEAD, True, True)
    assert [warning["code"] for warning in found["warnings"]] == ["change-contact"]
    assert found["result"]["metrics_version"] >= 1
    nothing = json.loads(render_change_json(ChangeCheck("../x", HEAD, (), None)))
    assert (nothing["slug"], nothing["result"]) == (None, None)
