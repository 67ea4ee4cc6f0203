"""Reading with limits, writing all or nothing, hashing, and one form of JSON and CSV."""

import csv
import errno
import fcntl
import hashlib
import io
import json
import os
import stat
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext, suppress
from pathlib import Path

TEMPORARY_PREFIX = ".tmp-"  # of what is not whole yet; git ignores it

_AT_FDCWD, _RENAME_EXCHANGE = -100, 2  # <fcntl.h> and <linux/fs.h>
_RENAME_SWAP = 2  # <sys/stdio.h> of macOS
_TAKEN = frozenset({errno.EEXIST, errno.ENOTEMPTY, errno.ENOTDIR})
_NOT_OFFERED = frozenset({errno.EINVAL, errno.ENOSYS, errno.ENOTSUP, errno.EOPNOTSUPP})


def sha256_hex(content: bytes) -> str:
    """Return the SHA-256 of some bytes, as 64 lower-case hexadecimal digits.

    >>> sha256_hex(b"")[:8]
    'e3b0c442'
    """
    return hashlib.sha256(content).hexdigest()


def canonical_json(value: object) -> str:
    """Render JSON in the one form that this project writes.

    Keys keep their order, text stays readable, NaN and infinities are refused, and a newline ends it.

    >>> print(canonical_json({"b": 1, "a": "é"}), end="")
    {
      "b": 1,
      "a": "é"
    }
    """
    return json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def csv_text(header: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Render a table as CSV with LF line ends, quoting only where needed.

    >>> print(csv_text(["a", "b"], [["x,y", 1]]), end="")
    a,b
    "x,y",1
    """
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(header)
    writer.writerows(rows)
    return buffer.getvalue()


def read_regular(path: Path, limit: int) -> bytes | None:
    """Read a regular file of at most ``limit`` bytes without following a symbolic link.

    Returns
    -------
    bytes or None
        The content; None if it is larger than ``limit``.

    Raises
    ------
    OSError
        If it is missing, a symbolic link, not a regular file, or unreadable.
    """
    descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    mode = os.fstat(descriptor).st_mode
    if not stat.S_ISREG(mode):
        os.close(descriptor)
        if stat.S_ISDIR(mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
        raise OSError(errno.EINVAL, "not a regular file", str(path))
    with os.fdopen(descriptor, "rb") as stream:
        content = stream.read(limit + 1)
    return None if len(content) > limit else content


def write_atomic(path: Path, content: bytes) -> None:
    """Write a file so that a reader sees the old content or the new, never a part.

    The bytes go to a temporary file in the same folder, are flushed to disk, and the file is renamed. What is
    left of it if the process is killed, `remove_leftovers` removes.

    Raises
    ------
    OSError
        If it cannot be written, or if the path is a link, a device, a pipe or a folder, which a rename would
        replace.
    """
    if os.path.lexists(path) and not stat.S_ISREG(path.lstat().st_mode):
        raise OSError(errno.EEXIST, "not a regular file, so it is not replaced", str(path))
    try:
        descriptor, temporary = _make_temporary(path.parent)
    except OSError as error:  # name the file that was asked for, not the temporary one
        raise OSError(error.errno, error.strerror, str(path)) from error
    try:
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(content)
            stream.flush()
            os.fchmod(stream.fileno(), 0o644)
            os.fsync(stream.fileno())
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    flush_folder(path.parent)


def write_folder(folder: Path, contents: Mapping[str, bytes]) -> None:
    """Create a new folder with files in it, all of them or nothing.

    Raises
    ------
    FileExistsError
        If something of that name is there already.
    """
    if os.path.lexists(folder):
        raise FileExistsError(f"{folder} exists")
    folder.parent.mkdir(parents=True, exist_ok=True)
    with temporary_folder(folder.parent) as temporary:
        staging = temporary / folder.name
        staging.mkdir()
        for relative, content in sorted(contents.items()):
            target = staging / relative
            target.parent.mkdir(parents=True, exist_ok=True)
            write_atomic(target, content)
        try:
            staging.rename(folder)
        except OSError as error:
            if error.errno in _TAKEN:
                raise FileExistsError(f"{folder} exists: another run has just made it") from error
            raise
    flush_folder(folder.parent)


@contextmanager
def hold_folder(folder: Path) -> Iterator[None]:
    """Wait until no other run holds a folder, and hold it: for what reads, decides and then writes.

    It hinders only those who hold it too, and ends with the process. A folder that is not there, and one on a
    disk without locks, is held by nobody.
    """
    with _locked(folder) if folder.is_dir() else nullcontext():
        yield


def remove_leftovers(folder: Path) -> None:
    """Remove what killed runs left half-written in a folder; what a run is at work on stays.

    A lock that the system drops with the process tells one from the other. Where folders are made with
    `write_folder`, hold the folder that they are made in.
    """
    import shutil

    for path in sorted(folder.glob(f"{TEMPORARY_PREFIX}*")):
        with suppress(OSError):
            descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                if stat.S_ISDIR(os.fstat(descriptor).st_mode):
                    shutil.rmtree(path, ignore_errors=True)
                else:
                    path.unlink()
            finally:
                os.close(descriptor)


def exchange_folders(first: Path, second: Path) -> None:
    """Let two folders on one file system trade places.

    Linux and macOS do it in one step, so that a reader finds either of them under each name at every moment.
    On file systems that refuse, such as some network drives, it takes three renames: for a moment nothing has
    the first name, and if the process is killed then, its folder is left where `set_aside` says.

    Raises
    ------
    OSError
        If they cannot; then both are where they were.
    """
    exchange = _exchange
    try:
        exchange(first, second)
    except OSError as error:
        if error.errno not in _NOT_OFFERED:
            raise
        exchange = _exchange_by_renaming
        exchange(first, second)
    try:
        flush_folder(first.parent)
        flush_folder(second.parent)
    except OSError:
        exchange(first, second)
        raise


def set_aside(second: Path) -> Path:
    """Return where `exchange_folders` keeps the first folder while it has to rename one after the other."""
    return second.with_name(f"{second.name}.old")


def _exchange(first: Path, second: Path) -> None:
    """Ask the C library, since Python has no name for it."""
    import ctypes

    library = ctypes.CDLL(None, use_errno=True)
    names = os.fsencode(first), os.fsencode(second)
    if sys.platform == "darwin":
        rename = getattr(library, "renamex_np", None)
        arguments: tuple[object, ...] = (*names, _RENAME_SWAP)
    else:
        rename = getattr(library, "renameat2", None)
        arguments = (_AT_FDCWD, names[0], _AT_FDCWD, names[1], _RENAME_EXCHANGE)
    if rename is None:
        raise OSError(errno.ENOSYS, os.strerror(errno.ENOSYS), str(first))
    if rename(*arguments) != 0:
        code = ctypes.get_errno()
        raise OSError(code, os.strerror(code), str(first))


def _exchange_by_renaming(first: Path, second: Path) -> None:
    from contextlib import ExitStack

    aside = set_aside(second)
    with ExitStack() as undoing:
        first.rename(aside)
        undoing.callback(aside.rename, first)
        second.rename(first)
        undoing.callback(first.rename, second)
        aside.rename(second)
        undoing.pop_all()


def _make_temporary(folder: Path) -> tuple[int, Path]:
    """Open a new file with a lock on it."""
    import tempfile  # only what writes pays for it

    while True:
        descriptor, name = tempfile.mkstemp(prefix=TEMPORARY_PREFIX, dir=folder)
        with suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        if os.path.lexists(name):
            return descriptor, Path(name)
        os.close(descriptor)  # it was taken for a leftover before it had its lock


@contextmanager
def temporary_folder(parent: Path) -> Iterator[Path]:
    """Make a folder for the time of its use, with a lock on it."""
    import tempfile

    with tempfile.TemporaryDirectory(prefix=TEMPORARY_PREFIX, dir=parent) as name, _locked(Path(name)):
        yield Path(name)


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        with suppress(OSError):  # some disks know no locks
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def flush_folder(folder: Path) -> None:
    """Wait until what was created, renamed and deleted in a folder is on disk."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
