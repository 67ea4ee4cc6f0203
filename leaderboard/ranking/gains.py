"""What systems gain from inferring properties: the paper's own question."""

from collections.abc import Iterable
from dataclasses import dataclass

from leaderboard.grading import Yardstick
from leaderboard.metrics.exact_tests import paired_p
from leaderboard.metrics.resampling import Interval, percentile_interval
from leaderboard.models import Metadata
from leaderboard.ranking.entries import Entry
from leaderboard.ranking.shares import count_points, denominator, share_out

DECIMALS = 6


@dataclass(frozen=True)
class Gain:
    """Accuracy with property inference minus that of the same system without.

    Attributes
    ----------
    value, low, high
        The difference in overall accuracy with its 95 % interval, in [-1, 1].
    p
        Exact two-sided p of the paired sign-flip test over pairs.
    without
        Slug of the submission without property inference.
    """

    value: float
    low: float
    high: float
    p: float
    without: str


def is_counterpart(with_property: Metadata, without_property: Metadata) -> bool:
    """Tell whether two submissions are one system of one team, trained alike, tested with and without.

    Their protocols say so: testing is ``with_property`` in one and ``without_property`` in the other.
    """
    a, b = with_property, without_property
    same = (a.submission.team, a.submission.system, a.protocol.training) == (
        b.submission.team,
        b.submission.system,
        b.protocol.training,
    )
    return same and (a.protocol.testing, b.protocol.testing) == ("with_property", "without_property")


def find_gains(entries: Iterable[Entry], others: Iterable[Entry], yardstick: Yardstick) -> dict[str, Gain]:
    """Find the property gain of each complete submission with a complete counterpart among others.

    The gains go by slug. Of several counterparts the latest counts, of several of one date the last by slug.
    """
    systems: dict[str, list[Entry]] = {}
    for other in others:
        if other.is_complete and not other.is_baseline:
            systems.setdefault(other.metadata.submission.system, []).append(other)
    gains = {}
    for entry in entries:
        relatives = systems.get(entry.metadata.submission.system, [])
        counterparts = [other for other in relatives if is_counterpart(entry.metadata, other.metadata)]
        if counterparts:
            latest = max(counterparts, key=lambda other: (other.metadata.submission.date, other.slug))
            gains[entry.slug] = _measure_gain(entry, latest, yardstick)
    return gains


def _measure_gain(entry: Entry, other: Entry, yardstick: Yardstick) -> Gain:
    reference = yardstick.reference
    two = [entry.credits, other.credits]
    with_it, without_it = share_out(two, reference)
    points_with, points_without = count_points(two, reference)
    difference = with_it - without_it
    whole = denominator(reference)
    resampled = (difference @ yardstick.draws.pairs) / whole
    interval = percentile_interval(float(difference.sum() / whole), resampled)
    if not isinstance(interval, Interval):
        raise TypeError("a mean over drawn pairs always has a value")
    return Gain(
        value=round(interval.value, DECIMALS),
        low=round(interval.low, DECIMALS),
        high=round(interval.high, DECIMALS),
        p=paired_p(points_with - points_without),
        without=other.slug,
    )
