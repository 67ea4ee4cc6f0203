"""Single cells of people's files."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.reference.judgements.answers import (
    count_decimals,
    is_empty,
    is_number,
    parse_answer,
    parse_count,
    parse_share,
)


@pytest.mark.parametrize(
    "text", ["YES", "yes", "y", "1", "1.0", "True", "T", " hit ", "contact", '"YES"', "['yes']"]
)
def test_every_spelling_of_yes_is_understood(text: str) -> None:
    """Words, numbers and truth values, in any case and with quotes, blanks or brackets around them."""
    assert parse_answer(text) is True


@pytest.mark.parametrize(
    "text", ["NO", "no", "n", "0", "0.0", "False", "f", "miss", "no contact", "no-contact"]
)
def test_every_spelling_of_no_is_understood(text: str) -> None:
    """The same for NO."""
    assert parse_answer(text) is False


@pytest.mark.parametrize(
    "text", ["", " ", "Next", "NaN", "null", "undefined", "continue", "N/A", "None", "-"]
)
def test_what_stands_where_nobody_answered_is_no_answer(text: str) -> None:
    """Empty cells, missing values of other programs, and screens that are clicked away."""
    assert is_empty(text)
    assert parse_answer(text) is None


@pytest.mark.parametrize("text", ["maybe", "-1", "2", "0.5", "10", "not", "yesno", "\u0661"])
def test_nothing_else_is_guessed(text: str) -> None:
    """What is neither YES nor NO nor empty stays unknown, a minus sign included."""
    assert parse_answer(text) is None
    assert not is_empty(text)


@given(st.text())
def test_every_cell_is_one_thing(text: str) -> None:
    """No text is an answer and empty at once, and none raises."""
    assert not (is_empty(text) and parse_answer(text) is not None)
    if parse_share(text) is not None:
        assert is_number(text)
        assert count_decimals(text) >= 0


def test_shares_are_exact_and_counts_are_whole() -> None:
    """Shares keep their digits and stay within 0 and 1; counts may have been made floats by a program."""
    assert parse_share("0.7142857142857143") == Fraction(7142857142857143, 10**16)
    assert parse_share("1e-05") == Fraction(1, 100_000)
    assert [parse_share(text) for text in ("1.01", "-0.1", "84", "", "half")] == [None] * 5
    assert [parse_count(text) for text in ("91", "91.0", "0")] == [91, 91, 0]
    assert [parse_count(text) for text in ("91.5", "-1", "1e3", "", "9999999999")] == [None] * 5
