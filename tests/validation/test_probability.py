"""What is a probability and what is not."""

import math
from decimal import Decimal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.validation.probability import Fault, parse_probability


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0", 0.0),
        ("1", 1.0),
        ("1.", 1.0),
        (".5", 0.5),
        ("+0.5", 0.5),
        ("00.5", 0.5),
        ("5e-1", 0.5),
        ("5E-01", 0.5),
        ("0.1234567890123456789", 0.1234567890123456789),
        ("0.99999999999999999", 1.0),
        ("1.000000000000000000000", 1.0),
        ("5e-324", 5e-324),
        ("0e999", 0.0),
        ("0.0e-999", 0.0),
    ],
)
def test_plain_numbers_are_read(text: str, value: float) -> None:
    """Decimal and exponent notation with any number of digits give the nearest float64."""
    assert parse_probability(text) == value


def test_minus_zero_is_zero() -> None:
    """The sign of -0 goes nowhere, so that bytes made from it do not differ."""
    value = parse_probability("-0.0")
    assert isinstance(value, float)
    assert math.copysign(1, value) == 1


@given(st.floats(0, 1))
def test_what_python_writes_is_read_bit_for_bit(value: float) -> None:
    """Repr and parse are inverse on all of [0, 1]."""
    assert parse_probability(repr(value)) == value


@pytest.mark.parametrize(
    ("text", "code", "what"),
    [
        ("-1e-300", "probability-out-of-range", "is below 0"),
        ("1.0000000000000002", "probability-out-of-range", "is above 1"),
        ("1.00000000000000001", "probability-out-of-range", "is above 1"),
        ("100000000000000001e-17", "probability-out-of-range", "is above 1"),
        ("50", "probability-out-of-range", "is above 1"),
        ("1e400", "probability-not-finite", "is too large for a number"),
        ("-1e400", "probability-not-finite", "is too large for a number"),
        ("Infinity", "probability-not-finite", "is not finite"),
        ("-INF", "probability-not-finite", "is not finite"),
        ("1e-400", "probability-underflow", "is too small for a number"),
        ("-1e-400", "probability-underflow", "is too small for a number"),
        ("NaN", "probability-not-a-number", "stands for no value"),
        ("N/A", "probability-not-a-number", "stands for no value"),
        ("null", "probability-not-a-number", "stands for no value"),
        ("50 %", "probability-percent", "is a percentage"),
        ("0,5", "probability-decimal-comma", "has a decimal comma"),
        ("TRUE", "probability-not-a-number", "is a word"),
        ("0.5 ", "probability-not-a-number", "has blanks around it"),
        ("\u00a00.5", "probability-not-a-number", "has blanks around it"),
        ("\u0660.\u0665", "probability-not-a-number", "has digits other than 0-9"),
        ("=1/2", "probability-not-a-number", "is a spreadsheet formula"),
        ("1_0", "probability-not-a-number", "is not a plain decimal number"),
        ("0x1p-2", "probability-not-a-number", "is not a plain decimal number"),
        ("1e", "probability-not-a-number", "is not a plain decimal number"),
        (".", "probability-not-a-number", "is not a plain decimal number"),
        ("0.5.5", "probability-not-a-number", "is not a plain decimal number"),
        ("--0.5", "probability-not-a-number", "is not a plain decimal number"),
        ("0.5\n", "probability-not-a-number", "has blanks around it"),
        ("#DIV/0!", "probability-not-a-number", "is not a plain decimal number"),
        ("0" * 401, "probability-not-a-number", "is not a plain decimal number"),
    ],
)
def test_everything_else_is_named_for_what_it_is(text: str, code: str, what: str) -> None:
    """Each common mistake has its code and its words."""
    fault = parse_probability(text)
    assert isinstance(fault, Fault)
    assert (fault.code, fault.what) == (code, what)
    assert fault.hint


@given(st.text(alphabet="0123456789.eE+-_ ,%nax", max_size=12) | st.text(max_size=8))
def test_a_number_is_never_changed_silently(text: str) -> None:
    """What is read is the float64 nearest to the decimal number that is written, and lies in [0, 1]."""
    value = parse_probability(text)
    if isinstance(value, float):
        assert text.isascii()
        assert value == float(Decimal(text))
        assert 0 <= Decimal(text) <= 1
        assert (value == 0) == (Decimal(text) == 0)
