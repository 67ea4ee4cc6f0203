"""Reading with limits, writing all or nothing, hashing, and one form of JSON and CSV."""

import csv
import errno
import hashlib
import io
import json
import os
import stat
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path


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

    The bytes go to a temporary file in the same folder, are flushed to disk, and the file is renamed.

    Raises
    ------
    OSError
        If it cannot be written, or if the path is a link, a device, a pipe or a folder, which a rename would
        replace.
    """
    import tempfile  # only what writes pays for it

    if os.path.lexists(path) and not stat.S_ISREG(path.lstat().st_mode):
        raise OSError(errno.EEXIST, "not a regular file, so it is not replaced", str(path))
    try:
        descriptor, name = tempfile.mkstemp(prefix=".tmp-", dir=path.parent)
    except OSError as error:  # name the file that was asked for, not the temporary one
        raise OSError(error.errno, error.strerror, str(path)) from error
    temporary = Path(name)
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
    _flush_folder(path.parent)


def write_folder(folder: Path, contents: Mapping[str, bytes]) -> None:
    """Create a new folder with files in it, all of them or nothing.

    Raises
    ------
    FileExistsError
        If something of that name is there already.
    """
    if os.path.lexists(folder):
        raise FileExistsError(f"{folder} exists")
    import tempfile

    folder.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".tmp-", dir=folder.parent) as name:
        staging = Path(name) / folder.name
        staging.mkdir()
        for relative, content in sorted(contents.items()):
            target = staging / relative
            target.parent.mkdir(parents=True, exist_ok=True)
            write_atomic(target, content)
        staging.rename(folder)
    _flush_folder(folder.parent)


def _flush_folder(folder: Path) -> None:
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
