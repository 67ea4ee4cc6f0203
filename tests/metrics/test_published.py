"""Arithmetic on printed numbers, against hand-made cases, SciPy and enumeration."""

from fractions import Fraction
from math import comb

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from leaderboard.metrics.published import (
    Figure,
    can_be_mean,
    chance_p,
    mean_of,
    rounded_counts,
    truncated_counts,
    wilson_interval,
)

counts_of_trials = st.integers(1, 1000).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n)))
digits = st.integers(0, 5)


def percent(printed: str) -> Figure:
    """A percentage as printed."""
    decimals = len(printed.partition(".")[2])
    return Figure(Fraction(printed) / 100, Fraction(1, 100 * 10**decimals))


class TestCounts:
    """Which whole numbers of right answers give a figure."""

    @pytest.mark.parametrize(
        ("printed", "n", "rounded", "truncated"),
        [
            ("67.2", 192, [129], []),  # 129/192 = 67.1875 %
            ("67.1", 192, [], [129]),
            ("67.19", 192, [129], []),
            ("75.9", 192, [], []),
            ("59.6", 384, [229], [229]),  # 59.635... %
            ("56.3", 192, [108], []),  # 56.25 %, the half rounded up
            ("56.2", 192, [108], [108]),  # and rounded to even
            ("60", 5, [3], [3]),
            ("50", 1, [], []),
            ("0", 10, [0], [0]),
            ("100", 10, [10], [10]),
            ("60", 1000, list(range(595, 606)), list(range(600, 610))),
        ],
    )
    def test_hand_cases(self, printed: str, n: int, rounded: list[int], truncated: list[int]) -> None:
        """A half may have gone either way; cut off means at least the figure and less than one digit more."""
        assert list(rounded_counts(percent(printed), n)) == rounded
        assert list(truncated_counts(percent(printed), n)) == truncated

    def test_an_exact_share_has_one_count_or_none(self) -> None:
        """What is printed as k/n hides no rounding."""
        exact = Figure(Fraction(229, 384), Fraction(0))
        assert list(rounded_counts(exact, 384)) == list(truncated_counts(exact, 384)) == [229]
        assert not rounded_counts(exact, 192)
        assert not truncated_counts(exact, 192)

    @given(counts_of_trials, digits)
    def test_a_rounded_share_is_never_impossible(self, share: tuple[int, int], decimals: int) -> None:
        """Whatever k/n is printed, rounded as Python rounds fractions, k is among the counts found."""
        k, n = share
        printed = Figure(round(Fraction(k, n), decimals), Fraction(1, 10**decimals))
        assert k in rounded_counts(printed, n)

    @given(counts_of_trials, digits)
    def test_a_truncated_share_is_found_as_such(self, share: tuple[int, int], decimals: int) -> None:
        """Cutting digits off a share gives a figure whose truncated counts hold k."""
        k, n = share
        value = Fraction(k * 10**decimals // n, 10**decimals)
        assert k in truncated_counts(Figure(value, Fraction(1, 10**decimals)), n)

    @given(st.integers(0, 1000), st.integers(1, 400))
    def test_counts_are_those_of_enumeration(self, thousandths: int, n: int) -> None:
        """Trying every k gives the same counts, for rounding and for truncation."""
        value, step = Fraction(thousandths, 1000), Fraction(1, 1000)
        shares = {k: Fraction(k, n) for k in range(n + 1)}
        rounded = [k for k, share in shares.items() if abs(share - value) <= step / 2]
        truncated = [k for k, share in shares.items() if value <= share < value + step]
        assert list(rounded_counts(Figure(value, step), n)) == rounded
        assert list(truncated_counts(Figure(value, step), n)) == truncated


class TestMean:
    """Whether an overall can be the mean of its parts."""

    @pytest.mark.parametrize(
        ("overall", "parts", "possible"),
        [
            ("59.9", ["67.1", "56.3", "55.7", "60.4"], True),  # mean 59.875
            ("56.0", ["60.4", "54.2", "54.2", "69.8"], False),  # mean 59.65
            ("51.9", ["52.1", "52.1", "51.6", "51.6"], True),
            ("50.1", ["50.0", "50.0"], True),  # both can be 50.05
            ("50.2", ["50.0", "50.0"], False),
            ("49.8", ["50.0", "50.0"], False),
            ("50", ["49.6", "50.4"], True),
        ],
    )
    def test_hand_cases(self, overall: str, parts: list[str], *, possible: bool) -> None:
        """The half steps of the overall and, on average, of the parts are all that rounding can hide."""
        assert can_be_mean(percent(overall), tuple(map(percent, parts))) is possible

    @given(st.lists(st.fractions(0, 1), min_size=1, max_size=8), digits, digits)
    def test_a_rounded_mean_of_rounded_parts_is_always_possible(
        self, values: list[Fraction], overall_decimals: int, part_decimals: int
    ) -> None:
        """Nothing is accused that rounding explains."""
        mean = sum(values, Fraction(0)) / len(values)
        overall = Figure(round(mean, overall_decimals), Fraction(1, 10**overall_decimals))
        parts = tuple(Figure(round(v, part_decimals), Fraction(1, 10**part_decimals)) for v in values)
        assert can_be_mean(overall, parts)

    def test_the_mean_is_exact(self) -> None:
        """No float comes between: a third stays a third."""
        parts = tuple(Figure(Fraction(k, 3), Fraction(0)) for k in (0, 1, 2))
        assert mean_of(parts) == Fraction(1, 3)


@given(counts_of_trials)
def test_wilson_interval_is_that_of_scipy(share: tuple[int, int]) -> None:
    """To the last digits, for every count."""
    k, n = share
    expected = stats.binomtest(k, n).proportion_ci(0.95, method="wilson")
    assert wilson_interval(k / n, n) == pytest.approx((expected.low, expected.high), rel=1e-9, abs=1e-12)


@given(counts_of_trials)
def test_wilson_interval_lies_in_the_unit_interval(share: tuple[int, int]) -> None:
    """It holds the share, and mirrors when right and wrong change places."""
    k, n = share
    low, high = wilson_interval(k / n, n)
    assert 0 <= low <= k / n + 1e-12
    assert k / n - 1e-12 <= high <= 1
    assert wilson_interval(1 - k / n, n) == pytest.approx((1 - high, 1 - low), abs=1e-12)


def test_all_or_none_have_an_end_at_one_or_zero() -> None:
    """However it is rounded, the interval of a share of 1 ends there, and that of 0 begins there."""
    for n in range(1, 500):
        assert wilson_interval(1.0, n)[1] <= 1
        assert wilson_interval(0.0, n)[0] >= 0
        assert wilson_interval(1.0, n)[1] == pytest.approx(1, abs=1e-12)
        assert wilson_interval(0.0, n)[0] == pytest.approx(0, abs=1e-12)


@given(counts_of_trials)
def test_chance_p_is_that_of_scipy(share: tuple[int, int]) -> None:
    """The exact two-sided binomial test against one half."""
    k, n = share
    assert chance_p(k, n) == pytest.approx(stats.binomtest(k, n).pvalue, rel=1e-9)


def test_chance_p_is_exact_far_out() -> None:
    """All of 768 right has 2 of 2^768 patterns; no float overflows on the way."""
    assert chance_p(768, 768) == chance_p(0, 768) == 2.0**-767
    assert chance_p(50_000, 100_000) == 1
    exact = Fraction(2 * sum(comb(2000, k) for k in range(901)), 2**2000)
    assert chance_p(900, 2000) == chance_p(1100, 2000) == float(exact)
