"""How wide words are, as far as that can be told without their font."""

from functools import cache
from unicodedata import combining, east_asian_width

ELLIPSIS = "\N{HORIZONTAL ELLIPSIS}"
NARROW = frozenset("iljtfr.,:;'|!()[] -")
WIDE = frozenset("mwMW@%")
MEAN_WIDTHS = {"wide": 1.05, "capital": 0.72, "mean": 0.58, "narrow": 0.36}


def estimate_width(text: str, size: float) -> float:
    """Estimate how wide a text is in a common sans-serif font, rather too wide than too narrow."""
    return size * sum(_width_of(letter) for letter in text)


def cut(text: str, width: float, size: float) -> str:
    r"""Cut a text to fit a width, with an ellipsis where something is missing.

    >>> cut("Short", 80, 12), ascii(cut("A name that goes on and on", 80, 12))
    ('Short', "'A name th\\u2026'")
    """
    if estimate_width(text, size) <= width:
        return text
    room, kept = width - size * MEAN_WIDTHS["wide"], ""
    for letter in text:
        room -= size * _width_of(letter)
        if room < 0:
            break
        kept += letter
    return kept.rstrip() + ELLIPSIS


def wrap(text: str, width: float, size: float) -> list[str]:
    """Break a text into lines that fit a width; a word that is too long for any is cut.

    >>> wrap("A text on two lines", 80, 12)
    ['A text on', 'two lines']
    """
    lines: list[str] = []
    for word in text.split():
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and estimate_width(longer, size) <= width:
            lines[-1] = longer
        else:
            lines.append(cut(word, width, size))
    return lines


@cache
def _width_of(letter: str) -> float:
    if combining(letter):
        return 0
    if letter in WIDE or east_asian_width(letter) in "WF":
        return MEAN_WIDTHS["wide"]
    if letter in NARROW:
        return MEAN_WIDTHS["narrow"]
    return MEAN_WIDTHS["capital" if letter.isupper() else "mean"]
