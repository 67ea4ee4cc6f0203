"""How scores are printed: percent, points, p-values and plain numbers, and footnotes for what has none."""

from collections.abc import Callable

from leaderboard.grading import Metric
from leaderboard.models import Score
from leaderboard.website.pages import Cell

ABSENT = "\N{EN DASH}"
MINUS = "\N{MINUS SIGN}"
SMALLEST_P = 0.001


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


def show_p(value: float) -> str:
    """Print a p-value with three decimals, and smaller ones as a bound.

    >>> show_p(0.0123), show_p(1e-9)
    ('0.012', '< 0.001')
    """
    return f"{value:.3f}" if value >= SMALLEST_P else f"< {SMALLEST_P}"


SHARES = ("accuracy", "pair_accuracy", "pair_order", "yes_rate")
GAPS = ("human_gap",)


def unit_of(metric: Metric) -> str:
    """Name the unit in which a metric is printed; empty for plain numbers."""
    if metric.name in SHARES:
        return "%"
    return "points" if metric.name in GAPS else ""


def printer_of(metric: Metric) -> Callable[[float], str]:
    """Choose how a metric's values are printed."""
    if metric.is_p_value:
        return show_p
    return {"%": show_percent, "points": show_points}.get(unit_of(metric), show_number)


def show_bound(metric: Metric, value: float) -> str:
    """Print a round value of a metric, such as chance or an end of its range, with its unit and no zeros."""
    unit = unit_of(metric)
    return f"{100 * value:g} {unit}".replace("-", MINUS) if unit else f"{value:g}".replace("-", MINUS)


def show_exactly(value: float) -> str:
    """Print a value as results hold it: six decimals, or all its digits where six lose some.

    >>> show_exactly(0.5), show_exactly(1.5e-9)
    ('0.500000', '1.5e-09')
    """
    text = f"{value:.6f}"
    return text if float(text) == value else repr(value)


class Footnotes:
    """Numbers the reasons why values are missing, in the order in which a page meets them."""

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}

    @property
    def texts(self) -> tuple[str, ...]:
        """The reasons; the first one has number 1."""
        return tuple(self._numbers)

    def cell(self, metric: Metric, score: Score | None, *, absent: str) -> Cell:
        """Print a score, or a dash with the reason why there is none.

        Parameters
        ----------
        absent
            The reason where nothing was graded.
        """
        if score is not None and score.value is not None:
            return Cell(printer_of(metric)(score.value), exact=show_exactly(score.value))
        why = absent if score is None else f"undefined: {score.why}"
        return Cell(ABSENT, why=why, note=self._numbers.setdefault(why, len(self._numbers) + 1))
