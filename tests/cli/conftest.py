"""An instance to work on: the embedded reference in an empty folder."""

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from leaderboard.cli import group

Run = Callable[..., Result]


@pytest.fixture
def root(tmp_path: Path, repo_root: Path) -> Path:
    """Copy the embedded reference into an instance of its own."""
    shutil.copytree(repo_root / "reference", tmp_path / "instance/reference")
    return tmp_path / "instance"


@pytest.fixture
def example(root: Path, repo_root: Path) -> Path:
    """Copy a complete, graded submission into the instance."""
    return shutil.copytree(repo_root / "submissions/example-slots", root / "submissions/example-slots")


@pytest.fixture
def run(root: Path) -> Run:
    """Run a command on the instance and check its exit status."""

    def run_command(*arguments: object, exit_code: int = 0, text: str | None = None) -> Result:
        result = CliRunner().invoke(group, ["--root", str(root), *map(str, arguments)], input=text)
        assert result.exit_code == exit_code, result.output
        return result

    return run_command
