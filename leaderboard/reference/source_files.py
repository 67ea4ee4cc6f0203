"""Official files as read: from a folder, an archive or the network."""

import os
import stat
import zipfile
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from pathlib import Path

from leaderboard.errors import SourceError
from leaderboard.files import read_regular, sha256_hex
from leaderboard.reference.cells import quote
from leaderboard.reference.source_archives import (
    LIMITS,
    Limits,
    Wanted,
    choose_members,
    is_chosen,
    name_some,
    open_archive,
    read_member,
    say_odd_name,
)

ARCHIVE_SUFFIX = ".zip"
LINK_HINT = "put the file itself there, or name what the link points to as another source"
SMALLER_HINT = "name a folder that holds the official files only"


@dataclass(frozen=True)
class SourceFile:
    """One official file.

    Attributes
    ----------
    name
        Its path within the folder or archive that it came from, with ``/`` between the parts.
    origin
        How messages name it: its path, and for a member of an archive that of the archive before it.
    content
        Its bytes.
    """

    name: str
    origin: str
    content: bytes

    @cached_property
    def sha256(self) -> str:
        """The checksum of its bytes."""
        return sha256_hex(self.content)


_Found = tuple[str, SourceFile]  # with the folder or archive that it came from


def read_source_files(
    paths: Sequence[Path], is_wanted: Wanted, *, limits: Limits = LIMITS
) -> tuple[SourceFile, ...]:
    """Read the wanted files of folders and zip archives.

    Archives that lie in a folder are read as well, archives in archives are not. Equal files of one name
    count once: those of an archive that is named twice, or of one that lies beside what was unpacked from it.

    Parameters
    ----------
    paths
        Folders and zip archives; these may be links, links inside a folder are not followed.
    is_wanted
        Tells whether to read a file from its path within its folder or archive, with ``/`` between the parts.
    limits
        How much is read.

    Returns
    -------
    tuple of SourceFile
        By name.

    Raises
    ------
    SourceError
        If a path cannot be read or holds no wanted file; if a wanted file is a link, special, encrypted,
        damaged, too large or oddly named; if files of one name differ.
    """
    found = (found for path in paths for found in _read_path(path, is_wanted, limits))
    return _by_name(_merge(_limit_total(found, limits)))


def read_members(
    archive: zipfile.ZipFile, origin: str, is_wanted: Wanted, *, limits: Limits = LIMITS
) -> tuple[SourceFile, ...]:
    """Read the wanted members of an archive, in the order in which they are stored, and nothing else of it.

    Parameters
    ----------
    archive
        Any archive, also one that is fetched piece by piece.
    origin
        How messages name the archive.
    is_wanted
        Tells from a member's path whether to read it.
    limits
        How much is read.

    Returns
    -------
    tuple of SourceFile
        By name.

    Raises
    ------
    SourceError
        If it holds no wanted member, or one that is a link, special, encrypted, damaged, too large, oddly
        named or there twice. Errors of the disk or the network pass through.
    """
    files = _by_name(_read_chosen(archive, origin, is_wanted, limits))
    if not files:
        raise _nothing_wanted(origin, archive.namelist())
    return files


def _by_name(files: Iterable[SourceFile]) -> tuple[SourceFile, ...]:
    return tuple(sorted(files, key=lambda file: (file.name, file.origin)))


def _read_chosen(
    archive: zipfile.ZipFile, origin: str, is_wanted: Wanted, limits: Limits
) -> Iterator[SourceFile]:
    for member in choose_members(archive, origin, is_wanted, limits):
        own_origin = f"{origin}/{member.filename}"
        yield SourceFile(member.filename, own_origin, read_member(archive, member, own_origin))


def _nothing_wanted(origin: str, names: Iterable[str]) -> SourceError:
    files = [name for name in names if not name.endswith("/")]
    found = f"among its files are {name_some(files)}" if files else "it is empty"
    return SourceError(f"{origin}: holds no official file; {found}", "is it the right folder or archive?")


def _read_path(path: Path, is_wanted: Wanted, limits: Limits) -> Iterator[_Found]:
    """Read what a caller named, and insist that something wanted is there."""
    try:
        if path.is_dir():
            yield from _read_folder(path, is_wanted, limits)
        elif stat.S_ISREG(path.stat().st_mode):
            with path.open("rb", buffering=0) as stream, open_archive(stream, str(path)) as archive:
                files = read_members(archive, str(path), is_wanted, limits=limits)
            yield from ((str(path), file) for file in files)
        else:
            raise SourceError(f"{path}: is neither a folder nor a zip archive")
    except OSError as error:
        reason = error.strerror or str(error)
        raise SourceError(f"{error.filename or path}: cannot be read: {reason}") from error


def _read_folder(folder: Path, is_wanted: Wanted, limits: Limits) -> Iterator[_Found]:
    names, is_empty = [], True
    for name, entry in _walk(folder, limits):
        names.append(name)
        for found in _read_entry(folder, name, entry, is_wanted, limits):
            is_empty = False
            yield found
    if is_empty:
        raise _nothing_wanted(str(folder), names)


def _walk(folder: Path, limits: Limits) -> Iterator[tuple[str, "os.DirEntry[str]"]]:
    """List everything below a folder but folders, each with its path below it; follow no links."""
    n_names = 0
    prefixes = [""]
    while prefixes:
        prefix = prefixes.pop()
        with os.scandir(folder / prefix) as entries:
            listed = sorted(islice(entries, limits.n_names - n_names + 1), key=lambda entry: entry.name)
        n_names += len(listed)
        if n_names > limits.n_names:
            message = f"holds more than {limits.n_names:,} files and folders; no more are looked at"
            raise SourceError(f"{folder}: {message}", SMALLER_HINT)
        for entry in listed:
            if entry.is_dir(follow_symlinks=False):
                prefixes.append(f"{prefix}{entry.name}/")
            else:
                yield f"{prefix}{entry.name}", entry


def _read_entry(
    folder: Path, name: str, entry: "os.DirEntry[str]", is_wanted: Wanted, limits: Limits
) -> Iterator[_Found]:
    """Read a wanted file, or what is wanted of an archive."""
    is_archive = is_chosen(name, lambda path: path.lower().endswith(ARCHIVE_SUFFIX))
    if not is_archive and not is_chosen(name, is_wanted):
        return
    if saying := say_odd_name(name):
        raise SourceError(
            f"{folder}: the name {quote(name)} {saying}", "rename it, or move it out of the folder"
        )
    if not entry.is_file(follow_symlinks=False):
        kind = "symbolic link" if entry.is_symlink() else "special file"
        raise SourceError(f"{entry.path}: is a {kind}, and only plain files are read", LINK_HINT)
    if is_archive:
        with Path(entry.path).open("rb", buffering=0) as stream, open_archive(stream, entry.path) as archive:
            files = _read_chosen(archive, entry.path, is_wanted, limits)
            yield from ((entry.path, file) for file in files)
    else:
        yield str(folder), SourceFile(name, entry.path, _read_plain(Path(entry.path), limits))


def _read_plain(path: Path, limits: Limits) -> bytes:
    content = read_regular(path, limits.file_size)
    if content is None:
        raise SourceError(f"{path}: has more than {limits.file_size:,} bytes", "is it the right file?")
    return content


def _limit_total(found: Iterable[_Found], limits: Limits) -> Iterator[_Found]:
    n_bytes = 0
    for source, file in found:
        n_bytes += len(file.content)
        if n_bytes > limits.total_size:
            message = f"with {file.origin} there are more than {limits.total_size:,} bytes of wanted files"
            raise SourceError(message, SMALLER_HINT)
        yield source, file


def _merge(found: Iterable[_Found]) -> Iterator[SourceFile]:
    """Keep once what several sources have under one name, or under the end of a longer one."""
    named: dict[str, SourceFile] = {}
    equal: dict[str, list[_Found]] = {}
    for source, file in found:
        rival = named.setdefault(file.name.casefold(), file)
        if rival.sha256 != file.sha256:
            message = f"{rival.origin} and {file.origin} have the same name and differ"
            raise SourceError(message, "keep the one that counts, and move the other away")
        twins = equal.setdefault(file.sha256, [])
        if rival is file and not any(other != source and _end_alike(twin, file) for other, twin in twins):
            yield file
        twins.append((source, file))


def _end_alike(first: SourceFile, second: SourceFile) -> bool:
    shorter, longer = sorted((first.name, second.name), key=len)
    return f"/{longer}".endswith(f"/{shorter}")
