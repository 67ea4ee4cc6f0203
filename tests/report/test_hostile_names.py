"""A submission may be called anything printable: on every report that is text, and the rest as without."""

import csv
import io
import json
import re
from collections.abc import Callable
from dataclasses import replace

import pytest

from builders import build_metadata, build_reference, build_submission
from hostile_texts import PRINTABLE, check_lines, outside_of_fences
from hostile_twins import Twins, judge_texts
from leaderboard.assessing import Assessment
from leaderboard.changes import ChangeCheck
from leaderboard.comparing import compare
from leaderboard.reference import Reference
from leaderboard.report.board import render_board, render_board_csv, render_board_json
from leaderboard.report.changes import render_change_summary
from leaderboard.report.comparison import render_comparison
from leaderboard.report.latex import escape_latex, render_board_latex
from leaderboard.report.problems import escape_line
from leaderboard.report.proposal import render_proposal_body
from leaderboard.report.result import render_result
from leaderboard.report.terminal import Terminal


@pytest.fixture(scope="module")
def reference() -> Reference:
    return build_reference()


@pytest.fixture(scope="module")
def twins(reference: Reference) -> Twins:
    texts = list(PRINTABLE.values())
    return Twins(reference, texts, [f"Plain{n:02}x" for n in range(len(texts))])


@pytest.mark.parametrize("width", [80, 132, 400])
def test_tables_for_terminals_command_nothing(twins: Twins, width: int) -> None:
    """However a name is broken over lines, none is a command; where there is room it is shown whole."""
    terminal = Terminal(width)
    check_lines(render_board(twins.boards()[0], twins.reference, {}, terminal=terminal))
    for entry in twins.hostile:
        text = render_result(entry.result, twins.reference, {}, metadata=entry.metadata, terminal=terminal)
        check_lines(text)
        name = entry.metadata.submission.name
        assert width < 400 or text.startswith(
            f"{escape_line(name)}  {name.replace('##[', escape_line('##['))}; "
        )


def test_colours_are_the_programs_alone(twins: Twins) -> None:
    """On a terminal with colours, names bring none of their own, nor links."""
    hostile, harmless = (
        render_board(board, twins.reference, {}, terminal=Terminal(400, has_colour=True))
        for board in twins.boards()
    )
    assert set(re.findall("\x1b[^m]*m", hostile)) == set(re.findall("\x1b[^m]*m", harmless))
    check_lines(re.sub("\x1b[^m]*m", ".", hostile))


def test_comparisons_command_nothing(twins: Twins) -> None:
    """Both names stand at the beginning of a line."""
    a, b = (
        replace(
            build_submission(twins.reference, entry.probabilities.tolist()),
            slug=slug,
            metadata=build_metadata(),
        )
        for slug, entry in zip(("a-slug", "::error::"), twins.hostile[::3], strict=False)
    )
    comparison = compare(a, b, twins.reference)
    for text in PRINTABLE.values():
        check_lines(render_comparison(comparison, twins.reference, {"a-slug": text, "::error::": text}))


def test_spreadsheets_compute_nothing(twins: Twins) -> None:
    """A cell of the board's CSV is a number, or begins with nothing that is computed; none is split."""
    hostile, harmless = (
        list(csv.reader(io.StringIO(render_board_csv(board, twins.reference, {}))))
        for board in twins.boards()
    )
    for row, twin in zip(hostile, harmless, strict=True):
        for cell, plain in zip(row, twin, strict=True):
            assert cell in {twins.translate(plain), f"'{twins.translate(plain)}"}
            if cell == plain and re.fullmatch(r"-?[0-9.]+(e-?[0-9]+)?", cell):
                continue
            assert not cell.startswith(tuple("=+-@\uff1d\uff0b\uff0d\uff20\t\r\n"))


def test_latex_prints_and_runs_nothing(twins: Twins) -> None:
    """After its escapes, no name has a character left that TeX knows."""
    hostile, harmless = (render_board_latex(board, twins.reference, {}) for board in twins.boards())
    assert hostile == twins.translate(harmless, escape_latex)
    for text in PRINTABLE.values():
        left = re.sub(r"\\[&%$#_{}]|\\text(backslash|asciitilde|asciicircum)\{\}", "", escape_latex(text))
        assert not set(left) & set("\\&%$#_{}~^")


def test_programs_get_every_text_as_it_is(twins: Twins) -> None:
    """JSON is the same but for the words."""
    hostile, harmless = (render_board_json(board, twins.reference, {}) for board in twins.boards())
    assert hostile == twins.translate(harmless, lambda text: json.dumps(text, ensure_ascii=False)[1:-1])


@pytest.mark.parametrize("text", PRINTABLE.values(), ids=PRINTABLE)
def test_pages_of_the_host_show_text_in_fences_only(reference: Reference, text: str) -> None:
    """Verdict on a branch and text of a pull request are the same outside of fences, whatever the names."""
    two = [judge_texts(reference, name=words, team=words, description=words) for words in ("Plain", text)]
    contents = {"submissions/example/predictions.csv": b"x"}
    renders: list[Callable[[Assessment], str]] = [
        lambda found: render_change_summary(ChangeCheck("example", "0" * 40, (), found), reference),
        lambda found: render_proposal_body(found, reference, contents),
    ]
    for render in renders:
        plain, page = map(render, two)
        check_lines(page)
        assert outside_of_fences(page) == outside_of_fences(plain)
        assert escape_line(f"name      {text}") in page
