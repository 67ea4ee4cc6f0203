"""Whole files to the cache: continued where they broke off, fetched again only if they changed."""

from dataclasses import dataclass, replace
from http import HTTPStatus

import requests

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
    too_large,
)
from leaderboard.reference.fetching.cache import CachedFile, Held
from leaderboard.reference.fetching.failures import BrokenOffError, show_url
from leaderboard.reference.fetching.progress import following
from leaderboard.reference.fetching.sessions import Attempts, Connection
from leaderboard.reference.fetching.upstream import Upstream


@dataclass(frozen=True)
class Download:
    """A file to be taken whole.

    Attributes
    ----------
    what, url
        What it is, for people, and where.
    place
        Where it is kept.
    limit
        How many bytes it may have.
    """

    what: str
    url: str
    place: CachedFile
    limit: int

    def fetch(self, connection: Connection, sha256: str = "") -> Upstream:
        """Fetch what is not here yet, and return the version that is here then.

        Raises
        ------
        SourceError
            If it cannot be fetched, or has another checksum than the one given; nothing is kept then.
        """
        upstream = self._persist(connection)
        if sha256 and upstream.sha256 != sha256:
            self.place.discard()
            message = f"has the sha256 {upstream.sha256}, but the official file is known to have {sha256}"
            hint = "it was changed at its source or on the way; nothing of it is kept"
            raise SourceError(f"{show_url(self.url)}: {message}", hint)
        return upstream

    def _persist(self, connection: Connection) -> Upstream:
        attempts = Attempts(connection, self.url)
        while True:
            try:
                return self._continue(connection)
            except BrokenOffError as error:
                attempts.wait_after(error)

    def _continue(self, connection: Connection) -> Upstream:
        """Ask for what is missing, and take what comes of it."""
        held = self.place.find()
        with connection.get(self.url, _conditions(held)) as answer:
            if held is not None and held.is_whole and answer.status_code == HTTPStatus.NOT_MODIFIED:
                return held.upstream
            if held is not None and answer.status_code == HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE:
                self.place.discard()
                raise contradiction(
                    self.url, f"it has announced more than {held.n_bytes} bytes, and now has no more"
                )
            part = self._begin(answer, held)
            with following(connection.progress, self.what, part.upstream.size):
                connection.progress.advance(part.start)
                self._take(answer, part, connection)
        return self.place.complete(part.upstream)

    def _begin(self, answer: requests.Response, held: Held | None) -> Part:
        """Understand what the server has begun to send, and prepare the place for it."""
        if held is None or held.is_whole or answer.status_code != HTTPStatus.PARTIAL_CONTENT:
            check_success(answer, self.url, HTTPStatus.OK)
            part = parse_whole(answer)
            self._check_size(part.upstream.size)
            self.place.begin(part.upstream)
            return part
        part = parse_part(answer, self.url)
        if part.start != held.n_bytes or part.length != (part.upstream.size or 0) - part.start:
            raise contradiction(self.url, f"asked for the bytes from {held.n_bytes} on, it sends others")
        if not part.upstream.is_same(held.upstream):
            self.place.discard()
            raise changed_meanwhile(self.url)
        self._check_size(part.upstream.size)
        # The first answer's word: that to a conditional request need not repeat all headers.
        return replace(part, upstream=held.upstream.model_copy(update={"size": part.upstream.size}))

    def _check_size(self, size: int | None) -> None:
        if size is not None and size > self.limit:
            raise too_large(self.url, describe_size(size), self.limit)

    def _take(self, answer: requests.Response, part: Part, connection: Connection) -> None:
        limit = self.limit - part.start
        pieces = read_content(answer, part, connection, url=self.url, limit=limit)
        with self.place.part_file.open("ab") as stream:
            for piece in pieces:
                stream.write(piece)


def _conditions(held: Held | None) -> dict[str, str]:
    """Ask for what is missing of the version that is here, or for the whole of any other."""
    if held is None:
        return {}
    if held.is_whole:
        return held.upstream.change_conditions
    if held.n_bytes == 0 or not held.upstream.part_condition:
        return {}
    return {"Range": f"bytes={held.n_bytes}-", "If-Range": held.upstream.part_condition}
