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
        ("-1e400", "probability-not-finite", "is too far below 0 for a number"),
        ("-0,5", "probability-decimal-comma", "has a decimal comma"),
        (",5", "probability-decimal-comma", "has a decimal comma"),
        ("5,0e-1", "probability-decimal-comma", "has a decimal comma"),
        ("1,234,5", "probability-not-a-number", "is not a plain decimal number"),
        ("\u22120.5", "probability-not-a-number", "has U+2212 MINUS SIGN, which no plain number has"),
        ("0.5\u200b", "probability-not-a-number", "has U+200B ZERO WIDTH SPACE, which no plain number has"),
        ("0.5\ue000", "probability-not-a-number", "has U+E000 (no name), which no plain number has"),
        ("np.float64(0.5)", "probability-not-a-number", "is how Python shows an object"),
        ("tensor(0.5000)", "probability-not-a-number", "is how Python shows an object"),
        ("[0.5]", "probability-not-a-number", "is how Python shows an object"),
        (
            "1" + "0" * 400,
            "probability-not-a-number",
            "has 401 characters; no probability needs more than 400",
        ),
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
        ("0" * 401, "probability-not-a-number", "has 401 characters; no probability needs more than 400"),
        ("x" * 401, "probability-not-a-number", "is not a plain decimal number"),
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


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("1.0000000000000002", "if that comes from rounding, write 1"),
        ("-1e-17", "if that comes from rounding, write 0"),
        ("1.2", "a percentage or a logit? Divide by 100, or apply the logistic function"),
        ("57.9", "a percentage or a logit? Divide by 100, or apply the logistic function"),
        ("-0.1", "a logit? Apply the logistic function"),
        ("250", "write a plain number between 0 and 1, such as 0.5"),
    ],
)
def test_what_lies_outside_gets_fitting_advice(text: str, hint: str) -> None:
    """A sum a hair above 1, a percentage and a logit are mended in different ways."""
    fault = parse_probability(text)
    assert isinstance(fault, Fault)
    assert (fault.code, fault.hint) == ("probability-out-of-range", hint)


SIGNS = st.sampled_from(["", "+", "-"])
DIGITS = st.text("0123456789", min_size=1, max_size=25)
EXPONENTS = st.just("") | st.integers(-400, 400).map("e{}".format) | st.integers(-30, 3).map("E{:+03}".format)
NUMBERS = st.builds(
    lambda sign, whole, fraction, exponent: f"{sign}{whole}{fraction}{exponent}",
    SIGNS,
    DIGITS | st.just("0"),
    st.just("") | DIGITS.map(".{}".format),
    EXPONENTS,
)


@given(NUMBERS)
def test_the_decimal_number_decides(text: str) -> None:
    """A number in [0, 1] is read as its nearest float64; outside, or vanishing, it has the code for that."""
    value, exact = parse_probability(text), Decimal(text)
    if exact != 0 and float(exact) == 0:
        expected = "probability-underflow"
    elif math.isinf(float(exact)):
        expected = "probability-not-finite"
    else:
        expected = "" if 0 <= exact <= 1 else "probability-out-of-range"
    assert (value.code if isinstance(value, Fault) else "") == expected
    if isinstance(value, float):
        assert value.hex() == abs(float(exact)).hex()
