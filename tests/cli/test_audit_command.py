"""``leaderboard audit`` from the outside."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from leaderboard.cli import group

Run = Callable[..., Result]

HEADER = "source,url,system,training,testing,training_trials,auxiliary,scope,metric,printed,n,note\n"


def test_without_a_file_the_reference_is_audited(run: Run) -> None:
    """The table ends with how often each flag is set and what it means; findings are no failure."""
    output = run("audit").output
    assert "169 numbers:\n   12 impossible: no whole number of right answers" in output
    assert "    1 not-the-mean: the overall cannot be the plain mean of its parts" in output


def test_json_has_every_row_with_its_findings(run: Run) -> None:
    """The columns of the file, what was found, and the flags counted."""
    data = json.loads(run("audit", "--json").output)
    assert len(data["numbers"]) == 169
    assert data["flags"] | {"not-above-chance": 0} == {
        "impossible": 12,
        "truncated": 2,
        "not-the-mean": 1,
        "not-above-chance": 0,
        "n-unknown": 1,
    }
    (found,) = (each for each in data["numbers"] if "not-the-mean" in each["flags"])
    assert (found["system"], found["printed"], found["mean_of_parts"]) == ("VGG-mlp", "56.0", 0.5965)


def test_a_file_needs_no_leaderboard_around_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Any table in the same form can be audited."""
    file = tmp_path / "numbers.csv"
    file.write_text(f"{HEADER}A paper,,A,,,,,Mass,accuracy,67.1,192,\n")
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(group, ["audit", "--json", str(file)])
    assert result.exit_code == 0
    assert json.loads(result.output)["numbers"][0]["flags"] == ["truncated"]


def test_a_broken_file_is_named(run: Run, tmp_path: Path) -> None:
    """Exit status 1 and one line with file, line and column."""
    file = tmp_path / "numbers.csv"
    file.write_text(f"{HEADER}A paper,,A,,,,,Mass,accuracy,sixty,192,\n")
    output = run("audit", file, exit_code=1).output
    assert output.startswith(f"error: {file}:2: printed is 'sixty': must be a number such as 52.6")


def test_a_leaderboard_without_published_numbers_says_so(run: Run, root: Path) -> None:
    """And what to do."""
    (root / "reference/published.csv").unlink()
    assert run("audit", exit_code=1).output.splitlines() == [
        "error: this leaderboard has no reference/published.csv",
        "  name a file: leaderboard audit FILE",
    ]


def test_a_missing_file_is_wrong_usage(run: Run, tmp_path: Path) -> None:
    """Exit status 2, as for every argument that names nothing."""
    assert "does not exist" in run("audit", tmp_path / "no", exit_code=2).output
