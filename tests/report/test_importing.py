"""What an import made, as a maintainer reads it."""

from dataclasses import replace
from pathlib import Path

from leaderboard.models import Manifest
from leaderboard.problems import Problem
from leaderboard.reference.recipes import ImportedProperty, ImportReport
from leaderboard.report.importing import render_import

REPORT = ImportReport(
    title="Physion",
    root=Path("physion"),
    manifest=Manifest(kind="official", files={}, digest="a" * 64),
    properties=(
        ImportedProperty("Roll", n_trials=150, n_rated=94, human_accuracy=0.8681294),
        ImportedProperty("Dominoes", n_trials=1500, n_rated=0, human_accuracy=None),
    ),
    problems=(),
)
SUMMARY = (
    "Physion: 1,650 trials, 94 of them judged by people, in physion\n"
    "  Roll       150 trials,   94 judged, human accuracy 0.868129\n"
    "  Dominoes  1500 trials,    0 judged\n"
    f"sealed as official, digest {'a' * 64}\n"
)


def test_clean_import_is_summed_up() -> None:
    """Each property has its trials, how many people judged, and how accurate they were."""
    assert render_import(REPORT) == SUMMARY


def test_oddities_come_first() -> None:
    """What was odd in the official files stands before the summary, which is seen last."""
    problem = Problem("import-unmatched", "'ramp_1' fits no trial", "humans/ramp.csv", 7)
    text = render_import(replace(REPORT, problems=(problem,)))
    oddities = text.removesuffix(SUMMARY)
    assert "humans/ramp.csv:7" in oddities
    assert "import-unmatched" in oddities
    assert "'ramp_1' fits no trial" in oddities
