"""Tables of calibration: what a submission's probabilities mean, in bins."""

from leaderboard.grading import find_metric
from leaderboard.metrics.calibration import N_BINS
from leaderboard.models import Bin, Calibration, Score
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Entry
from leaderboard.website.numbers import EN_DASH, Footnotes
from leaderboard.website.pages import Cell, Column, ScopeRow, ScoreTable

EMPTY = "no trial has such a probability"
SHARE = find_metric("yes_rate")


def compose_calibrations(entry: Entry) -> tuple[ScoreTable, ...]:
    """Tabulate overall, or what is covered of the properties where not all are."""
    calibration = entry.result.calibration
    scopes = [OVERALL] if OVERALL in calibration else list(calibration)
    return tuple(_compose_table(number, scope, calibration[scope]) for number, scope in enumerate(scopes))


def _compose_table(number: int, scope: str, calibration: Calibration) -> ScoreTable:
    footnotes = Footnotes()
    people = calibration.people or (None,) * len(calibration.label)
    rows = tuple(
        _compose_row(label, of_people, footnotes)
        for label, of_people in zip(calibration.label, people, strict=True)
    )
    ece, human_ece = find_metric("ece"), find_metric("human_ece")
    columns = [
        Column("Mean P(YES)", "%", ece.name, "Mean probability of the trials in the bin"),
        Column("YES was right", "%", ece.name, "Share of these trials whose label is YES"),
    ]
    if calibration.people:
        meaning = "Mean share of people who said YES to them"
        columns.append(Column("People said YES", "%", human_ece.name, meaning, is_people=True))
    return ScoreTable(
        key=f"calibration-{number}",
        title="Overall" if scope == OVERALL else scope,
        caption=_describe(scope, calibration),
        row_title="P(YES)",
        count_titles=("Trials",),
        columns=tuple(columns),
        rows=rows,
        footnotes=footnotes.texts,
    )


def _describe(scope: str, calibration: Calibration) -> str:
    pooled = "The trials of all properties together. " if scope == OVERALL else ""
    n_trials = sum(bin_.n for bin_ in calibration.label)
    n_rated = sum(bin_.n for bin_ in calibration.people or ())
    is_partly = calibration.people is not None and n_rated < n_trials
    rated = f" People judged {n_rated:,} of the {n_trials:,} trials." if is_partly else ""
    return f"{pooled}A bin holds its upper end, the first one 0 as well.{rated}"


def _compose_row(label: Bin, people: Bin | None, footnotes: Footnotes) -> ScopeRow:
    low = label.upto - 1 / N_BINS
    values = [label.predicted, label.observed, *([people.observed] if people else [])]
    cells = tuple(_print(value, footnotes) for value in values)
    return ScopeRow(f"{low:.1f}{EN_DASH}{label.upto:.1f}", 1, (f"{label.n:,}",), cells)


def _print(value: float | None, footnotes: Footnotes) -> Cell:
    return footnotes.cell(SHARE, None if value is None else Score(value=value), absent=EMPTY)
