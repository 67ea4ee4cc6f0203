"""How sure ranks are, against plain loops over resamples and hand-computed cases."""

import itertools
from random import Random
from statistics import NormalDist

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from leaderboard.metrics.ranks import (
    detectable_difference,
    find_best_group,
    find_best_probabilities,
    find_rank_sets,
    holm_adjust,
    resample_scores,
)
from leaderboard.metrics.resampling import draw_weights
from leaderboard.metrics.undefined import Undefined

Integers = NDArray[np.int64]

STRATA = np.repeat([0, 1, 2], [4, 5, 3])
WEIGHTS = draw_weights(STRATA, 200, seed=5, stream=0).astype(np.float64)
SHARES = st.lists(st.lists(st.integers(0, 2), min_size=12, max_size=12), min_size=2, max_size=6).map(np.array)


def rank_sets(shares: Integers, strata: Integers, weights: NDArray[np.float64]) -> Integers:
    """Find the rank sets on these resamples."""
    return find_rank_sets(shares, strata, resample_scores(shares, weights))


def loop_over_rank_sets(shares: Integers) -> list[list[int]]:
    """Do the same one system, one rival and one resample at a time, with standard errors pair by pair."""
    sets = []
    for i in range(len(shares)):
        statistics, largest = [], [0.0] * len(WEIGHTS)
        for j in range(len(shares)):
            difference = (shares[j] - shares[i]).astype(float)
            error = (
                sum(
                    ((difference[s == STRATA] - difference[s == STRATA].mean()) ** 2).sum()
                    for s in set(STRATA)
                )
                ** 0.5
            )
            total = difference.sum()
            if error < 1e-9:
                statistics.append(np.sign(total) * np.inf if total else 0.0)
                continue
            statistics.append(total / error)
            for b, weights in enumerate(WEIGHTS):
                largest[b] = max(largest[b], abs((weights * difference).sum() - total) / error)
        critical = float(np.quantile(largest, 0.95)) * (1 + 1e-6)  # an equal one is not significant
        better = sum(t > critical for t in statistics)
        worse = sum(t < -critical for t in statistics)
        sets.append([1 + better, len(shares) - worse])
    return sets


@given(SHARES)
def test_rank_sets_equal_a_loop_over_systems_rivals_and_resamples(shares: Integers) -> None:
    """With ties, equal systems, and differences that are the same on every pair."""
    assert rank_sets(shares, STRATA, WEIGHTS).tolist() == loop_over_rank_sets(shares)


@given(SHARES)
def test_a_rank_set_holds_the_ranks_that_the_scores_give(shares: Integers) -> None:
    """All ranks that ties could be given are inside."""
    scores = shares.sum(axis=1)
    for score, (low, high) in zip(scores, rank_sets(shares, STRATA, WEIGHTS), strict=True):
        assert low <= 1 + (scores > score).sum()
        assert (scores >= score).sum() <= high


@given(SHARES, st.randoms(use_true_random=False))
def test_the_order_of_systems_does_not_matter(shares: Integers, random: Random) -> None:
    """Everything moves with the systems."""
    order = list(range(len(shares)))
    random.shuffle(order)
    turned = shares[order]
    assert (rank_sets(turned, STRATA, WEIGHTS) == rank_sets(shares, STRATA, WEIGHTS)[order]).all()
    found = find_best_probabilities(resample_scores(turned, WEIGHTS))
    assert found == pytest.approx(find_best_probabilities(resample_scores(shares, WEIGHTS))[order])


def test_a_clearly_better_system_has_the_first_rank_alone() -> None:
    """And the worse ones share the others."""
    shares = np.array([[2] * 11 + [1], [0, 1] * 6, [1, 0] * 6])
    assert rank_sets(shares, STRATA, WEIGHTS).tolist() == [[1, 1], [2, 3], [2, 3]]


def test_one_system_has_rank_one() -> None:
    """There is nobody to compare it with."""
    assert rank_sets(np.ones((1, 12), np.int64), STRATA, WEIGHTS).tolist() == [[1, 1]]
    assert find_best_probabilities(resample_scores(np.ones((1, 12), np.int64), WEIGHTS)).tolist() == [1.0]
    assert find_best_group(np.ones((1, 12), np.int64), 0).tolist() == [True]


def test_sixty_copies_are_one_system_that_takes_sixty_ranks() -> None:
    """Copies get the same set, and a worse system comes after all of them."""
    shares = np.array([[2, 1] * 6] * 60 + [[0, 0] * 6])
    sets = rank_sets(shares, STRATA, WEIGHTS).tolist()
    assert sets == [[1, 60]] * 60 + [[61, 61]]
    assert find_best_probabilities(resample_scores(shares, WEIGHTS))[:60] == pytest.approx(1 / 60)


def test_many_systems_are_compared_on_fewer_resamples() -> None:
    """The work is bounded, and the sets still hold the observed ranks."""
    rng = np.random.default_rng(1)
    shares = rng.binomial(2, 0.6, (900, 12))
    weights = draw_weights(STRATA, 1500, seed=1, stream=0).astype(np.float64)
    sets, scores = rank_sets(shares, STRATA, weights), shares.sum(axis=1)
    assert (sets[:, 0] <= 1 + (scores > scores[:, None]).sum(axis=1)).all()


@given(SHARES, st.sampled_from([1, 10**6]))
def test_scores_on_resamples_are_whole_and_exact(shares: Integers, unit: int) -> None:
    """Also beyond what float32 holds."""
    found = resample_scores(unit * shares, WEIGHTS)
    assert found.dtype == (np.float32 if unit * shares.max() * 12 < 2**24 else np.float64)
    assert (found == unit * shares @ WEIGHTS.T.astype(np.int64)).all()


@given(SHARES)
def test_chances_to_be_the_best_equal_a_loop_and_add_up_to_one(shares: Integers) -> None:
    """In each resample the best share the win."""
    wins = np.zeros(len(shares))
    for weights in WEIGHTS:
        scores = (shares * weights.astype(int)).sum(axis=1)
        wins += (scores == scores.max()) / (scores == scores.max()).sum()
    found = find_best_probabilities(resample_scores(shares, WEIGHTS))
    assert found == pytest.approx(wins / len(WEIGHTS))
    assert found.sum() == pytest.approx(1)


def test_holm_by_hand() -> None:
    """Four p-values: 4 p, 3 p, 2 p, p, never falling and at most 1."""
    assert holm_adjust(np.array([0.01, 0.04, 0.03, 0.005])) == pytest.approx([0.03, 0.06, 0.06, 0.02])
    assert holm_adjust(np.array([0.9, 0.8])).tolist() == [1.0, 1.0]
    assert holm_adjust(np.array([])).tolist() == []


def enumerate_p(differences: Integers) -> float:
    """Try every pattern of signs."""
    patterns: list[int] = [
        sum(s * d for s, d in zip(signs, differences, strict=True))
        for signs in itertools.product((1, -1), repeat=len(differences))
    ]
    reached = sum(abs(pattern) >= abs(int(differences.sum())) for pattern in patterns)
    return reached / len(patterns)


@given(st.lists(st.lists(st.integers(0, 2), min_size=8, max_size=8), min_size=2, max_size=4).map(np.array))
def test_the_best_group_equals_enumeration_with_holm(shares: Integers) -> None:
    """Each rival of the best by all patterns of signs, corrected step by step."""
    best = int(np.argmax(shares.sum(axis=1)))
    rivals = [i for i in range(len(shares)) if i != best]
    p = {i: enumerate_p(shares[best] - shares[i]) for i in rivals}
    expected, reached = {best: True}, 0.0
    for place, i in enumerate(sorted(rivals, key=lambda i: p[i])):
        reached = max(reached, p[i] * (len(rivals) - place))
        expected[i] = reached >= 0.05
    assert find_best_group(shares, best).tolist() == [bool(expected[i]) for i in range(len(shares))]


def test_the_detectable_difference_by_hand() -> None:
    """One stratum, two systems: the sum of squares about the mean difference, times 1.96 + 0.84."""
    shares = np.array([[2, 0, 1, 1], [1, 1, 1, 0]])  # differences 1, -1, 0, 1 about their mean 1/4: 2.75
    z = NormalDist().inv_cdf(0.975) + NormalDist().inv_cdf(0.8)
    assert detectable_difference(shares, np.zeros(4, np.int64)) == pytest.approx(z * 2.75**0.5)
    alone = detectable_difference(shares[:1], np.zeros(4, np.int64))
    assert alone == Undefined("there are fewer than two different systems")


def test_a_difference_that_is_the_same_on_every_pair_of_a_stratum_is_significant() -> None:
    """It has no error: 1 more on each pair of one stratum puts a system before its rival, both ways."""
    rival = np.array([3, 7, 1, 5, 2, 9, 4, 6, 8, 1, 0, 2]) * 1001
    better = rival + (STRATA == 0)
    assert rank_sets(np.array([rival, better]), STRATA, WEIGHTS).tolist() == [[2, 2], [1, 1]]


@pytest.mark.parametrize("step", [1, 1001])
def test_one_more_on_a_pair_that_is_always_drawn_is_significant(step: int) -> None:
    """A stratum of one pair has no error, however small the difference on it."""
    strata = np.array([0] * 11 + [1])
    weights = draw_weights(strata, 200, seed=5, stream=0).astype(np.float64)
    rival = np.array([3, 7, 1, 5, 2, 9, 4, 6, 8, 1, 0, 2])
    better = rival + step * (strata == 1)
    for shares, sets in (([rival, better], [[2, 2], [1, 1]]), ([better, rival], [[1, 1], [2, 2]])):
        assert rank_sets(np.array(shares), strata, weights).tolist() == sets
    other = np.append(rival[10::-1], rival[11])  # as good as the rival, and far from it on most pairs
    found = rank_sets(np.array([rival, better, other]), strata, weights).tolist()
    assert found[:2] == [[2, 3], [1, 2]] if step == 1 else [[2, 3], [1, 1]]


def test_without_systems_or_pairs_there_are_no_scores() -> None:
    """An empty board is no error."""
    assert resample_scores(np.zeros((0, 12), np.int64), WEIGHTS).shape == (0, 200)
    assert resample_scores(np.zeros((2, 0), np.int64), np.zeros((5, 0))).tolist() == [[0] * 5] * 2


def test_equal_scores_without_error_are_not_significant() -> None:
    """1 more on each pair of one stratum, 1 less on each of another of the same size: nobody is better."""
    strata = np.repeat([0, 1], 6)
    weights = draw_weights(strata, 200, seed=5, stream=0).astype(np.float64)
    first = np.array([3, 7, 1, 5, 2, 9, 4, 6, 8, 1, 0, 2])
    second = first + np.where(strata == 0, 1, -1)
    assert rank_sets(np.array([first, second]), strata, weights).tolist() == [[1, 2], [1, 2]]


def test_the_best_group_is_drawn_at_five_percent() -> None:
    """Ahead on n pairs and never behind, p is 2 / 2^n: 1/16 for 5 pairs is in, 1/32 for 6 is out."""
    best = np.ones(8, np.int64)
    for n_ahead, is_in in [(5, True), (6, False)]:
        rival = np.where(np.arange(8) < n_ahead, 0, 1)
        assert find_best_group(np.array([best, rival]), 0).tolist() == [True, is_in]


def test_the_detectable_difference_is_a_root_mean_square() -> None:
    """Of three systems: by hand, sums of squares about the mean differences are 4, 4 and 16."""
    shares = np.array([[1, 1, 1, 1], [2, 0, 2, 0], [0, 2, 0, 2]])
    z = NormalDist().inv_cdf(0.975) + NormalDist().inv_cdf(0.8)
    found = detectable_difference(shares, np.zeros(4, np.int64))
    assert found == pytest.approx(z * ((4 + 4 + 16) / 3) ** 0.5)


def test_many_systems_use_the_first_thousand_resamples() -> None:
    """900 different systems: what comes after the first 1,000 resamples changes nothing."""
    rng = np.random.default_rng(1)
    shares = np.unique(rng.binomial(2, np.linspace(0.2, 0.8, 900)[:, None], (900, 12)), axis=0)
    weights = draw_weights(STRATA, 1500, seed=1, stream=0).astype(np.float64)
    assert len(shares) > 775  # 600,000,000 / 775^2 is 999
    others = weights.copy()
    others[1000:] = 1
    fewer = rank_sets(shares, STRATA, weights[:1000])
    assert (rank_sets(shares, STRATA, weights) == fewer).all()
    assert (rank_sets(shares, STRATA, others) == fewer).all()


def test_a_hundred_systems_use_every_resample() -> None:
    """What comes after the first 1,000 resamples counts, up to 60,000 of them."""
    rng = np.random.default_rng(1)
    shares = np.unique(rng.binomial(2, np.linspace(0.2, 0.8, 100)[:, None], (100, 12)), axis=0)
    resampled = resample_scores(shares, draw_weights(STRATA, 1000, seed=1, stream=0))
    still = np.repeat(shares.sum(axis=1)[:, None], 40_000, axis=1).astype(resampled.dtype)
    narrow = find_rank_sets(shares, STRATA, np.hstack([resampled, still]))
    wide = find_rank_sets(shares, STRATA, resampled)
    assert (wide[:, 1] - wide[:, 0]).mean() > 3 * (narrow[:, 1] - narrow[:, 0]).mean()
