"""What an import made, as a maintainer reads it."""

from dataclasses import replace
from pathlib import Path

import pytest

from leaderboard.models import Manifest, Source
from leaderboard.problems import Problem
from leaderboard.reference.differences import Difference
from leaderboard.reference.fetching import SourceChange
from leaderboard.reference.importing import ImportReport
from leaderboard.reference.recipes import ImportedProperty
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
PROPERTIES = (
    "Physion: 1,650 trials, 94 of them judged by people\n"
    "  Roll       150 trials,   94 judged, human accuracy 0.868129\n"
    "  Dominoes  1500 trials,    0 judged\n"
)
SUMMARY = f"{PROPERTIES}sealed as official in physion, digest {'a' * 64}\n"
NO_DIFFERENCE = Difference((), (), (), (), ())


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


def test_a_refused_change_is_shown_with_the_way_to_accept_it() -> None:
    """Trials are counted with examples, files named, and the option that takes the change over."""
    difference = Difference(("new",), ("a", "b", "c", "d"), ("e",), ("f",), ("Roll.csv", "human_trials.csv"))
    assert render_import(replace(REPORT, manifest=None, difference=difference)) == (
        f"{PROPERTIES}"
        "the official reference that is there differs:\n"
        "  1 trials are new: new\n"
        "  4 trials are gone: a, b, c, ...\n"
        "  1 trials end otherwise: e\n"
        "  1 trials were judged otherwise: f\n"
        "  files: Roll.csv, human_trials.csv\n"
        "nothing was written; if the change is meant, add --accept-change\n"
    )


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("added", "is new"),
        ("removed", "is gone"),
        ("content", "has another content, sha256 " + "0" * 64 + " is now " + "1" * 64),
        ("validators", "has another date or ETag, and the same content"),
    ],
)
def test_changed_official_files_are_named(kind: str, words: str) -> None:
    """Each file is named by its path in the archive, with what became of it."""
    before, after = (
        Source(what="trials", url="all.zip", member="lists/Roll.csv", sha256=digit * 64) for digit in "01"
    )
    change = SourceChange(
        kind,  # type: ignore[arg-type]  # one of its four kinds
        None if kind == "added" else before,
        None if kind == "removed" else after,
    )
    text = render_import(replace(REPORT, difference=NO_DIFFERENCE, source_changes=(change,)))
    assert "the official files are not those that were fetched before:\n" in text
    assert f"  lists/Roll.csv: {words}\n" in text


def test_nothing_new_is_no_failure() -> None:
    """The same reference again is said to be there already."""
    report = replace(REPORT, manifest=None, difference=NO_DIFFERENCE)
    assert render_import(report) == f"{PROPERTIES}nothing to write: physion has this reference already\n"
    assert not report.is_refused


def test_files_that_are_no_reference() -> None:
    """Without anything understood there are no properties to list."""
    problem = Problem("import-no-trials", "no file lists test trials", "--from")
    text = render_import(ImportReport("Physion", Path("physion"), None, (), (problem,)))
    assert text.endswith("nothing was written: the files cannot be made a reference\n")
