"""Finding an instance and its files."""

from pathlib import Path

import pytest

from leaderboard.errors import InstanceError
from leaderboard.instance import Instance, find_instance


def test_the_nearest_instance_upward_is_found(tmp_path: Path) -> None:
    """From a folder deep inside, the instance above it is found."""
    (tmp_path / "reference").mkdir()
    (tmp_path / "reference/benchmark.toml").touch()
    inside = tmp_path / "submissions" / "x"
    inside.mkdir(parents=True)
    assert find_instance(inside) == Instance(tmp_path)


def test_without_an_instance_the_message_says_what_to_do(tmp_path: Path) -> None:
    """Outside an instance the error names the folder and --root."""
    with pytest.raises(InstanceError, match="no leaderboard here") as caught:
        find_instance(tmp_path)
    assert caught.value.hint == "go to a leaderboard's folder or name it with --root DIR"


def test_submission_folders_are_sorted_and_half_written_ones_ignored(tmp_path: Path) -> None:
    """Order does not depend on the disk, and temporary folders do not count."""
    for name in ("zeta", "alpha", ".tmp-x"):
        (tmp_path / "submissions" / name).mkdir(parents=True)
    (tmp_path / "submissions/ledger.csv").touch()
    assert [path.name for path in Instance(tmp_path).submission_dirs()] == ["alpha", "zeta"]
    assert Instance(tmp_path / "none").submission_dirs() == []


def test_paths_are_shown_relative_to_the_instance(tmp_path: Path) -> None:
    """Paths inside are shortened, others stay as they are."""
    instance = Instance(tmp_path)
    assert instance.display_path(tmp_path / "submissions" / "x") == "submissions/x"
    assert instance.display_path(Path("/elsewhere/file.csv")) == "/elsewhere/file.csv"
