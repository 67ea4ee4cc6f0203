"""Reading chosen members of a zip archive by somebody else: judged before they are read, and while they are.

Nothing is ever unpacked to disk, and members that nobody wants are not read at all: whatever they are, they
do no harm.
"""

import io
import re
import stat
import struct
import zipfile
import zlib
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from copy import copy
from dataclasses import dataclass

from leaderboard.errors import SourceError
from leaderboard.reference.cells import quote

N_SHOWN = 3
CHUNK = 1_000_000
DIRECTORY_SIZE = 64_000_000  # what 200,000 members with long names need
MAX_NAME_LENGTH = 500
AGAIN_HINT = "download it again, and compare its size with that at its source"
UNPACK_HINT = "unpack it yourself, look at it, and name the folder instead"

# All that zipfile and zlib raise on damaged archives, besides errors of the disk. NotImplementedError, for
# features that they do not know, is a RuntimeError, and UnicodeDecodeError a ValueError.
_DAMAGE = (
    zipfile.BadZipFile,
    zlib.error,
    struct.error,
    EOFError,
    RuntimeError,
    ValueError,
    OverflowError,
)

_PACKINGS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
_ENCRYPTED = 0x1 | 0x40  # flag bits, the second for strong encryption
_LOCAL_HEADER = 30  # bytes before a member's name and content
_SMALL = 1_000_000  # bytes that may be packed as tightly as one likes
_DRIVE = re.compile(r"[A-Za-z]:")
_JUNK_FILES = frozenset({".ds_store", "thumbs.db", "desktop.ini"})

Wanted = Callable[[str], bool]


@dataclass(frozen=True)
class Limits:
    """How much is read.

    Attributes
    ----------
    file_size, total_size
        Bytes of one file and of all of them, unpacked.
    ratio
        How many times its packed size a file may be; text packs at about ten to one, and what deflate can do
        at most is a thousand to one.
    n_names
        How many files a folder or an archive may list, wanted or not.
    """

    file_size: int = 100_000_000
    total_size: int = 400_000_000
    ratio: int = 200
    n_names: int = 200_000


LIMITS = Limits()


def is_junk(name: str) -> bool:
    """Tell whether a path names what operating systems leave behind.

    >>> is_junk("__MACOSX/data/._Mass.csv"), is_junk("data/Mass.csv")
    (True, False)
    """
    *folders, file = name.split("/")
    return "__MACOSX" in folders or file.startswith("._") or file.lower() in _JUNK_FILES


def is_chosen(name: str, is_wanted: Wanted) -> bool:
    """Tell whether a path is wanted and no junk, also if so only where backslashes separate folders."""
    path = name.replace("\\", "/")
    return not path.endswith("/") and not is_junk(path) and is_wanted(path)


def say_odd_name(name: str) -> str:
    r"""Say what is odd about a path; empty if it plainly names a file below a folder.

    >>> say_odd_name("data/../../etc/passwd.csv")
    "has a part '..'"
    >>> say_odd_name("data/Mass.csv")
    ''
    """
    if len(name) > MAX_NAME_LENGTH:
        return f"has more than {MAX_NAME_LENGTH} characters"
    if not name.isprintable():
        return "holds characters that cannot be shown"
    if "\\" in name:
        return "holds backslashes"
    if name.startswith("/") or _DRIVE.match(name):
        return "starts at the root of a disk"
    odd = next((part for part in name.split("/") if part in {"", ".", ".."}), None)
    return "" if odd is None else f"has a part {quote(odd)}"


def name_some(names: Sequence[str]) -> str:
    """Show the first names of a list and count the others."""
    shown = ", ".join(quote(name) for name in names[:N_SHOWN])
    return shown if len(names) <= N_SHOWN else f"{shown} and {len(names) - N_SHOWN:,} more"


@contextmanager
def open_archive(stream: io.RawIOBase, origin: str) -> Iterator[zipfile.ZipFile]:
    """Open an archive on disk; ``origin`` is how messages name it.

    Raises
    ------
    SourceError
        If it is no zip archive or its directory is damaged or huge.
    """
    with _BoundedReader(stream) as reader:
        with refusing_damage(f"{origin}: is no zip archive, or a damaged one"):
            archive = zipfile.ZipFile(reader)
        with archive:
            yield archive


@contextmanager
def refusing_damage(saying: str) -> Iterator[None]:
    """Make what zipfile raises on damaged archives a `SourceError`; errors of disk or network pass through.

    Parameters
    ----------
    saying
        Which archive or member is damaged; what zipfile found follows in brackets.
    """
    try:
        yield
    except _DAMAGE as error:
        detail = str(error)[:MAX_NAME_LENGTH] or "it ends too early"
        raise SourceError(f"{saying} ({detail})", AGAIN_HINT) from error


def choose_members(
    archive: zipfile.ZipFile, origin: str, is_wanted: Wanted, limits: Limits
) -> list[zipfile.ZipInfo]:
    """Choose the wanted members by the archive's directory alone, in the order in which they are stored.

    Raises
    ------
    SourceError
        If one of them is anything but a file that can be read within the limits, or is not told apart.
    """
    members = archive.infolist()
    if len(members) > limits.n_names:
        message = f"lists {len(members):,} members; at most {limits.n_names:,} are looked at"
        raise SourceError(f"{origin}: {message}", UNPACK_HINT)
    wanted = [member for member in members if is_chosen(member.filename, is_wanted)]
    for member in wanted:
        for saying, hint in _list_faults(member, limits):
            raise SourceError(f"{origin}: the member {quote(member.orig_filename)} {saying}", hint)
    _refuse_repeats(wanted, origin)
    _refuse_overlaps(archive, wanted, origin)
    if sum(member.file_size for member in wanted) > limits.total_size:
        message = f"{len(wanted)} wanted members have more than {limits.total_size:,} bytes unpacked"
        raise SourceError(f"{origin}: {message}", UNPACK_HINT)
    return sorted(wanted, key=lambda member: member.header_offset)


def read_member(archive: zipfile.ZipFile, member: zipfile.ZipInfo, origin: str) -> bytes:
    """Read a chosen member, and no more than one chunk beyond the size that the directory declares.

    Raises
    ------
    SourceError
        If it is damaged or has another size.
    """
    content = bytearray()
    # zipfile stops at the declared size without a word, so it is made to go on.
    longer = copy(member)
    longer.file_size += 2 * CHUNK
    with refusing_damage(f"{origin}: is damaged"), archive.open(longer) as stream:
        while len(content) <= member.file_size and (chunk := stream.read(CHUNK)):
            content += chunk
    if len(content) != member.file_size:
        size = "more" if len(content) > member.file_size else "less"
        message = f"unpacks to {size} than the {member.file_size:,} bytes that its archive declares"
        raise SourceError(f"{origin}: {message}", AGAIN_HINT)
    return bytes(content)


class _BoundedReader(io.BufferedReader):
    """Reads no more than a directory's largest size at once; zipfile reads the directory in one piece."""

    def read(self, size: int | None = -1, /) -> bytes:
        if size is not None and size > DIRECTORY_SIZE:
            raise zipfile.BadZipFile(f"the directory is said to have {size:,} bytes")
        return super().read(size)


def _list_faults(member: zipfile.ZipInfo, limits: Limits) -> Iterator[tuple[str, str]]:
    """Say why a member cannot be read, and what to do about it."""
    for name in (member.orig_filename, member.filename):  # the first holds what follows a NUL
        if saying := say_odd_name(name):
            yield f"is not plainly a file: its name {saying}", UNPACK_HINT
    kind = stat.S_IFMT(member.external_attr >> 16)  # zero where the archive was not made on Unix
    if kind not in {0, stat.S_IFREG}:
        yield f"is a {'symbolic link' if stat.S_ISLNK(kind) else 'special file'}", UNPACK_HINT
    if member.flag_bits & _ENCRYPTED:
        yield "is encrypted", "unpack it with its password, and name the folder instead"
    if member.compress_type not in _PACKINGS:
        yield f"is packed by method {member.compress_type}; only deflate (8) is read", UNPACK_HINT
    if member.file_size > limits.file_size:
        yield f"has {member.file_size:,} bytes; at most {limits.file_size:,} are read", UNPACK_HINT
    if member.file_size > max(_SMALL, limits.ratio * member.compress_size):
        message = f"has {member.file_size:,} bytes packed into {member.compress_size:,}"
        yield f"{message}; more than {limits.ratio} to one is not read", UNPACK_HINT


def _refuse_repeats(wanted: Sequence[zipfile.ZipInfo], origin: str) -> None:
    """Refuse names that mean the same file, on some systems at least."""
    counts = Counter(member.filename.casefold() for member in wanted)
    repeated = sorted(member.filename for member in wanted if counts[member.filename.casefold()] > 1)
    if repeated:
        first, second = repeated[0], next(n for n in repeated[1:] if n.casefold() == repeated[0].casefold())
        said = quote(first) if first == second else f"{quote(first)} and {quote(second)}"
        raise SourceError(f"{origin}: several members are called {said}", UNPACK_HINT)


def _refuse_overlaps(archive: zipfile.ZipFile, wanted: Sequence[zipfile.ZipInfo], origin: str) -> None:
    """Refuse members that share bytes with others or with the directory: a trick to unpack one many times."""
    chosen = {id(member) for member in wanted}
    end, last = 0, None
    for member in sorted(archive.infolist(), key=lambda member: member.header_offset):
        is_shared = member.header_offset < end
        if is_shared and (id(member) in chosen or id(last) in chosen):
            message = f"the member {quote(member.filename)} shares bytes with another"
            raise SourceError(f"{origin}: {message}", AGAIN_HINT)
        its_end = member.header_offset + _LOCAL_HEADER + len(member.orig_filename) + member.compress_size
        if its_end > archive.start_dir and id(member) in chosen:
            message = f"the member {quote(member.filename)} runs into the directory"
            raise SourceError(f"{origin}: {message}", AGAIN_HINT)
        if its_end >= end:
            end, last = its_end, member
