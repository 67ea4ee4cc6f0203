"""Members of a large archive on a server, by ranges: its directory, and then nothing but what is wanted."""

import io
import zipfile
from bisect import bisect_right
from collections import deque
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from http import HTTPStatus

import requests
from remotezip import PartialBuffer, RemoteZip, RemoteZipError

from leaderboard.errors import SourceError
from leaderboard.reference.fetching.answers import (
    Part,
    changed_meanwhile,
    check_success,
    contradiction,
    describe_size,
    parse_part,
    parse_whole,
    read_content,
)
from leaderboard.reference.fetching.failures import AGAIN_HINT, BrokenOffError, show_url
from leaderboard.reference.fetching.progress import following
from leaderboard.reference.fetching.remotes import RemoteArchive
from leaderboard.reference.fetching.sessions import Attempts, Connection
from leaderboard.reference.fetching.upstream import Upstream
from leaderboard.reference.source_archives import DIRECTORY_SIZE, LIMITS, choose_members, refusing_damage
from leaderboard.reference.source_files import SourceFile, read_members

TAIL = 131_072  # read first, from the end: the directory of a small archive, and any comment behind it
MAX_GAP = 65_536  # members so close to one another are read at once: a request costs more than such a gap
MAX_HEADER = 30 + 2 * 65_535 + 24  # bytes of a member beside its packed content: header, names, descriptor

Span = tuple[int, int]


class RemoteRanges:
    """A file on a server that is read by ranges, all of one version.

    Parameters
    ----------
    connection
        What it is read over.
    url
        Where it is.

    Attributes
    ----------
    upstream
        The version, as the server's first answer told it.
    n_allowed
        How many more bytes may be read.
    """

    def __init__(self, connection: Connection, url: str) -> None:
        self._connection = connection
        self._url = url
        self._spans: Sequence[Span] = ()
        self._pieces: list[tuple[int, bytes]] = []
        self.n_allowed = DIRECTORY_SIZE + TAIL
        self.upstream = self._open()

    @property
    def size(self) -> int:
        """How many bytes the whole file has."""
        return self.upstream.size or 0

    def plan(self, spans: Sequence[Span], n_allowed: int) -> None:
        """Announce what is going to be read, as first bytes and ends; each span is read in one go."""
        self._spans, self.n_allowed = spans, n_allowed

    def read(self, start: int, end: int) -> bytes:
        """Read the bytes from ``start`` up to ``end``, or fewer where a planned span ends.

        Raises
        ------
        SourceError
            If they cannot be read, or the file has changed since the first answer.
        zipfile.BadZipFile
            If there are no such bytes.
        """
        if not 0 <= start < end <= self.size:
            raise zipfile.BadZipFile("it points to places that it does not have")
        for place, content in self._pieces:
            if place <= start and end <= place + len(content):
                return content[start - place : end - place]
        span = next((span for span in self._spans if span[0] <= start < span[1]), (start, end))
        content = self._fetch(*span)
        self._pieces.append((span[0], content))
        return content[start - span[0] : end - span[0]]

    def _open(self) -> Upstream:
        """Ask for one byte, to learn which version is there and whether ranges can be had."""
        with self._connection.get(self._url, {"Range": "bytes=0-0"}) as answer:
            check_success(answer, self._url, HTTPStatus.PARTIAL_CONTENT, HTTPStatus.OK)
            if answer.status_code == HTTPStatus.OK:
                raise self._no_ranges(answer)
            part = self._parse(answer, 0, 1)
            with suppress(BrokenOffError):  # read only so that the connection can be used again
                deque(read_content(answer, part, self._connection, url=self._url, limit=1), maxlen=0)
            return part.upstream

    def _no_ranges(self, answer: requests.Response) -> SourceError:
        size = parse_whole(answer).length
        message = f"{show_url(self._url)}: its server sends files only as a whole"
        cost = "an unknown number of bytes" if size is None else describe_size(size)
        return SourceError(message, f"--full-download takes all of it, {cost}")

    def _fetch(self, start: int, end: int) -> bytes:
        self.n_allowed -= end - start
        if self.n_allowed < 0:
            message = f"{show_url(self._url)}: {describe_size(end - start)} of it would have to be read"
            raise SourceError(message, "is this still the official file?")
        content = bytearray()
        attempts = Attempts(self._connection, self._url)
        while len(content) < end - start:
            try:
                self._continue(content, start, end)
            except BrokenOffError as error:
                attempts.wait_after(error)
        return bytes(content)

    def _continue(self, content: bytearray, start: int, end: int) -> None:
        """Ask for what is missing of a range, and append what comes."""
        start += len(content)
        headers = {"Range": f"bytes={start}-{end - 1}"}
        if self.upstream.strong_etag:
            headers["If-Match"] = self.upstream.strong_etag
        with self._connection.get(self._url, headers) as answer:
            part = self._check(answer, start, end)
            for piece in read_content(answer, part, self._connection, url=self._url, limit=end - start):
                content += piece

    def _check(self, answer: requests.Response, start: int, end: int) -> Part:
        """Make sure that an answer brings this range of this version, before its content is read."""
        if answer.status_code in {
            HTTPStatus.PRECONDITION_FAILED,
            HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE,
            HTTPStatus.OK,
        }:
            raise changed_meanwhile(self._url)
        check_success(answer, self._url, HTTPStatus.PARTIAL_CONTENT)
        part = self._parse(answer, start, end)
        if not part.upstream.is_same(self.upstream):
            raise changed_meanwhile(self._url)
        return part

    def _parse(self, answer: requests.Response, start: int, end: int) -> Part:
        part = parse_part(answer, self._url)
        if (part.start, part.length) != (start, end - start):
            raise contradiction(self._url, f"asked for the bytes from {start} to {end - 1}, it sends others")
        return part


def fetch_members(connection: Connection, remote: RemoteArchive) -> tuple[tuple[SourceFile, ...], Upstream]:
    """Fetch the wanted members of an archive and as little else of it as possible.

    Raises
    ------
    SourceError
        If the server sends no ranges, the archive changes meanwhile or is damaged, or a member is refused.
    """
    origin = show_url(remote.url)
    with _refusing_misreadings(origin):
        with following(connection.progress, f"{remote.what}: directory", None):
            ranges = RemoteRanges(connection, remote.url)
            archive = _open_archive(ranges, remote.url)
        with archive:
            spans = find_spans(archive, choose_members(archive, origin, remote.is_wanted, LIMITS))
            ranges.plan(spans, LIMITS.total_size)
            with following(connection.progress, remote.what, sum(end - start for start, end in spans)):
                return read_members(archive, origin, remote.is_wanted), ranges.upstream


def find_spans(archive: zipfile.ZipFile, members: Sequence[zipfile.ZipInfo]) -> list[Span]:
    """Find which bytes of an archive to read for some members: close ones together, no more than needed."""
    starts = sorted({*(info.header_offset for info in archive.infolist()), archive.start_dir})
    spans: list[Span] = []
    for start in sorted(member.header_offset for member in members):
        following_start = starts[min(bisect_right(starts, start), len(starts) - 1)]
        spans.append((start, following_start))
    longest = {member.header_offset: member.compress_size + MAX_HEADER for member in members}
    return _merge([(start, min(end, start + longest[start])) for start, end in spans])


def _merge(spans: Sequence[Span]) -> list[Span]:
    merged: list[Span] = []
    for start, end in spans:
        if merged and start - merged[-1][1] <= MAX_GAP:
            merged[-1] = (merged[-1][0], max(end, merged[-1][1]))
        else:
            merged.append((start, end))
    return merged


def _open_archive(ranges: RemoteRanges, url: str) -> zipfile.ZipFile:
    with refusing_damage(f"{show_url(url)}: is no zip archive, or a damaged one"):
        archive: zipfile.ZipFile = RemoteZip(url, TAIL, fetcher=lambda *_, **__: _Fetcher(ranges))
        return archive


@contextmanager
def _refusing_misreadings(origin: str) -> Iterator[None]:
    try:
        yield
    except (RemoteZipError, zipfile.BadZipFile) as error:
        raise SourceError(f"{origin}: is a damaged zip archive ({error})", AGAIN_HINT) from error


class _Fetcher:
    """Reads for the library, whose ranges are inclusive; a negative start counts from the end."""

    def __init__(self, ranges: RemoteRanges) -> None:
        self._ranges = ranges

    def fetch(self, asked: tuple[int, int | None], *, stream: bool) -> PartialBuffer:
        del stream  # what is fetched is in memory
        start, last = asked
        size = self._ranges.size
        start = max(start + size, 0) if last is None else start
        content = self._ranges.read(start, size if last is None else last + 1)
        return PartialBuffer(io.BytesIO(content), start, len(content), stream=False)
