"""The board of a track as a LaTeX table."""

from leaderboard.grading import Scores
from leaderboard.ranking import Board, Row
from leaderboard.reference import Reference
from leaderboard.report.board import Column, board_columns
from leaderboard.report.terminal import ABSENT

_LATEX_SPECIAL = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    **{character: f"\\{character}" for character in "&%$#_{}"},
}


def render_board_latex(board: Board, reference: Reference, people: Scores) -> str:
    """Render a board as a LaTeX table with booktabs rules."""
    columns = board_columns(board, reference)
    blocks = [[_latex_row(["", "System", *(column.title for column in columns)])]]
    if people:
        blocks.append(
            [_latex_row(["", "People", *(column.show(column.score(people)) for column in columns)])]
        )
    groups = (board.ranked, board.partial, board.baselines)
    blocks += [[_latex_entry(row, columns) for row in rows] for rows in groups]
    lines = [*_latex_comments(board, reference), rf"\begin{{tabular}}{{rl{'r' * len(columns)}}}", r"\toprule"]
    lines.append("\n\\midrule\n".join("\n".join(block) for block in blocks if block))
    return "\n".join([*lines, r"\bottomrule", r"\end{tabular}", ""])


def _latex_comments(board: Board, reference: Reference) -> list[str]:
    title, track = escape_latex(reference.benchmark.title), escape_latex(board.track.title)
    comments = [f"% {title}, {track}, reference {reference.manifest.digest}"]
    if reference.is_synthetic:
        comments.append("% SYNTHETIC reference: labels and people are simulated; no figure here is real.")
    return comments


def _latex_entry(row: Row, columns: tuple[Column, ...]) -> str:
    shown = [column.show(column.score(row.entry.result.scores)) for column in columns]
    return _latex_row(["" if row.rank is None else str(row.rank), row.entry.metadata.submission.name, *shown])


def _latex_row(cells: list[str]) -> str:
    return " & ".join("--" if cell == ABSENT else escape_latex(cell) for cell in cells) + r" \\"


def escape_latex(text: str) -> str:
    r"""Write a text so that LaTeX prints it and runs nothing.

    >>> print(escape_latex("50% of $x_1$"))
    50\% of \$x\_1\$
    """
    return "".join(_LATEX_SPECIAL.get(character, character) for character in text)
