"""What the stand-in's web server serves, what goes wrong with it, and what it has seen."""

import threading
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

Content = bytes | Path


@dataclass(frozen=True)
class Fault:
    """What goes wrong with a path; what is not set goes right.

    Attributes
    ----------
    times
        How many requests it concerns; None means all from now on.
    status, retry_after
        Answer with this status and no content, with this ``Retry-After``.
    redirect_to
        Answer 302 with this ``Location``; that of the path itself makes a loop.
    ignores_ranges
        Answer 200 with the whole, and do not announce ranges.
    drops
        Close the connection without an answer.
    hangs
        Do not answer until the server is closed.
    cut_after
        Close the connection after so many bytes of the body.
    chunk, pause
        Send the body in chunks of so many bytes, with so many seconds after each.
    etag
        Send this ETag instead of that of the content; an empty one leaves it out.
    changes
        Every request finds another ETag.
    content
        Serve this instead.
    length_off_by
        Announce a ``Content-Length`` wrong by so many bytes, and close the connection after the body.
    range_off_by
        Announce a ``Content-Range`` shifted by so many bytes.
    is_gzipped
        Send the whole with ``Content-Encoding: gzip``.
    """

    times: int | None = None
    status: int | None = None
    retry_after: str | None = None
    redirect_to: str | None = None
    ignores_ranges: bool = False
    drops: bool = False
    hangs: bool = False
    cut_after: int | None = None
    chunk: int = 65536
    pause: float = 0.0
    etag: str | None = None
    changes: bool = False
    content: bytes | None = None
    length_off_by: int = 0
    range_off_by: int = 0
    is_gzipped: bool = False


@dataclass(frozen=True)
class Seen:
    """A request that came in, and the status that it got; 0 where it got no answer."""

    method: str
    path: str
    headers: Mapping[str, str]
    status: int


class Site:
    """Contents by path, faults by path, and a record of what was asked and sent.

    Parameters
    ----------
    files
        What to serve, by path (``/test_data.zip``): bytes, or a file, which is read anew at each request.
        The mapping may be changed while serving, in ``files``.

    Attributes
    ----------
    requests
        Number of requests, by path; those for paths that do not exist too.
    bytes_sent
        Bytes of bodies sent, by path.
    log
        Every request in the order of answering.
    """

    def __init__(self, files: Mapping[str, Content]) -> None:
        self.files = dict(files)
        self.requests: Counter[str] = Counter()
        self.bytes_sent: Counter[str] = Counter()
        self.log: list[Seen] = []
        self.is_closing = threading.Event()
        self.lock = threading.Lock()
        self._faults: dict[str, list[Fault]] = {}
        self._n_faulty: Counter[str] = Counter()

    def set_faults(self, path: str, *faults: Fault) -> None:
        """Let these faults befall the next requests for a path, one after the other; none mends it."""
        with self.lock:
            self._faults[path] = list(faults)
            self._n_faulty[path] = 0

    def next_fault(self, path: str) -> Fault:
        """Count a request, and say what goes wrong with it."""
        with self.lock:
            self.requests[path] += 1
            place = self._n_faulty[path]
            self._n_faulty[path] += 1
            for fault in self._faults.get(path, []):
                if fault.times is None or place < fault.times:
                    return fault
                place -= fault.times
        return Fault()

    def note(self, seen: Seen) -> None:
        """Record a request."""
        with self.lock:
            self.log.append(seen)

    def note_sent(self, path: str, n_bytes: int) -> None:
        """Record a part of a body that is about to be sent."""
        with self.lock:
            self.bytes_sent[path] += n_bytes
