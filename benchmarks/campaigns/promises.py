"""What must hold of whatever a reader of strangers' bytes answers."""

from collections.abc import Iterable

from leaderboard.problems import CODES, Problem
from leaderboard.report.problems import render_problems


def require(holds: object) -> None:
    """Complain if a promise is broken.

    Raises
    ------
    AssertionError
        Then.
    """
    if not holds:
        raise AssertionError("a promise is broken")


def require_sound(problems: Iterable[Problem]) -> None:
    """Known codes, and text that stays in its line and commands nobody."""
    found = tuple(problems)
    for problem in found:
        require(problem.code in CODES)
        require((problem.message + problem.hint + problem.file).isprintable())
    for line in render_problems(found, "text").splitlines():
        require(line.isprintable() and not line.lstrip().startswith("::"))
