"""What a submission says of itself, judged."""

import datetime as dt

import pytest

from builders import build_benchmark
from leaderboard.models import Metadata
from leaderboard.problems import Problems
from leaderboard.validation.metadata import judge_metadata
from raw_submissions import SUBMISSION_TOML, TODAY


def judge(toml: str, today: dt.date = TODAY) -> tuple[Metadata | None, list[tuple[str, int | None, str]]]:
    problems = Problems()
    metadata = judge_metadata(toml.encode(), build_benchmark(), "f", today, problems)
    return metadata, [(problem.code, problem.line, problem.message) for problem in problems]


def change(old: str, new: str) -> str:
    assert SUBMISSION_TOML.count(old) == 1
    return SUBMISSION_TOML.replace(old, new)


@pytest.mark.parametrize("days", [-400, 0, 1])
def test_a_date_up_to_tomorrow_is_accepted(days: int) -> None:
    """Tomorrow has begun somewhere already."""
    date = TODAY + dt.timedelta(days=days)
    metadata, found = judge(change("2026-05-20", date.isoformat()))
    assert metadata is not None
    assert (metadata.submission.date, found) == (date, [])


def test_the_day_after_tomorrow_is_refused() -> None:
    """With its line, and with today's date for those whose clock is wrong."""
    message = "submission.date 2026-06-03 is in the future; today is 2026-06-01 (UTC)"
    assert judge(change("2026-05-20", "2026-06-03")) == (None, [("date-in-future", 5, message)])


def test_date_and_track_are_judged_beside_other_faults() -> None:
    """One run finds all of them, in the order of lines."""
    toml = change("2026-05-20", "9999-12-31").replace("with_property", "fully_observed").replace("rgb", "x")
    assert [(code, line) for code, line, _ in judge(toml)[1]] == [
        ("date-in-future", 5),
        ("no-track", 8),
        ("unknown-value", 14),
    ]


def test_a_protocol_must_fit_a_track() -> None:
    """The hint names the tracks; baselines stand on all boards and need none."""
    toml = change("with_property", "fully_observed")
    message = "no track takes training separate with testing fully_observed"
    assert judge(toml) == (None, [("no-track", 8, message)])
    metadata, found = judge(toml.replace("object-centric", "baseline"))
    assert metadata is not None
    assert (metadata.is_baseline, found) == (True, [])


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ('team = "Example Lab"', '"team" = 3', 4),
        ('team = "Example Lab"', "  'team'   =   3", 4),
        ("[submission]", "# note\n\n[ submission ]\nteam = 3\n[x]", 4),
        ("[submission]", "links.paper = 3\n[submission]", 1),
        ('name = "Example"', 'name = "\u2028\x85"\n', 2),
    ],
)
def test_keys_are_found_however_they_are_written(old: str, new: str, line: int) -> None:
    """Quoted keys, spaces, comments and dotted keys lead to the right line."""
    assert line in [found_line for _, found_line, _ in judge(change(old, new))[1]]


@pytest.mark.parametrize(
    ("toml", "message"),
    [
        ("a = [1,", "is not TOML: "),
        ("a = " + "[" * 5000, "is nested too deeply"),
        ("a = " + "9" * 5000, "is not TOML: a number has thousands of digits"),
        ("a = 1\na = 2\n", "is not TOML: a key is given twice"),
        ("a = \x07", "is not TOML: a value cannot be read"),
        ("\x1b = 1", "is not TOML: "),
    ],
)
def test_what_is_not_toml_is_one_problem(toml: str, message: str) -> None:
    """Whatever the parser raises becomes one printable message."""
    metadata, found = judge(toml)
    assert metadata is None
    assert [code for code, _, _ in found] == ["toml-syntax"]
    assert found[0][2].startswith(message)
    assert found[0][2].isprintable()


@pytest.mark.parametrize(
    "value",
    ["0x" + "f" * 9000, "[" * 200 + "]" * 200, "{a.b.c = 1}", "nan", "inf", "true", "1979-05-27", "07:32:00"],
)
@pytest.mark.parametrize("key", ["training", "training_trials", "auxiliary"])
def test_values_of_other_kinds_are_refused(key: str, value: str) -> None:
    """Neither size nor kind of a value breaks the judging."""
    training = 'training = "separate"'
    toml = change(training, f"{key} = {value}" if key == "training" else f"{training}\n{key} = {value}")
    metadata, found = judge(toml)
    assert metadata is None
    assert [code for code, _, _ in found] in (["wrong-type"], ["malformed-value"])


def test_deep_dotted_keys_are_refused() -> None:
    """Thousands of levels are neither a crash nor a long wait."""
    _, found = judge(".".join("a" * 20_000) + " = 1\n" + SUBMISSION_TOML)
    assert found == [("toml-syntax", 1, "is nested too deeply")]
    _, found = judge(".".join("a" * 1000) + " = 1\n" + SUBMISSION_TOML)
    assert found == [("unknown-key", None, "a is not a known key")]
