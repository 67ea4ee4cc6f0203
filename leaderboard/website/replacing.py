"""Putting a built site in the place of an older one, as a whole or not at all."""

import os
import tempfile
from collections.abc import Iterable
from pathlib import Path

from leaderboard.errors import InstanceError

MARKER = ".leaderboard-site"
MARKER_TEXT = b"Written by `leaderboard site build`, which replaces this folder as a whole.\n"


def replace_site(folder: Path, contents: Iterable[tuple[str, bytes]]) -> None:
    """Write a site beside the folder, then put it in the folder's place.

    Parameters
    ----------
    contents
        Paths in the site and their bytes; each is written as it comes.

    Raises
    ------
    InstanceError
        If the folder holds something that is no earlier site, or cannot be written.
    """
    folder = folder.resolve()
    refuse_other_content(folder)
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".tmp-", dir=folder.parent) as name:
            fresh = Path(name) / "fresh"
            _write_all(fresh, contents)
            _swap(folder, fresh, Path(name) / "old")
    except OSError as error:
        raise InstanceError(f"cannot write the site to {folder}: {error.strerror or error}") from error


def refuse_other_content(folder: Path) -> None:
    """Refuse to replace anything but an empty folder or an earlier site.

    Raises
    ------
    InstanceError
        If the folder is a file, or holds something that is no earlier site.
    """
    if not os.path.lexists(folder):
        return
    hint = "choose a new or empty folder with --out, or remove this one yourself"
    if not folder.is_dir():
        raise InstanceError(f"{folder} is not a folder", hint)
    if any(folder.iterdir()) and not (folder / MARKER).is_file():
        raise InstanceError(f"{folder} is not empty and not an earlier site, so it is not replaced", hint)


def _write_all(folder: Path, contents: Iterable[tuple[str, bytes]]) -> None:
    folder.mkdir()
    (folder / MARKER).write_bytes(MARKER_TEXT)
    for path, content in contents:
        target = folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)


def _swap(folder: Path, fresh: Path, old: Path) -> None:
    """Rename the fresh folder into place; put the old one back if that fails."""
    if not folder.exists():
        fresh.rename(folder)
        return
    folder.rename(old)
    try:
        fresh.rename(folder)
    except OSError:
        old.rename(folder)
        raise
