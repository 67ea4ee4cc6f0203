"""Putting a whole reference in its place: the old one or the new one is there, never a mixture of them.

Everything is made in a folder beside its final place and then moved there in one step. A run that is killed
may leave that folder, ``.tmp-reference-*``, which nothing reads; the next run removes it. A lock that the
system drops with the process tells such a leftover from the folder of a run that is still at work.
"""

import fcntl
import os
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from leaderboard.errors import InstanceError
from leaderboard.files import exchange_folders, flush_folder, set_aside, write_folder
from leaderboard.instance import Instance
from leaderboard.models import Manifest, Source
from leaderboard.models.benchmark import ReferenceKind
from leaderboard.reference.sealing import seal_reference

STAGING_PREFIX = ".tmp-reference-"
STAGED = "instance"


def install_reference(
    instance: Instance, contents: Mapping[str, bytes], kind: ReferenceKind, *, sources: Sequence[Source]
) -> Manifest:
    """Write and seal a reference, in place of the one that is there if there is one.

    An instance without a reference gets empty ``submissions/`` and ``site/`` too, and its root may be new.
    Of an old reference nothing is kept: what is to stay must be among the contents.

    Parameters
    ----------
    instance
        Where.
    contents
        The reference's files by name, all but the manifest.
    kind
        Whether trials and people are real.
    sources
        Where the files came from.

    Raises
    ------
    BrokenReferenceError
        If the files could not be used for grading; then nothing is changed.
    InstanceError
        If the reference is no folder, or the disk fails; then the old reference is as it was.
    """
    _require_replaceable(instance)
    outside = instance.root.absolute().parent
    try:
        outside.mkdir(parents=True, exist_ok=True)
        _remove_leftovers(outside)
        _remove_leftovers(instance.root)
        with _staging_folder(instance.root if instance.root.exists() else outside) as folder:
            staged = Instance(folder / STAGED)
            write_folder(staged.reference_dir, contents)
            manifest = seal_reference(staged, kind, sources=sources)
            _put_in_place(staged, instance)
    except OSError as error:
        message = f"{instance.reference_dir}: cannot be written: {error.strerror or error}"
        raise InstanceError(message, "it is as it was before") from error
    return manifest


def _require_replaceable(instance: Instance) -> None:
    folder = instance.reference_dir
    if folder.is_symlink() or (folder.exists() and not folder.is_dir()):
        message = f"{folder}: is a link or a file, and only a folder can be replaced"
        raise InstanceError(message, "put a folder in its place, or name another instance with --root DIR")


def _put_in_place(staged: Instance, instance: Instance) -> None:
    """Move what is ready; what was there before is in its stead afterwards."""
    if instance.reference_dir.exists():
        exchange_folders(instance.reference_dir, staged.reference_dir)
    elif instance.root.exists():
        _add_empty_folders(instance)
        _move(staged.reference_dir, instance.reference_dir)
    else:
        _add_empty_folders(staged)
        _move(staged.root, instance.root)


def _add_empty_folders(instance: Instance) -> None:
    for folder in (instance.submissions_dir, instance.site_dir):
        folder.mkdir(exist_ok=True)


def _move(source: Path, target: Path) -> None:
    source.rename(target)
    try:
        flush_folder(target.parent)
    except OSError:
        target.rename(source)
        raise


@contextmanager
def _staging_folder(parent: Path) -> Iterator[Path]:
    """Make a folder for the time of its use, with a lock on it."""
    with (
        tempfile.TemporaryDirectory(prefix=STAGING_PREFIX, dir=parent, ignore_cleanup_errors=True) as name,
        _lock(Path(name)),
    ):
        yield Path(name)


@contextmanager
def _lock(folder: Path) -> Iterator[bool]:
    """Lock a folder, and tell whether that was possible: others may hold it, some disks know no locks."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_NOFOLLOW | os.O_DIRECTORY)
    try:
        yield _take_lock(descriptor)
    finally:
        os.close(descriptor)


def _take_lock(descriptor: int) -> bool:
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def _remove_leftovers(parent: Path) -> None:
    """Remove what killed runs left in a folder, as far as that is possible."""
    for folder in sorted(parent.glob(f"{STAGING_PREFIX}*")):
        with suppress(OSError), _lock(folder) as is_ours:
            if is_ours:
                _rescue(folder, Instance(parent))
                shutil.rmtree(folder, ignore_errors=True)


def _rescue(leftover: Path, instance: Instance) -> None:
    """Put back a reference that was killed on its way out, which can happen where it takes several renames.

    The run is stopped then: it was begun as if there were no reference.
    """
    aside = set_aside(Instance(leftover / STAGED).reference_dir)
    if aside.is_dir() and not os.path.lexists(instance.reference_dir):
        aside.rename(instance.reference_dir)
        message = f"{instance.reference_dir}: was gone since an import was killed, and is back now"
        raise InstanceError(message, "start the command again")
