"""Problems and their collector."""

import re

import pytest

from leaderboard.problems import CODES, Problem, Problems, Severity


def test_codes_and_meanings_have_one_form() -> None:
    """A code can be a folder and an anchor; its meaning is one sentence."""
    for code, kind in CODES.items():
        assert re.fullmatch("[a-z0-9]+(-[a-z0-9]+)*", code)
        assert re.fullmatch(r"[A-Z\w].*[^.]\.", kind.meaning)


def test_a_code_must_be_in_the_catalogue() -> None:
    """A slip of the finger in our own code is a bug and fails at once."""
    problems = Problems()
    with pytest.raises(KeyError, match="unknown-trail"):
        problems.add("unknown-trail", "message", "file")
    assert not problems


def test_only_errors_refuse() -> None:
    """Warnings and notes are found and do no harm."""
    harmless, harmful = Problems(), Problems()
    for code in ("beyond-track", "reference-no-pairs"):
        harmless.add(code, "message", "file")
        harmful.add(code, "message", "file")
    harmful.add("empty-file", "message", "file")
    assert (harmless.has_errors, harmful.has_errors) == (False, True)
    assert [problem.severity for problem in harmful] == [Severity.WARNING, Severity.NOTE, Severity.ERROR]


def test_problems_of_a_file_come_in_the_order_of_its_lines() -> None:
    """Those without a line come last, and equals stay in the order of finding; earlier files come first."""
    problems, found = Problems(), Problems()
    problems.add("slug-malformed", "first", "folder")
    for line, message in ((9, "c"), (None, "d"), (2, "a"), (2, "b")):
        found.add("unknown-trial", message, "file", line=line)
    problems.extend_by_line(found)
    assert [problem.message for problem in problems] == ["first", "a", "b", "c", "d"]
    assert problems.found[1] == Problem("unknown-trial", "a", "file", 2)
