"""The ledger is read strictly, and who is withdrawn leaves the board."""

import datetime as dt
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.errors import InstanceError
from leaderboard.instance import Instance
from leaderboard.ledger import HEADER, Ledger, parse_ledger, published_dirs, read_ledger, render_ledger
from leaderboard.models.ledger import LedgerLine
from leaderboard.problems import Problems

HEAD = ",".join(HEADER) + "\n"
ONE, TWO = "1" * 64, "2" * 64
ADDED = f"2026-01-02,first,added,new submission,{ONE}\n"


def complain(text: str | bytes) -> list[tuple[str, str, int | None]]:
    """Read a ledger and list what is wrong with it."""
    problems = Problems()
    content = text.encode() if isinstance(text, str) else text
    ledger = parse_ledger(content, "ledger.csv", problems)
    assert (ledger is None) == problems.has_errors
    return [(p.code, p.message, p.line) for p in problems]


def test_lines_are_read_as_they_are_written() -> None:
    """A life from being added to being withdrawn, with a comma in a reason."""
    text = (
        HEAD
        + ADDED
        + f"2026-01-03,second,added,new submission,{TWO}\n"
        + f'2026-02-01,first,regraded,"metrics_version 1 -> 2, reference a -> b",{TWO}\n'
        + f"2026-02-01,second,flagged,asked about its pretraining,{TWO}\n"
        + f"2026-03-01,second,superseded,by third,{TWO}\n"
        + f"2026-04-01,second,withdrawn,at its authors' wish,{TWO}\n"
    )
    problems = Problems()
    ledger = parse_ledger(text.encode(), "ledger.csv", problems)
    assert ledger is not None
    assert (list(problems), len(ledger.lines)) == ([], 6)
    assert ledger.latest["first"].date == dt.date(2026, 2, 1)
    assert ledger.withdrawn == {"second"}
    assert render_ledger(ledger.lines) == text


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", ("ledger-malformed", f"the first line is ''; it must be {','.join(HEADER)}", 1)),
        (b"\xff", ("ledger-unreadable", "is not UTF-8 text", 1)),
        ("\ufeff" + HEAD, ("ledger-malformed", "the first line is '\\ufeffdate,slug,event,reason", 1)),
        (HEAD.replace("\n", "\r\n"), ("ledger-malformed", "holds a carriage return or NUL", 1)),
        (HEAD + "\0\n", ("ledger-malformed", "holds a carriage return or NUL", 2)),
        (HEAD + ADDED[:-1], ("ledger-malformed", "the last line does not end", 2)),
        (HEAD + "\n" + ADDED, ("ledger-malformed", "the line is blank", 2)),
        (HEAD + "a,b\n", ("ledger-malformed", "the line has 2 cells, not 5", 2)),
        (HEAD + ADDED.replace("new", '"new'), ("ledger-malformed", "malformed CSV: ", 2)),
        (HEAD + ADDED.replace("first", '"first"'), ("ledger-malformed", "is written in another form", 2)),
        (
            HEAD + ADDED.replace("2026-01-02", "2.1.2026"),
            ("ledger-value", "date is '2.1.2026'", 2),
        ),
        (
            HEAD + ADDED.replace("2026-01-02", "20260102"),
            ("ledger-value", "date is '20260102'", 2),
        ),
        (
            HEAD + ADDED.replace("first", "First!"),
            ("ledger-value", "slug is 'First!': is no slug", 2),
        ),
        (
            HEAD + ADDED.replace("added", "gone"),
            ("ledger-value", "event is 'gone': Input should be", 2),
        ),
        (HEAD + ADDED.replace("new submission", ""), ("ledger-value", "reason is '': must not be empty", 2)),
        (HEAD + ADDED.replace("new", "=1+1"), ("ledger-value", "reason is '=1+1 submission': must not", 2)),
        (
            HEAD + ADDED.replace("new", "\u202e"),
            ("ledger-value", "reason is '\\u202e submission': has", 2),
        ),
        (HEAD + ADDED.replace("new", "x" * 301), ("ledger-value", "reason is 'xxx", 2)),
        (HEAD + ADDED.replace(ONE, "1"), ("ledger-value", "result_sha256 is '1': String should match", 2)),
        (HEAD + ADDED + ADDED, ("ledger-order", "first is added a second time", 3)),
        (
            HEAD + ADDED.replace("added", "flagged"),
            ("ledger-order", "first is flagged before it", 2),
        ),
        (
            HEAD + ADDED + ADDED.replace("added", "regraded"),
            ("ledger-order", "first is regraded with the result that it had before", 3),
        ),
        (
            HEAD + ADDED + ADDED.replace("added", "flagged").replace(ONE, TWO),
            ("ledger-order", "first is flagged with another result than before", 3),
        ),
        (
            HEAD + ADDED + ADDED.replace("first", "other").replace("01-02", "01-01"),
            ("ledger-order", "is dated 2026-01-01, before the line above it (2026-01-02)", 3),
        ),
        (
            HEAD + ADDED + ADDED.replace("added", "withdrawn") + ADDED.replace("added", "flagged"),
            ("ledger-order", "first is flagged after it was withdrawn", 4),
        ),
    ],
)
def test_each_fault_is_named_with_its_line(text: str | bytes, expected: tuple[str, str, int]) -> None:
    """One fault, one problem, in the line where it is."""
    ((code, message, line),) = complain(text)
    assert (code, line) == (expected[0], expected[2])
    assert message.startswith(expected[1])
    assert message.isprintable()


def test_all_faults_are_named_at_once() -> None:
    """A second fault is not hidden by the first."""
    assert [line for *_, line in complain(f"{HEAD}x\n{ADDED}2026-1-2,A,gone,,0\n")] == [2, 4, 4, 4, 4, 4]


@given(st.binary(max_size=200) | st.text(max_size=200).map(lambda text: (HEAD + text).encode()))
def test_any_bytes_are_a_ledger_or_problems(content: bytes) -> None:
    """Whatever the file holds, the outcome is one of the two."""
    problems = Problems()
    ledger = parse_ledger(content, "ledger.csv", problems)
    assert (ledger is None) == problems.has_errors
    assert ledger is None or render_ledger(ledger.lines).encode() == content


REASONS = st.text(st.characters(categories=["L", "N", "P", "S"]), min_size=1, max_size=40)


@given(st.lists(st.tuples(st.dates(), REASONS), max_size=5))
def test_what_is_rendered_is_read_again(cells: list[tuple[dt.date, str]]) -> None:
    """Quotes, commas and other alphabets survive."""
    lines = []
    for number, (date, reason) in enumerate(sorted(cells)):
        try:
            line = LedgerLine(
                date=date, slug=f"slug-{number}", event="added", reason=reason, result_sha256=ONE
            )
        except ValueError:  # a reason that is not allowed
            continue
        lines.append(line)
    problems = Problems()
    assert parse_ledger(render_ledger(lines).encode(), "x", problems) == Ledger(tuple(lines))


@pytest.fixture
def instance(tmp_path: Path) -> Instance:
    for slug in ("first", "second"):
        (tmp_path / "submissions" / slug).mkdir(parents=True)
    return Instance(tmp_path)


def test_without_a_file_there_are_no_lines_yet(instance: Instance) -> None:
    """A new instance has published nothing, and all that is there may be."""
    problems = Problems()
    assert read_ledger(instance, problems) == Ledger()
    assert [folder.name for folder in published_dirs(instance)] == ["first", "second"]


def test_withdrawn_submissions_leave_the_board(instance: Instance) -> None:
    """Their folder may stay; flagged and superseded ones stay on the board."""
    lines = ADDED + ADDED.replace("added", "withdrawn") + ADDED.replace("first", "second")
    instance.ledger_file.write_text(HEAD + lines + ADDED.replace("first,added", "second,superseded"))
    assert [folder.name for folder in published_dirs(instance)] == ["second"]


def test_a_broken_ledger_publishes_nothing(instance: Instance) -> None:
    """Nobody knows then what left the board."""
    instance.ledger_file.write_text(HEAD + "x\n")
    with pytest.raises(InstanceError, match=r"^submissions/ledger\.csv:2: the line has 1 cell, not 5$"):
        published_dirs(instance)


def test_what_is_no_plain_file_is_not_read(instance: Instance) -> None:
    """A link, a folder and an empty file are no ledgers."""
    problems = Problems()
    instance.ledger_file.symlink_to("/etc/hostname")
    assert read_ledger(instance, problems) is None
    instance.ledger_file.unlink()
    instance.ledger_file.mkdir()
    assert read_ledger(instance, problems) is None
    instance.ledger_file.rmdir()
    instance.ledger_file.touch()
    assert read_ledger(instance, problems) is None
    assert [problem.code for problem in problems] == ["ledger-unreadable"] * 2 + ["ledger-malformed"]


def test_an_enormous_file_is_not_read(instance: Instance, monkeypatch: pytest.MonkeyPatch) -> None:
    """The limit is a thousand times what is ever needed."""
    monkeypatch.setattr("leaderboard.ledger.SIZE_LIMIT", 10)
    instance.ledger_file.write_text(HEAD)
    problems = Problems()
    assert read_ledger(instance, problems) is None
    assert [problem.message for problem in problems] == ["is larger than 10 bytes"]
