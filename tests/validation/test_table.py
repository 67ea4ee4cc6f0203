"""From text to rows."""

import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.problems import Problems
from leaderboard.validation.table import MAX_SURPLUS, Row, parse_rows

KNOWN = ("a/x,y/1", "b/2")


def parse(text: str) -> tuple[list[Row], list[tuple[str, int | None]]]:
    problems = Problems()
    rows = parse_rows(text, KNOWN, "f", problems)
    return rows, [(p.code, p.line) for p in problems]


def hint_of(text: str) -> str:
    problems = Problems()
    parse_rows(text, KNOWN, "f", problems)
    return problems.found[0].hint


def test_rows_know_their_lines() -> None:
    """Cells may be quoted, the status may be there, and lines count from the header's 1."""
    rows, found = parse('"trial_id","probability",status\n"a/x,y/1",0.5,\nb/2,,refused\n')
    assert rows == [Row(2, "a/x,y/1", "0.5", ""), Row(3, "b/2", "", "refused")]
    assert found == []


def test_other_separators_of_lines_are_ordinary_characters() -> None:
    """A form feed or a Unicode line separator inside a cell does not shift the line numbers."""
    rows, _ = parse("trial_id,probability\na\x0c\u2028\x85,1\nb/2,0\n")
    assert [(row.line, row.trial_id) for row in rows] == [(2, "a\x0c\u2028\x85"), (3, "b/2")]


def test_good_rows_are_kept_beside_bad_lines() -> None:
    """Every line is judged for itself, so that one run finds all faults."""
    lines = ["a,1", "", "a,1,2", "a", '"a,1', "trial_id,probability", "b,2", "", "", ","]
    rows, found = parse("\n".join(["trial_id,probability", *lines]))
    assert [row.line for row in rows] == [2, 8]
    assert found == [
        ("blank-line", 3),
        ("ragged-row", 4),
        ("ragged-row", 5),
        ("malformed-quotes", 6),
        ("repeated-header", 7),
        ("blank-line", 9),
    ]


@pytest.mark.parametrize(
    ("text", "code", "hint"),
    [
        ("", "empty-file", "the first line must be"),
        (" \n\n", "empty-file", "the first line must be"),
        ("trial_id;probability\n", "wrong-separator", "export it with commas"),
        ("trial_id\tprobability\n", "wrong-separator", "export it with commas"),
        ("trial_id,trial_id\n", "duplicate-column", "the first line must be"),
        ("id,prob\n", "wrong-header", "the first line must be"),
        ("probability,trial_id\n", "wrong-header", "in this order"),
        (",trial_id,probability\n", "wrong-header", "index=False"),
        ("b/2,0.5\n", "wrong-header", "without a header"),
        ("a/x,y/1,0.5\n", "wrong-header", "without a header"),
        ("a/x,y/1,a/x\n", "wrong-header", "without a header"),
        ("\n\ntrial_id,probability\nb/2,0.5\n", "wrong-header", "remove the empty lines above the header"),
        (" \ntrial_id,probability\n", "wrong-header", "remove the empty line above the header"),
        ("id;prob\n", "wrong-separator", "export it with commas"),
        ('"trial_id,probability\n', "wrong-header", "the first line must be"),
        ("trial_id,probability", "no-rows", "give one row per trial"),
    ],
)
def test_without_a_header_no_row_is_judged(text: str, code: str, hint: str) -> None:
    """The header says what the columns mean; where it fails, one problem says so."""
    rows, found = parse(text)
    assert (rows, [found_code for found_code, _ in found]) == ([], [code])
    assert hint in hint_of(text)


def test_a_header_in_capitals_is_refused_but_understood() -> None:
    """The rows below it are judged all the same."""
    rows, found = parse("Trial_ID, Probability\nb/2,0.5\n")
    assert found == [("wrong-header", 1)]
    assert rows == [Row(2, "b/2", "0.5", "")]


@pytest.mark.parametrize(
    ("line", "hint"),
    [
        ("b/2", "give each column a cell"),
        (";;", "separate cells by a comma, not by a semicolon"),
        ("b/2;0.5", "separate cells by a comma, not by a semicolon"),
        ("b/2,0,5", "write the probability with a point, 0.5, not 0,5"),
        ("a/x,y/1,0.5", 'put the trial id in double quotes, since it holds commas: "..."'),
        (
            "a/x,y/1,0,5",
            (
                'put the trial id in double quotes, since it holds commas: "..."; '
                "write the probability with a point, 0.5, not 0,5"
            ),
        ),
        ("c,0.5,x", "remove what is too much; a cell that holds commas needs double quotes"),
    ],
)
def test_a_ragged_row_is_explained(line: str, hint: str) -> None:
    """The surplus tells whether a decimal comma or an id without quotes made it."""
    assert hint_of(f"trial_id,probability\n{line}\n") == hint


def test_rows_far_beyond_the_trials_are_only_counted() -> None:
    """A file may be longer than the benchmark by 10,000 rows; what follows is not judged."""
    most = 2 + MAX_SURPLUS
    rows, found = parse("trial_id,probability\n" + "a,1\n" * most)
    assert (len(rows), found) == (most, [])
    rows, found = parse("trial_id,probability\n" + "a,1\n" * (most + 1))
    assert (len(rows), found) == (most, [("too-many-rows", None)])


CELLS = st.text(st.characters(blacklist_characters="\r\n\0", blacklist_categories=["Cs"]), max_size=6)


@given(st.lists(st.tuples(CELLS.filter(lambda cell: cell.strip(", \t")), CELLS), min_size=1, max_size=5))
def test_cells_are_those_of_the_csv_module(cells: list[tuple[str, str]]) -> None:
    """What csv.writer writes comes back cell by cell."""
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerows([("trial_id", "probability"), *cells])
    rows, found = parse(buffer.getvalue())
    assert [(row.trial_id, row.probability) for row in rows] == cells
    assert found == []


def test_a_file_without_header_whose_ids_are_torn_repeats_no_column() -> None:
    """Equal numbers inside an unquoted id are not two columns of the same name."""
    problems = Problems()
    parse_rows("a=0.3,0.5,0.3/1,0.5\n", ("a=0.3,0.5,0.3/1",), "f", problems)
    assert [(p.code, p.message) for p in problems] == [
        ("wrong-header", "the header is 'a=0.3,0.5,0.3/1,0.5'")
    ]


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ([""], "the line is empty"),
        ([" "], "the line is empty but for blanks or commas"),
        ([","], "the line is empty but for blanks or commas"),
        (["", ""], "each of lines 2 to 3 is empty"),
        ([",", "", "  "], "each of lines 2 to 4 is empty but for blanks or commas"),
    ],
)
def test_blank_lines_are_described_as_they_are(lines: list[str], message: str) -> None:
    """One problem for a run of them; its words are true of every line of the run."""
    problems = Problems()
    parse_rows("\n".join(["trial_id,probability", *lines, "b/2,1"]), KNOWN, "f", problems)
    assert [(p.code, p.line, p.message) for p in problems] == [("blank-line", 2, message)]


LINES = st.lists(
    st.sampled_from(
        ['"a/x,y/1",0.5', "b/2,0.5", "a/x,y/1,0,5", "", ",", '"', "trial_id,probability", "b/2", '"b/2"x,1']
    )
)


@given(LINES, st.sampled_from(["\n", "\r\n"]))
def test_every_line_is_a_row_or_is_reported(lines: list[str], line_end: str) -> None:
    """No line gets lost: each is among the rows, or has a problem at it or at the start of its blank run."""
    rows, found = parse(line_end.join(["trial_id,probability", *lines, "b/2,1"]) + line_end)
    accounted = {row.line for row in rows} | {line for _, line in found}
    for number, line in enumerate(lines, 2):
        is_inside_run = line in ("", ",") and lines[number - 3 : number - 2] in ([""], [","])
        assert number in accounted or is_inside_run
    assert len({row.line for row in rows}) == len(rows)


def test_a_row_without_its_status_is_told_about_the_comma() -> None:
    """Whoever has a status column may leave the status empty, not out."""
    assert (
        hint_of("trial_id,probability,status\nb/2,0.5\n")
        == "give each column a cell: an empty status too has its comma"
    )
    assert hint_of("trial_id,probability,status\nb/2\n") == "give each column a cell"
