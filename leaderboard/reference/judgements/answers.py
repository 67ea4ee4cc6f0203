"""Single cells of people's files: answers in every spelling, what is no answer, and numbers."""

import re
from fractions import Fraction

_YES = frozenset({"yes", "y", "1", "1.0", "true", "t", "hit", "hits", "contact", "touch", "touches"})
_NO = frozenset({"no", "n", "0", "0.0", "false", "f", "miss", "misses", "nocontact", "notouch", "nohit"})
_EMPTY = frozenset(
    {
        *("", "-", "--", "na", "n/a", "nan", "nil", "none", "null", "undefined", "missing"),
        *("next", "continue", "ok", "skip", "skipped", "timeout", "noanswer", "noresponse"),
    }
)

_FRILLS = re.compile(r"[\s_'\"\[\]]+|(?<=[a-z])-(?=[a-z])")
_SHARE = re.compile(r"[0-9]{1,9}(?:\.[0-9]{1,30})?(?:e-[0-9]{1,2})?", re.ASCII)
_COUNT = re.compile(r"([0-9]{1,9})(?:\.0{1,30})?", re.ASCII)


def parse_answer(text: str) -> bool | None:
    """Tell whether a cell says YES (or: right) or NO (or: wrong); None if neither.

    >>> parse_answer(" Yes"), parse_answer("0.0"), parse_answer("no contact"), parse_answer("-1")
    (True, False, False, None)
    """
    plain = _strip_frills(text)
    if plain in _YES:
        return True
    return False if plain in _NO else None


def is_empty(text: str) -> bool:
    """Tell whether a cell holds what experiments write where nobody answered.

    >>> is_empty("Next"), is_empty("NaN"), is_empty("no")
    (True, True, False)
    """
    return _strip_frills(text) in _EMPTY


def is_number(text: str) -> bool:
    """Tell whether a cell is a plain number without sign."""
    return _SHARE.fullmatch(text.strip()) is not None


def parse_share(text: str) -> Fraction | None:
    """Turn a cell into a share of people from 0 to 1, exactly as printed; None if it is none.

    >>> parse_share("0.75"), parse_share("75")
    (Fraction(3, 4), None)
    """
    if not is_number(text):
        return None
    share = Fraction(text.strip())
    return share if share <= 1 else None


def parse_count(text: str) -> int | None:
    """Turn a cell into a number of people; None if it is none.

    >>> parse_count("91"), parse_count("91.0"), parse_count("0.91")
    (91, 91, None)
    """
    match = _COUNT.fullmatch(text.strip())
    return int(match[1]) if match else None


def count_decimals(text: str) -> int:
    """Count the decimals that a share is printed with.

    >>> count_decimals("0.7142"), count_decimals("1"), count_decimals("1e-05")
    (4, 0, 5)
    """
    digits, _, exponent = text.strip().partition("e-")
    return len(digits.partition(".")[2]) + int(exponent or 0)


def _strip_frills(text: str) -> str:
    return _FRILLS.sub("", text.casefold())
