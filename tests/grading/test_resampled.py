"""Metrics from sums on every resample: what rounding may not do."""

import numpy as np

from leaderboard.grading.resampled import RESAMPLED, correlate, limit


def test_a_correlation_stays_within_one_and_without_variance_is_none() -> None:
    """Sums that were rounded lead a digit beyond 1 or -1; where one side does not vary there is no value."""
    xz = np.array([1.0000000000000002, -1.0000000000000002, 0.5, -0.5, 0.0])
    ones = np.ones(5)
    assert correlate(ones, ones, xz).tolist() == [1, -1, 0.5, -0.5, 0]
    flat = np.full(5, np.nan)
    assert np.isnan(correlate(flat, ones, xz)).all()
    assert np.isnan(correlate(ones, flat, xz)).all()
    assert correlate(4 * ones, 9 * ones, 3 * ones).tolist() == [0.5] * 5
    assert xz[0] > 1  # the sums are left as they are, since others use them


def test_limits_are_kept_and_nothing_stays_nothing() -> None:
    """In place, from both sides."""
    values = np.array([-2.0, -0.25, 0.5, 3.0, np.nan])
    assert limit(values, -1, 2) is values
    assert values[:4].tolist() == [-1, -0.25, 0.5, 2]
    assert np.isnan(values[4])


def test_calibration_errors_stay_within_their_range() -> None:
    """The sum of signed excesses may be below 0 on a resample, an error may not."""
    sums = {"label_excess": np.array([-1.0, 1.0, 9.0]), "n": np.full(3, 4.0)}
    assert RESAMPLED["ece"](sums).tolist() == [0, 0.25, 1]
