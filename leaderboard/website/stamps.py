"""What a built site was made from, so that building it again without changes can be left out."""

import os
from collections.abc import Collection, Iterable, Iterator
from importlib.metadata import version
from pathlib import Path

import leaderboard
from leaderboard.files import sha256_hex
from leaderboard.instance import Instance

MARKER = ".leaderboard-site"
_FIRST_LINE = "Written by `leaderboard site build`, which replaces this folder as a whole."

PRINTING = ("jinja2", "markupsafe", "numpy", "pydantic", "resvg-py")
"""Distributions whose versions could change a byte of a page."""


def digest_inputs(instance: Instance, out: Path, commit: str = "") -> str | None:
    """Return the SHA-256 of all that a site is made from: instance, engine, commit, versions of what prints.

    Returns
    -------
    str or None
        None where a link or something else that is no plain file lies among them: what stands behind it
        could change unseen.
    """
    skipped = {os.path.realpath(instance.dist_dir), os.path.realpath(out)}
    engine = Path(leaderboard.__file__).parent
    lines = [f"commit {commit}", *(f"{name} {version(name)}" for name in PRINTING)]
    for folder in (engine, instance.reference_dir, instance.submissions_dir, instance.site_dir):
        for file in _walk(folder, skipped):
            if file.is_symlink() or not file.is_file():
                return None
            lines.append(f"{folder.name}/{_place(file, folder)} {sha256_hex(file.read_bytes())}")
    return _digest(lines)


def render_marker(inputs: str | None, digests: dict[str, str]) -> bytes:
    """Render the file by which a folder is known as a built site.

    Parameters
    ----------
    inputs
        What `digest_inputs` gave before anything was read.
    digests
        The SHA-256 of each file's bytes, by its path in the site.
    """
    made_from = () if inputs is None else (f"from {inputs}", f"to {_digest_files(digests)}")
    return "".join(f"{line}\n" for line in (_FIRST_LINE, *made_from)).encode()


def is_current(folder: Path, inputs: str | None) -> bool:
    """Whether a folder holds, byte for byte, the site that was made from these inputs."""
    marker = folder / MARKER
    if inputs is None or not marker.is_file():
        return False
    files = {_place(file, folder): file for file in _walk(folder, ())}
    del files[MARKER]
    if any(file.is_symlink() or not file.is_file() for file in files.values()):
        return False
    digests = {place: sha256_hex(file.read_bytes()) for place, file in files.items()}
    return marker.read_bytes() == render_marker(inputs, digests)


def _walk(folder: Path, skipped: Collection[str]) -> Iterator[Path]:
    """Yield all that is no folder beneath a folder, in the order of names; caches are no inputs."""
    for place, names, files in os.walk(folder):
        linked = [name for name in names if Path(place, name).is_symlink()]
        names[:] = sorted(
            name
            for name in names
            if name != "__pycache__" and os.path.realpath(f"{place}/{name}") not in skipped
        )
        yield from (Path(place, name) for name in sorted([*files, *linked]))


def _place(file: Path, folder: Path) -> str:
    return file.relative_to(folder).as_posix()


def _digest_files(digests: dict[str, str]) -> str:
    return _digest(f"{path} {digest}" for path, digest in sorted(digests.items()))


def _digest(lines: Iterable[str]) -> str:
    return sha256_hex("".join(f"{line}\n" for line in lines).encode(errors="surrogateescape"))
