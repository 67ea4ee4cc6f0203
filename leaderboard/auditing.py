"""Auditing published numbers: are they possible, do they agree, and do they differ from chance.

Nothing here can be graded again, since nobody published the predictions. What remains is arithmetic: whether
any count of right answers gives the figure, whether the overall is the mean of its parts, what interval a
share of so many trials has. A flag is a fact about a printed figure, not a verdict on its authors: a typing
error or another number of trials than believed explains it as well.
"""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor
from typing import Literal

from leaderboard.metrics.published import (
    Figure,
    can_be_mean,
    chance_p,
    mean_of,
    rounded_counts,
    truncated_counts,
    wilson_interval,
)
from leaderboard.models.benchmark import OVERALL
from leaderboard.models.published import ACCURACY, PublishedNumber

ALPHA = 0.05

Fit = Literal["rounded", "truncated", "impossible"]
Group = tuple[object, ...]

FLAGS = {
    "impossible": "no whole number of right answers out of n gives the figure, rounded or cut off",
    "truncated": "a whole number of right answers gives the figure only if digits were cut off, not rounded",
    "not-the-mean": "the overall cannot be the plain mean of its parts, whatever rounding hides",
    "contradicted": "the source prints another figure for the same number",
    "not-above-chance": f"no better than coin flips: exact p is {ALPHA} or more, or at most half are right",
    "n-unknown": "the number of trials behind the figure is not known, so counts cannot be checked",
}
"""Every flag, in the order in which they are listed, and what it says."""


@dataclass(frozen=True)
class Rights:
    """How many answers can have been right, and what follows from it.

    Attributes
    ----------
    fit
        How k/n gives the figure.
    counts
        The whole numbers k that give it; if none does, its two neighbours.
    interval
        95 % Wilson interval, from the lower bound of the smallest k to the upper bound of the largest.
    p
        Exact two-sided binomial p against 1/2, for the k nearest to n/2.
    is_above_chance
        Whether that k is more than n/2 and p below 0.05.
    """

    fit: Fit
    counts: range
    interval: tuple[float, float]
    p: float
    is_above_chance: bool


@dataclass(frozen=True)
class AuditedNumber:
    """A published number and what was found.

    Attributes
    ----------
    number
        The row.
    rights
        None unless it is an accuracy and the number of trials is known.
    n_parts, mean
        The parts of an overall, and their plain mean as printed; 0 and None for any other number.
    flags
        Words of `FLAGS`, in that order.
    """

    number: PublishedNumber
    rights: Rights | None
    n_parts: int
    mean: Fraction | None
    flags: tuple[str, ...]


def audit(numbers: Sequence[PublishedNumber]) -> tuple[AuditedNumber, ...]:
    """Audit published numbers, in their order.

    Parts of an overall are the other scopes of the same source, system, training, testing, training trials,
    auxiliary and metric. Where all trial counts are known and the parts' do not add up to the overall's, they
    are not its parts.
    """
    groups: dict[Group, list[PublishedNumber]] = defaultdict(list)
    for number in numbers:
        groups[_group_of(number)].append(number)
    return tuple(_audit_number(number, groups[_group_of(number)]) for number in numbers)


def _group_of(number: PublishedNumber) -> Group:
    return (
        number.source,
        number.system,
        number.training,
        number.testing,
        number.training_trials,
        number.auxiliary,
        number.metric,
    )


def _audit_number(number: PublishedNumber, group: Sequence[PublishedNumber]) -> AuditedNumber:
    parts = _find_parts(number, group)
    rights = _find_rights(number)
    same = [other.figure for other in group if other.scope == number.scope]
    found = {
        # An overall may be the mean of rounded parts, so it is held against them and not against k/n.
        "impossible": bool(rights and rights.fit == "impossible" and not parts),
        "truncated": bool(rights and rights.fit == "truncated" and not parts),
        "not-the-mean": bool(parts) and not can_be_mean(number.figure, parts),
        "contradicted": not all(can_be_mean(number.figure, (other,)) for other in same),
        "not-above-chance": rights is not None and not rights.is_above_chance,
        "n-unknown": rights is None and number.metric == ACCURACY,
    }
    flags = tuple(flag for flag in FLAGS if found[flag])
    return AuditedNumber(number, rights, len(parts), mean_of(parts) if parts else None, flags)


def _find_rights(number: PublishedNumber) -> Rights | None:
    n = number.n_trials
    if number.metric != ACCURACY or n is None:
        return None
    fit, counts = _find_counts(number.figure, n)
    nearest = min(max(n // 2, counts[0]), counts[-1])
    p = chance_p(nearest, n)
    low, high = wilson_interval(counts[0] / n, n)[0], wilson_interval(counts[-1] / n, n)[1]
    return Rights(fit, counts, (low, high), p, is_above_chance=2 * nearest > n and p < ALPHA)


def _find_parts(number: PublishedNumber, group: Sequence[PublishedNumber]) -> tuple[Figure, ...]:
    """Find the figures whose mean an overall should be; none if they are fewer than two or not its parts."""
    if number.scope != OVERALL:
        return ()
    parts = {(other.scope, other.figure, other.n_trials) for other in group if other.scope != OVERALL}
    sizes = [n for _, _, n in parts]
    total = sum(n for n in sizes if n is not None)
    is_partition = number.n_trials is None or None in sizes or total == number.n_trials
    is_unique = len({scope for scope, _, _ in parts}) == len(parts) > 1
    return tuple(figure for _, figure, _ in parts) if is_partition and is_unique else ()


def _find_counts(figure: Figure, n: int) -> tuple[Fit, range]:
    if rounded := rounded_counts(figure, n):
        return "rounded", rounded
    if truncated := truncated_counts(figure, n):
        return "truncated", truncated
    return "impossible", range(floor(figure.value * n), ceil(figure.value * n) + 1)
