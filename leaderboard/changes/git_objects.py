"""Reading commits, trees and blobs of a repository without checking anything out.

Nothing from a commit is executed, filtered or followed: names come NUL-terminated, contents by the id of
their blob, with the size known before they are read.
"""

import hashlib
import os
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from leaderboard.errors import LeaderboardError

PLAIN_MODE = "100644"
MAX_LISTING = 10_000_000  # bytes; a submission changes three files
MAX_MESSAGE = 500

_SAFE = ("--no-replace-objects", "-c", "core.hooksPath=/dev/null", "-c", "core.fsmonitor=false")
_ENVIRONMENT = {
    "GIT_CONFIG_NOSYSTEM": "1",
    "GIT_CONFIG_GLOBAL": os.devnull,
    "GIT_TERMINAL_PROMPT": "0",
    "GIT_OPTIONAL_LOCKS": "0",
    "LC_ALL": "C",
}


class GitError(LeaderboardError):
    """Git is not there, or cannot read what it was asked for."""


@dataclass(frozen=True)
class ChangedPath:
    """A path that differs between two commits; the mode is ``000000`` where it is gone."""

    path: str
    old_mode: str
    new_mode: str


@dataclass(frozen=True)
class TreeEntry:
    """An entry of a folder in a commit; ``size`` is None unless it is a blob."""

    name: str
    mode: str
    kind: str
    object_id: str
    size: int | None


@dataclass(frozen=True)
class GitRepository:
    """The repository that a folder lies in.

    Parameters
    ----------
    folder
        Any folder of its work tree.
    """

    folder: Path

    def resolve(self, revision: str) -> str:
        """Return the id of the commit that a revision names.

        Raises
        ------
        GitError
            If it names none.
        """
        try:
            return (
                self._run("rev-parse", "--verify", "--end-of-options", f"{revision}^{{commit}}")
                .decode()
                .strip()
            )
        except GitError:
            shown = ascii(revision)
            raise GitError(f"{shown} names no commit here", "fetch it first: git fetch origin ...") from None

    def merge_base(self, first: str, second: str) -> str:
        """Return the commit from which two commits went apart.

        Raises
        ------
        GitError
            If they share no history.
        """
        try:
            return self._run("merge-base", first, second).decode().strip()
        except GitError:
            hint = "fetch more of the history: git fetch --unshallow"
            raise GitError(f"{first[:12]} and {second[:12]} share no history", hint) from None

    def prefix(self) -> str:
        """Return the folder's path within the repository: empty at its top, else with a slash at the end."""
        return _decode(self._run("rev-parse", "--show-prefix")).rstrip("\n")

    def read_remote(self, name: str) -> str | None:
        """Return the address of a remote as this repository has it; None if there is none of that name."""
        try:
            return _decode(self._run("config", "--get", f"remote.{name}.url")).rstrip("\n") or None
        except GitError:
            return None

    def list_changes(self, old: str, new: str) -> tuple[ChangedPath, ...]:
        """List the paths that differ between two commits, each rename as two of them."""
        listing = self._run("diff-tree", "-r", "-z", "--raw", "--no-renames", "--no-ext-diff", old, new)
        fields = _split(listing)
        pairs = zip(fields[::2], fields[1::2], strict=True)
        return tuple(ChangedPath(path, *_parse_modes(meta)) for meta, path in pairs)

    def list_commits(self, path: str) -> tuple[str, ...]:
        """List the commits that gave the checked-out branch its versions of a path, newest first.

        A side branch counts by the merge that brought it in.
        """
        pathspec = f":(top,literal){path}"
        return tuple(self._run("rev-list", "--first-parent", "HEAD", "--", pathspec).decode().split())

    def list_folder(self, commit: str, path: str) -> tuple[TreeEntry, ...]:
        """List the entries of a folder in a commit, by name; none if there is no such folder."""
        listing = self._run("ls-tree", "-z", "-l", "--full-tree", commit, "--", f"{path}/")
        return tuple(_parse_entries(_split(listing), path))

    def read_blob(self, entry: TreeEntry, limit: int) -> bytes | None:
        """Read the content of an entry; None if it is no blob or larger than the limit."""
        if entry.size is None or entry.size > limit:
            return None
        return self._run("cat-file", "blob", entry.object_id, limit=limit)

    def _run(self, *arguments: str, limit: int = MAX_LISTING) -> bytes:
        program = shutil.which("git")
        if program is None:
            raise GitError("git is not installed", "changes are read with it")
        command = [program, *_SAFE, *arguments]
        environment = {**os.environ, **_ENVIRONMENT}
        with subprocess.Popen(  # noqa: S603  (a fixed program; revisions are ids or come after --end-of-options)
            command, cwd=self.folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        ) as process:
            output = _read(process.stdout, limit)
            if len(output) > limit:
                process.kill()
                hint = "is this the right branch?"
                raise GitError(f"git {arguments[0]} gives more than {limit:,} bytes", hint)
            message = _read(process.stderr, MAX_MESSAGE).decode(errors="replace").strip()
        if process.returncode:
            raise GitError(f"git {arguments[0]}: {ascii(message)[1:-1]}")
        return output


def blob_id(content: bytes) -> str:
    """Return the id that git gives to a content.

    >>> blob_id(b"")
    'e69de29bb2d1d6434b8b29ae775ad8c2e48c5391'
    """
    header = f"blob {len(content)}\0".encode()
    return hashlib.sha1(header + content, usedforsecurity=False).hexdigest()


def _read(stream: IO[bytes] | None, limit: int) -> bytes:
    return b"" if stream is None else stream.read(limit + 1)


def _parse_modes(meta: str) -> tuple[str, str]:
    """Parse ``:<old mode> <new mode> <old id> <new id> <status>``."""
    old_mode, new_mode, *_ = meta.removeprefix(":").split(" ")
    return old_mode, new_mode


def _parse_entries(lines: list[str], folder: str) -> Iterator[TreeEntry]:
    """Parse ``<mode> <kind> <id> <size>``, a tab, and ``<path>``."""
    for line in lines:
        meta, _, path = line.partition("\t")
        mode, kind, object_id, size = meta.split()
        name = path.removeprefix(f"{folder}/")
        yield TreeEntry(name, mode, kind, object_id, int(size) if size.isdigit() else None)


def _split(listing: bytes) -> list[str]:
    return _decode(listing).split("\0")[:-1]


def _decode(output: bytes) -> str:
    return output.decode("utf-8", "surrogateescape")
