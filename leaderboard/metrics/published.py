"""What a printed number gives away about the counts behind it; exact, with whole numbers and fractions."""

from dataclasses import dataclass
from fractions import Fraction
from itertools import accumulate
from math import ceil, floor, sqrt
from statistics import NormalDist

Z = NormalDist().inv_cdf(0.975)
"""Half the width of a 95 % interval in standard deviations, 1.96."""


@dataclass(frozen=True)
class Figure:
    """A number as printed: its value, and what one unit of its last digit is worth (0: it is exact).

    67.1 % is ``Figure(Fraction(671, 1000), Fraction(1, 1000))``.
    """

    value: Fraction
    step: Fraction


def rounded_counts(figure: Figure, n: int) -> range:
    """All whole k for which k/n, rounded, prints the figure: the GRIM test; empty if there is none.

    They are those with |k/n - value| <= step/2. A half may have been rounded up or down, so both are taken.
    Source: Brown & Heathers (2017), *The GRIM test*.

    Parameters
    ----------
    figure
        A share as printed, in [0, 1].
    n
        Number of trials, at least 1.

    Examples
    --------
    >>> rounded_counts(Figure(Fraction(672, 1000), Fraction(1, 1000)), 192)
    range(129, 130)
    >>> list(rounded_counts(Figure(Fraction(671, 1000), Fraction(1, 1000)), 192))
    []
    """
    half = figure.step / 2
    return _within(ceil((figure.value - half) * n), floor((figure.value + half) * n), n)


def truncated_counts(figure: Figure, n: int) -> range:
    """All whole k for which k/n, cut off after the last printed digit, gives the figure.

    They are those with value <= k/n < value + step.

    Examples
    --------
    >>> truncated_counts(Figure(Fraction(671, 1000), Fraction(1, 1000)), 192)
    range(129, 130)
    """
    first = ceil(figure.value * n)
    last = ceil((figure.value + figure.step) * n) - 1 if figure.step else floor(figure.value * n)
    return _within(first, last, n)


def can_be_mean(overall: Figure, parts: tuple[Figure, ...]) -> bool:
    """Whether the overall can be the plain mean of its parts before any of them was rounded.

    Each printed figure stands for the interval value ± step/2. The mean of the parts then lies within the
    mean of their values ± the mean of their half steps, and that must meet the overall's own interval.

    Parameters
    ----------
    overall, parts
        Figures as printed; at least one part.

    Examples
    --------
    >>> parts = tuple(Figure(Fraction(k, 10), Fraction(1, 10)) for k in (2, 3))
    >>> can_be_mean(Figure(Fraction(2, 10), Fraction(1, 10)), parts)
    True
    >>> can_be_mean(Figure(Fraction(1, 10), Fraction(1, 10)), parts)
    False
    """
    slack = overall.step / 2 + sum(part.step for part in parts) / (2 * len(parts))
    return abs(overall.value - mean_of(parts)) <= slack


def mean_of(parts: tuple[Figure, ...]) -> Fraction:
    """Plain mean of some figures' values, exact.

    >>> mean_of((Figure(Fraction(1, 2), Fraction(0)), Figure(Fraction(1, 4), Fraction(0))))
    Fraction(3, 8)
    """
    return sum((part.value for part in parts), Fraction(0)) / len(parts)


def wilson_interval(share: float, n: int) -> tuple[float, float]:
    """95 % interval of a share of n independent trials, within [0, 1].

    With z = 1.96: (share + z²/2n ± z sqrt(share (1 - share)/n + z²/4n²)) / (1 + z²/n).
    Source: Wilson (1927), *Probable inference, the law of succession, and statistical inference*.

    Parameters
    ----------
    share
        k/n, in [0, 1].
    n
        Number of trials, at least 1.

    Examples
    --------
    >>> [round(bound, 4) for bound in wilson_interval(0.5, 100)]
    [0.4038, 0.5962]
    """
    centre = share + Z * Z / (2 * n)
    reach = Z * sqrt(share * (1 - share) / n + Z * Z / (4 * n * n))
    scale = 1 + Z * Z / n
    return max((centre - reach) / scale, 0.0), min((centre + reach) / scale, 1.0)


def chance_p(k: int, n: int) -> float:
    """Exact two-sided binomial p of k right of n against 1/2, in [0, 1].

    Both tails are equally large: p = 2 P(at most min(k, n - k) of n coins show heads), or 1 if that is more.
    Patterns of coins are counted in whole numbers and divided once by 2^n.

    Examples
    --------
    >>> chance_p(2, 2), chance_p(0, 4), chance_p(5, 10)
    (0.5, 0.125, 1.0)
    """
    fewer = min(k, n - k)
    # n over 0, n over 1, ..., each from the one before
    patterns = accumulate(range(fewer), lambda count, i: count * (n - i) // (i + 1), initial=1)
    p: float = min(2 * sum(patterns), 2**n) / 2**n  # Python divides whole numbers with one rounding
    return p


def _within(first: int, last: int, n: int) -> range:
    return range(max(first, 0), min(last, n) + 1)
