"""The pages of properties and scenarios: the same scores as on the boards, for one of them alone."""

from collections.abc import Iterator, Sequence

from leaderboard.grading import find_metric, subset_masks
from leaderboard.models import Property
from leaderboard.models.benchmark import Scenario
from leaderboard.models.result import SubsetScores
from leaderboard.website.describing import (
    SUBSET_TITLES,
    count_of,
    describe_subset,
    is_crossfit,
    list_subsets,
    property_path,
    scenario_path,
)
from leaderboard.website.figures.marks import Drawing
from leaderboard.website.forests import draw_part
from leaderboard.website.material import Count, Material
from leaderboard.website.numbers import show_interval, show_number, show_percent
from leaderboard.website.pages import Fact, Link
from leaderboard.website.property_pages import PropertyPage
from leaderboard.website.scope_tables import CEILING, ScopeColumn, Scoped, compose_scope_table
from leaderboard.website.trial_paths import list_path, scenario_anchor

OF_PEOPLE = ("human_r", "human_r_normalized")
OF_PAIRS = ("pair_accuracy", "pair_order")
OF_PROBABILITIES = ("auc", "brier", "yes_rate")
WHOLE_ONLY = (
    "Scores on easy and hard trials, and the ceiling of human r: one scenario has too few trials for them, "
    "so they stand with the whole property."
)


def compose_properties(material: Material) -> Iterator[PropertyPage]:
    """Gather the pages of all properties, each followed by those of its scenarios."""
    for property_ in material.reference.benchmark.properties:
        yield _compose_property(property_, material)
        scenarios = material.reference.benchmark.scenarios_of(property_.name)
        if len(scenarios) > 1:
            yield from (_compose_scenario(scenario, property_, material) for scenario in scenarios)


def _compose_property(property_: Property, material: Material) -> PropertyPage:
    benchmark = material.reference.benchmark
    scenarios, count = benchmark.scenarios_of(property_.name), material.count(property_.name)
    scoped = Scoped(property_.name, "property", _choose_columns(property_, material))
    return PropertyPage(
        path=property_path(property_.name),
        title=property_.name,
        summary=f"{_say_count(count)}, from {count_of(len(scenarios), 'scenario')}.",
        whole=None,
        siblings_title="Properties",
        siblings=tuple(
            Link(p.name, property_path(p.name), is_current=p is property_) for p in benchmark.properties
        ),
        parts=tuple(_link_parts(scenarios, material)),
        drawings=_draw_parts(property_.name, material),
        tables=tuple(compose_scope_table(scoped, board, material) for board in material.boards),
        facts=tuple(_list_facts(property_, material)),
        trials=Link(f"All {_say_count(count)}", list_path(property_.name)),
    )


def _compose_scenario(scenario: Scenario, property_: Property, material: Material) -> PropertyPage:
    count, name = material.count(scenario.id), property_.name
    scoped = Scoped(scenario.id, "scenario", _choose_scenario_columns(scenario, material))
    siblings = material.reference.benchmark.scenarios_of(name)
    return PropertyPage(
        path=scenario_path(name, scenario.id),
        title=scenario.title,
        summary=f"{_say_count(count)} of {name}, released as {scenario.id}.",
        whole=Link(name, property_path(name)),
        siblings_title=f"Scenarios of {name}",
        siblings=tuple(Link(s.title, scenario_path(name, s.id), is_current=s is scenario) for s in siblings),
        parts=(),
        drawings=_draw_parts(scenario.id, material),
        tables=tuple(compose_scope_table(scoped, board, material) for board in material.boards),
        facts=tuple(_list_scenario_facts(scenario, material)),
        trials=Link(f"All {_say_count(count)}", f"{list_path(name)}#{scenario_anchor(scenario.id)}"),
    )


def _draw_parts(scope: str, material: Material) -> tuple[Drawing, ...]:
    return tuple(draw_part(scope, board, material) for board in material.boards if board.ranked)


def _say_count(count: Count) -> str:
    in_pairs = f" in {count_of(count.n_pairs, 'pair')}" if count.n_pairs else ""
    return f"{count_of(count.n, 'trial')}{in_pairs}"


def _link_parts(scenarios: Sequence[Scenario], material: Material) -> Iterator[Link]:
    """Link the scenarios of a property that has more than one; the only one is the property itself."""
    for scenario in scenarios if len(scenarios) > 1 else ():
        path = scenario_path(scenario.property, scenario.id)
        yield Link(scenario.title, path, count_of(material.count(scenario.id).n, "trial"))


def _list_facts(property_: Property, material: Material) -> Iterator[Fact]:
    """Say what the property consists of, which trials are easy and hard, and how well people agree."""
    for scenario in material.reference.benchmark.scenarios_of(property_.name):
        yield Fact(scenario.title, f"{count_of(material.count(scenario.id).n, 'trial')} ({scenario.id}).")
    people = material.people.get(property_.name, {})
    for subset in (subset for subset in list_subsets(material) if subset in people and subset != "all"):
        yield Fact(
            SUBSET_TITLES[subset], f"{describe_subset(subset, material)} {_say_size(people[subset], subset)}"
        )
    ceiling = material.people_score(CEILING.name, property_.name, "all")
    if ceiling is not None and ceiling.value is not None:
        text = f"{show_number(ceiling.value)}, 95 % interval {show_interval(CEILING, ceiling)}"
        yield Fact(CEILING.title, f"{text}. {CEILING.meaning}")


def _say_size(scores: SubsetScores, subset: str) -> str:
    """Say how large a subset is, and how much of it is in the opposite one as well."""
    if not scores.n:
        return "There are none."
    accuracy = scores.metrics.get("accuracy")
    numbers = f"{scores.n:,.0f} trials" + (f" in {scores.n_pairs:,.0f} pairs" if scores.n_pairs else "")
    words = [f"{numbers} on average" if is_crossfit(subset) else numbers]
    if scores.n_pairs_in_both is not None:
        other = "hard" if subset.startswith("easy") else "easy"
        words.append(f"{scores.n_pairs_in_both:,.0f} of these pairs are {other} as well")
    if accuracy is not None and accuracy.value is not None:
        words.append(f"people are right on {show_percent(accuracy.value)} %")
    return f"{'; '.join(words)}."


def _list_scenario_facts(scenario: Scenario, material: Material) -> Iterator[Fact]:
    """Say how many of the trials are easy, hard or both, and what is known of whole properties only."""
    if not material.people:
        return
    inside, masks = material.reference.in_scenario(scenario.id), subset_masks(material.reference)
    for subset in ("easy", "hard"):
        size = f"{_say_count(material.count(scenario.id, subset))}."
        yield Fact(SUBSET_TITLES[subset], f"{describe_subset(subset, material)} {size}")
    n_both = int((inside & masks["easy"] & masks["hard"]).sum())
    yield Fact("Easy and hard", f"{count_of(n_both, 'trial')}, because of the two trials of a pair.")
    yield Fact("Not by scenario", WHOLE_ONLY)


def _choose_columns(property_: Property, material: Material) -> tuple[ScopeColumn, ...]:
    accuracy, name = find_metric("accuracy"), property_.name
    scenarios = material.reference.benchmark.scenarios_of(name)
    columns = [ScopeColumn(accuracy.title, accuracy, name)]
    columns += [ScopeColumn(s.title, accuracy, s.id) for s in scenarios if len(scenarios) > 1]
    subsets = [subset for subset in list_subsets(material) if subset != "all"]
    columns += [ScopeColumn(SUBSET_TITLES[subset], accuracy, name, subset) for subset in subsets]
    metrics = (*(OF_PEOPLE if material.people else ()), *(OF_PAIRS if material.has_pairs else ()))
    return (*columns, *(ScopeColumn(find_metric(m).title, find_metric(m), name) for m in metrics))


def _choose_scenario_columns(scenario: Scenario, material: Material) -> tuple[ScopeColumn, ...]:
    """Choose what is graded on scenarios: everything but what needs people's reliability or subsets."""
    metrics = ["accuracy", "accuracy_p"]
    metrics += ["human_r", "error_consistency"] if material.people else []
    metrics += [*(OF_PAIRS if material.has_pairs else ()), *OF_PROBABILITIES]
    return tuple(ScopeColumn(find_metric(m).title, find_metric(m), scenario.id) for m in metrics)
