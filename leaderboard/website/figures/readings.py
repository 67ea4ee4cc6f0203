"""Scores in words, as figures say them to a pointer and to whoever cannot see them, and as a table."""

from collections.abc import Sequence

from leaderboard.models import Score
from leaderboard.website.figures.marks import Numbers
from leaderboard.website.numbers import printer_of, show_interval, unit_of
from leaderboard.website.quantities import Described

MAX_READINGS = 12

ScoreLine = tuple[str, str, str, Score | None, str]
"""A score of a figure: the group it belongs to, its name, what is shown of it, and why there is none."""


def read_score(quantity: Described, name: str, score: Score | None, absent: str = "") -> str:
    """Say a score with its unit and interval, or why there is none."""
    if score is None or score.value is None:
        return f"{name}: {absent if score is None else f'undefined, {score.why}'}"
    unit = f" {unit_of(quantity)}".rstrip()
    interval = show_interval(quantity, score)
    sure = f", 95 % interval {interval}" if interval else ""
    return f"{name}: {printer_of(quantity)(score.value)}{unit}{sure}"


def describe_readings(quantity: Described, readings: Sequence[tuple[str, Score | None, str]]) -> str:
    """Say the first of many scores and how many more there are.

    Each reading is a name, a score, and the reason where there is none.
    """
    shown = [read_score(quantity, *reading) for reading in readings[:MAX_READINGS]]
    n_more = len(readings) - len(shown)
    more = [f"{n_more} more"] if n_more else []
    return "; ".join([*shown, *more]) + "." if shown else "Nothing to show."


def list_scores(quantity: Described, lines: Sequence[ScoreLine]) -> Numbers:
    """Lay out scores as columns, with all digits."""
    groups, names, series, scores, absences = zip(*lines, strict=True) if lines else ([], [], [], [], [])
    whys = zip(scores, absences, strict=True)
    return {
        "metric": [quantity.name for _ in lines],
        "group": groups,
        "name": names,
        "series": series,
        **{part: [getattr(score, part, None) for score in scores] for part in ("value", "low", "high")},
        "why": [absent if score is None else score.why for score, absent in whys],
    }
