"""How the stand-in's web server answers one request."""

import gzip
import hashlib
import re
import sys
from collections.abc import Iterator
from contextlib import suppress
from email.utils import formatdate
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from socket import SHUT_RDWR, socket
from typing import Any
from urllib.parse import unquote, urlsplit

from release_site import Content, Fault, Seen, Site

RELEASED = 1_698_800_000  # seconds since 1970; the time that contents in memory are from
_RANGE = re.compile(r"bytes=([0-9]*)-([0-9]*)")


class UnsatisfiableError(Exception):
    """A range lies beyond the content."""


def parse_range(header: str, size: int) -> tuple[int, int] | None:
    """Parse ``Range`` into first and last byte; None where it is to be ignored, as several ranges are.

    Raises
    ------
    UnsatisfiableError
        If no byte of the content lies within.
    """
    match = _RANGE.fullmatch(header.strip())
    if match is None or match[1] == match[2] == "":
        return None
    if match[1] == "":
        first, last = max(size - int(match[2]), 0), size - 1
    else:
        first, last = int(match[1]), min(int(match[2] or size), size - 1)
        if match[2] and int(match[2]) < first:
            return None
    if first >= size:
        raise UnsatisfiableError
    return first, last


def size_of(content: Content) -> int:
    return len(content) if isinstance(content, bytes) else content.stat().st_size


def etag_of(content: Content) -> str:
    """Make a strong ETag; that of a file is from its size and time, since files may be huge."""
    if isinstance(content, bytes):
        return f'"{hashlib.sha256(content).hexdigest()[:32]}"'
    status = content.stat()
    return f'"{status.st_size:x}-{status.st_mtime_ns:x}"'


def last_modified_of(content: Content) -> str:
    return formatdate(RELEASED if isinstance(content, bytes) else content.stat().st_mtime, usegmt=True)


def chunks_of(content: Content, first: int, length: int, chunk: int) -> Iterator[bytes]:
    """Yield the bytes from ``first`` on, without reading a file whole."""
    if isinstance(content, bytes):
        for start in range(first, first + length, chunk):
            yield content[start : min(start + chunk, first + length)]
        return
    with content.open("rb") as stream:
        stream.seek(first)
        while length > 0 and (part := stream.read(min(chunk, length))):
            length -= len(part)
            yield part


class Handler(BaseHTTPRequestHandler):
    """Answers GET and HEAD with ranges, preconditions and the faults that were ordered."""

    protocol_version = "HTTP/1.1"
    disable_nagle_algorithm = True  # or every small answer waits for the client's acknowledgement
    server: "SiteServer"

    def do_GET(self) -> None:
        self._answer(self._site.next_fault(self._path))

    do_HEAD = do_GET  # noqa: N815 - the base class looks for this name

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002 - as in the base class
        """Stay quiet; `Site.log` has it all."""

    @property
    def _site(self) -> Site:
        return self.server.site

    @property
    def _path(self) -> str:
        return unquote(urlsplit(self.path).path)

    def _note(self, status: int) -> None:
        self._site.note(Seen(self.command, self._path, dict(self.headers.items()), int(status)))

    def _answer(self, fault: Fault) -> None:
        if fault.hangs or fault.drops:
            self._note(0)
            if fault.hangs:
                self._site.is_closing.wait()
            self.close_connection = True
        elif fault.redirect_to is not None:
            self._send_bare(HTTPStatus.FOUND, {"Location": fault.redirect_to})
        elif fault.status is not None:
            hint = {} if fault.retry_after is None else {"Retry-After": fault.retry_after}
            self._send_bare(fault.status, hint)
        elif (content := self._site.files.get(self._path)) is None:
            self._send_bare(HTTPStatus.NOT_FOUND, {})
        else:
            self._serve(content if fault.content is None else fault.content, fault)

    def _serve(self, content: Content, fault: Fault) -> None:
        validators = self._validators(content, fault)
        etag = validators.get("ETag", "")
        if self.headers.get("If-Match", etag) not in {etag, "*"}:
            self._send_bare(HTTPStatus.PRECONDITION_FAILED, validators)
        elif etag and self.headers.get("If-None-Match") == etag:
            self._send_bare(HTTPStatus.NOT_MODIFIED, validators)
        elif fault.is_gzipped:
            body = gzip.compress(content if isinstance(content, bytes) else content.read_bytes(), mtime=0)
            self._send(200, {**validators, "Content-Encoding": "gzip"}, (body, 0, len(body)), fault)
        elif fault.ignores_ranges:
            self._send(200, validators, (content, 0, size_of(content)), fault)
        else:
            self._serve_range(content, {**validators, "Accept-Ranges": "bytes"}, fault)

    def _validators(self, content: Content, fault: Fault) -> dict[str, str]:
        etag = etag_of(content) if fault.etag is None else fault.etag
        if fault.changes:
            etag = f'"{self._site.requests[self._path]}-{etag[1:]}'
        headers = {"Last-Modified": last_modified_of(content)}
        return {**headers, "ETag": etag} if etag else headers

    def _serve_range(self, content: Content, headers: dict[str, str], fault: Fault) -> None:
        size = size_of(content)
        wanted = self.headers.get("Range", "") if self._is_range_valid(headers) else ""
        try:
            asked = parse_range(wanted, size)
        except UnsatisfiableError:
            unsatisfied = {**headers, "Content-Range": f"bytes */{size}"}
            self._send_bare(HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE, unsatisfied)
            return
        if asked is None:
            self._send(200, headers, (content, 0, size), fault)
            return
        first, last = asked
        told = f"bytes {first + fault.range_off_by}-{last + fault.range_off_by}/{size}"
        self._send(206, {**headers, "Content-Range": told}, (content, first, last - first + 1), fault)

    def _is_range_valid(self, headers: dict[str, str]) -> bool:
        """Tell whether ``If-Range`` lets the range be answered: none given, same ETag or same date."""
        condition = self.headers.get("If-Range")
        return condition is None or condition in {headers.get("ETag"), headers["Last-Modified"]}

    def _send_bare(self, status: int, headers: dict[str, str]) -> None:
        self._send(status, headers, (b"", 0, 0), Fault())

    def _send(
        self, status: int, headers: dict[str, str], part: tuple[Content, int, int], fault: Fault
    ) -> None:
        content, first, length = part
        self._note(status)  # first, so that whoever has the answer finds it noted
        self.send_response(status)
        for name, value in headers.items():
            self.send_header(name, value)
        if status != HTTPStatus.NOT_MODIFIED:
            self.send_header("Content-Length", str(length + fault.length_off_by))
        self.close_connection = self.close_connection or fault.length_off_by != 0
        self.end_headers()
        if self.command == "HEAD":
            return
        if fault.cut_after is not None and fault.cut_after < length:
            length, self.close_connection = fault.cut_after, True
        for chunk in chunks_of(content, first, length, fault.chunk):
            self._send_chunk(chunk, fault.pause)

    def _send_chunk(self, chunk: bytes, pause: float) -> None:
        self._site.note_sent(self._path, len(chunk))
        self.wfile.write(chunk)
        if pause:
            self._site.is_closing.wait(pause)


class SiteServer(ThreadingHTTPServer):
    """Listens on a free port of the loopback address."""

    daemon_threads = True

    def __init__(self, site: Site) -> None:
        self.site = site
        self._open: set[socket] = set()
        super().__init__(("127.0.0.1", 0), Handler)

    def process_request(self, request: Any, client_address: Any) -> None:
        with self.site.lock:
            self._open.add(request)
        super().process_request(request, client_address)

    def shutdown_request(self, request: Any) -> None:
        with self.site.lock:
            self._open.discard(request)
        super().shutdown_request(request)

    def close_connections(self) -> None:
        """Wake the threads that wait for another request on a connection kept open."""
        with self.site.lock:
            for request in self._open:
                with suppress(OSError):  # the client may have closed it
                    request.shutdown(SHUT_RDWR)

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Say nothing about a client that went away, which is what many tests are about."""
        if not isinstance(sys.exception(), OSError):
            super().handle_error(request, client_address)
