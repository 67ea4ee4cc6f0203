"""Reading an answer: what its headers promise, and its content held against that."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from http import HTTPStatus

import requests
from urllib3.exceptions import HTTPError

from leaderboard.errors import SourceError
from leaderboard.reference.fetching.failures import (
    AGAIN_HINT,
    LATER_HINT,
    BrokenOffError,
    explain_status,
    show_url,
)
from leaderboard.reference.fetching.sessions import Connection
from leaderboard.reference.fetching.upstream import Upstream

CHUNK = 262_144
_CONTENT_RANGE = re.compile(r"bytes ([0-9]{1,18})-([0-9]{1,18})/([0-9]{1,18})")
_LENGTH = re.compile(r"[0-9]{1,18}")


@dataclass(frozen=True)
class Part:
    """A file or a range of it that a server has begun to send.

    Attributes
    ----------
    start
        Place of its first byte.
    length
        Number of its bytes; None if the server does not say.
    upstream
        The version of the file; its size is that of the whole.
    """

    start: int
    length: int | None
    upstream: Upstream


def parse_whole(answer: requests.Response) -> Part:
    """Understand the headers of an answer that brings a whole file."""
    length = _length_of(answer)
    return Part(0, length, Upstream.parse(answer.headers, length))


def parse_part(answer: requests.Response, url: str) -> Part:
    """Understand the headers of an answer that brings a range.

    Raises
    ------
    SourceError
        If they contradict one another.
    """
    told = answer.headers.get("Content-Range", "")
    match = _CONTENT_RANGE.fullmatch(told)
    if match is None:
        raise contradiction(url, f"sends a part without saying which (Content-Range {told[:100]!r})")
    first, last, total = map(int, match.groups())
    length = _length_of(answer)
    if not first <= last < total or length not in {None, last - first + 1}:
        raise contradiction(url, f"sends {length} bytes as {told!r}")
    return Part(first, last - first + 1, Upstream.parse(answer.headers, total))


def read_content(
    answer: requests.Response, part: Part, connection: Connection, *, url: str, limit: int
) -> Iterator[bytes]:
    """Yield the content in pieces, as they come.

    Raises
    ------
    SourceError
        If it is packed, or longer than ``limit``.
    BrokenOffError
        If it ends too early.
    """
    packing = answer.headers.get("Content-Encoding", "identity")
    if packing.lower() != "identity":
        message = f"{show_url(url)}: comes packed ({packing[:100]!r}) although it was asked for as it is"
        raise SourceError(message, LATER_HINT)
    n = 0
    while piece := _read_piece(answer):
        connection.note(len(piece))
        n += len(piece)
        if n > limit:
            raise too_large(url, f"more than {describe_size(limit)}", limit)
        yield piece
    if part.length is not None and n < part.length:
        raise BrokenOffError(f"{n} of {part.length} bytes")


def check_success(answer: requests.Response, url: str, *expected: HTTPStatus) -> None:
    """Refuse an answer with a status other than those expected.

    Raises
    ------
    SourceError
        If it has one.
    """
    if answer.status_code not in expected:
        raise explain_status(answer, url)


def contradiction(url: str, what: str) -> SourceError:
    """Say that a server contradicts itself."""
    return SourceError(f"{show_url(url)}: the server contradicts itself: {what}", AGAIN_HINT)


def changed_meanwhile(url: str) -> SourceError:
    """Say that not all parts are of one version."""
    return SourceError(f"{show_url(url)}: changed while it was being fetched", AGAIN_HINT)


def too_large(url: str, size: str, limit: int) -> SourceError:
    """Say that a file is too large."""
    message = f"{show_url(url)}: has {size}; at most {describe_size(limit)} are fetched"
    return SourceError(message, "is this still the official file?")


def describe_size(n_bytes: int) -> str:
    """Say a number of bytes in the unit that people would use.

    >>> describe_size(999), describe_size(12_345), describe_size(4_400_000_000)
    ('999 bytes', '12.3 kB', '4.4 GB')
    """
    for unit, name in ((10**9, "GB"), (10**6, "MB"), (10**3, "kB")):
        if n_bytes >= unit:
            return f"{n_bytes / unit:.1f} {name}"
    return f"{n_bytes} bytes"


def _length_of(answer: requests.Response) -> int | None:
    told = answer.headers.get("Content-Length", "")
    if "Transfer-Encoding" in answer.headers or not _LENGTH.fullmatch(told):
        return None
    return int(told)


def _read_piece(answer: requests.Response) -> bytes:
    try:
        # What has come so far, not the next so many bytes: of those an interruption would leave nothing.
        piece: bytes | None = answer.raw.read1(CHUNK, decode_content=False)
    except HTTPError as error:
        raise BrokenOffError from error
    return piece or b""
