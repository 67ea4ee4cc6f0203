"""How scores are printed: percent, points, p-values and plain numbers, intervals, and footnotes."""

from collections.abc import Callable
from math import isinf

from leaderboard.models import Score
from leaderboard.website.pages import Cell
from leaderboard.website.quantities import Described

EN_DASH = "\N{EN DASH}"
ABSENT = EN_DASH
MINUS = "\N{MINUS SIGN}"
SMALLEST_P = 0.001
SMALLEST_PERCENT = 0.1

SOME_UNDEFINED = "resamples without a value are left out of the interval"


def show_percent(value: float) -> str:
    """Print a share as percent with one decimal.

    >>> show_percent(0.58854)
    '58.9'
    """
    return f"{100 * value:z.1f}".replace("-", MINUS)


def show_points(value: float) -> str:
    r"""Print a difference of shares in percentage points, with its sign.

    >>> show_points(0.0213), ascii(show_points(-0.0213)), show_points(-0.0001)
    ('+2.1', "'\\u22122.1'", '+0.0')
    """
    return f"{100 * value:+z.1f}".replace("-", MINUS)


def show_number(value: float) -> str:
    r"""Print a number with three decimals.

    >>> show_number(0.1234), ascii(show_number(-0.1234)), show_number(-0.0001)
    ('0.123', "'\\u22120.123'", '0.000')
    """
    return f"{value:z.3f}".replace("-", MINUS)


def show_signed(value: float) -> str:
    r"""Print a number with three decimals and its sign.

    >>> show_signed(0.1234), ascii(show_signed(-0.1234)), show_signed(-0.0001)
    ('+0.123', "'\\u22120.123'", '+0.000')
    """
    return f"{value:+z.3f}".replace("-", MINUS)


def show_p(value: float) -> str:
    """Print a p-value with three decimals, and smaller ones as a bound.

    >>> show_p(0.0123), show_p(1e-9)
    ('0.012', '< 0.001')
    """
    return f"{value:.3f}" if value >= SMALLEST_P else f"< {SMALLEST_P}"


def name_p(value: float) -> str:
    """Print a p-value as a statement.

    >>> name_p(0.0123), name_p(1e-9)
    ('p = 0.012', 'p < 0.001')
    """
    return f"p = {show_p(value)}" if value >= SMALLEST_P else f"p {show_p(value)}"


def show_probability(value: float) -> str:
    """Print a probability as percent, close to the ends as a bound unless it is the very end.

    >>> show_probability(0.123), show_probability(0.0004), show_probability(0.9996), show_probability(0.0)
    ('12.3 %', '< 0.1 %', '> 99.9 %', '0 %')
    """
    percent = 100 * value
    if percent in (0, 100):
        return f"{percent:.0f} %"
    if percent < SMALLEST_PERCENT:
        return f"< {SMALLEST_PERCENT} %"
    if percent > 100 - SMALLEST_PERCENT:
        return f"> {100 - SMALLEST_PERCENT} %"
    return f"{percent:.1f} %"


def show_ends(low: str, high: str) -> str:
    r"""Join the printed ends of an interval; with a dash only where no sign can be taken for one.

    >>> ascii(show_ends("61.3", "67.2")), show_ends("+0.9", "+7.2")
    ("'61.3\\u201367.2'", '+0.9 to +7.2')
    """
    has_sign = any(end.startswith((MINUS, "+")) for end in (low, high))
    return f"{low} to {high}" if has_sign else f"{low}{EN_DASH}{high}"


SHARES = ("accuracy", "pair_accuracy", "pair_order", "yes_rate", "best_probability")
GAPS = ("human_gap", "property_gain", "detectable_difference", "accuracy_difference")
SIGNED = ("human_r_difference",)


def unit_of(quantity: Described) -> str:
    """Name the unit in which a number is printed; empty for plain numbers."""
    if quantity.name in SHARES:
        return "%"
    return "points" if quantity.name in GAPS else ""


def printer_of(quantity: Described) -> Callable[[float], str]:
    """Choose how the values of a metric are printed."""
    if quantity.is_p_value:
        return show_p
    if quantity.name in SIGNED:
        return show_signed
    return {"%": show_percent, "points": show_points}.get(unit_of(quantity), show_number)


def show_interval(quantity: Described, score: Score | None) -> str:
    """Print the 95 % interval of a score as its value is printed; nothing where there is none."""
    if score is None or score.value is None or score.low is None or score.high is None:
        return ""
    show = printer_of(quantity)
    return show_ends(show(score.low), show(score.high))


def show_bound(quantity: Described, value: float) -> str:
    """Print a round value of a metric, such as chance or an end of its range, with its unit and no zeros."""
    unit = unit_of(quantity)
    return f"{100 * value:g} {unit}".replace("-", MINUS) if unit else f"{value:g}".replace("-", MINUS)


def show_range(quantity: Described) -> str:
    """Print the range of a metric's values; an infinite end is none."""
    low, high = (show_bound(quantity, end) for end in (quantity.low, quantity.high))
    if isinf(quantity.low):
        return "unbounded" if isinf(quantity.high) else f"at most {high}"
    return f"at least {low}" if isinf(quantity.high) else f"{low} to {high}"


def show_exactly(value: float) -> str:
    """Print a value as results hold it: six decimals, or all its digits where six lose some.

    >>> show_exactly(0.5), show_exactly(1.5e-9)
    ('0.500000', '1.5e-09')
    """
    text = f"{value:.6f}"
    return text if float(text) == value else repr(value)


class Footnotes:
    """Numbers what must be told of single numbers, in the order in which a page meets them.

    That is why a value is missing, and that an interval leaves out resamples without a value.
    """

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}
        self._most_undefined = 0

    @property
    def texts(self) -> tuple[str, ...]:
        """The notes; the first one has number 1."""
        left_out = f"{SOME_UNDEFINED}, {self._most_undefined:,} at most"
        return tuple(left_out if text == SOME_UNDEFINED else text for text in self._numbers)

    def cell(self, quantity: Described, score: Score | None, *, absent: str, remark: str = "") -> Cell:
        """Print a score with its interval, or a dash with the reason why there is none.

        Parameters
        ----------
        absent
            The reason where nothing was graded.
        remark
            Words below the number.
        """
        if score is None or score.value is None:
            why = absent if score is None else f"undefined: {score.why}"
            return Cell(ABSENT, why=why, note=self._number(why))
        interval = show_interval(quantity, score)
        return Cell(
            printer_of(quantity)(score.value),
            exact=show_exactly(score.value),
            interval=interval,
            ends=(show_exactly(score.low or 0), show_exactly(score.high or 0)) if interval else (),
            remark=remark,
            n_undefined=score.undefined_resamples or 0,
            note=self._note_undefined(score.undefined_resamples) if score.undefined_resamples else 0,
        )

    def _note_undefined(self, n_undefined: int) -> int:
        self._most_undefined = max(self._most_undefined, n_undefined)
        return self._number(SOME_UNDEFINED)

    def _number(self, text: str) -> int:
        return self._numbers.setdefault(text, len(self._numbers) + 1)
