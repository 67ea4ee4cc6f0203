"""Downloads on disk: whole ones to ask about, begun ones to continue."""

import fcntl
import hashlib
import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import platformdirs

from leaderboard.errors import InstanceError
from leaderboard.files import canonical_json, sha256_hex, write_atomic
from leaderboard.reference.fetching.upstream import Upstream

APPLICATION = "physionpp-leaderboard"
RECORD_LIMIT = 10_000
LOCK_NAME = "lock"


@dataclass(frozen=True)
class Held:
    """What is on disk of a file: its version, and how many bytes, all or the first ones."""

    upstream: Upstream
    n_bytes: int
    is_whole: bool


@dataclass(frozen=True)
class CachedFile:
    """Where the download of one URL is kept.

    A begun download is there as ``.part``, a whole one without suffix, never both, and the record beside it
    says of which version its bytes are. Whatever was interrupted between two steps, they are of that version.

    Attributes
    ----------
    folder, key
        The cache, and the checksum of the URL.
    """

    folder: Path
    key: str

    @property
    def whole_file(self) -> Path:
        """The download when it is whole."""
        return self.folder / self.key

    @property
    def part_file(self) -> Path:
        """The download while it is not."""
        return self.folder / f"{self.key}.part"

    @property
    def record_file(self) -> Path:
        """The version that the bytes are of."""
        return self.folder / f"{self.key}.json"

    def find(self) -> Held | None:
        """Find what is there, after checking the bytes of a whole file; damaged ones are removed."""
        upstream = self._read_record()
        if upstream is not None and self.part_file.is_file():
            n_bytes = self.part_file.stat().st_size
            if upstream.size is None or n_bytes < upstream.size:
                return Held(upstream, n_bytes, is_whole=False)
            if n_bytes == upstream.size:
                upstream = self.complete(upstream)
        if (
            upstream is not None
            and self.whole_file.is_file()
            and _hash_file(self.whole_file) == upstream.sha256
        ):
            return Held(upstream, self.whole_file.stat().st_size, is_whole=True)
        self.discard()
        return None

    def begin(self, upstream: Upstream) -> None:
        """Make room for a download of this version."""
        self.discard()
        self._write_record(upstream)

    def complete(self, upstream: Upstream) -> Upstream:
        """Move the download, all of which is there, into place; return its version with size and checksum."""
        with self.part_file.open("rb") as stream:
            os.fsync(stream.fileno())
        found = {"size": self.part_file.stat().st_size, "sha256": _hash_file(self.part_file)}
        whole = upstream.model_copy(update=found)
        self._write_record(whole)
        self.part_file.rename(self.whole_file)
        return whole

    def discard(self) -> None:
        """Remove whatever is there, the record last: bytes without one count for nothing."""
        for file in (self.whole_file, self.part_file, self.record_file):
            file.unlink(missing_ok=True)

    def _read_record(self) -> Upstream | None:
        try:
            content = self.record_file.read_bytes()[:RECORD_LIMIT]
            return Upstream.model_validate_json(content)
        except (FileNotFoundError, ValueError):
            return None

    def _write_record(self, upstream: Upstream) -> None:
        write_atomic(self.record_file, canonical_json(upstream.model_dump()).encode())


@dataclass(frozen=True)
class Cache:
    """A folder of downloads that this process alone uses."""

    folder: Path

    def place(self, url: str) -> CachedFile:
        """Say where the download of a URL is kept."""
        return CachedFile(self.folder, sha256_hex(url.encode()))


@contextmanager
def open_cache(folder: Path | None = None) -> Iterator[Cache]:
    """Open the cache, by default the user's; no other process can meanwhile.

    Raises
    ------
    InstanceError
        If another process uses it, or it cannot be read or written.
    """
    folder = _choose_folder(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with (folder / LOCK_NAME).open("wb") as lock:
            _lock(lock.fileno(), folder)
            yield Cache(folder)
    except OSError as error:
        hint = "is the disk full? another folder for downloads can be named by XDG_CACHE_HOME"
        raise InstanceError(f"{error.filename or folder}: {error.strerror or error}", hint) from error


def _choose_folder(folder: Path | None) -> Path:
    return platformdirs.user_cache_path(APPLICATION) if folder is None else folder


def _lock(descriptor: int, folder: Path) -> None:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        message = f"{folder}: is in use by another process that fetches"
        raise InstanceError(message, "wait until it is done") from None


def _hash_file(path: Path) -> str:
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
