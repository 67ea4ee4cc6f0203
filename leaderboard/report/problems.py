"""Problems as text for people, JSON for programs, and annotations for GitHub."""

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Literal

from leaderboard.files import canonical_json
from leaderboard.problems import Problem
from leaderboard.submission import Submission

MAX_SHOWN = 20
MAX_PATH = 300  # in a git tree, a path may have any length

Format = Literal["text", "json", "github"]

_COMMANDS = {"error": "error", "warning": "warning", "note": "notice"}


def render_problems(problems: Sequence[Problem], format_: Format = "text") -> str:
    """Render problems; text and annotations show at most 20 of a code and count the rest."""
    if format_ == "json":
        return canonical_json(problems_data(problems))
    lines = _github_lines(problems) if format_ == "github" else _text_lines(problems)
    return "".join(f"{line}\n" for line in lines)


def problems_data(problems: Sequence[Problem]) -> dict[str, object]:
    """Lay out all problems for JSON: whether the input is valid, errors, and what else was found."""
    errors = [_problem_data(problem) for problem in problems if problem.is_error]
    others = [_problem_data(problem) for problem in problems if not problem.is_error]
    return {"valid": not errors, "errors": errors, "warnings": others}


def render_verdict(location: str, submission: Submission | None, problems: Sequence[Problem]) -> str:
    """Say in one line whether a submission is valid, and what it covers or how many problems it has."""
    n_warnings = sum(not problem.is_error for problem in problems)
    warned = f", {_count(n_warnings, 'warning')}" if n_warnings else ""
    if submission is None:
        n_errors = len(problems) - n_warnings
        return f"{escape_line(_shorten_path(location))}: refused, {_count(n_errors, 'problem')}{warned}"
    n, n_covered = submission.covered.size, int(submission.covered.sum())
    unanswered = n_covered - int(submission.answered.sum())
    missing = f", {unanswered} of them unanswered" if unanswered else ""
    return f"{escape_line(_shorten_path(location))}: valid, {n_covered} of {n} trials{missing}{warned}"


def escape_line(text: str) -> str:
    r"""Show a text on one line: what cannot be printed is escaped, and no line is a command to GitHub.

    Workflows read commands from whatever is printed, after leading blanks: ``::`` at the start of a line,
    and the older ``##[`` anywhere.

    >>> print(escape_line("::add-mask::a\nb"))
    \x3a:add-mask::a\nb
    """
    return defuse_commands("".join(c if c.isprintable() else ascii(c)[1:-1] for c in text))


def defuse_commands(line: str) -> str:
    r"""Keep one line from being a command to GitHub; colours stay.

    >>> print(defuse_commands("a ##[error]b"))
    a #\x23[error]b
    """
    plain = line.replace("##[", r"#\x23[")
    return rf"\x3a{plain.lstrip()[1:]}" if plain.lstrip().startswith("::") else plain


def _problem_data(problem: Problem) -> dict[str, object]:
    return {
        "code": problem.code,
        "message": problem.message,
        "file": _encodable(problem.file),
        "line": problem.line,
        "hint": problem.hint,
    }


def _text_lines(problems: Sequence[Problem]) -> Iterable[str]:
    shown: Counter[str] = Counter()
    for problem in problems:
        shown[problem.code] += 1
        if shown[problem.code] <= MAX_SHOWN:
            file = _shorten_path(problem.file)
            place = file if problem.line is None else f"{file}:{problem.line}"
            severity = "" if problem.is_error else f"{problem.severity.value}: "
            yield escape_line(f"{place}: {severity}{problem.code}: {problem.message}")
            if problem.hint:
                yield f"    {escape_line(problem.hint)}"
    yield from _count_rest(shown)


def _github_lines(problems: Sequence[Problem]) -> Iterable[str]:
    shown: Counter[str] = Counter()
    for problem in problems:
        shown[problem.code] += 1
        if shown[problem.code] <= MAX_SHOWN:
            properties = {"file": _shorten_path(problem.file), "line": problem.line, "title": problem.code}
            given = ",".join(
                f"{k}={_escape_property(str(v))}" for k, v in properties.items() if v is not None
            )
            text = "; ".join(filter(None, (problem.message, problem.hint)))
            yield f"::{_COMMANDS[problem.severity]} {given}::{_escape_data(text)}"
    for line in _count_rest(shown):
        yield f"::notice::{_escape_data(line)}"


def _count_rest(shown: Counter[str]) -> Iterable[str]:
    for code, count in shown.items():
        if count > MAX_SHOWN:
            yield f"... and {count - MAX_SHOWN} more of {code}"


def _escape_data(text: str) -> str:
    """Escape as GitHub's workflow commands ask, and what cannot be printed as in text.

    What follows cannot start a command of its own, nor steer the terminal of whoever reads the log.
    """
    plain = "".join(c if c.isprintable() or c in "\r\n" else ascii(c)[1:-1] for c in text)
    return plain.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _escape_property(text: str) -> str:
    return _escape_data(text).replace(":", "%3A").replace(",", "%2C")


def _shorten_path(path: str) -> str:
    """Leave out the middle of an endless path."""
    half = MAX_PATH // 2
    return path if len(path) <= MAX_PATH else f"{path[:half]}...{path[-half:]}"


def _encodable(text: str) -> str:
    """Escape what UTF-8 cannot hold: a file's name may be any bytes."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"
