"""Reading with limits, writing all or nothing."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from leaderboard.files import canonical_json, csv_text, read_regular, write_atomic, write_folder


def test_write_atomic_replaces_the_content_and_leaves_nothing_else(tmp_path: Path) -> None:
    """After a write there is one file with the new content and ordinary permissions."""
    target = tmp_path / "result.json"
    write_atomic(target, b"old")
    write_atomic(target, b"new")
    assert target.read_bytes() == b"new"
    assert target.stat().st_mode & 0o777 == 0o644
    assert [path.name for path in tmp_path.iterdir()] == ["result.json"]


def test_write_atomic_keeps_the_old_file_when_the_disk_fails(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A failure before the rename leaves the old content and no temporary file."""
    target = tmp_path / "result.json"
    write_atomic(target, b"old")

    def fail(_descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", fail)
    with pytest.raises(OSError, match="No space left"):
        write_atomic(target, b"new")
    assert target.read_bytes() == b"old"
    assert [path.name for path in tmp_path.iterdir()] == ["result.json"]


@pytest.mark.parametrize("kind", ["link", "dangling link", "pipe", "folder"])
def test_write_atomic_replaces_nothing_but_regular_files(tmp_path: Path, kind: str) -> None:
    """What is there and is no regular file stays what it is: a rename would silently destroy it."""
    target = tmp_path / "target"
    if kind == "link":
        (tmp_path / "real").write_bytes(b"real")
    make: dict[str, Callable[[], object]] = {
        "link": lambda: target.symlink_to("real"),
        "dangling link": lambda: target.symlink_to("nowhere"),
        "pipe": lambda: os.mkfifo(target),
        "folder": target.mkdir,
    }
    make[kind]()
    before = sorted((path.name, path.lstat().st_ino) for path in tmp_path.iterdir())
    with pytest.raises(OSError, match="not a regular file, so it is not replaced") as caught:
        write_atomic(target, b"new")
    assert caught.value.filename == str(target)
    assert sorted((path.name, path.lstat().st_ino) for path in tmp_path.iterdir()) == before


def test_a_file_that_cannot_be_written_is_named_as_asked_for(tmp_path: Path) -> None:
    """The error speaks of the target, not of a temporary file that nobody knows."""
    target = tmp_path / "nowhere/result.json"
    with pytest.raises(FileNotFoundError) as caught:
        write_atomic(target, b"new")
    assert caught.value.filename == str(target)


def test_write_folder_makes_all_files_or_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A failure in the middle leaves no folder behind."""
    contents = {"a.txt": b"1", "b/c.txt": b"2"}
    write_folder(tmp_path / "first", contents)
    assert (tmp_path / "first/b/c.txt").read_bytes() == b"2"

    calls = []

    def fail_second(path: Path, _content: bytes) -> None:
        calls.append(path)
        if len(calls) > 1:
            raise OSError(28, "No space left on device")

    monkeypatch.setattr("leaderboard.files.write_atomic", fail_second)
    with pytest.raises(OSError, match="No space left"):
        write_folder(tmp_path / "second", contents)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["first"]


def test_write_folder_never_replaces(tmp_path: Path) -> None:
    """A folder that is there already stays as it is, even if it is only a dangling link."""
    (tmp_path / "taken").symlink_to(tmp_path / "nowhere")
    with pytest.raises(FileExistsError, match="taken exists"):
        write_folder(tmp_path / "taken", {"a.txt": b"1"})


def test_read_regular_stops_at_the_limit(tmp_path: Path) -> None:
    """A file of the limit's size is read; one byte more gives None."""
    file = tmp_path / "file"
    file.write_bytes(b"12345")
    assert read_regular(file, 5) == b"12345"
    assert read_regular(file, 4) is None


def test_read_regular_follows_no_link_and_opens_no_pipe(tmp_path: Path) -> None:
    """Symbolic links and named pipes are refused without being opened or waited for."""
    (tmp_path / "target").write_bytes(b"secret")
    (tmp_path / "link").symlink_to(tmp_path / "target")
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(OSError, match="link"):
        read_regular(tmp_path / "link", 100)
    with pytest.raises(OSError, match="not a regular file"):
        read_regular(tmp_path / "pipe", 100)


def test_json_refuses_numbers_that_json_does_not_know() -> None:
    """NaN never reaches a file."""
    with pytest.raises(ValueError, match="not JSON compliant"):
        canonical_json({"value": float("nan")})


def test_csv_quotes_what_needs_it() -> None:
    """Commas in ids survive a round trip."""
    assert csv_text(["id"], [["scale=0.3,0.5"], ["plain"]]) == 'id\n"scale=0.3,0.5"\nplain\n'
