"""The forest plots of a board and of a submission."""

from leaderboard.grading import find_metric
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Board, Entry
from leaderboard.website.describing import warn_of_simulation
from leaderboard.website.figures.forest import Band, Forest, ForestRow, draw_forest
from leaderboard.website.figures.marks import Drawing
from leaderboard.website.material import Material
from leaderboard.website.quantities import Described, find_quantity
from leaderboard.website.score_tables import NOT_GRADED, list_scopes

CEILING = find_quantity("ceiling")
PLOTTED = ("accuracy", "human_r")
DRAWN = 60
"""Rows of a board that its figures draw: more cannot be read in one, and all are in the table."""

SCOPES = "Overall, by property and by scenario, with 95 % intervals."


def draw_board(board: Board, material: Material) -> tuple[Drawing, ...]:
    """Draw accuracy of the ranked submissions, and human r where there are people; nothing without any."""
    if not board.ranked:
        return ()
    return tuple(_draw_overall(board, material, metric, DRAWN) for metric in _choose_metrics(material))


def draw_top(board: Board, material: Material, n: int) -> Drawing | None:
    """Draw accuracy of the first n ranked submissions; nothing without any."""
    return _draw_overall(board, material, PLOTTED[0], n) if board.ranked else None


def draw_scopes(entry: Entry, material: Material) -> tuple[Drawing, ...]:
    """Draw accuracy and human r of a submission by scope, people or their ceiling beside them."""
    return tuple(_draw_scopes(entry, material, metric) for metric in _choose_metrics(material))


def draw_part(scope: str, board: Board, material: Material) -> Drawing:
    """Draw the accuracy of a board's ranked submissions on one property or scenario, in the board's order."""
    metric = find_metric("accuracy")
    people = material.people_score(metric.name, scope, "all")
    rows = (
        ForestRow(row.entry.metadata.submission.name, 1, row.entry.score(metric.name, scope))
        for row in board.ranked[:DRAWN]
    )
    return draw_forest(
        Forest(
            key=f"forest-{board.track.id}",
            title=f"{metric.title}: {board.track.title}",
            caption=f"{_name_drawn(board, DRAWN)} in the order of their board, with 95 % intervals.",
            quantity=metric,
            rows=tuple(rows),
            bands=(Band("people", people),) if people and people.value is not None else (),
            warning=warn_of_simulation(material),
        )
    )


def beside_of(metric: str) -> tuple[str, Described]:
    """Name what of people stands beside a metric: the ceiling of human r, else their own score."""
    return ("ceiling", CEILING) if metric == "human_r" else ("people", find_metric(metric))


def list_bands(material: Material, metric: str, subset: str = "all") -> tuple[Band, ...]:
    """Gather what people reach overall, or how high their noise lets human r be; nothing if unknown."""
    title, quantity = beside_of(metric)
    score = material.people_score(quantity.name, OVERALL, subset)
    return (Band(title, score),) if score and score.value is not None else ()


def _choose_metrics(material: Material) -> tuple[str, ...]:
    return PLOTTED if material.people else PLOTTED[:1]


def _name_drawn(board: Board, n: int) -> str:
    n_ranked = len(board.ranked)
    return "Ranked submissions" if n_ranked <= n else f"The first {n} of {n_ranked:,} ranked submissions"


def _draw_overall(board: Board, material: Material, metric: str, n: int) -> Drawing:
    entries = [row.entry for row in board.ranked[:n]]
    return draw_forest(
        Forest(
            key=f"forest-{metric}".replace("_", "-"),
            title=find_metric(metric).title,
            caption=f"{_name_drawn(board, n)}, overall, with 95 % intervals.",
            quantity=find_metric(metric),
            rows=tuple(ForestRow(e.metadata.submission.name, 1, e.score(metric)) for e in entries),
            bands=list_bands(material, metric),
            warning=warn_of_simulation(material),
        )
    )


def _draw_scopes(entry: Entry, material: Material, metric: str) -> Drawing:
    beside, quantity = beside_of(metric)
    rows = tuple(
        ForestRow(
            title,
            level,
            entry.score(metric, scope),
            material.people_score(quantity.name, scope, "all"),
            absent=NOT_GRADED,
        )
        for scope, title, level in list_scopes(entry, material.reference.benchmark, "all")
    )
    has_people = any(row.beside and row.beside.value is not None for row in rows)
    return draw_forest(
        Forest(
            key=f"forest-{metric}".replace("_", "-"),
            title=find_metric(metric).title,
            caption=SCOPES,
            quantity=find_metric(metric),
            rows=rows,
            series="this submission",
            beside=beside if has_people else "",
            beside_shape="tick" if quantity is CEILING else "small diamond",
            warning=warn_of_simulation(material),
        )
    )
