"""The page that explains every number, made from the table of metrics and the benchmark's definition."""

from leaderboard.grading import METRICS
from leaderboard.grading.scopes import CROSSFIT_SUBSETS
from leaderboard.website.describing import (
    SUBSET_TITLES,
    describe_chance,
    describe_subset,
    list_subsets,
)
from leaderboard.website.material import Material
from leaderboard.website.method_pages import MethodPage, MetricEntry
from leaderboard.website.numbers import ABSENT, show_range
from leaderboard.website.pages import Fact
from leaderboard.website.quantities import OF_BOARDS, OF_COMPARISONS, OF_PEOPLE, Described
from leaderboard.website.remarks import describe_intervals

DIRECTIONS = {"higher": "higher is better", "lower": "lower is better", "none": "neither end is better"}

TERMS = {
    "Overall": "The plain mean of the properties; a p-value pools the pairs of all properties.",
    "Property": "Scored when all its scenarios are covered; overall, when all properties are.",
    "Rank": "Complete submissions of a track by overall accuracy; equal scores share a rank.",
    "Rank set": (
        "The ranks that a submission could have as well, at 95 %: 1 plus the number of submissions that are "
        "significantly better, to the number of all less those significantly worse. The tests are paired, on "
        "the draws of the intervals, and hold for all rivals at once."
    ),
    "Among the best": (
        "The submission with the highest accuracy and all that are not distinguishable from it by an exact "
        "paired sign-flip test at 5 %, corrected for the number of tests by Holm's procedure."
    ),
    "Unanswered trial": "Earns no credit; where a metric needs a probability, it counts as 0.5.",
    "Undefined": "Where a formula gives no value there is a dash, with the reason below the table.",
}
INTERVAL_LIMITS = (
    "p-values have none. Resamples in which a metric has no value are left out and counted below the table."
)
FIXED_HALVES = " On cross-fitted subsets people are not drawn anew: nobody may be in both halves."


def compose_method(material: Material) -> MethodPage:
    """Gather what the page of methods shows."""
    subsets = list_subsets(material)
    terms = [Fact(SUBSET_TITLES[subset], describe_subset(subset, material)) for subset in subsets]
    halves = FIXED_HALVES if CROSSFIT_SUBSETS[0] in subsets else ""
    terms.append(Fact("Interval", f"{describe_intervals(material)} {INTERVAL_LIMITS}{halves}"))
    terms += [Fact(word, meaning) for word, meaning in TERMS.items()]
    others = (*OF_BOARDS, *OF_COMPARISONS, *(OF_PEOPLE if material.people else ()))
    return MethodPage(
        path="method.html",
        title="Method",
        summary="What every number means: its direction, its range, and what guessing gives.",
        metrics=tuple(_describe_metric(metric) for metric in METRICS),
        others=tuple(_describe_metric(quantity) for quantity in others),
        terms=tuple(terms),
    )


def _describe_metric(quantity: Described) -> MetricEntry:
    return MetricEntry(
        name=quantity.name,
        title=quantity.title,
        meaning=quantity.meaning,
        direction=DIRECTIONS[quantity.direction],
        range=show_range(quantity),
        chance=describe_chance(quantity) or ABSENT,
    )
