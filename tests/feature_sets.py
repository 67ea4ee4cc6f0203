"""Simulated features of a readout's own trials and of the test trials, with a known signal or none."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from leaderboard.files import csv_text
from leaderboard.readout import Features, features_from_columns
from leaderboard.readout.matching import FittingSet, TargetSet
from leaderboard.reference import Reference

Arrays = dict[str, NDArray[Any]]


def name_pairs(n_pairs: int, scenario: str = "readout") -> tuple[list[str], list[str]]:
    """Name the trials of some pairs, and each trial's pair."""
    pairs = [f"{scenario}/set=x/{number:04d}" for number in range(n_pairs) for _ in (0, 1)]
    copies = [f"-copy{copy}/" for _ in range(n_pairs) for copy in (0, 1)]
    return [pair.replace("/", copy, 1) for pair, copy in zip(pairs, copies, strict=True)], pairs


def draw_labels(n_pairs: int, rng: np.random.Generator) -> NDArray[np.int64]:
    """Let one member of each pair, chosen at random, end with YES."""
    first = rng.integers(0, 2, n_pairs)
    return np.stack([first, 1 - first], axis=1).ravel()


def draw_features(
    labels: NDArray[np.int64], rng: np.random.Generator, *, n_features: int = 8, signal: float = 0.0
) -> NDArray[np.float64]:
    """Draw noise in which members of a pair resemble each other, and a first feature that tells the label.

    The best possible accuracy is that of ``signal`` standard deviations between the two outcomes.
    """
    n_pairs = len(labels) // 2
    values = rng.normal(size=(len(labels), n_features))
    values[:, 1:] += 2 * np.repeat(rng.normal(size=(n_pairs, n_features - 1)), 2, axis=0)
    values[:, 0] += signal * (labels - 0.5)
    return values


def simulate_sets(
    seed: int, *, n_pairs: int = 20, n_test: int = 40, n_features: int = 8, signal: float = 0.0
) -> tuple[FittingSet, TargetSet, NDArray[np.int64]]:
    """Draw trials to fit on, test trials, and the labels of the test trials."""
    rng = np.random.default_rng(seed)
    trial_ids, pair_ids = name_pairs(n_pairs)
    labels, hidden = draw_labels(n_pairs, rng), draw_labels(n_test // 2, rng)
    drawn = [draw_features(y, rng, n_features=n_features, signal=signal) for y in (labels, hidden)]
    fitting = FittingSet("Alpha", tuple(trial_ids), tuple(pair_ids), drawn[0], labels)
    return fitting, TargetSet(tuple(f"t{n}" for n in range(n_test)), drawn[1]), hidden


def simulate_files(
    reference: Reference, *, seed: int = 0, n_pairs: int = 10, n_features: int = 6, signal: float = 3.0
) -> tuple[dict[str, Arrays], Arrays]:
    """Draw the arrays of a file to fit on for each property, and of one file of all test trials."""
    rng = np.random.default_rng(seed)
    fitting: dict[str, Arrays] = {}
    for property_ in reference.benchmark.properties:
        trial_ids, _ = name_pairs(n_pairs, f"{property_.name.lower()}_readout")
        labels = draw_labels(n_pairs, rng)
        features = draw_features(labels, rng, n_features=n_features, signal=signal)
        fitting[property_.name] = {
            "trial_id": np.array(trial_ids),
            "label": labels,
            "features": features.astype(np.float32),
        }
    features = draw_features(reference.labels, rng, n_features=n_features, signal=signal)
    test = {"trial_id": np.array(reference.trial_ids), "features": features.astype(np.float32)}
    return fitting, test


def simulate_readout(reference: Reference, **options: Any) -> tuple[list[Features], list[Features]]:
    """Take the same arrays as features."""
    fitting, test = simulate_files(reference, **options)
    return (
        [
            features_from_columns(arrays, name=name, property_name=name, with_labels=True)
            for name, arrays in fitting.items()
        ],
        [features_from_columns(test, name="test", with_labels=False)],
    )


def write_npz(path: Path, arrays: Mapping[str, NDArray[Any]], *, pickles: bool = False) -> Path:
    """Write arrays as an ``.npz`` file."""
    np.savez(path, allow_pickle=pickles, **arrays)
    return path


def write_npy(path: Path, arrays: Mapping[str, NDArray[Any]]) -> Path:
    """Write the features as an ``.npy`` file, and the other columns as a table beside it."""
    np.save(path, arrays["features"])
    columns = {name: column for name, column in arrays.items() if name != "features"}
    text = csv_text(list(columns), zip(*columns.values(), strict=True))
    path.with_suffix(".csv").write_text(text, encoding="utf-8")
    return path


def write_parquet(path: Path, arrays: Mapping[str, NDArray[Any]]) -> Path:
    """Write the arrays as columns of a Parquet file, features as lists."""
    import pyarrow as pa
    from pyarrow import parquet

    columns: dict[str, Sequence[Any]] = {name: array.tolist() for name, array in arrays.items()}
    parquet.write_table(pa.table(columns), path)
    return path


WRITERS: dict[str, Callable[[Path, Mapping[str, NDArray[Any]]], Path]] = {
    ".npz": write_npz,
    ".npy": write_npy,
    ".parquet": write_parquet,
}
