"""`leaderboard ledger` on an instance with one graded submission."""

from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

from git_trees import GitTrees
from leaderboard.files import sha256_hex
from leaderboard.instance import Instance
from leaderboard.recording import check_ledger, open_history

Run = Callable[..., Result]


def test_a_ledger_is_begun_and_then_sound(root: Path, example: Path, run: Run) -> None:
    """`update` prints what it appends, `check` counts what is there, and a second update adds nothing."""
    digest = sha256_hex((example / "result.json").read_bytes())
    output = run("ledger", "check", exit_code=1).output
    assert output == (
        "submissions/example-slots: ledger-unrecorded: has no line in the ledger\n"
        "    leaderboard ledger update\n"
    )
    output = run("ledger", "update", "--date", "2026-11-21").output
    assert output == (
        f"2026-11-21,example-slots,added,new submission,{digest}\n1 new in submissions/ledger.csv\n"
    )
    written = (root / "submissions/ledger.csv").read_bytes()
    assert run("ledger", "check").output == (
        "the ledger is sound: lines 1, submissions 1; there is no history to compare it with\n"
    )
    assert run("ledger", "update").output == "0 new in submissions/ledger.csv\n"
    assert (root / "submissions/ledger.csv").read_bytes() == written


def test_with_a_history_nothing_is_left_out(root: Path, example: Path, run: Run) -> None:
    """Results that changed are compared with the committed ones, and what is refused is not written."""
    git = GitTrees(root).init()
    run("ledger", "update", "--date", "2026-11-21")
    git.run("add", "--all")
    git.run("commit", "-q", "-m", "message")
    assert run("ledger", "check").output == "the ledger is sound: lines 1, submissions 1\n"
    result = example / "result.json"
    text = result.read_text(encoding="utf-8")
    assert '"answered": 768' in text
    result.write_text(text.replace('"answered": 768', '"answered": 767'), encoding="utf-8")
    lines = run("ledger", "update", exit_code=1).output.splitlines()
    assert lines[0] == (
        "submissions/example-slots/result.json: ledger-score: coverage answered was 768, is now 767"
        " (other bytes by the same grader)"
    )
    assert lines[-1] == "nothing was written to the ledger"
    assert run("ledger", "check", exit_code=1).output.startswith(
        "submissions/example-slots: ledger-unrecorded"
    )


def test_a_withdrawn_submission_is_on_no_board(root: Path, example: Path, run: Run) -> None:
    """Neither in the terminal nor on the site, though its folder stays."""
    run("ledger", "update", "--date", "2026-11-21")
    ledger = root / "submissions/ledger.csv"
    line = (
        ledger.read_text(encoding="utf-8").splitlines()[1].replace("added,new submission", "withdrawn,a test")
    )
    ledger.write_text(f"{ledger.read_text(encoding='utf-8')}{line}\n", encoding="utf-8")
    assert "Example Slots" not in run("rank").output
    run("site", "build")
    assert not (root / "site/dist/submissions" / example.name).exists()
    assert "Example Slots" not in (root / "site/dist/index.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("arguments", [("check", "x"), ("update", "--date", "today"), ("remove",)])
def test_wrong_usage_is_told(run: Run, arguments: tuple[str, ...]) -> None:
    """Exit status 2."""
    run("ledger", *arguments, exit_code=2)


def test_the_ledger_of_this_repository_is_sound(repo_root: Path) -> None:
    """Every row that is published here is in it, and no line of it was ever rewritten."""
    instance = Instance(repo_root)
    assert check_ledger(instance, open_history(instance)).problems == ()
