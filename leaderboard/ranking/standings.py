"""How sure the ranks of a board are."""

from collections.abc import Sequence
from dataclasses import dataclass

from leaderboard.grading import Yardstick
from leaderboard.grading.draws import find_strata
from leaderboard.metrics.ranks import (
    detectable_difference,
    find_best_group,
    find_best_probabilities,
    find_rank_sets,
    resample_scores,
)
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.ranking.entries import Entry
from leaderboard.ranking.shares import count_points, denominator, share_out

DECIMALS = 6


@dataclass(frozen=True)
class Standing:
    """How sure the rank of a submission is.

    Attributes
    ----------
    low, high
        Its 95 % rank set: the ranks that paired tests against all others do not exclude.
    best_probability
        The share of resamples in which it is the best; ties share.
    is_among_best
        Whether it is the best or not distinguishable from it.
    """

    low: int
    high: int
    best_probability: float
    is_among_best: bool


def find_standings(entries: Sequence[Entry], yardstick: Yardstick) -> tuple[list[Standing], Estimate]:
    """Find the standing of complete submissions, best first, and the smallest difference that can be told.

    Returns
    -------
    standings
        In the order of the entries.
    detectable
        In accuracy, from 0 to 1; undefined with fewer than two different submissions.
    """
    reference = yardstick.reference
    shares = share_out([entry.credits for entry in entries], reference)
    strata = find_strata(reference)
    resampled = resample_scores(shares, yardstick.draws.small_pairs.T)
    sets = find_rank_sets(shares, strata, resampled).tolist()
    best = find_best_probabilities(resampled).tolist()
    group = find_best_group(count_points([entry.credits for entry in entries], reference), best=0).tolist()
    detectable = detectable_difference(shares, strata)
    standings = [
        Standing(low, high, round(probability, DECIMALS), is_in)
        for (low, high), probability, is_in in zip(sets, best, group, strict=True)
    ]
    if isinstance(detectable, Undefined):
        return standings, detectable
    return standings, round(detectable / denominator(reference), DECIMALS)
