"""What a probability looks like, and what people write instead."""

import math
import re
import unicodedata
from collections.abc import Callable
from dataclasses import dataclass
from decimal import Decimal

# A sign, digits with or without a point, an exponent: linear time, ASCII digits only.
_NUMBER = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_NON_ZERO = re.compile(r"[1-9]")
_ABSENT = {"nan", "na", "n/a", "null", "none", "nil", "-", "?"}
_INFINITE = {"inf", "infinity"}
_WORDS = {"true", "false", "yes", "no", "y", "n"}
_DECIMAL_COMMA = re.compile(r"[+-]?[0-9]*,[0-9]+(?:e[+-]?[0-9]+)?")
_LONGEST = 400
_ROUNDING = 1e-6  # what sums and softmaxes in single precision may miss 0 and 1 by
_PERCENT = 100

PLAIN = "write a plain number between 0 and 1, such as 0.5"


@dataclass(frozen=True)
class Fault:
    """Why a text is no probability: a code, what is wrong with it, and what to do."""

    code: str
    what: str
    hint: str


def parse_probability(text: str) -> float | Fault:
    """Parse P(YES): a plain decimal or exponent number in [0, 1], in ASCII digits.

    Nothing is rounded into range: numbers too large or too small for float64 are refused.
    -0 becomes 0.

    >>> parse_probability("2.5e-1"), parse_probability("-0.0")
    (0.25, 0.0)
    >>> parse_probability("50%").code
    'probability-percent'
    """
    if _NUMBER.fullmatch(text) is None:
        return _explain(text)
    if len(text) > _LONGEST:
        what = f"has {len(text):,} characters; no probability needs more than {_LONGEST}"
        return Fault("probability-not-a-number", what, PLAIN)
    value = float(text)
    if math.isinf(value):
        side = "large" if value > 0 else "far below 0"
        return Fault("probability-not-finite", f"is too {side} for a number", PLAIN)
    if value == 0 and _NON_ZERO.search(re.split("[eE]", text)[0]):
        return Fault("probability-underflow", "is too small for a number", "write 0")
    if not 0 <= value <= 1 or (value == 1 and Decimal(text) > 1):
        side = "below 0" if value < 0 else "above 1"
        return Fault("probability-out-of-range", f"is {side}", _hint_range(value))
    return value + 0.0


def _hint_range(value: float) -> str:
    """Say what to do about a number that lies a hair, somewhat or far outside 0 to 1."""
    if -_ROUNDING <= value <= 1 + _ROUNDING:
        return f"if that comes from rounding, write {0 if value < 0 else 1}"
    if value < 0:
        return "a logit? Apply the logistic function"
    if value <= _PERCENT:
        return "a percentage or a logit? Divide by 100, or apply the logistic function"
    return PLAIN


def _explain(text: str) -> Fault:
    """Say what a text that is no plain number seems to be."""
    tidy = text.strip().lower()
    for seems_so, fault in _MISTAKES:
        if seems_so(text, tidy):
            return fault
    odd = next((character for character in tidy if not character.isascii()), None)
    if odd is not None:
        what = f"has U+{ord(odd):04X} {unicodedata.name(odd, '(no name)')}, which no plain number has"
        return Fault("probability-not-a-number", what, PLAIN)
    return Fault("probability-not-a-number", "is not a plain decimal number", PLAIN)


# What people write instead of a number: how to know it from the text and its tidied form, and what to say.
_MISTAKES: tuple[tuple[Callable[[str, str], bool], Fault], ...] = (
    (
        lambda text, tidy: text.strip() != text and _NUMBER.fullmatch(tidy) is not None,
        Fault("probability-not-a-number", "has blanks around it", "remove the blanks"),
    ),
    (
        lambda _, tidy: tidy in _ABSENT,
        Fault(
            "probability-not-a-number",
            "stands for no value",
            "give a number; or leave it empty and say in a status column: refused, unparsable or error",
        ),
    ),
    (
        lambda _, tidy: tidy.lstrip("+-") in _INFINITE,
        Fault("probability-not-finite", "is not finite", PLAIN),
    ),
    (
        lambda _, tidy: tidy.endswith("%"),
        Fault("probability-percent", "is a percentage", "divide by 100: 50% is 0.5"),
    ),
    (
        lambda _, tidy: _DECIMAL_COMMA.fullmatch(tidy) is not None,
        Fault("probability-decimal-comma", "has a decimal comma", "write 0.5, not 0,5"),
    ),
    (
        lambda _, tidy: tidy in _WORDS,
        Fault("probability-not-a-number", "is a word", "write 1 for YES and 0 for NO, or better P(YES)"),
    ),
    (
        lambda _, tidy: tidy.startswith(("[", "(", "np.", "array", "tensor")),
        Fault("probability-not-a-number", "is how Python shows an object", "write float(p) instead of p"),
    ),
    (
        lambda _, tidy: any(character.isdigit() and not character.isascii() for character in tidy),
        Fault("probability-not-a-number", "has digits other than 0-9", PLAIN),
    ),
    (
        lambda _, tidy: tidy.startswith("="),
        Fault("probability-not-a-number", "is a spreadsheet formula", "export values, not formulas"),
    ),
)
