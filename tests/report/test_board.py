"""The board as text, CSV, LaTeX and JSON."""

import csv
import io
import json

import numpy as np
import pytest

from builders import build_entry, build_reference
from leaderboard.grading import Yardstick, grade_people
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


@pytest.fixture(scope="module")
def judged() -> tuple[Board, Reference]:
    """Build a board that says how sure its ranks are, with a gain on its first row."""
    large = build_reference(40, n_people=4)
    right = np.where(large.labels == 1, 0.9, 0.1)
    poor = np.where(np.arange(large.n_trials) % 5 == 0, 1 - right, right)
    coin = np.random.default_rng(5).random(large.n_trials)
    entries = [
        build_entry(large, "best", right.tolist(), system="one"),
        build_entry(large, "same", right.tolist(), system="two"),
        build_entry(large, "coin", coin.tolist(), system="three"),
        build_entry(large, "old", poor.tolist(), system="one", testing="without_property"),
    ]
    track = large.benchmark.default_track
    return rank_entries(entries, track, yardstick=Yardstick.of(large)), large


def test_the_table_says_how_sure_ranks_are(judged: tuple[Board, Reference]) -> None:
    """Rank sets with a mark on the best group, the gain with its test, and what can be told apart."""
    board, large = judged
    lines = render_board(board, large, {}).splitlines()
    rows = {
        name: next(line.split() for line in lines if name in line.split())
        for name in ("best", "same", "coin")
    }
    assert rows["best"][:8] == ["1", "best", "1", "to", "2†", "+20.0*", "100.0", "100.0"]
    assert rows["same"][:6] == ["1", "same", "1", "to", "2†", "100.0"]
    assert rows["coin"][:3] == ["3", "coin", "3"]
    assert isinstance(board.detectable, float)
    assert f"A true difference of {100 * board.detectable:.1f} points is found 4 times in 5." in lines
    assert any(line.startswith("gain: points over the system without") for line in lines)


def test_a_wide_terminal_shows_the_chance_to_be_the_best(judged: tuple[Board, Reference]) -> None:
    """Two equal ones share it."""
    board, large = judged
    lines = render_board(board, large, {}, terminal=Terminal(200)).splitlines()
    assert "best, %" in next(line for line in lines if "ranks" in line)
    assert next(line.split() for line in lines if "same" in line.split())[5] == "50"


def test_programs_get_standings_and_gains(judged: tuple[Board, Reference]) -> None:
    """In JSON as they are, in CSV the ends of the rank set and of the interval."""
    board, large = judged
    data = json.loads(render_board_json(board, large, {}))
    first, last = data["rows"][0], data["rows"][-1]
    assert (first["rank_set"], first["best_probability"], first["among_best"]) == ([1, 2], 0.5, True)
    assert (first["property_gain"]["value"], first["property_gain"]["without"]) == (0.2, "old")
    assert (last["rank_set"], last["among_best"]) == ([3, 3], False)
    assert "property_gain" not in last
    assert data["detectable_difference"] == {"value": board.detectable}
    rows = list(csv.DictReader(io.StringIO(render_board_csv(board, large, {}))))
    assert [(row["rank_low"], row["rank_high"]) for row in rows] == [("1", "2"), ("1", "2"), ("3", "3")]
    score = board.ranked[-1].entry.score("accuracy")
    assert score is not None
    ends = (rows[-1]["accuracy.overall.low"], rows[-1]["accuracy.overall.high"])
    assert ends == (str(score.low), str(score.high))


def test_a_board_without_rivals_says_why_nothing_is_detectable(reference: Reference) -> None:
    """One submission cannot be told from anything."""
    entry = build_entry(reference, "one", np.linspace(0, 1, reference.n_trials).tolist())
    board = rank_entries([entry], reference.benchmark.default_track, yardstick=Yardstick.of(reference))
    data = json.loads(render_board_json(board, reference, {}))
    assert data["detectable_difference"] == {
        "value": None,
        "why": "there are fewer than two different systems",
    }
