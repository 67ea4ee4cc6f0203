"""The folder of downloads: whose it is, and how it is emptied."""

from pathlib import Path

import platformdirs
import pytest

from leaderboard.errors import InstanceError
from leaderboard.reference.fetching.cache import open_cache
from leaderboard.reference.fetching.upstream import Upstream


def test_the_users_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By default it lies where the system keeps what can be had again."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    with open_cache() as cache:
        assert cache.folder == platformdirs.user_cache_path("physionpp-leaderboard")
        assert cache.folder.is_dir()


def test_each_address_has_its_place(tmp_path: Path) -> None:
    """Files are named by the checksum of their address, which may be as long and odd as it likes."""
    with open_cache(tmp_path) as cache:
        first, second = (
            cache.place("https://example.com/a"),
            cache.place("https://example.com/" + "../" * 999),
        )
        assert first.key != second.key
        assert second.whole_file.parent == tmp_path
        assert len(second.key) == 64


def test_a_cache_in_use(tmp_path: Path) -> None:
    """One process at a time has it."""
    with (
        open_cache(tmp_path),
        pytest.raises(InstanceError, match="in use by another process"),
        open_cache(tmp_path),
    ):
        pass


def test_no_folder(tmp_path: Path) -> None:
    """A cache that cannot be made is named."""
    (tmp_path / "file").touch()
    with (
        pytest.raises(InstanceError, match="file/cache: Not a directory"),
        open_cache(tmp_path / "file/cache"),
    ):
        pass


def test_more_bytes_than_there_should_be(tmp_path: Path) -> None:
    """A begun download that is longer than its file is of no use."""
    with open_cache(tmp_path) as cache:
        place = cache.place("url")
        place.begin(Upstream(size=2))
        place.part_file.write_bytes(b"abc")
        assert place.find() is None
        assert not place.part_file.exists()
