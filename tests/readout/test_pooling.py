"""From frames to features of a trial."""

import numpy as np
import pytest

from leaderboard.errors import SourceError
from leaderboard.readout.pooling import Pooling, check_pooling, pool_frames, pooled_width

BLOCK = np.array([[[1.0, 8.0], [3.0, 4.0]], [[0.0, 0.0], [5.0, -1.0]]])  # (trials, frames, features)


@pytest.mark.parametrize(
    ("pooling", "expected"),
    [
        ("mean", [[2.0, 6.0], [2.5, -0.5]]),
        ("max", [[3.0, 8.0], [5.0, 0.0]]),
        ("last", [[3.0, 4.0], [5.0, -1.0]]),
        ("flatten", [[1.0, 8.0, 3.0, 4.0], [0.0, 0.0, 5.0, -1.0]]),
        ("smallest", [[1.0], [-1.0]]),
    ],
)
def test_each_way_of_pooling(pooling: Pooling, expected: list[list[float]]) -> None:
    """Each way gives the numbers that one finds by hand, and as many as it says."""
    assert pool_frames(BLOCK, pooling).tolist() == expected
    assert pooled_width(BLOCK.shape, pooling) == len(expected[0])


def test_mean_of_low_precision_is_computed_in_high() -> None:
    """The mean of half-precision frames neither overflows nor loses digits."""
    block = np.full((1, 100, 1), 60000.0, np.float16)
    assert pool_frames(block, "mean").tolist() == [[float(np.float16(60000.0))]]


@pytest.mark.parametrize(
    ("shape", "pooling", "message"),
    [
        ((4, 3, 2), None, r"features have frames, their shape is \(4, 3, 2\)"),
        ((4, 3), "mean", r"features have no frames to pool, their shape is \(4, 3\)"),
        ((4,), None, r"features have the shape \(4,\); it must be \(n_trials, n_features\) or"),
        ((4, 3, 2, 1), "mean", r"features have the shape \(4, 3, 2, 1\)"),
    ],
)
def test_pooling_must_fit_the_shape(shape: tuple[int, ...], pooling: Pooling | None, message: str) -> None:
    """Frames are pooled only in a stated way, and nothing else is."""
    with pytest.raises(SourceError, match=rf"^file: {message}"):
        check_pooling(shape, pooling, "file")


@pytest.mark.parametrize("shape", [(4,), (4, 3), (4, 3, 2), (4, 3, 2, 2)])
def test_distances_may_have_any_shape(shape: tuple[int, ...]) -> None:
    """Distances per trial, per frame, or per frame and pair of particles all have a smallest."""
    check_pooling(shape, "smallest", "file")
    assert pool_frames(np.ones(shape), "smallest").shape == (4, 1)
