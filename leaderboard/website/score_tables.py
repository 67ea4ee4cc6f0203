"""Tables of all scores of a submission, subset by subset, with people's beside them."""

from collections.abc import Sequence
from dataclasses import dataclass

from leaderboard.grading import METRICS, SUBSETS
from leaderboard.grading.observations import NOT_A_PROPERTY
from leaderboard.models import Benchmark, Score
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Entry
from leaderboard.website.describing import SUBSET_TITLES, describe_subset, is_crossfit, title_scopes
from leaderboard.website.material import Material
from leaderboard.website.numbers import Footnotes, unit_of
from leaderboard.website.pages import Column, Fact, ScopeRow, ScoreTable
from leaderboard.website.quantities import Described, find_quantity

NOT_GRADED = "not all of its scenarios are covered"
CEILING = find_quantity("ceiling")


def compose_score_tables(entry: Entry, material: Material) -> tuple[ScoreTable, ...]:
    """Tabulate every subset of which something was graded."""
    benchmark = material.reference.benchmark
    subsets = [subset for subset in SUBSETS if list_scopes(entry, benchmark, subset)]
    return tuple(_compose_table(entry, material, subset) for subset in subsets)


def list_scopes(entry: Entry, benchmark: Benchmark, subset: str) -> list[tuple[str, str, int]]:
    """List what was graded, each scope with its title and level."""
    graded = {scope for scope, subsets in entry.result.scores.items() if subset in subsets}
    return title_scopes(graded, benchmark)


@dataclass(frozen=True)
class _ScoreColumn:
    """A metric of the submission, or a figure of people beside it."""

    quantity: Described
    is_people: bool

    @property
    def absent(self) -> str:
        """Why there may be nothing: people's ceiling is one of whole properties."""
        return f"undefined: {NOT_A_PROPERTY.why}" if self.quantity is CEILING else NOT_GRADED

    def score(self, entry: Entry, material: Material, scope: str, subset: str) -> Score | None:
        look_up = material.people_score if self.is_people else entry.score
        return look_up(self.quantity.name, scope, subset)

    def describe(self) -> Column:
        quantity, unit = self.quantity, unit_of(self.quantity)
        if self.quantity is CEILING:
            return Column("Ceiling", "of people", quantity.name, quantity.meaning, is_people=True)
        if self.is_people:
            return Column("People", unit, quantity.name, f"{quantity.title} of people", is_people=True)
        return Column(quantity.title, unit, quantity.name, quantity.meaning, quantity.direction)


def _compose_table(entry: Entry, material: Material, subset: str) -> ScoreTable:
    """Tabulate every metric on one subset of every scope, people's beside them where they have any."""
    scopes = list_scopes(entry, material.reference.benchmark, subset)
    columns, omitted = _sort_out(_all_columns(entry, material, subset), entry, material, subset)
    footnotes, rows = Footnotes(), []
    n_counts = None if material.has_pairs else 1
    for scope, title, level in scopes:
        cells = tuple(
            footnotes.cell(
                column.quantity, column.score(entry, material, scope, subset), absent=column.absent
            )
            for column in columns
        )
        rows.append(ScopeRow(title, level, _list_counts(entry, scope, subset)[:n_counts], cells))
    return ScoreTable(
        key=subset,
        title=f"{SUBSET_TITLES[subset]}{'' if is_crossfit(subset) else ' trials'}",
        caption=describe_subset(subset, material),
        row_title="Scope",
        count_titles=_count_titles(subset)[:n_counts],
        columns=tuple(column.describe() for column in columns),
        rows=tuple(rows),
        footnotes=footnotes.texts,
        omitted=omitted,
    )


def _all_columns(entry: Entry, material: Material, subset: str) -> list[_ScoreColumn]:
    """List the metrics that are computed on a subset, each followed by people's or by their ceiling."""
    graded = {
        m for subsets in entry.result.scores.values() if subset in subsets for m in subsets[subset].metrics
    }
    people = material.people.get(OVERALL, {}).get(subset)
    of_people = people.metrics if people else {}
    columns = []
    for metric in (metric for metric in METRICS if metric.name in graded):
        columns.append(_ScoreColumn(metric, is_people=False))
        beside: Described = CEILING if metric.name == "human_r" else metric
        if beside.name in of_people:
            columns.append(_ScoreColumn(beside, is_people=True))
    return columns


def _sort_out(
    columns: Sequence[_ScoreColumn], entry: Entry, material: Material, subset: str
) -> tuple[list[_ScoreColumn], tuple[Fact, ...]]:
    """Take out the columns without any value and for one reason, and name them by reason."""
    kept: list[_ScoreColumn] = []
    omitted: dict[str, list[str]] = {}
    scopes = list_scopes(entry, material.reference.benchmark, subset)
    for column in columns:
        scores = [column.score(entry, material, scope, subset) for scope, _, _ in scopes]
        reasons = {score.why for score in scores if score}
        if len(reasons) == 1 and (why := reasons.pop()):
            omitted.setdefault(why, []).append(column.quantity.title)
        else:
            kept.append(column)
    return kept, tuple(Fact("; ".join(titles), f"undefined: {why}") for why, titles in omitted.items())


def _count_titles(subset: str) -> tuple[str, ...]:
    if subset == "all":
        return ("Trials", "Pairs")
    other = "hard" if subset.startswith("easy") else "easy"
    titles = ("Trials", "Pairs", f"also {other}")
    return tuple(f"{title}, on average" for title in titles) if is_crossfit(subset) else titles


def _list_counts(entry: Entry, scope: str, subset: str) -> tuple[str, ...]:
    scores = entry.result.scores.get(scope, {}).get(subset)
    if scores is None:
        return ("",) * len(_count_titles(subset))
    counts = (scores.n, scores.n_pairs, scores.n_pairs_in_both)
    return tuple(f"{count:,.0f}" for count in counts if count is not None)
