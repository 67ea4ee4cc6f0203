"""What the page of the method shows."""

from dataclasses import dataclass

from leaderboard.website.pages import Fact, Page


@dataclass(frozen=True)
class MetricEntry:
    """What a reader should know of a metric."""

    name: str
    title: str
    meaning: str
    direction: str
    range: str
    chance: str


@dataclass(frozen=True)
class MethodPage(Page):
    """What every number means."""

    metrics: tuple[MetricEntry, ...]
    others: tuple[MetricEntry, ...]
    terms: tuple[Fact, ...]
