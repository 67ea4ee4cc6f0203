"""News of the board as an Atom feed: one item per submission, dated by the submission itself."""

import uuid

from leaderboard.grading import find_metric
from leaderboard.models import Score
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Entry
from leaderboard.website.describing import badges_of
from leaderboard.website.feed_items import Feed, FeedItem
from leaderboard.website.material import Material
from leaderboard.website.numbers import show_interval, show_percent

NEVER = "1970-01-01"
ACCURACY = find_metric("accuracy")


def compose_feed(material: Material) -> Feed:
    """Gather the feed's items, newest first; baselines are no news."""
    benchmark = material.reference.benchmark
    entries = [p.entry for p in material.publications if not p.entry.is_baseline]
    entries.sort(key=lambda entry: entry.metadata.submission.date, reverse=True)
    title = material.texts.title or f"{benchmark.title} leaderboard"
    items = tuple(_compose_item(entry, material) for entry in entries)
    return Feed(
        id=_name_forever(material, ""),
        site=material.texts.url,
        title=title + (" (synthetic)" if material.reference.is_synthetic else ""),
        updated=items[0].updated if items else _at_midnight(NEVER),
        entries=items,
    )


def _compose_item(entry: Entry, material: Material) -> FeedItem:
    about = entry.metadata.submission
    scored = _describe_accuracy(entry.score(ACCURACY.name, OVERALL))
    badges = f"({', '.join(badges_of(entry))}) " if badges_of(entry) else ""
    return FeedItem(
        id=_name_forever(material, entry.slug),
        slug=entry.slug,
        title=about.name,
        author=about.team,
        updated=_at_midnight(about.date.isoformat()),
        summary=f"{scored}{badges}{about.description}".strip(),
    )


def _describe_accuracy(score: Score | None) -> str:
    if score is None or score.value is None:
        return ""
    interval = show_interval(ACCURACY, score)
    return f"Accuracy {show_percent(score.value)} %" + (f" ({interval}). " if interval else ". ")


def _name_forever(material: Material, slug: str) -> str:
    """Make an address-free identifier that stays the same wherever the site is served."""
    return uuid.uuid5(uuid.NAMESPACE_URL, f"leaderboard/{material.reference.benchmark.name}/{slug}").urn


def _at_midnight(date: str) -> str:
    return f"{date}T00:00:00Z"
