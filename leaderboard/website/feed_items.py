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
    """The news feed; ``site`` is where the site is served, empty where that is not known."""

    id: str
    site: str
    title: str
    updated: str
    entries: tuple[FeedItem, ...]
