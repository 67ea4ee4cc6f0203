"""Two submissions side by side, for a terminal and as JSON."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict

from rich.table import Table
from rich.text import Text

from leaderboard.comparing import Comparison, ScopeComparison
from leaderboard.files import canonical_json
from leaderboard.metrics.resampling import Interval
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.models import Score
from leaderboard.models.benchmark import OVERALL
from leaderboard.reference import Reference
from leaderboard.report.terminal import (
    ABSENT,
    Terminal,
    format_number,
    format_p,
    new_table,
    reference_banner,
    render_tables,
)

DECIMALS = 6
ACCURACY_COLUMNS = ("accuracy, %", "A", "B", "A-B", "95 %", "p", "pairs A / B / =")
AGREEMENT_COLUMNS = ("agreement", "human r A-B", "95 %", "kappa of A and B")
INTERVAL_NOTE = (
    "95 %: percentile bootstrap over pairs within scenarios, and over people where they are known;"
)
TEST_NOTE = "p: exact two-sided sign-flip test over pairs; pairs: on how many A, B or neither earns more."


def render_comparison(
    comparison: Comparison,
    reference: Reference,
    names: Mapping[str, str],
    *,
    terminal: Terminal | None = None,
) -> str:
    """Render a comparison: every scope with its difference, and the trials that differ most.

    Parameters
    ----------
    names
        How to call each of the two, by the slug that the comparison has.
    """
    heading = Text()
    for letter, slug in (("A", comparison.a), ("B", comparison.b)):
        heading.append(f"{letter}  {names.get(slug, slug)}", "bold").append(f"  {slug}\n")
    heading.append(reference_banner(reference))
    notes = (Text(line, "dim") for line in _notes(comparison))
    tables = (
        _scope_table(comparison, reference, ACCURACY_COLUMNS, _accuracy_cells),
        _scope_table(comparison, reference, AGREEMENT_COLUMNS, _agreement_cells),
        _trial_table(comparison),
    )
    return render_tables([heading, "", *tables, *notes], terminal or Terminal())


def render_comparison_json(comparison: Comparison) -> str:
    """Render a comparison for programs, with six decimals; what is undefined is null with a reason."""
    data = asdict(comparison)
    for laid_out, scope in zip(data["scopes"], comparison.scopes, strict=True):
        laid_out["accuracy_a"] = round(scope.accuracy_a, DECIMALS)
        laid_out["accuracy_b"] = round(scope.accuracy_b, DECIMALS)
        laid_out["difference"] = _interval_data(scope.difference)
        laid_out["human_r_difference"] = _interval_data(scope.human_r_difference)
        laid_out["kappa"] = _estimate_data(scope.kappa)
    return canonical_json(data)


def _scope_table(
    comparison: Comparison,
    reference: Reference,
    columns: Sequence[str],
    cells: Callable[[ScopeComparison], list[str]],
) -> Table:
    table = new_table(columns)
    titles = {s.id: f"  {s.title}" for s in reference.benchmark.scenarios}
    for scope in comparison.scopes:
        style = "bold" if scope.name == OVERALL else ""
        table.add_row(titles.get(scope.name, scope.name), *cells(scope), style=style)
    return table


def _accuracy_cells(scope: ScopeComparison) -> list[str]:
    overlap, difference = scope.overlap, scope.difference
    return [
        f"{100 * _settle(scope.accuracy_a):.1f}",
        f"{100 * _settle(scope.accuracy_b):.1f}",
        _show_points(difference.value),
        f"{_show_points(difference.low)} to {_show_points(difference.high)}",
        format_p(Score(value=scope.p)),
        f"{overlap.n_pairs_a} / {overlap.n_pairs_b} / {overlap.n_pairs_equal}",
    ]


def _agreement_cells(scope: ScopeComparison) -> list[str]:
    kappa = None if isinstance(scope.kappa, Undefined) else Score(value=_settle(scope.kappa))
    return [*_interval_cells(scope.human_r_difference), format_number(kappa)]


def _interval_cells(interval: Interval | Undefined) -> list[str]:
    if isinstance(interval, Undefined):
        return [ABSENT, ABSENT]
    value, low, high = (f"{_settle(end):+z.3f}" for end in (interval.value, interval.low, interval.high))
    return [value, f"{low} to {high}"]


def _show_points(difference: float) -> str:
    return f"{100 * _settle(difference):+z.1f}"


def _settle(value: float) -> float:
    """Round as JSON and the website do before they print, so that all print the same digits."""
    return round(value, DECIMALS) + 0.0


def _trial_table(comparison: Comparison) -> Table:
    table = new_table(("trials on which they differ most", "label", "A", "B", "people"))
    for trial in comparison.trials:
        people = ABSENT if trial.human_mean is None else f"{trial.human_mean:.3f}"
        label = "YES" if trial.label else "NO"
        table.add_row(
            trial.trial_id, label, f"{trial.probability_a:.3f}", f"{trial.probability_b:.3f}", people
        )
    return table


def _notes(comparison: Comparison) -> list[str]:
    resamples = f"{comparison.resamples:,} resamples, the same for both."
    notes = [f"{INTERVAL_NOTE} {resamples}", TEST_NOTE, "kappa: agreement of the two answers, beyond chance."]
    if comparison.property_gain:
        notes.insert(
            0, f"{comparison.property_gain} is the property gain: one system, with and without inference."
        )
    lost = max((_n_undefined(scope.human_r_difference) for scope in comparison.scopes), default=0)
    if lost:
        notes.append(f"Human r has no value in up to {lost:,} resamples; its interval is that of the others.")
    undefined = (
        s.human_r_difference for s in comparison.scopes if isinstance(s.human_r_difference, Undefined)
    )
    return notes + [f"{ABSENT} undefined: {why}" for why in sorted({estimate.why for estimate in undefined})]


def _n_undefined(interval: Interval | Undefined) -> int:
    return 0 if isinstance(interval, Undefined) else interval.n_undefined


def _interval_data(interval: Interval | Undefined) -> dict[str, object]:
    if isinstance(interval, Undefined):
        return {"value": None, "why": interval.why}
    rounded = {key: round(getattr(interval, key), DECIMALS) + 0.0 for key in ("value", "low", "high")}
    return rounded | {"n_undefined": interval.n_undefined}


def _estimate_data(estimate: Estimate) -> dict[str, object]:
    if isinstance(estimate, Undefined):
        return {"value": None, "why": estimate.why}
    return {"value": round(estimate, DECIMALS) + 0.0}
