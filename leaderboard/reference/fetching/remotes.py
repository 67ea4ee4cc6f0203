"""What to fetch, and what was fetched."""

from collections.abc import Callable
from dataclasses import dataclass

from leaderboard.models import Source
from leaderboard.reference.source_files import SourceFile


@dataclass(frozen=True)
class RemoteFile:
    """A file that is taken whole.

    Attributes
    ----------
    what
        What it is, for people.
    url
        Where it is.
    sha256
        Its checksum, if that is known in advance; another content is then refused.
    """

    what: str
    url: str
    sha256: str = ""


@dataclass(frozen=True)
class RemoteArchive:
    """A zip archive of which some members are wanted.

    Attributes
    ----------
    what
        What it is, for people.
    url
        Where it is.
    is_wanted
        Tells from a member's path whether to read it.
    is_large
        Whether to fetch only the wanted members, by ranges; otherwise the archive is taken whole.
    sha256
        Its checksum, if that is known in advance; it can only be proven of an archive that is taken whole.
    """

    what: str
    url: str
    is_wanted: Callable[[str], bool]
    is_large: bool
    sha256: str = ""


Remote = RemoteFile | RemoteArchive


@dataclass(frozen=True)
class Fetched:
    """What was fetched.

    Attributes
    ----------
    files, sources
        The files in the order of what was asked for, members of an archive by name; and of each in the same
        order where it came from.
    n_bytes
        How many bytes of content were transferred, those of interrupted transfers too.
    """

    files: tuple[SourceFile, ...]
    sources: tuple[Source, ...]
    n_bytes: int
