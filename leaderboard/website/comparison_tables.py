"""The pages that compare two submissions, with the numbers of ``leaderboard compare``, and their list."""

from collections.abc import Callable, Iterator, Sequence

from leaderboard.comparing import Comparison, Overlap, ScopeComparison, TrialDifference
from leaderboard.grading import find_metric
from leaderboard.metrics.resampling import Interval
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.models import Score
from leaderboard.ranking import Board
from leaderboard.website.comparison_data import render_contenders, render_ground
from leaderboard.website.comparison_figures import draw_differences
from leaderboard.website.comparison_pages import Choice, ComparisonPage, ComparisonsPage, Side, TrialLine
from leaderboard.website.describing import board_path, count_of, submission_path, title_scopes
from leaderboard.website.figures.marks import Drawing
from leaderboard.website.material import Material
from leaderboard.website.neighbours import N_TOP
from leaderboard.website.numbers import (
    ABSENT,
    MINUS,
    Footnotes,
    name_p,
    show_exactly,
    show_interval,
    show_number,
    show_points,
    unit_of,
)
from leaderboard.website.pages import Cell, Column, Fact, Link, ScopeRow, ScoreTable
from leaderboard.website.quantities import Described, find_quantity
from leaderboard.website.trial_paths import trial_path

COMPARISONS_PATH = "compare/index.html"
DECIMALS = 6
LEVEL = 0.05
ALWAYS_THERE = "not compared"
COUNT_TITLES = (
    "Trials",
    "Both right",
    "Only A",
    "Only B",
    "Neither",
    "Pairs",
    "A better",
    "B better",
    "Equal",
)

_Measure = Callable[[ScopeComparison], Score]


def pair_key(a: str, b: str) -> str:
    """Name two submissions as the folder of their comparison is named."""
    return f"{a}--vs--{b}"


def comparison_path(a: str, b: str) -> str:
    """Say where the comparison of two submissions is."""
    return f"compare/{pair_key(a, b)}/index.html"


def link_comparisons(slug: str, material: Material) -> tuple[Link, ...]:
    """Link the comparisons of a submission, each by the other's name, and the page to compare it with any."""
    found = [comparison for comparison in material.comparisons if slug in (comparison.a, comparison.b)]
    names = _name_submissions(material) if found else {}
    links = [Link(names[c.b if c.a == slug else c.a], comparison_path(c.a, c.b)) for c in found]
    has_others = len(material.publications) > 1
    return (*links, Link("any others", f"{COMPARISONS_PATH}?of={slug}")) if has_others else ()


def compose_comparisons(material: Material) -> ComparisonsPage:
    """Gather the page that compares any submissions, and lists the ready-made comparisons."""
    by_board = ((board, list_comparisons(board, material)) for board in material.boards)
    return ComparisonsPage(
        path=COMPARISONS_PATH,
        title="Comparisons",
        summary=(
            "What tells submissions apart, on the same trials and with the same resamples. Each of the first "
            f"{N_TOP} of a board has a page beside the next one, and beside the best."
        ),
        tables=tuple(_list_board(board, found, material) for board, found in by_board if found),
        choices=tuple(
            Choice(slug, name, file)
            for (slug, name), file in zip(
                _name_submissions(material).items(), render_contenders(material), strict=True
            )
        ),
        ground=render_ground(material.reference),
    )


def compose_comparison_pages(material: Material) -> Iterator[ComparisonPage]:
    """Gather the pages of all comparisons, board by board."""
    for board in material.boards:
        for comparison in list_comparisons(board, material):
            yield _compose_page(comparison, board, material)


def list_comparisons(board: Board, material: Material) -> list[Comparison]:
    """List the comparisons of a board's submissions."""
    slugs = {row.entry.slug for row in board.ranked}
    return [comparison for comparison in material.comparisons if comparison.a in slugs]


def _name_submissions(material: Material) -> dict[str, str]:
    return {p.entry.slug: p.entry.metadata.submission.name for p in material.publications}


def _list_board(board: Board, comparisons: Sequence[Comparison], material: Material) -> ScoreTable:
    names, columns, footnotes = _name_submissions(material), _choose_columns(material)[2:], Footnotes()
    rows = [
        ScopeRow(
            f"{names[c.a]} and {names[c.b]}",
            1,
            (),
            _print_scope(c.scopes[0], columns, footnotes),
            comparison_path(c.a, c.b),
        )
        for c in comparisons
    ]
    return ScoreTable(
        key=board.track.id,
        title=board.track.title,
        caption="Overall; A is named first and is the better by accuracy.",
        row_title="A and B",
        count_titles=(),
        columns=tuple(column for column, _, _ in columns),
        rows=tuple(rows),
        footnotes=footnotes.texts,
    )


def _compose_page(comparison: Comparison, board: Board, material: Material) -> ComparisonPage:
    names = _name_submissions(material)
    a, b = names[comparison.a], names[comparison.b]
    overall = comparison.scopes[0]
    return ComparisonPage(
        path=comparison_path(comparison.a, comparison.b),
        title=f"{a} and {b}",
        summary=f"Compared in pairs, on {count_of(overall.n, 'trial')}, with the same resamples for both.",
        board=Link(board.track.title, board_path(board)),
        sides=tuple(_describe_sides(comparison, board)),
        verdict=_judge(overall),
        drawings=tuple(_draw_all(comparison, material)),
        tables=(_tabulate_scores(comparison, material), _tabulate_overlap(comparison, material)),
        trials=tuple(_show_trial(trial, material) for trial in comparison.trials),
        has_people=material.reference.people is not None,
        notes=tuple(_list_notes(comparison)),
    )


def _draw_all(comparison: Comparison, material: Material) -> Iterator[Drawing]:
    scopes = list(_list_scopes(comparison, material))
    rows = [(title, level, _score_interval(scope.difference)) for scope, title, level in scopes]
    yield draw_differences("accuracy_difference", rows, material)
    if material.people:
        rows = [(title, level, _score_interval(scope.human_r_difference)) for scope, title, level in scopes]
        yield draw_differences("human_r_difference", rows, material)


def _describe_sides(comparison: Comparison, board: Board) -> Iterator[Side]:
    rows = {row.entry.slug: row for row in board.ranked}
    for letter, slug in (("A", comparison.a), ("B", comparison.b)):
        about = rows[slug].entry.metadata.submission
        place = f"rank {rows[slug].rank} of {len(board.ranked)}, {about.team}"
        yield Side(letter, Link(about.name, submission_path(slug), place))


def _judge(overall: ScopeComparison) -> str:
    """Say in a sentence what the difference overall is and how sure that is."""
    difference = _score_interval(overall.difference)
    interval = show_interval(find_quantity("accuracy_difference"), difference)
    points = show_points(overall.difference.value)
    sure = "tells" if overall.p < LEVEL else "does not tell"
    return (
        f"Overall, the accuracy of A minus that of B is {points} points: 95 % interval {interval}, "
        f"exact {name_p(overall.p)}. On its own, such a test {sure} the two apart at 5 %."
    )


def _choose_columns(material: Material) -> list[tuple[Column, Described, _Measure]]:
    """List the columns of scores, each with what it prints: accuracy, its difference, agreement."""
    accuracy = find_metric("accuracy")
    columns: list[tuple[Column, Described, _Measure]] = [
        (_title("Accuracy of A", accuracy), accuracy, lambda scope: _score(scope.accuracy_a)),
        (_title("Accuracy of B", accuracy), accuracy, lambda scope: _score(scope.accuracy_b)),
    ]
    found: list[tuple[str, str, _Measure]] = [
        (f"Accuracy, A {MINUS} B", "accuracy_difference", lambda s: _score_interval(s.difference)),
        ("Exact p", "paired_p", lambda scope: Score(value=scope.p)),
        (f"Human r, A {MINUS} B", "human_r_difference", lambda s: _score_interval(s.human_r_difference)),
        ("Kappa of A and B", "rival_kappa", lambda scope: _score(scope.kappa)),
    ]
    for title, name, measure in found:
        if material.people or name != "human_r_difference":
            quantity = find_quantity(name)
            columns.append((_title(title, quantity), quantity, measure))
    return columns


def _title(title: str, quantity: Described) -> Column:
    return Column(title, unit_of(quantity), quantity.name, quantity.meaning)


def _score(estimate: Estimate) -> Score:
    """Round as the command does."""
    if isinstance(estimate, Undefined):
        return Score(value=None, why=estimate.why)
    return Score(value=round(estimate, DECIMALS) + 0.0)


def _score_interval(interval: Interval | Undefined) -> Score:
    if isinstance(interval, Undefined):
        return Score(value=None, why=interval.why)
    value, low, high = (round(end, DECIMALS) + 0.0 for end in (interval.value, interval.low, interval.high))
    return Score(value=value, low=low, high=high, undefined_resamples=interval.n_undefined or None)


def _print_scope(
    scope: ScopeComparison, columns: Sequence[tuple[Column, Described, _Measure]], footnotes: Footnotes
) -> tuple[Cell, ...]:
    return tuple(
        footnotes.cell(quantity, measure(scope), absent=ALWAYS_THERE) for _, quantity, measure in columns
    )


def _list_scopes(comparison: Comparison, material: Material) -> Iterator[tuple[ScopeComparison, str, int]]:
    """Yield each scope that was compared with its title and level."""
    compared = {scope.name: scope for scope in comparison.scopes}
    for name, title, level in title_scopes(compared, material.reference.benchmark):
        if name in compared:
            yield compared[name], title, level


def _tabulate_scores(comparison: Comparison, material: Material) -> ScoreTable:
    columns, footnotes = _choose_columns(material), Footnotes()
    rows = [
        ScopeRow(title, level, (), _print_scope(scope, columns, footnotes))
        for scope, title, level in _list_scopes(comparison, material)
    ]
    return ScoreTable(
        key="scores",
        title="Scores",
        caption="Below each difference stands its 95 % interval; above 0, A is better.",
        row_title="Scope",
        count_titles=(),
        columns=tuple(column for column, _, _ in columns),
        rows=tuple(rows),
        footnotes=footnotes.texts,
    )


def _tabulate_overlap(comparison: Comparison, material: Material) -> ScoreTable:
    rows = [
        ScopeRow(title, level, _count(scope, scope.overlap), ())
        for scope, title, level in _list_scopes(comparison, material)
    ]
    return ScoreTable(
        key="overlap",
        title="Who is right where",
        caption="Trials by who earns full credit, and pairs by who earns more credit.",
        row_title="Scope",
        count_titles=COUNT_TITLES,
        columns=(),
        rows=tuple(rows),
        footnotes=(),
    )


def _count(scope: ScopeComparison, overlap: Overlap) -> tuple[str, ...]:
    trials = (overlap.n_both_right, overlap.n_only_a, overlap.n_only_b, overlap.n_neither)
    pairs = (overlap.n_pairs_a, overlap.n_pairs_b, overlap.n_pairs_equal)
    return tuple(f"{count:,}" for count in (scope.n, *trials, scope.n_pairs, *pairs))


def _show_trial(trial: TrialDifference, material: Material) -> TrialLine:
    values = [trial.probability_a, trial.probability_b]
    shown = [(show_number(value), show_exactly(value)) for value in values]
    if material.reference.people is not None:
        mean = trial.human_mean
        shown.append((ABSENT, "") if mean is None else (show_number(mean), show_exactly(mean)))
    link = Link(trial.trial_id, trial_path(trial.trial_id))
    return TrialLine(link, "YES" if trial.label else "NO", tuple(shown))


def _list_notes(comparison: Comparison) -> Iterator[Fact]:
    if comparison.property_gain:
        gain = comparison.property_gain.replace("-", f" {MINUS} ")
        yield Fact("Property gain", f"{gain} is that of one system, with and without property inference.")
    resamples = count_of(comparison.resamples, "resample")
    yield Fact("Interval", f"Percentile bootstrap, {resamples}, seed {comparison.seed}, the same for both.")
    yield Fact("Many pairs", "No p is corrected for the number of comparisons; the board's rank sets are.")
    yield Fact("Compare again", f"leaderboard compare {comparison.a} {comparison.b}", is_code=True)
