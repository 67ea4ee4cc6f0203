"""The figure of the paper: accuracy and human r on all, easy and hard trials, by system and property."""

from collections.abc import Iterator
from dataclasses import replace

from leaderboard.grading import find_metric
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Board, Entry
from leaderboard.website.boards import NOT_COVERED, NOT_FOR_PEOPLE, link_tracks
from leaderboard.website.describing import SUBSET_TITLES, count_of, figure_path, warn_of_simulation
from leaderboard.website.figure_pages import FigurePage
from leaderboard.website.figures.forest import Forest, ForestRow, draw_forest, span
from leaderboard.website.figures.marks import Drawing
from leaderboard.website.forests import list_bands
from leaderboard.website.material import Material
from leaderboard.website.quantities import find_quantity

MAX_SYSTEMS = 10
SUBSETS = ("all", "easy", "hard")
NUMERALS = ("I", "II", "III", "IV", "V", "VI")
SPLIT_HALF = find_quantity("split_half_r")


def compose_figure(board: Board, material: Material) -> FigurePage:
    """Gather what the page of the paper's figure shows, for one track."""
    return FigurePage(
        path=figure_path(board),
        title="People and models",
        summary=_describe(board, material),
        tracks=link_tracks(material, board, figure_path),
        panels=_draw_panels(board, material),
    )


def _describe(board: Board, material: Material) -> str:
    n_ranked = len(board.ranked)
    shown = f"the first {MAX_SYSTEMS} of {n_ranked} ranked submissions"
    if n_ranked <= MAX_SYSTEMS:
        shown = count_of(n_ranked, "ranked submission") if n_ranked else "no ranked submissions"
    people = "people and " if material.people else ""
    return f"{board.track.title}: {people}{shown}, overall and by property, with 95 % intervals."


def _draw_panels(board: Board, material: Material) -> tuple[Drawing, ...]:
    """Draw three panels of accuracy above three of human r; those of one metric share their axis."""
    entries = [row.entry for row in board.ranked[:MAX_SYSTEMS]]
    metrics, subsets = (("accuracy", "human_r"), SUBSETS) if material.people else (("accuracy",), ("all",))
    numerals, panels = iter(NUMERALS), []
    for metric in metrics:
        forests = [_compose_panel(entries, material, metric, subset) for subset in subsets]
        scale = span(*forests)
        for forest in forests:
            title = f"{next(numerals)} {forest.title}"
            panels.append(draw_forest(replace(forest, title=title, scale=scale)))
    return tuple(panels)


def _compose_panel(entries: list[Entry], material: Material, metric: str, subset: str) -> Forest:
    rows = [*_list_people(material, metric, subset)]
    for entry in entries:
        for scope, title, level in _list_scopes(material, entry.metadata.submission.name):
            rows.append(ForestRow(title, level, entry.score(metric, scope, subset), absent=NOT_COVERED))
    count = material.count(OVERALL, subset)
    n_trials = count.n_rated if metric == "human_r" else count.n
    return Forest(
        key=f"panel-{metric}-{subset}".replace("_", "-"),
        title=f"{find_metric(metric).title}, {SUBSET_TITLES[subset].lower()}",
        caption=f"{count_of(n_trials, 'trial')}.",
        quantity=find_metric(metric),
        rows=tuple(rows),
        bands=list_bands(material, metric, subset),
        warning=warn_of_simulation(material),
    )


def _list_scopes(material: Material, title: str) -> list[tuple[str, str, int]]:
    names = [property_.name for property_ in material.reference.benchmark.properties]
    return [(OVERALL, title, 0), *((name, name, 2) for name in names)]


def _list_people(material: Material, metric: str, subset: str) -> Iterator[ForestRow]:
    """List people's own scores: accuracy, and how well two halves of them agree."""
    if not material.people:
        return
    name, title = (SPLIT_HALF.name, "People, split-half") if metric == "human_r" else (metric, "People")
    for scope, row_title, level in _list_scopes(material, title):
        score = material.people_score(name, scope, subset)
        yield ForestRow(row_title, level, score, absent=NOT_FOR_PEOPLE, is_people=True)
