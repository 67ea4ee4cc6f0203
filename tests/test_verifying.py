"""Naming the differences between a committed result and a fresh one."""

import json

import pytest

from leaderboard.verifying import list_differences

FRESH = json.dumps({"a": {"b": 1, "c": None}, "d": [1, 2]}).encode()


def test_equal_bytes_do_not_differ() -> None:
    """Nothing to say."""
    assert list_differences(FRESH, FRESH) == []


@pytest.mark.parametrize(
    ("committed", "difference"),
    [
        (None, "has no result.json"),
        (b"\xff", "result.json is not JSON"),
        (b"[" * 100_000, "result.json is not JSON"),
        (b"[]", " is [], should be "),
        (
            FRESH.replace(b" ", b""),
            "result.json has the right content in other bytes",
        ),
        (FRESH.replace(b'"b": 1', b'"b": true'), "a.b is true, should be 1"),
        (FRESH.replace(b'"b": 1', b'"b": 1.0'), "a.b is 1.0, should be 1"),
        (FRESH.replace(b'"b": 1, ', b""), "a.b is missing"),
        (FRESH.replace(b'"b"', b'"x": 0, "b"'), "a.x should not be there"),
        (FRESH.replace(b"[1, 2]", b"[2, 1]"), "d is [2, 1], should be [1, 2]"),
    ],
)
def test_each_difference_is_named(committed: bytes | None, difference: str) -> None:
    """Where it is, what is there, and what should be."""
    found = list_differences(committed, FRESH)
    assert len(found) == 1
    assert found[0].startswith(difference)


def test_many_differences_are_counted() -> None:
    """Twenty are shown."""
    fresh = {f"key{number:02d}": number for number in range(30)}
    committed = {key: value + 1 for key, value in fresh.items()}
    found = list_differences(json.dumps(committed).encode(), json.dumps(fresh).encode())
    assert len(found) == 21
    assert found[-1] == "... and 10 more differences"


def test_what_is_shown_is_plain_and_short() -> None:
    """A forged key cannot move the cursor or fill the screen."""
    committed = json.dumps({"\x1b[2J" + "x" * 500: "\n::error::" + "y" * 500}).encode()
    (line,) = list_differences(committed, b"{}")
    assert line.isprintable()
    assert len(line) < 120
