"""What a server says of a file, and what has changed since it was locked."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal, Self

from pydantic import Field

from leaderboard.models import Source
from leaderboard.models.strict import StrictModel

MAX_HEADER_LENGTH = 200

Key = tuple[str, str]


class Upstream(StrictModel):
    """One version of a file on a server.

    ``size`` is None if the server does not say it; ``sha256`` is empty until the file is here as a whole.
    """

    etag: str = ""
    last_modified: str = ""
    size: int | None = Field(default=None, ge=0)
    sha256: str = ""

    @classmethod
    def parse(cls, headers: Mapping[str, str], size: int | None) -> Self:
        """Take the version from the headers of an answer."""
        etag, last_modified = (_read_header(headers, name) for name in ("ETag", "Last-Modified"))
        return cls(etag=etag, last_modified=last_modified, size=size)

    @property
    def strong_etag(self) -> str:
        """The ETag if equal ones promise equal bytes, or an empty text."""
        return self.etag if self.etag.startswith('"') else ""

    @property
    def part_condition(self) -> str:
        """What to send as ``If-Range``; empty if nothing tells this version from others."""
        return self.strong_etag or self.last_modified

    @property
    def change_conditions(self) -> dict[str, str]:
        """Headers that ask for the file only if it is another version."""
        conditions = {"If-None-Match": self.etag, "If-Modified-Since": self.last_modified}
        return next(({name: value} for name, value in conditions.items() if value), {})

    def is_same(self, other: "Upstream") -> bool:
        """Tell whether two answers can be about the same version; sizes and dates may be left out."""
        if self.etag != other.etag:
            return False
        if None not in {self.size, other.size} and self.size != other.size:
            return False
        dates = {self.last_modified, other.last_modified} - {""}
        return bool(self.etag) or len(dates) <= 1


@dataclass(frozen=True)
class SourceChange:
    """How an official file differs from what was locked.

    Attributes
    ----------
    kind
        ``added`` and ``removed``: the file was not locked, or is no longer found. ``content``: its checksum
        is another. ``validators``: only its ETag or date is.
    before, after
        The file as locked and as found; None where it is not.
    """

    kind: Literal["added", "removed", "content", "validators"]
    before: Source | None
    after: Source | None

    @property
    def is_content(self) -> bool:
        """Whether other bytes would be imported."""
        return self.kind != "validators"


def compare_sources(locked: Iterable[Source], found: Iterable[Source]) -> tuple[SourceChange, ...]:
    """List what has changed upstream, by URL and member.

    A locked source without checksum locks nothing: whatever is found at its URL is no change.

    Parameters
    ----------
    locked
        The sources of the manifest that is there.
    found
        Those that were fetched.
    """
    before = {_key_of(source): source for source in locked}
    after = {_key_of(source): source for source in found}
    open_urls = {source.url for source in before.values() if not source.sha256}
    changes = []
    for key in sorted(before.keys() | after.keys()):
        old, new = before.get(key), after.get(key)
        if key[0] not in open_urls or (old is not None and old.sha256):
            changes += _compare_pair(old, new)
    return tuple(changes)


def _compare_pair(old: Source | None, new: Source | None) -> list[SourceChange]:
    if old is None or new is None:
        return [SourceChange("added" if old is None else "removed", old, new)]
    if old.sha256 != new.sha256:
        return [SourceChange("content", old, new)]
    if (old.etag, old.last_modified) != (new.etag, new.last_modified):
        return [SourceChange("validators", old, new)]
    return []


def _read_header(headers: Mapping[str, str], name: str) -> str:
    """Read a header that is going to be written down; an outlandish one is none."""
    text = headers.get(name, "")
    return text if text.isprintable() and len(text) <= MAX_HEADER_LENGTH else ""


def _key_of(source: Source) -> Key:
    return source.url, source.member
