"""The board as text, CSV, LaTeX and JSON."""

import csv
import io
import json

import numpy as np
import pytest

from builders import build_entry, build_reference
from leaderboard.grading import grade_people
from leaderboard.ranking import Board, rank_entries
from leaderboard.reference import Reference
from leaderboard.report.board import render_board, render_board_csv, render_board_json
from leaderboard.report.latex import render_board_latex
from leaderboard.report.terminal import Terminal


@pytest.fixture(scope="module")
def reference() -> Reference:
    """Build a small synthetic reference with people."""
    return build_reference()


@pytest.fixture(scope="module")
def board(reference: Reference) -> Board:
    """Build a board with a hostile name, a partial submission and a baseline."""
    rng = np.random.default_rng(3)
    covered = (reference.properties == 1).tolist()
    entries = [
        build_entry(reference, "evil", rng.random(reference.n_trials).tolist(), name="=1+1 & $x_1$ [red]"),
        build_entry(reference, "good", np.where(reference.labels == 1, 0.9, 0.2).tolist(), name="Good"),
        build_entry(reference, "part", [0.9] * reference.n_trials, covered=covered, name="Part"),
        build_entry(reference, "base", [0.5] * reference.n_trials, family="baseline", name="Chance"),
    ]
    return rank_entries(entries, reference.benchmark.default_track)


def test_the_table_shows_people_first_then_ranks_then_reference_lines(
    board: Board, reference: Reference
) -> None:
    """The order of the rows tells what is ranked and what is not."""
    lines = render_board(board, reference, grade_people(reference)).splitlines()
    names = ("People", "1 Good", "2 =1+1 & $x_1$ [red]", "Part", "Chance")
    places = [next(i for i, line in enumerate(lines) if name in line) for name in names]
    assert places == sorted(places)


def test_the_table_says_that_it_is_synthetic_and_who_is_not_ranked(
    board: Board, reference: Reference
) -> None:
    """Nobody can mistake simulated figures for real ones."""
    text = render_board(board, reference, {})
    assert "SYNTHETIC reference: labels and people are simulated; no figure here is real." in text
    assert "Not ranked, because not all properties are covered: Part." in text


def test_an_empty_board_says_so(reference: Reference) -> None:
    """A track without submissions is not an empty page."""
    empty = rank_entries([], reference.benchmark.default_track)
    assert "No submission on this track yet." in render_board(empty, reference, {})


def test_colours_appear_only_on_terminals_that_want_them(board: Board, reference: Reference) -> None:
    """Without colour there is no escape character; with colour the text is the same."""
    plain = render_board(board, reference, {}, terminal=Terminal(120))
    coloured = render_board(board, reference, {}, terminal=Terminal(120, has_colour=True))
    assert "\x1b" not in plain
    assert "\x1b" in coloured


def test_csv_has_full_precision_and_runs_nothing(board: Board, reference: Reference) -> None:
    """Values equal the result's; a name that a spreadsheet would run gets an apostrophe."""
    people = grade_people(reference)
    rows = list(csv.DictReader(io.StringIO(render_board_csv(board, reference, people))))
    assert [row["kind"] for row in rows] == ["people", "ranked", "ranked", "partial", "baseline"]
    good, evil = rows[1], rows[2]
    score = board.ranked[0].entry.score("human_r")
    assert score is not None
    assert float(good["human_r.overall"]) == score.value
    assert evil["name"] == "'=1+1 & $x_1$ [red]"
    assert rows[3]["accuracy.overall"] == ""
    assert rows[4]["human_r.overall"] == ""
    assert {row["reference"] for row in rows} == {"synthetic"}


def test_latex_is_escaped_and_has_booktabs_rules(board: Board, reference: Reference) -> None:
    """Special characters of names are printed, not run; the rules balance."""
    text = render_board_latex(board, reference, grade_people(reference))
    assert r"=1+1 \& \$x\_1\$ [red]" in text
    assert (text.count(r"\toprule"), text.count(r"\bottomrule")) == (1, 1)
    assert text.count("{tabular}") == 2
    assert "% SYNTHETIC reference" in text
    widths = {line.count(" & ") for line in text.splitlines() if line.endswith(r"\\")}
    assert len(widths) == 1


def test_json_holds_all_scores_of_every_row(board: Board, reference: Reference) -> None:
    """The JSON board carries each row's whole result."""
    data = json.loads(render_board_json(board, reference, grade_people(reference)))
    assert [row["slug"] for row in data["rows"]] == ["good", "evil", "part", "base"]
    assert data["reference"] == {"kind": "synthetic", "digest": "0" * 64}
    for row, shown in zip(data["rows"], board.rows, strict=True):
        assert row["result"] == json.loads(shown.entry.result.model_dump_json(by_alias=True))


def test_another_metric_gets_a_column_of_its_own(reference: Reference) -> None:
    """A board ordered by AUC shows AUC."""
    entry = build_entry(reference, "one", np.linspace(0, 1, reference.n_trials).tolist())
    board = rank_entries([entry], reference.benchmark.default_track, "auc")
    header = render_board_csv(board, reference, {}).splitlines()[0]
    assert "auc.overall" in header.split(",")
