"""Problems as text, JSON and annotations."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from builders import build_reference, build_submission
from leaderboard.problems import Problem
from leaderboard.report.problems import escape_line, render_problems, render_verdict

ERROR = Problem("unknown-trial", "'x' is not a trial", "a/predictions.csv", 5, "did you mean y?")
WARNING = Problem("beyond-track", "too much", "a/submission.toml")


def test_text_names_place_code_and_remedy() -> None:
    """One line for the problem and an indented one for the hint; warnings say that they are."""
    assert render_problems([ERROR, WARNING], "text") == (
        "a/predictions.csv:5: unknown-trial: 'x' is not a trial\n"
        "    did you mean y?\n"
        "a/submission.toml: warning: beyond-track: too much\n"
    )


def test_nothing_wrong_is_no_text() -> None:
    """No problems, no lines."""
    assert render_problems([], "text") == ""
    assert render_problems([], "github") == ""


def test_json_is_as_specified() -> None:
    """Whether it is valid, errors and warnings, each with all five keys."""
    assert json.loads(render_problems([ERROR, WARNING], "json")) == {
        "valid": False,
        "errors": [
            {
                "code": "unknown-trial",
                "message": "'x' is not a trial",
                "file": "a/predictions.csv",
                "line": 5,
                "hint": "did you mean y?",
            }
        ],
        "warnings": [
            {
                "code": "beyond-track",
                "message": "too much",
                "file": "a/submission.toml",
                "line": None,
                "hint": "",
            }
        ],
    }
    assert json.loads(render_problems([WARNING], "json"))["valid"] is True


def test_text_and_annotations_show_twenty_of_a_code() -> None:
    """The rest is counted; JSON has them all."""
    problems = [WARNING, *[ERROR] * 23]
    text = render_problems(problems, "text").splitlines()
    assert sum("unknown-trial: " in line for line in text) == 20
    assert text[-1] == "... and 3 more of unknown-trial"
    annotations = render_problems(problems, "github").splitlines()
    assert annotations[-1] == "::notice::... and 3 more of unknown-trial"
    assert len(annotations) == 22
    assert len(json.loads(render_problems(problems, "json"))["errors"]) == 23


def test_annotations_are_escaped_as_github_asks() -> None:
    """Percent and line ends everywhere, colon and comma in properties."""
    problem = Problem("unexpected-file", "50%\r\n::x", "a:b,c\n%.csv", 3, "why?")
    assert render_problems([problem], "github") == (
        "::error file=a%3Ab%2Cc%0A%25.csv,line=3,title=unexpected-file::50%25%0D%0A::x; why?\n"
    )
    assert render_problems([WARNING], "github") == (
        "::warning file=a/submission.toml,title=beyond-track::too much\n"
    )


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("plain: é", "plain: é"),
        ("a\x1b[31m\n\u202e\udcff", r"a\x1b[31m\n\u202e\udcff"),
        ("::error::x", r"\x3a:error::x"),
        ("  ::error::x", r"\x3a:error::x"),
        ("x ##[error]", r"x #\x23[error]"),
    ],
)
def test_a_line_is_never_a_command(text: str, shown: str) -> None:
    """Neither to a terminal nor to GitHub."""
    assert escape_line(text) == shown


@given(st.lists(st.text(max_size=12), min_size=3, max_size=3), st.none() | st.integers(1, 99))
def test_no_problem_can_break_out_of_its_line(texts: list[str], line: int | None) -> None:
    """Whatever file, message and hint hold, lines stay printable and are no commands."""
    message, file, hint = texts
    problem = Problem("unexpected-file", message, file, line, hint)
    shown = render_problems([problem], "text").split("\n")[:-1]
    assert len(shown) == 1 + bool(hint)
    for part in shown:
        assert part.isprintable()
        assert not part.lstrip().startswith("::")
        assert "##[" not in part
    annotation = render_problems([problem], "github")
    assert annotation.count("\n") == 1
    assert annotation.startswith("::error file=")
    assert json.loads(render_problems([problem], "json").encode())["errors"][0]["message"] == message


def test_the_verdict_is_one_line() -> None:
    """What is covered and unanswered, or how many problems there are."""
    reference = build_reference()
    whole = build_submission(reference, [0.5] * 24)
    answered = [False] * 2 + [True] * 22
    assert render_verdict("a", whole, []) == "a: valid, 24 of 24 trials"
    unanswered = build_submission(reference, [0.5] * 24, answered=answered)
    assert render_verdict("a", unanswered, [WARNING]) == (
        "a: valid, 24 of 24 trials, 2 of them unanswered, 1 warning"
    )
    assert render_verdict("a\n", None, [ERROR, ERROR, WARNING]) == r"a\n: refused, 2 problems, 1 warning"
