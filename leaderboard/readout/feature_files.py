"""Reading features from the files in which people keep them."""

import zipfile
import zlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from leaderboard.errors import SourceError
from leaderboard.readout.features import (
    TRIAL,
    Features,
    choose_columns,
    features_from_columns,
)
from leaderboard.readout.pooling import Array, Pooling
from leaderboard.reference.cells import quote
from leaderboard.reference.source_tables import read_source_table

SUFFIXES = (".npz", ".npy", ".parquet")

_DAMAGED = (ValueError, EOFError, OSError, MemoryError, zipfile.BadZipFile, zlib.error)
_PLAIN_HINT = "save plain arrays: numbers as they are, ids with .astype(str); pickles are never opened"


def read_features(
    path: Path, *, pooling: Pooling | None = None, property_name: str | None = None, with_labels: bool
) -> Features:
    """Read features and what stands beside them.

    - ``.npz``: arrays ``trial_id`` and ``features``, and where known ``pair_id``, ``property``, ``label``.
    - ``.npy``: the features, which stay on disk until they are used; a table of the same name that ends in
      ``.csv`` has the other columns.
    - ``.parquet``: columns of these names; the features are one column of lists, or columns ``feature_...``.

    Parameters
    ----------
    path
        The file.
    pooling
        What becomes of the frames of three-dimensional features.
    property_name
        The property that all trials belong to, in place of a column.
    with_labels
        Whether to read labels. Where not, an array or column of labels is never used.

    Raises
    ------
    SourceError
        If the file is damaged, unsafe or malformed, or features are not finite.
    """
    readers = {".npz": _read_npz, ".npy": _read_npy, ".parquet": _read_parquet}
    if path.suffix not in readers:
        hint = f"give {', '.join(SUFFIXES)}; docs/readout.md says what stands in each"
        raise SourceError(f"{path}: is none of the kinds of files that features are read from", hint)
    return features_from_columns(
        readers[path.suffix](path, with_labels=with_labels),
        name=str(path),
        pooling=pooling,
        property_name=property_name,
        with_labels=with_labels,
    )


def _read_npz(path: Path, *, with_labels: bool) -> Mapping[str, Array]:
    try:
        with path.open("rb") as stream:
            archive = np.load(stream, allow_pickle=False)
            if isinstance(archive, np.ndarray):
                raise SourceError(f"{path}: is one array", "name it .npy, and put a table beside it")
            return {name: archive[name] for name in choose_columns(archive.files, with_labels=with_labels)}
    except _DAMAGED as error:
        raise _refuse(path, error) from None


def _read_npy(path: Path, *, with_labels: bool) -> Mapping[str, Array]:
    try:
        features = np.load(path, mmap_mode="r", allow_pickle=False)
    except _DAMAGED as error:
        raise _refuse(path, error) from None
    if not isinstance(features, np.ndarray):
        features.close()
        raise SourceError(f"{path}: holds several arrays", "name it .npz")
    beside = path.with_suffix(".csv")
    if not beside.exists():
        message = f"is missing: the table with the column {TRIAL}, a row for each row of {path.name}"
        raise SourceError(f"{beside}: {message}")
    table = read_source_table(beside, [TRIAL])
    names = choose_columns(table.header, with_labels=with_labels, with_features=False)
    return {name: np.array([row[name] for row in table.rows]) for name in names} | {"features": features}


def _read_parquet(path: Path, *, with_labels: bool) -> Mapping[str, Array]:
    try:
        import pyarrow as pa
        from pyarrow import parquet
    except ImportError:
        hint = "install it with pip install pyarrow, or save the features as .npz"
        raise SourceError(f"{path}: reading Parquet needs pyarrow, which is not installed", hint) from None
    try:
        with parquet.ParquetFile(path) as file:
            names = choose_columns(file.schema_arrow.names, with_labels=with_labels)
            _require_single(names, path)
            table = file.read(columns=names)
    except (pa.ArrowException, OSError) as error:
        raise SourceError(f"{path}: cannot be read as Parquet: {str(error).splitlines()[0]}") from None
    return {name: _to_array(table.column(name).combine_chunks(), f"{path}: {name}") for name in names}


def _to_array(column: Any, name: str) -> Array:  # noqa: ANN401  (pyarrow ships no types)
    """Turn a column of Arrow's into an array; lists of equal length give it one more dimension."""
    if not hasattr(column, "value_lengths"):
        return np.asarray(column.to_numpy(zero_copy_only=False))
    lengths = column.value_lengths().unique().to_pylist()
    if len(lengths) != 1 or lengths[0] is None:
        raise SourceError(f"{name}: trials have different numbers of values", "give all the same")
    values = _to_array(column.flatten(), name)
    return values.reshape(len(column), lengths[0], *values.shape[1:])


def _require_single(names: Sequence[str], path: Path) -> None:
    for name in names:
        if names.count(name) > 1:
            raise SourceError(f"{path}: has the column {quote(name)} twice", "keep one of them")


def _refuse(path: Path, error: Exception) -> SourceError:
    pickled = "holds pickled Python objects, which could run programs"
    if "Object arrays" in str(error) or "Python objects" in str(error):
        return SourceError(f"{path}: {pickled}", _PLAIN_HINT)
    if "pickled" in str(error):  # NumPy's guess about whatever does not begin like a file of its own
        return SourceError(f"{path}: is no file of NumPy's, or {pickled}", _PLAIN_HINT)
    if isinstance(error, MemoryError):
        hint = "save the features as .npy: they stay on disk until they are read, block by block"
        return SourceError(f"{path}: is larger than the memory, or damaged: {error}", hint)
    return SourceError(f"{path}: is damaged, or no file of NumPy's: {str(error).splitlines()[0]}")
