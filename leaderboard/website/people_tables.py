"""The table of people: how often they are right, and how well they agree with each other."""

from dataclasses import dataclass

from leaderboard.grading import find_metric
from leaderboard.models.benchmark import OVERALL
from leaderboard.website.describing import SUBSET_TITLES, describe_people, list_subsets
from leaderboard.website.material import Material
from leaderboard.website.numbers import Footnotes, unit_of
from leaderboard.website.pages import Column, ScopeRow, ScoreTable
from leaderboard.website.quantities import OF_PEOPLE, Described

NOT_COMPUTED = "not computed here"


@dataclass(frozen=True)
class _Figure:
    """A figure of people on one subset."""

    quantity: Described
    subset: str
    title: str

    def describe(self) -> Column:
        return Column(self.title, unit_of(self.quantity), self.quantity.name, self.quantity.meaning)


def compose_people_table(material: Material) -> ScoreTable | None:
    """Tabulate every figure of people on overall and the properties; nothing without human data."""
    if not material.people:
        return None
    figures, footnotes = _choose_figures(material), Footnotes()
    names = [property_.name for property_ in material.reference.benchmark.properties]
    rows = []
    for scope in (OVERALL, *names):
        cells = tuple(
            footnotes.cell(
                figure.quantity,
                material.people_score(figure.quantity.name, scope, figure.subset),
                absent=NOT_COMPUTED,
            )
            for figure in figures
        )
        count = f"{material.count(scope).n_rated:,}"
        rows.append(ScopeRow(scope.title() if scope == OVERALL else scope, scope != OVERALL, (count,), cells))
    return ScoreTable(
        key="people",
        title="How often they are right, and how well they agree",
        caption=describe_people(material),
        row_title="Scope",
        count_titles=("Rated trials",),
        columns=tuple(figure.describe() for figure in figures),
        rows=tuple(rows),
        footnotes=footnotes.texts,
    )


def _choose_figures(material: Material) -> list[_Figure]:
    accuracy, yes_rate = find_metric("accuracy"), find_metric("yes_rate")
    titles = {subset: SUBSET_TITLES[subset] for subset in list_subsets(material)} | {"all": accuracy.title}
    figures = [_Figure(accuracy, subset, title) for subset, title in titles.items()]
    figures.append(_Figure(yes_rate, "all", yes_rate.title))
    there = material.people[OVERALL]["all"].metrics
    return figures + [_Figure(q, "all", q.title) for q in OF_PEOPLE if q.name in there]
