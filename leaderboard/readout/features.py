"""Features of trials as a value, however they were stored."""

import hashlib
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from leaderboard.errors import SourceError
from leaderboard.readout.pooling import Array, Pooling, check_pooling, pool_frames, pooled_width
from leaderboard.reference.cells import quote

Integers = NDArray[np.int64]
Reals = NDArray[np.floating[Any]]

TRIAL, PAIR, PROPERTY, LABEL, FEATURES = "trial_id", "pair_id", "property", "label", "features"
FEATURE_PREFIX = "feature_"

BLOCK_BYTES = 32_000_000  # of a file on disk that are in memory at a time, at least one trial
MAX_SIZE = 1e100  # of one value: squares of larger ones would overflow


@dataclass(frozen=True)
class Origin:
    """Where features came from.

    Attributes
    ----------
    name
        How messages name it.
    shape, dtype
        Of the array as it was stored.
    pooling
        What became of the frames; None where there were none.
    sha256
        Of the array's bytes row by row, in whatever kind of file they are.
    """

    name: str
    shape: tuple[int, ...]
    dtype: str
    pooling: Pooling | None
    sha256: str


@dataclass(frozen=True)
class Features:
    """Features of some trials, and what is said of these.

    Attributes
    ----------
    origin
        Where they came from.
    trial_ids : n_trials texts
        As they were given.
    values : (n_trials, n_features)
        Finite numbers.
    pair_ids, properties : n_trials texts
        None where it is not said.
    labels : (n_trials,)
        0 or 1; None where there are none or they were not asked for.
    """

    origin: Origin
    trial_ids: tuple[str, ...]
    values: Reals
    pair_ids: tuple[str, ...] | None = None
    properties: tuple[str, ...] | None = None
    labels: Integers | None = None


class Columns(Protocol):
    """What a mapping of arrays and a data frame have in common."""

    def keys(self) -> Iterable[str]:
        """Name the columns."""

    def __getitem__(self, name: str, /) -> Any:  # noqa: ANN401  (whatever NumPy can take for an array)
        """Return a column."""


def choose_columns(names: Iterable[str], *, with_labels: bool, with_features: bool = True) -> list[str]:
    """Choose the columns that have a meaning here; whatever else a file holds is not looked at.

    >>> choose_columns(["trial_id", "label", "labels", "feature_0", "frame"], with_labels=False)
    ['trial_id', 'feature_0']
    """
    wanted = {TRIAL, PAIR, PROPERTY} | ({LABEL} if with_labels else set())
    names = list(names)
    if with_features and FEATURES in names:
        return [name for name in names if name in wanted or name == FEATURES]
    return [name for name in names if name in wanted or (with_features and name.startswith(FEATURE_PREFIX))]


def features_from_columns(
    columns: Columns,
    *,
    name: str = "features",
    pooling: Pooling | None = None,
    property_name: str | None = None,
    with_labels: bool,
) -> Features:
    """Take features from a data frame, or from arrays by name.

    Parameters
    ----------
    columns
        ``trial_id``, and where they are known ``pair_id``, ``property`` and ``label``. The features are the
        column ``features``, an array or one list per trial, or else the columns ``feature_...``.
    name
        How messages name it.
    pooling
        What becomes of the frames of three-dimensional features.
    property_name
        The property that all trials belong to, in place of a column.
    with_labels
        Whether to read labels: for the trials that a readout is fitted on, and never for others.

    Raises
    ------
    SourceError
        If a column is missing or malformed, or features are not finite.
    """
    names = [str(key) for key in columns.keys()]  # noqa: SIM118  (a data frame iterates in its own way)
    described = {
        key: np.asarray(columns[key])
        for key in choose_columns(names, with_labels=with_labels, with_features=False)
    }
    if TRIAL not in described:
        raise SourceError(f"{name}: lacks {TRIAL}, the trial of each row; found {_list_names(names)}")
    array = _gather_features(columns, names, name)
    for key, column in described.items():
        if column.shape != array.shape[:1]:
            message = f"{key} has the shape {column.shape} and the features {array.shape}"
            raise SourceError(f"{name}: {message}", "give one for each trial")
    trial_ids = _parse_texts(described[TRIAL], TRIAL, name)
    if len(set(trial_ids)) < len(trial_ids):
        repeated = next(t for index, t in enumerate(trial_ids) if t in trial_ids[:index])
        raise SourceError(f"{name}: trial {quote(repeated)} has two rows", "keep one of them")
    texts = {key: _parse_texts(described[key], key, name) for key in (PAIR, PROPERTY) if key in described}
    return Features(
        *_pool_values(array, trial_ids, pooling, name),
        pair_ids=texts.get(PAIR),
        properties=texts.get(PROPERTY) if property_name is None else (property_name,) * len(trial_ids),
        labels=_parse_labels(described[LABEL], trial_ids, name) if LABEL in described else None,
    )


def _gather_features(columns: Columns, names: Sequence[str], name: str) -> Array:
    if FEATURES in names:
        array = np.asarray(columns[FEATURES])
        if array.dtype.hasobject:  # a list for each trial
            array = _stack([np.asarray(row) for row in array.tolist()], 0, name)
    else:
        keys = [key for key in names if key.startswith(FEATURE_PREFIX)]
        if not keys:
            hint = f"name the array {FEATURES}, or the columns {FEATURE_PREFIX}0, {FEATURE_PREFIX}1, ..."
            raise SourceError(f"{name}: lacks features; found {_list_names(names)}", hint)
        array = _stack([np.asarray(columns[key]) for key in keys], 1, name)
    if not array.size:
        raise SourceError(f"{name}: the features are empty, their shape is {array.shape}")
    if array.dtype.kind not in "biuf":
        raise SourceError(f"{name}: features are of type {array.dtype}; numbers are needed")
    return array


def _stack(arrays: Sequence[Array], axis: int, name: str) -> Array:
    if len({array.shape for array in arrays}) > 1:
        raise SourceError(f"{name}: trials have different numbers of features", "give all the same")
    return np.stack(arrays, axis=axis) if arrays else np.empty(0)


def _pool_values(
    array: Array, trial_ids: Sequence[str], pooling: Pooling | None, name: str
) -> tuple[Origin, tuple[str, ...], Reals]:
    """Read the array once, block by block, to hash, check and pool it."""
    check_pooling(array.shape, pooling, name)
    digest = hashlib.sha256()
    is_single = np.result_type(array.dtype, np.float32) == np.float32  # holds the numbers without rounding
    width = pooled_width(array.shape, pooling)
    values = np.empty((len(array), width), np.float32 if is_single else np.float64)
    step = max(1, BLOCK_BYTES // (math.prod(array.shape[1:]) * array.dtype.itemsize))
    for start in range(0, len(array), step):
        block = np.ascontiguousarray(array[start : start + step])
        digest.update(block.data)
        _check_finite(block, trial_ids[start : start + step], name)
        values[start : start + step] = pool_frames(block, pooling)
    origin = Origin(name, array.shape, str(array.dtype), pooling, digest.hexdigest())
    return origin, tuple(trial_ids), values


def _check_finite(block: Array, trial_ids: Sequence[str], name: str) -> None:
    if block.dtype.kind != "f" or float(np.abs(block).max()) < MAX_SIZE:
        return
    is_sound = (np.abs(block.astype(np.float64)) < MAX_SIZE).reshape(len(block), -1)
    row = int(np.flatnonzero(~is_sound.all(axis=1))[0])
    what = f"{np.count_nonzero(~is_sound[row]):,} of the {math.prod(block.shape[1:]):,} features"
    message = f"{what} of trial {quote(trial_ids[row])} are NaN, infinite or absurdly large"
    hint = "a readout needs finite numbers: mend the model, or leave these features out"
    raise SourceError(f"{name}: {message}", hint)


def _parse_texts(column: Array, key: str, name: str) -> tuple[str, ...]:
    values = column.tolist()
    if column.dtype.kind == "S":
        values = [value.decode("utf-8", "replace") for value in values]
    for row, value in enumerate(values):
        if not isinstance(value, str) or not value:
            raise SourceError(f"{name}: {key} of row {row} (from 0) is {quote(str(value))}; a text is needed")
    return tuple(values)


def _parse_labels(column: Array, trial_ids: Sequence[str], name: str) -> Integers:
    allowed: dict[object, int] = {0: 0, 1: 1, "0": 0, "1": 1}
    values = [allowed.get(value) for value in column.tolist()]
    if None in values:
        row = values.index(None)
        message = f"the label of trial {quote(trial_ids[row])} is {quote(str(column[row]))}"
        raise SourceError(f"{name}: {message}; it must be 0 (NO) or 1 (YES)")
    return np.array(values, np.int64)


def _list_names(names: Sequence[str]) -> str:
    shown = ", ".join(map(quote, names[:8]))
    return f"{shown}, ..." if len(names) > 8 else shown or "nothing"  # noqa: PLR2004
