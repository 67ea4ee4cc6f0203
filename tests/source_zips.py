"""Small zip archives, sound ones and some that lie."""

import io
import warnings
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path

LISTED = {"data/Mass.csv": b"trial,label\n1,0\n", "data/Friction.csv": b"trial,label\n2,1\n"}

Change = Callable[[zipfile.ZipFile], None]


def is_csv(name: str) -> bool:
    return name.endswith(".csv")


def zip_bytes(members: Mapping[str, bytes] = LISTED, change: Change | None = None) -> bytes:
    """Pack members; ``change`` may falsify the directory just before it is written."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(name, content)
        if change is not None:
            change(archive)
    return buffer.getvalue()


def repeated_names(first: str, second: str) -> bytes:
    """Pack two members whose names may be equal."""
    buffer = io.BytesIO()
    with warnings.catch_warnings(), zipfile.ZipFile(buffer, "w") as archive:
        warnings.simplefilter("ignore")
        archive.writestr(first, b"1")
        archive.writestr(second, b"2")
    return buffer.getvalue()


def write_zip_file(path: Path, members: Mapping[str, bytes] = LISTED, change: Change | None = None) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(zip_bytes(members, change))
    return path


def falsify(**fields: object) -> Change:
    """Make a change of the directory's fields of the first member."""

    def change(archive: zipfile.ZipFile) -> None:
        for name, value in fields.items():
            setattr(archive.filelist[0], name, value)

    return change
