"""Sums over the drawn pairs: centred without losing what varies, and divided without warnings."""

import numpy as np

from leaderboard.grading.sums import about_means, share, spread


def test_sums_about_means_are_those_of_a_loop() -> None:
    """For one group of trials and for two with means of their own; neither total nor factors change."""
    rng = np.random.default_rng(1)
    x, z, group = rng.random((6, 9)), rng.random((6, 9)), np.arange(9) % 2
    total = (x * z).sum(axis=1)
    before = total.copy()
    whole = [((a - a.mean()) * (b - b.mean())).sum() for a, b in zip(x, z, strict=True)]
    counts = np.full(6, 9.0)
    assert np.allclose(about_means(total, (x.sum(axis=1), z.sum(axis=1), counts)), whole)
    within = sum(
        np.array(
            [
                ((a[group == g] - a[group == g].mean()) * (b[group == g] - b[group == g].mean())).sum()
                for a, b in zip(x, z, strict=True)
            ]
        )
        for g in (0, 1)
    )
    parts = [
        (x[:, group == g].sum(axis=1), z[:, group == g].sum(axis=1), np.full(6, float((group == g).sum())))
        for g in (0, 1)
    ]
    assert np.allclose(about_means(total, *parts), within)
    assert (total == before).all()


def test_a_spread_that_rounding_leaves_is_none() -> None:
    """A trillionth of the sum of squares or less; a little more is one."""
    squares, n = np.ones(4), np.ones(4)
    left = np.array([0.0, 0.9e-12, 1.1e-12, 0.5])
    found = spread(squares, (np.sqrt(1 - left), n))
    assert np.isnan(found[:2]).all()
    assert np.allclose(found[2:], left[2:], rtol=1e-3)


def test_a_share_of_nothing_is_none() -> None:
    """0 / 0 is NaN and no warning."""
    found = share(np.array([0.0, 1.0]), np.array([0.0, 4.0]))
    assert np.isnan(found[0])
    assert found[1] == 0.25
