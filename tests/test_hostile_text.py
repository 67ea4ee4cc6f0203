"""Hostile text in every place where a stranger may write, refused: messages about it stay messages.

In the terminal, in annotations, in JSON and on the pages of the check on pull requests. What is taken and
shown is looked at in tests/report/test_hostile_names.py and tests/website/test_hostile_pages.py.
"""

import csv
import io
import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
import tomli_w
from click.testing import CliRunner

from builders import build_reference
from git_trees import GitTrees
from hostile_texts import BAD_LINKS, FORBIDDEN, PRINTABLE, check_lines, outside_of_fences
from hostile_twins import judge_texts
from leaderboard.assessing import assess
from leaderboard.changes import ChangeCheck
from leaderboard.cli import group
from leaderboard.problems import Problem
from leaderboard.reference import Reference
from leaderboard.report.changes import render_change_json, render_change_summary
from leaderboard.report.problems import render_problems, render_verdict
from leaderboard.report.verification import render_verification
from leaderboard.submission import RawFile, RawSubmission
from leaderboard.verifying import Verification
from raw_submissions import SUBMISSION_TOML, TODAY, predictions_csv, raw_folder
from reference_folders import ReferenceFolder

EVERYTHING = {**PRINTABLE, **FORBIDDEN}
TEXT_KEYS = ("name", "team", "description", "parameters", "pretraining")
RULED_KEYS = ("system", "training", "testing", "family", "inputs", "github", "paper", "code", "weights")
ANNOTATION = re.compile(r"::(error|warning|notice) file=[^,:]*(,line=\d+)?,title=[a-z0-9-]+::[^\n]*")


@pytest.fixture(scope="module")
def reference() -> Reference:
    return build_reference()


def check_messages(problems: tuple[Problem, ...], reference: Reference, slug: str | None = "example") -> None:
    """Each way to show problems keeps each to its line, its annotation or its fence."""
    check_lines(render_problems(problems, "text"))
    for line in render_problems(problems, "github").splitlines():
        assert line.startswith("::notice::...") or ANNOTATION.fullmatch(line), ascii(line)
        assert line.isprintable()
    assert json.loads(render_problems(problems, "json"))["valid"] is False
    render_problems(problems, "json").encode()
    check = ChangeCheck(slug, "0" * 40, problems, None)
    page = render_change_summary(check, reference)
    check_lines(page)
    harmless = ChangeCheck(None, "0" * 40, (Problem(problems[0].code, "x", "x"),), None)
    shape = re.compile(r"errors \d+, others \d+|`[a-z0-9-]+` must|The branch must")
    left, right = (
        shape.sub("...", outside_of_fences(p)) for p in (page, render_change_summary(harmless, reference))
    )
    assert left == right
    json.loads(render_change_json(check))


@pytest.mark.parametrize("key", TEXT_KEYS)
def test_what_must_not_be_seen_is_refused_by_name(reference: Reference, key: str) -> None:
    """Control, direction and invisible characters, and texts without end, in each key that takes a text."""
    for text in FORBIDDEN.values():
        assessment = judge_texts(reference, **{key: text})
        assert assessment.result is None, ascii(text)
        assert {problem.line for problem in assessment.problems} != {None}
        check_messages(assessment.problems, reference)


@pytest.mark.parametrize("key", RULED_KEYS)
def test_keys_with_rules_take_no_hostile_text(reference: Reference, key: str) -> None:
    """A name of the system, a choice, an account or a link is one, or is refused."""
    for text in (*EVERYTHING.values(), *BAD_LINKS):
        assessment = judge_texts(reference, **{key: text})
        assert assessment.result is None, ascii(text)
        check_messages(assessment.problems, reference)


def test_keys_themselves_are_texts_too(reference: Reference) -> None:
    """An unknown key or section may be called anything."""
    for text in EVERYTHING.values():
        for extra in ({text: 1}, {"model": {text: 1}}, {"model": {"family": [text]}}):
            toml = SUBMISSION_TOML.replace("[model]", "[modell]") + tomli_w.dumps(extra)
            assessment = assess(raw_folder(predictions_csv(reference), toml), reference, today=TODAY)
            assert assessment.result is None
            check_messages(assessment.problems, reference)


@pytest.mark.parametrize("column", ["trial_id", "probability", "status", "header"])
def test_cells_are_named_and_stay_in_their_line(reference: Reference, column: str) -> None:
    """Whatever stands in a table, the message about it is one short line."""
    for text in EVERYTHING.values():
        row = {"trial_id": reference.trial_ids[0], "probability": "0.5", "status": "answered"}
        header = [*row]
        if column == "header":
            header[2] = text
        else:
            row[column] = text
        table = io.StringIO()
        csv.writer(table, lineterminator="\n").writerows([header, [*row.values()]])
        raw = raw_folder(table.getvalue().encode())
        check_messages(assess(raw, reference, today=TODAY).problems, reference)


def test_names_of_files_and_folders_are_texts(reference: Reference) -> None:
    """Of a submission, and of whatever lies beside them; also names that are no text at all."""
    for text in (*EVERYTHING.values(), "\udcff\udcfe", "a/b", ".git"):
        for location, name in [("submissions/example", text), (f"submissions/{text}", "predictions.csv")]:
            files = (RawFile(name, "file", 1, b"x"), RawFile("link", "symlink", 0, None))
            raw = RawSubmission(location, text, files)
            assessment = assess(raw, reference, today=TODAY)
            check_messages(assessment.problems, reference, text)
            check_lines(f"{render_verdict(raw.location, None, assessment.problems)}\n")
        check_lines(render_verification(Verification(None, text[:255], (), (text[:255],))))


@pytest.mark.parametrize(
    "name", ["a\n::error::b", "::error::b", "##[error]b", "a\x1b[2J", "a\u202eb", "=1+1", "@all", "\udcff"]
)
def test_a_branch_with_a_hostile_folder_is_answered_in_words(
    name: str, hostile_branch: Callable[[str], list[str]]
) -> None:
    """The workflow's command prints lines, annotations or JSON, and a page in which all is fenced."""
    arguments = hostile_branch(name)
    for form in ("text", "github", "json"):
        done = CliRunner().invoke(group, [*arguments, "--format", form])
        assert done.exit_code == 1
        if form == "github":
            assert all(ANNOTATION.fullmatch(line) for line in done.stdout.splitlines())
        elif form == "text":
            check_lines(done.stdout)
        else:
            json.loads(done.stdout)
    page = (Path(arguments[1]) / "page.md").read_text(encoding="utf-8")
    check_lines(page)
    assert name not in outside_of_fences(page)


@pytest.fixture
def hostile_branch(tmp_path: Path) -> Callable[[str], list[str]]:
    """An instance with a branch that adds a folder of some name; the arguments to check it."""

    def make(name: str) -> list[str]:
        ReferenceFolder().write(tmp_path)
        git = GitTrees(tmp_path).init()
        base = git.commit({"README.md": b"x"})
        head = git.commit({"README.md": b"x", f"submissions/{name}/predictions.csv": b"x"}, base)
        page = str(tmp_path / "page.md")
        return ["--root", str(tmp_path), "check-changes", base, head, "--summary", page]

    return make


def test_errors_of_the_program_are_lines_too(tmp_path: Path) -> None:
    """A folder's name is quoted in a message, with all that it holds."""
    for text in ("a\n::error::b", "\x1b[2J", "##[error]"):
        done = CliRunner().invoke(group, ["--root", str(tmp_path / text), "rank"])
        assert done.exit_code == 1
        check_lines(done.stderr)
        assert done.stderr.startswith("error: ")
