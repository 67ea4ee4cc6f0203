"""One submission's result for a terminal: accuracy beside people's, agreement, pairs and probabilities."""

from collections.abc import Callable, Iterator, Mapping

from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from leaderboard.grading import Scores
from leaderboard.grading.scopes import CROSSFIT_SUBSETS
from leaderboard.models import Metadata, Result, Score
from leaderboard.models.benchmark import OVERALL
from leaderboard.reference import Reference
from leaderboard.report.terminal import (
    ABSENT,
    Terminal,
    format_interval,
    format_number,
    format_p,
    format_percent,
    new_table,
    reference_banner,
    render_tables,
)

LARGE_GAP = 0.05
ALPHA = 0.05
PAPER_SUBSETS = ("easy", "hard")


def render_result(
    result: Result,
    reference: Reference,
    people: Scores,
    *,
    metadata: Metadata | None = None,
    terminal: Terminal | None = None,
) -> str:
    """Render a result with the human figures beside the model's.

    Parameters
    ----------
    people
        What ``grading.grade_people`` gives for the same reference.
    metadata
        Names the system, where it is known.
    """
    parts: list[RenderableType] = [
        _heading(result, reference, metadata),
        "",
        _accuracy_table(result, reference, people),
    ]
    if reference.people is not None:
        parts += [
            _subset_table(result, reference, people, names)
            for names in (PAPER_SUBSETS, CROSSFIT_SUBSETS)
            if any(names[0] in subsets for subsets in result.scores.values())
        ]
        parts += [_agreement_table(result, reference, people), _kappa_table(result, reference)]
    parts += [_probability_table(result, reference)]
    parts += [Text(line, "dim") for line in _legend(result, reference)]
    parts += [Text(f"warning: {check.code}: {check.message}", "yellow") for check in result.checks]
    return render_tables(parts, terminal or Terminal())


def _heading(result: Result, reference: Reference, metadata: Metadata | None) -> Text:
    coverage = result.coverage
    title = Text(metadata.submission.name if metadata else "Predictions", "bold")
    if metadata:
        protocol = metadata.protocol
        title.append(
            f"  {metadata.submission.team}; training {protocol.training}, testing {protocol.testing}",
            "not bold",
        )
    title.append("\n").append(reference_banner(reference))
    covered = f"{len(coverage.properties)} of {len(reference.benchmark.properties)} properties"
    given = f"{coverage.trials} of {reference.n_trials} trials, {coverage.answered} answered"
    title.append(f"\n{given}; {covered} complete")
    if not coverage.complete:
        title.append("\nPartial: without all properties there is no overall score and no rank.", "yellow")
    return title


def _scope_rows(result: Result, reference: Reference) -> Iterator[tuple[str, str]]:
    """Yield each graded scope with the name to show, scenarios indented under their property."""
    titles = [(OVERALL, "overall")]
    for property_ in reference.benchmark.properties:
        titles.append((property_.name, property_.name))
        titles += [(s.id, f"  {s.title}") for s in reference.benchmark.scenarios_of(property_.name)]
    yield from ((scope, title) for scope, title in titles if scope in result.scores)


def _score(scores: Scores, scope: str, subset: str, metric: str) -> Score | None:
    found = scores.get(scope, {}).get(subset)
    return found.metrics.get(metric) if found else None


def _accuracy_table(result: Result, reference: Reference, people: Scores) -> Table:
    table = new_table(["accuracy, %", "trials", "model", "95 %", "people", "95 %", "gap", "p"])
    for scope, title in _scope_rows(result, reference):
        p = _score(result.scores, scope, "all", "accuracy_p")
        cells: list[str | Text] = [str(result.scores[scope]["all"].n)]
        model, human = (_score(scores, scope, "all", "accuracy") for scores in (result.scores, people))
        cells += [_mark_chance(model, p), format_interval(model, format_percent)]
        cells += [format_percent(human), format_interval(human, format_percent)]
        cells += [_mark_gap(_score(result.scores, scope, "all", "human_gap")), format_p(p)]
        table.add_row(title, *cells, style="bold" if scope == OVERALL else "")
    return table


def _subset_table(result: Result, reference: Reference, people: Scores, names: tuple[str, str]) -> Table:
    """Tabulate easy and hard trials, which only overall and properties have."""
    columns = [column for name in ("easy", "hard") for column in (f"{name} n", "model", "people", "r")]
    table = new_table(
        ["the same, cross-fitted" if names == CROSSFIT_SUBSETS else "easy and hard, %", *columns]
    )
    for scope, title in _scope_rows(result, reference):
        subsets = result.scores[scope]
        if names[0] not in subsets:
            continue
        cells = []
        for name in names:
            cells += [
                f"{subsets[name].n:.0f}",
                format_percent(_score(result.scores, scope, name, "accuracy")),
            ]
            cells += [format_percent(_score(people, scope, name, "accuracy"))]
            cells += [format_number(_score(result.scores, scope, name, "human_r"))]
        table.add_row(title, *cells, style="bold" if scope == OVERALL else "")
    return table


def _mark_chance(accuracy: Score | None, p: Score | None) -> Text:
    is_above = p is not None and p.value is not None and p.value < ALPHA
    return Text(format_percent(accuracy) + ("*" if is_above else " "))


def _mark_gap(gap: Score | None) -> Text:
    """Show a gap in percentage points with its sign; an arrow and colour mark a large one."""
    if gap is None or gap.value is None:
        return Text(ABSENT)
    text = f"{100 * gap.value:+.1f}"
    if abs(gap.value) < LARGE_GAP:
        return Text(text + "  ")
    return Text(text + " ▲", "green") if gap.value > 0 else Text(text + " ▼", "red")


def _metric_table(
    result: Result,
    reference: Reference,
    title: str,
    columns: Mapping[str, tuple[str, str, Callable[[Score | None], str]]],
) -> Table:
    """Tabulate metrics by scope; each column names its metric, its subset and how to show it."""
    table = new_table([title, *columns])
    for scope, name in _scope_rows(result, reference):
        cells = [
            show(_score(result.scores, scope, subset, metric)) for metric, subset, show in columns.values()
        ]
        table.add_row(name, *cells, style="bold" if scope == OVERALL else "")
    return table


def _agreement_table(result: Result, reference: Reference, people: Scores) -> Table:
    """Tabulate agreement, with the ceiling of r where there is one: on whole properties, and overall."""
    table = new_table(["agreement with people", "r", "95 %", "ceiling", "r/ceiling", "95 %"])
    for scope, title in _scope_rows(result, reference):
        r, share = (_score(result.scores, scope, "all", m) for m in ("human_r", "human_r_normalized"))
        cells = [format_number(r), format_interval(r, format_number)]
        cells += [format_number(_score(people, scope, "all", "ceiling"))]
        cells += [format_number(share), format_interval(share, format_number)]
        table.add_row(title, *cells, style="bold" if scope == OVERALL else "")
    return table


def _kappa_table(result: Result, reference: Reference) -> Table:
    columns = {
        "partial r": ("human_r_partial", "all", format_number),
        "rmse": ("human_rmse", "all", format_number),
        "error kappa": ("error_consistency", "all", format_number),
        "answer kappa": ("cohen_kappa", "all", format_number),
    }
    return _metric_table(result, reference, "more agreement", columns)


def _probability_table(result: Result, reference: Reference) -> Table:
    columns = {
        "both right, %": ("pair_accuracy", "all", format_percent),
        "in order, %": ("pair_order", "all", format_percent),
        "AUC": ("auc", "all", format_number),
        "Brier": ("brier", "all", format_number),
        "ECE": ("ece", "all", format_number),
        "of people": ("human_ece", "all", format_number),
        "YES, %": ("yes_rate", "all", format_percent),
    }
    return _metric_table(result, reference, "pairs, probabilities", columns)


def _legend(result: Result, reference: Reference) -> Iterator[str]:
    bootstrap = result.bootstrap
    has_responses = reference.people is not None and reference.people.responses is not None
    drawn = "pairs within scenarios" + (" and people" if has_responses else "")
    yield f"95 %: bootstrap over {drawn}, {bootstrap.resamples:,} resamples; for all numbers: --json."
    yield f"* above chance: exact one-sided p < {ALPHA}, not corrected for the number of rows."
    if reference.people is not None:
        yield f"▲ ▼ the model is {100 * LARGE_GAP:.0f} points or more above or below people, same trials."
        both = sum(result.scores[name]["easy"].n_pairs_in_both or 0 for name in result.coverage.properties)
        easy, hard = reference.benchmark.grading.easy, reference.benchmark.grading.hard
        yield f"easy, hard: pairs with a member people get right above {easy}, below {hard}; both: {both}."
        if any(CROSSFIT_SUBSETS[0] in subsets for subsets in result.scores.values()):
            yield "cross-fitted: one half of the people chooses, the other is measured; n is an average."
        yield "ceiling: the highest r that noise in people's answers allows."
    reasons = dict.fromkeys(
        score.why
        for subsets in result.scores.values()
        for scores in subsets.values()
        for score in scores.metrics.values()
        if score.why
    )
    shown = list(reasons)[:3]
    if shown:
        yield f"{ABSENT} undefined: {'; '.join(shown)}" + (
            " and other reasons, see result.json" if len(reasons) > len(shown) else ""
        )
