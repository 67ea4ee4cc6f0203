"""Putting a built site in the place of an older one, as a whole or not at all."""

import os
from collections.abc import Iterable
from pathlib import Path

from leaderboard.errors import InstanceError
from leaderboard.files import exchange_folders, sha256_hex, temporary_folder
from leaderboard.website.stamps import MARKER, render_marker


def replace_site(folder: Path, contents: Iterable[tuple[str, bytes]], inputs: str | None = None) -> None:
    """Write a site beside the folder, then put it in the folder's place.

    Parameters
    ----------
    contents
        Paths in the site and their bytes; each is written as it comes.
    inputs
        What all of it was made from, as `digest_inputs` says; None if that is not known.

    Raises
    ------
    InstanceError
        If the folder holds something that is no earlier site, or cannot be written.
    """
    folder = folder.resolve()
    refuse_other_content(folder)
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with temporary_folder(folder.parent) as temporary:
            fresh = temporary / "fresh"
            _write_all(fresh, contents, inputs)
            if folder.exists():
                exchange_folders(folder, fresh)  # the earlier site ends with the temporary folder
            else:
                fresh.rename(folder)
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


def _write_all(folder: Path, contents: Iterable[tuple[str, bytes]], inputs: str | None) -> None:
    folder.mkdir()
    digests: dict[str, str] = {}
    made = {folder}
    for path, content in contents:
        digests[path] = sha256_hex(content)
        target = folder / path
        if target.parent not in made:  # asking the disk each time would take as long as writing
            target.parent.mkdir(parents=True, exist_ok=True)
            made.add(target.parent)
        target.write_bytes(content)
    (folder / MARKER).write_bytes(render_marker(inputs, digests))
