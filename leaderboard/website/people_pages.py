"""The page of people: how many judged, how often they were right, and how well they agree."""

from collections.abc import Iterator

import numpy as np

from leaderboard.grading import find_metric
from leaderboard.metrics.accuracy import Floats, is_above, is_below, right_counts
from leaderboard.models.benchmark import OVERALL
from leaderboard.reference import People
from leaderboard.website.describing import count_of, describe_people, describe_subset, warn_of_simulation
from leaderboard.website.figure_pages import PeoplePage
from leaderboard.website.figures.cumulative import Distribution, Threshold, draw_distribution
from leaderboard.website.figures.forest import Forest, ForestRow, draw_forest
from leaderboard.website.figures.marks import Drawing
from leaderboard.website.material import Material
from leaderboard.website.pages import Fact
from leaderboard.website.people_tables import NOT_COMPUTED, compose_people_table
from leaderboard.website.quantities import Described, find_quantity

NO_PEOPLE = "This reference has no human data."
SPREAD = "How many trials have at most such a share of people who were right."
BY_SCOPE = "How often people are right: overall, by property and by scenario, with 95 % intervals."
BY_PROPERTY = "How well two random halves of the people agree, and how high that lets human r be."


def compose_people(material: Material) -> PeoplePage:
    """Gather what the page of people shows."""
    people = material.reference.people
    return PeoplePage(
        path="people.html",
        title="People",
        summary=f"{describe_people(material)}." if people else NO_PEOPLE,
        facts=tuple(_list_facts(material, people)) if people else (),
        drawings=tuple(_draw_people(material, people)) if people else (),
        table=compose_people_table(material),
    )


def _list_facts(material: Material, people: People) -> Iterator[Fact]:
    rated = people.n[people.n > 0]
    if rated.size:
        spread = f"{rated.min():,} to {rated.max():,}, median {np.median(rated):g}"
        yield Fact("People per trial", f"{spread}; {count_of(rated.size, 'judged trial')}")
    for subset in ("easy", "hard"):
        count = material.count(OVERALL, subset)
        size = count_of(count.n, "trial") + (
            f" in {count_of(count.n_pairs, 'pair')}" if count.n_pairs else ""
        )
        yield Fact(subset.title(), f"{describe_subset(subset, material)} {size}.")


def _draw_people(material: Material, people: People) -> Iterator[Drawing]:
    yield _draw_spread(material, people)
    accuracy, split_half = find_metric("accuracy"), find_quantity("split_half_r")
    everything = _list_rows(material, accuracy, None)
    yield _draw_forest(material, "people-accuracy", accuracy, (everything, BY_SCOPE, ""))
    agreement = tuple(row for row in _list_rows(material, split_half, find_quantity("ceiling")) if row.score)
    if agreement:
        shown = (agreement, BY_PROPERTY, "ceiling of human r")
        yield _draw_forest(material, "people-agreement", split_half, shown)


def _draw_forest(
    material: Material, key: str, quantity: Described, shown: tuple[tuple[ForestRow, ...], str, str]
) -> Drawing:
    rows, caption, beside = shown
    warning = warn_of_simulation(material)
    return draw_forest(
        Forest(
            key,
            quantity.title,
            caption,
            quantity,
            rows,
            series=quantity.title.lower(),
            beside=beside,
            beside_shape="tick",
            warning=warning,
        )
    )


def _list_rows(material: Material, quantity: Described, beside: Described | None) -> tuple[ForestRow, ...]:
    benchmark = material.reference.benchmark
    scopes = [(OVERALL, "Overall", 0)]
    for property_ in benchmark.properties:
        members = benchmark.scenarios_of(property_.name)
        scopes += [(property_.name, property_.name, 1)]
        scopes += [(s.id, s.title, 2) for s in members if len(members) > 1 and beside is None]
    return tuple(
        ForestRow(
            title,
            level,
            material.people_score(quantity.name, scope, "all"),
            material.people_score(beside.name, scope, "all") if beside else None,
            absent=NOT_COMPUTED,
            is_people=True,
        )
        for scope, title, level in scopes
    )


def _draw_spread(material: Material, people: People) -> Drawing:
    reference, grading = material.reference, material.reference.benchmark.grading
    right = right_counts(people.n, people.n_yes, reference.labels)
    easy, hard = grading.easy_above, grading.hard_below
    n_easy, n_hard = int(is_above(right, people.n, easy).sum()), int(is_below(right, people.n, hard).sum())
    rated = people.n > 0
    above = f"{count_of(n_easy, 'trial')} above {grading.easy}"
    below = f"{count_of(n_hard, 'trial')} below {grading.hard}"
    statement = f"{above} and {below}, of {int(rated.sum()):,} judged."
    return draw_distribution(
        Distribution(
            key="people-spread",
            title="Accuracy of people, trial by trial",
            caption=f"{SPREAD} {statement}",
            axis="people who were right",
            values=_count_values(right[rated] / people.n[rated]),
            thresholds=(
                Threshold(float(hard), f"below {grading.hard}: {n_hard:,}", n_hard, -1),
                Threshold(float(easy), f"above {grading.easy}: {n_easy:,}", int(rated.sum()) - n_easy, 1),
            ),
            statement=statement,
            warning=warn_of_simulation(material),
        )
    )


def _count_values(shares: Floats) -> tuple[tuple[float, int], ...]:
    """Count the trials with each share, ascending."""
    values, counts = np.unique(shares, return_counts=True)
    return tuple(zip(values.tolist(), counts.tolist(), strict=True))
