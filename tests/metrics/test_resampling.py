"""Bootstrap draws that never change, and what is computed from them."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from leaderboard.metrics.resampling import (
    Interval,
    draw_weights,
    on_grid,
    percentile_interval,
)
from leaderboard.metrics.undefined import Undefined

STRATA = np.array([0, 0, 0, 1, 1, 2])
FIRST = [[0, 2, 1, 1, 1, 1], [0, 1, 2, 1, 1, 1], [0, 0, 3, 1, 1, 1], [0, 0, 3, 1, 1, 1]]


def test_the_first_draws_are_these_for_ever() -> None:
    """Committed numbers: a NumPy that drew others would change every interval."""
    assert draw_weights(STRATA, 4, seed=20231105, stream=0).tolist() == FIRST
    assert draw_weights(STRATA, 4, seed=20231105, stream=1).tolist() != FIRST


@pytest.mark.parametrize("n_resamples", [1, 2, 3, 1001, 2500])
@pytest.mark.parametrize("strata", [[0, 0, 0, 1, 1], [2, 7, 2, 7, 7, 2, 2], [1, 0, 0, 1, 3]], ids=str)
def test_strata_take_their_numbers_one_after_the_other(strata: list[int], n_resamples: int) -> None:
    """In ascending order, each as many raw numbers as it needs; half of one that is left over is dropped."""
    bits = np.random.PCG64(np.random.SeedSequence([7, 3]))
    expected = [[0] * len(strata) for _ in range(n_resamples)]
    for stratum in sorted(set(strata)):
        units = [unit for unit, number in enumerate(strata) if number == stratum]
        size = len(units) * n_resamples
        raw = bits.random_raw((size + 1) // 2).tolist()
        numbers = [part for value in raw for part in (value & 0xFFFFFFFF, value >> 32)][:size]
        for position, number in enumerate(numbers):
            expected[position // len(units)][units[(number * len(units)) >> 32]] += 1
    weights = draw_weights(np.array(strata), n_resamples, seed=7, stream=3)
    assert weights.tolist() == expected
    assert weights.dtype == np.uint16


def test_draws_follow_from_the_published_stream_of_pcg64() -> None:
    """The weights are counts of the high bits of raw numbers, computed here one by one."""
    raw = np.random.PCG64(np.random.SeedSequence([7, 3])).random_raw(6)
    numbers = [part for value in raw.tolist() for part in (value & 0xFFFFFFFF, value >> 32)]
    expected = [[0, 0, 0, 0] for _ in range(3)]
    for position, number in enumerate(numbers):
        expected[position // 4][(number * 4) >> 32] += 1
    assert draw_weights(np.zeros(4, np.int64), 3, seed=7, stream=3).tolist() == expected


@given(
    strata=st.lists(st.integers(0, 3), min_size=1, max_size=20),
    n_resamples=st.integers(1, 30),
    seed=st.integers(0, 2**63),
)
def test_each_resample_keeps_the_sizes_of_strata(strata: list[int], n_resamples: int, seed: int) -> None:
    """Whatever the strata, their sizes are kept, and the same seed gives the same draws."""
    groups = np.array(strata)
    weights = draw_weights(groups, n_resamples, seed=seed, stream=0)
    for stratum in set(strata):
        assert (weights[:, groups == stratum].sum(axis=1) == (groups == stratum).sum()).all()
    assert (weights == draw_weights(groups, n_resamples, seed=seed, stream=0)).all()


def test_units_are_drawn_equally_often() -> None:
    """Over many resamples a chi-square test finds nothing."""
    counts = draw_weights(np.zeros(10, np.int64), 20_000, seed=1, stream=0).sum(axis=0)
    assert stats.chisquare(counts).pvalue > 0.001


def test_interval_is_of_the_defined_resamples_and_counts_the_others() -> None:
    """NaN is neither dropped silently nor passed on."""
    resampled = np.concatenate([np.arange(41.0), [np.nan, np.nan]])
    assert percentile_interval(3.0, resampled) == Interval(3.0, 1.0, 39.0, 2)
    for nowhere in (np.full(5, np.nan), np.array([])):
        assert percentile_interval(3.0, nowhere) == Undefined("it has no value in any resample")


@given(
    size=st.integers(1, 3000),
    decimals=st.integers(0, 8),
    order=st.sampled_from(["drawn", "ascending", "tails where nobody looks"]),
    n_undefined=st.integers(0, 50),
    seed=st.integers(0, 2**32),
)
def test_interval_is_that_of_all_values_sorted(
    size: int, decimals: int, order: str, n_undefined: int, seed: int
) -> None:
    """Whatever is left unsorted in the middle: with ties, in any order, with values missing."""
    rng = np.random.default_rng(seed)
    values = rng.normal(size=size).round(decimals)
    if order != "drawn":
        values.sort()
    if order == "tails where nobody looks":
        values[::16] = 0
    expected = np.quantile(values, [0.025, 0.975])
    resampled = np.insert(values, rng.integers(0, size, n_undefined), np.nan)
    found = percentile_interval(0.0, resampled)
    assert isinstance(found, Interval)
    assert (found.low, found.high) == pytest.approx(expected, abs=1e-12)
    assert found.n_undefined == n_undefined


@pytest.mark.parametrize("seed", range(3))
def test_interval_of_a_mean_equals_scipy_bootstrap(seed: int) -> None:
    """On the same data SciPy's percentile interval is the same but for the noise of other draws."""
    data = np.random.default_rng(seed).normal(size=200)
    weights = draw_weights(np.zeros(200, np.int64), 10_000, seed=seed, stream=0)
    ours = percentile_interval(float(data.mean()), weights @ data / 200)
    theirs = stats.bootstrap(
        (data,), np.mean, method="percentile", n_resamples=10_000, rng=np.random.default_rng(seed)
    ).confidence_interval
    assert isinstance(ours, Interval)
    assert (ours.low, ours.high) == pytest.approx((theirs.low, theirs.high), abs=0.006)


@given(st.lists(st.floats(-1, 1), min_size=1, max_size=50), st.permutations(range(50)))
def test_sums_on_a_grid_do_not_depend_on_their_order(values: list[float], order: list[int]) -> None:
    """Products of two numbers on the grid, weighted by whole numbers, add up exactly in any order."""
    gridded = on_grid(np.array(values))
    assert np.abs(gridded - values).max() <= 2.0**-21
    assert (gridded * 2**20 == np.rint(gridded * 2**20)).all()
    terms = gridded * gridded[::-1] * np.arange(1, gridded.size + 1)
    shuffled = terms[[i for i in order if i < terms.size]]
    assert math.fsum(terms) == np.sum(terms) == np.sum(shuffled)
