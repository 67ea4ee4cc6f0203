"""The page that explains every number, made from the table of metrics and the benchmark's definition."""

from leaderboard.grading import METRICS, SUBSETS, Metric
from leaderboard.website.describing import describe_chance, describe_subset
from leaderboard.website.material import Material
from leaderboard.website.numbers import ABSENT, show_bound
from leaderboard.website.pages import Fact, MethodPage, MetricEntry

DIRECTIONS = {"higher": "higher is better", "lower": "lower is better", "none": "neither end is better"}

TERMS = {
    "Overall": "The plain mean of the properties; a p-value pools the pairs of all properties.",
    "Property": "Scored when all its scenarios are covered; overall, when all properties are.",
    "Rank": "Complete submissions of a track by overall accuracy; equal scores share a rank.",
    "Unanswered trial": "Earns no credit; where a metric needs a probability, it counts as 0.5.",
    "Undefined": "Where a formula gives no value there is a dash, with the reason below the table.",
}


def compose_method(material: Material) -> MethodPage:
    """Gather what the page of methods shows."""
    subsets = SUBSETS if material.people else SUBSETS[:1]
    terms = [Fact(subset.title(), describe_subset(subset, material)) for subset in subsets]
    terms += [Fact(word, meaning) for word, meaning in TERMS.items()]
    return MethodPage(
        path="method.html",
        title="Method",
        summary="What every number means: its direction, its range, and what guessing gives.",
        metrics=tuple(_describe_metric(metric) for metric in METRICS),
        terms=tuple(terms),
    )


def _describe_metric(metric: Metric) -> MetricEntry:
    return MetricEntry(
        name=metric.name,
        title=metric.title,
        meaning=metric.meaning,
        direction=DIRECTIONS[metric.direction],
        range=_describe_range(metric),
        chance=describe_chance(metric) or ABSENT,
    )


def _describe_range(metric: Metric) -> str:
    return f"{show_bound(metric, metric.low)} to {show_bound(metric, metric.high)}"
