"""Whether a reference is what its definition expects: every assumption with what was found."""

from leaderboard.reference.checking.checker import (
    Verdict,
    check_departures,
    check_reference,
    draw_datasheet,
)
from leaderboard.reference.checking.datasheet import Datasheet, Finding, Row, Section, Status

__all__ = [
    "Datasheet",
    "Finding",
    "Row",
    "Section",
    "Status",
    "Verdict",
    "check_departures",
    "check_reference",
    "draw_datasheet",
]
