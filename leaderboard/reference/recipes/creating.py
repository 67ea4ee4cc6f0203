"""Making a new instance whole or not at all."""

import os
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from leaderboard.errors import InstanceError
from leaderboard.files import write_folder
from leaderboard.instance import Instance
from leaderboard.models import Manifest, Source
from leaderboard.reference.sealing import seal_reference


def require_new(instance: Instance) -> None:
    """Refuse to go on where a reference is already.

    Raises
    ------
    InstanceError
        If the instance has a folder, or anything else, of that name.
    """
    if os.path.lexists(instance.reference_dir):
        raise InstanceError(
            f"{instance.reference_dir} exists, and an import never overwrites a reference",
            "name a new folder with --root DIR",
        )


def create_instance(
    instance: Instance, contents: Mapping[str, bytes], *, sources: Sequence[Source]
) -> Manifest:
    """Write and seal an official reference in a new instance, with empty submissions/ and site/.

    Everything is made in a temporary folder and moved into place at the end, so that an interruption leaves
    either no reference or the whole one.

    Parameters
    ----------
    instance
        Where; its root may be there already, its reference may not.
    contents
        The reference's files by name.
    sources
        The official files that were read, with the checksums of what was read.

    Raises
    ------
    InstanceError
        If there is a reference already.
    """
    require_new(instance)
    is_new = not instance.root.exists()
    parent = instance.root.absolute().parent if is_new else instance.root
    parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".tmp-", dir=parent) as name:
        staged = Instance(Path(name) / "instance")
        write_folder(staged.reference_dir, contents)
        manifest = seal_reference(staged, "official", sources=sources)
        if is_new:
            _add_empty_folders(staged)
            staged.root.rename(instance.root)
        else:
            _add_empty_folders(instance)
            staged.reference_dir.rename(instance.reference_dir)
    return manifest


def _add_empty_folders(instance: Instance) -> None:
    for folder in (instance.submissions_dir, instance.site_dir):
        folder.mkdir(exist_ok=True)
