"""Streaks and alternation: both formulas against every order there is."""

from collections.abc import Iterator
from itertools import groupby, permutations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.metrics.runs import expect_streaks, measure_runs, runs_p

COUNTS = [(1, 1), (2, 1), (3, 3), (4, 2), (1, 5), (5, 3), (4, 0), (0, 3)]


def every_order(n_ones: int, n_zeros: int) -> Iterator[list[int]]:
    """The lengths of the runs of every order of ones and zeros, each order once."""
    for order in set(permutations([1] * n_ones + [0] * n_zeros)):
        yield [len(list(run)) for _, run in groupby(order)]


@given(st.lists(st.integers(0, 1), max_size=40))
def test_runs_are_the_stretches_of_equal_answers(answers: list[int]) -> None:
    """Their lengths stand in the order of the answers and add up to their number."""
    lengths = measure_runs(np.array(answers, np.int64))
    assert lengths.tolist() == [len(list(run)) for _, run in groupby(answers)]
    assert lengths.dtype == np.int64


@pytest.mark.parametrize(("n_ones", "n_zeros"), COUNTS)
def test_alternation_is_counted_exactly(n_ones: int, n_zeros: int) -> None:
    """The probability of so many runs is the share of the orders that have as many."""
    found = [len(runs) for runs in every_order(n_ones, n_zeros)]
    for n_runs in range(1, n_ones + n_zeros + 2):
        share = sum(count >= n_runs for count in found) / len(found)
        assert runs_p(n_ones, n_zeros, n_runs) == pytest.approx(share, abs=1e-15)


@pytest.mark.parametrize(("n_ones", "n_zeros"), COUNTS)
def test_streaks_are_counted_exactly(n_ones: int, n_zeros: int) -> None:
    """The expected number of long runs is their mean over all orders, and no less than the chance of one."""
    orders = list(every_order(n_ones, n_zeros))
    for length in range(1, n_ones + n_zeros + 1):
        counts = [sum(run >= length for run in runs) for runs in orders]
        expected = expect_streaks(n_ones, n_zeros, length)
        assert expected == pytest.approx(sum(counts) / len(orders), abs=1e-12)
        assert expected >= sum(count > 0 for count in counts) / len(orders) - 1e-12


def test_nobody_alternates_for_long_by_chance() -> None:
    """Thirty-two answers that change every time are two orders of 601,080,390."""
    assert runs_p(16, 16, 32) == 2 / 601_080_390
