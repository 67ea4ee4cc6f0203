"""Reading with limits, writing all or nothing."""

import ctypes
import errno
import os
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from leaderboard import files
from leaderboard.files import (
    canonical_json,
    csv_text,
    exchange_folders,
    read_regular,
    write_atomic,
    write_folder,
)


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


def two_folders(root: Path) -> tuple[Path, Path]:
    first, second = root / "first", root / "deep/second"
    write_folder(first, {"a.txt": b"1"})
    write_folder(second, {"b.txt": b"2"})
    return first, second


def contents(folder: Path) -> dict[str, bytes]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()
    }


APART = {"first/a.txt": b"1", "deep/second/b.txt": b"2"}
EXCHANGED = {"first/b.txt": b"2", "deep/second/a.txt": b"1"}


def refuse_exchange(code: int) -> Callable[[Path, Path], None]:
    def refuse(first: Path, _second: Path) -> None:
        raise OSError(code, os.strerror(code), str(first))

    return refuse


def test_folders_trade_places_in_one_step(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No rename is needed where the system exchanges names."""
    first, second = two_folders(tmp_path)
    monkeypatch.setattr(Path, "rename", refuse_exchange(errno.EPERM))
    exchange_folders(first, second)
    assert contents(tmp_path) == EXCHANGED


@pytest.mark.parametrize("code", [errno.EINVAL, errno.ENOSYS, errno.ENOTSUP])
def test_folders_trade_places_by_renaming(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, code: int) -> None:
    """Where the file system refuses the one step, three renames do the same."""
    first, second = two_folders(tmp_path)
    monkeypatch.setattr(files, "_exchange", refuse_exchange(code))
    exchange_folders(first, second)
    assert contents(tmp_path) == EXCHANGED


def test_a_library_without_the_step_is_no_failure(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Other C libraries lack the function altogether."""
    first, second = two_folders(tmp_path)
    monkeypatch.setattr(ctypes, "CDLL", lambda *_, **__: object())
    exchange_folders(first, second)
    assert contents(tmp_path) == EXCHANGED


def test_macos_has_a_step_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """There the function takes two names and the flag for swapping."""
    first, second = two_folders(tmp_path)
    calls: list[tuple[object, ...]] = []

    class Library:
        @staticmethod
        def renamex_np(*arguments: object) -> int:
            calls.append(arguments)
            return 0

    monkeypatch.setattr(ctypes, "CDLL", lambda *_, **__: Library)
    monkeypatch.setattr(sys, "platform", "darwin")
    exchange_folders(first, second)
    assert calls == [(os.fsencode(first), os.fsencode(second), 2)]


@pytest.mark.parametrize("n_renames", [0, 1, 2])
def test_folders_stay_where_they_were_if_a_rename_fails(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, n_renames: int
) -> None:
    """What was renamed before is renamed back."""
    first, second = two_folders(tmp_path)
    rename, calls = Path.rename, []

    def fail_once(path: Path, target: Path) -> Path:
        calls.append(path)
        if len(calls) == n_renames + 1:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return rename(path, target)

    monkeypatch.setattr(files, "_exchange", refuse_exchange(errno.EINVAL))
    monkeypatch.setattr(Path, "rename", fail_once)
    with pytest.raises(OSError, match="No space left"):
        exchange_folders(first, second)
    assert contents(tmp_path) == APART


def test_other_failures_are_told(tmp_path: Path) -> None:
    """Nothing is tried instead where a folder is missing."""
    first, second = two_folders(tmp_path)
    with pytest.raises(FileNotFoundError) as caught:
        exchange_folders(first, second / "none")
    assert caught.value.filename == str(first)
    assert contents(tmp_path) == APART


@pytest.mark.parametrize("is_refused", [False, True])
def test_folders_go_back_if_the_disk_does_not_take_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, is_refused: bool
) -> None:
    """An exchange that may not outlive a power cut is undone and told."""
    first, second = two_folders(tmp_path)
    if is_refused:
        monkeypatch.setattr(files, "_exchange", refuse_exchange(errno.EINVAL))

    def fail(_descriptor: int) -> None:
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    monkeypatch.setattr(os, "fsync", fail)
    with pytest.raises(OSError, match="Input/output error"):
        exchange_folders(first, second)
    assert contents(tmp_path) == APART
