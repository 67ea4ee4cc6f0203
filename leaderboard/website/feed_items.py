"""What the feed holds."""

from dataclasses import dataclass


@dataclass(frozen=True)
class FeedItem:
    """A submission as news."""

    id: str
    slug: str
    title: str
    author: str
    updated: str
    summary: str


@dataclass(frozen=True)
class Feed:
    """The news feed."""

    id: str
    title: str
    updated: str
    entries: tuple[FeedItem, ...]
