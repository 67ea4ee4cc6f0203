"""From the features of a trial's frames to features of the trial."""

from collections.abc import Callable
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from leaderboard.errors import SourceError

Array = NDArray[Any]
Pooling = Literal["mean", "max", "last", "flatten", "smallest"]

FRAME_POOLINGS: tuple[Pooling, ...] = ("mean", "max", "last", "flatten")
"""Those for features. Distances have their own: the smallest of all numbers of a trial."""

_WITH_FRAMES = 3  # dimensions: trials, frames, features
_POOL: dict[str, Callable[[Array], Array]] = {
    "mean": lambda block: block.mean(axis=1, dtype=np.float64),
    "max": lambda block: block.max(axis=1),
    "last": lambda block: block[:, -1],
    "flatten": lambda block: block.reshape(len(block), -1),
    "smallest": lambda block: block.reshape(len(block), -1).min(axis=1, keepdims=True),
}


def pool_frames(block: Array, pooling: Pooling | None) -> Array:
    """Turn a block of trials into one row of features each.

    Parameters
    ----------
    block : (n_trials, n_features) or (n_trials, n_frames, n_features)
        Features of some trials.
    pooling
        What becomes of the frames; None where there are none.

    Examples
    --------
    >>> block = np.array([[[1, 2], [3, 5]]])
    >>> pool_frames(block, "mean").tolist(), pool_frames(block, "flatten").tolist()
    ([[2.0, 3.5]], [[1, 2, 3, 5]])
    """
    return block if pooling is None else _POOL[pooling](block)


def pooled_width(shape: tuple[int, ...], pooling: Pooling | None) -> int:
    """Count the features of a trial after pooling.

    >>> pooled_width((192, 30, 64), "mean"), pooled_width((192, 30, 64), "flatten")
    (64, 1920)
    """
    if pooling == "smallest":
        return 1
    return shape[1] * shape[2] if pooling == "flatten" else shape[-1]


def check_pooling(shape: tuple[int, ...], pooling: Pooling | None, name: str) -> None:
    """Insist that it is stated what becomes of frames, where there are frames and only there.

    Raises
    ------
    SourceError
        If the shape and the pooling do not fit.
    """
    if pooling == "smallest":
        return
    plain, framed = "(n_trials, n_features)", "(n_trials, n_frames, n_features)"
    n_dimensions = len(shape)
    if n_dimensions not in (_WITH_FRAMES - 1, _WITH_FRAMES):
        raise SourceError(f"{name}: features have the shape {shape}; it must be {plain} or {framed}")
    if n_dimensions == _WITH_FRAMES and pooling is None:
        hint = f"say what becomes of the frames: --pooling {', '.join(FRAME_POOLINGS[:-1])} or flatten"
        raise SourceError(f"{name}: features have frames, their shape is {shape}", hint)
    if n_dimensions < _WITH_FRAMES and pooling is not None:
        hint = f"leave --pooling {pooling} out, or give features of the shape {framed}"
        raise SourceError(f"{name}: features have no frames to pool, their shape is {shape}", hint)
