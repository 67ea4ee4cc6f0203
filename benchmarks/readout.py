"""Time the readout beside plain scikit-learn, measure its memory, and prove by simulation that it is fair.

Run with `python benchmarks/readout.py`; `--only NAME` runs one part. Features are simulated with fixed seeds.

- `speed`: four properties with 192 trials to fit on and 192 test trials of 4,096 features each, in files.
  Beside it, plain scikit-learn: StandardScaler and LogisticRegressionCV on all features, the same folds,
  strengths and seeds, with and without the held-out predictions that the report needs.
- `memory`: one property of 192 x 100,000 float32 features from memory-mapped files, in a process of its own.
- `chance`: 200 seeds without a signal in 256 features; accuracy on held-out and on 2,000 fresh trials.
- `signal`: 200 seeds with a signal in one of 8 features, whose best possible accuracy is known.
"""

import argparse
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import NDArray
from sklearn.linear_model import LogisticRegressionCV
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

from leaderboard.instance import Instance
from leaderboard.metrics.accuracy import credits_of
from leaderboard.readout import Settings, fit_readout, read_features
from leaderboard.readout.evaluation import estimate_accuracy
from leaderboard.readout.folds import list_splits, split_pairs
from leaderboard.readout.logistic import EXPONENTS, LogisticReadout
from leaderboard.readout.matching import FittingSet, TargetSet
from leaderboard.readout.outcome import Model
from leaderboard.reference import Reference, load_reference

ROOT = Path(__file__).resolve().parent.parent
N_SEEDS, N_REPETITIONS = 3, 200
N_PAIRS, N_FRESH = 96, 1_000
N_FEATURES, N_WIDE = 4_096, 100_000
SIGNALS = (0.5, 1.0, 2.0)  # standard deviations between the outcomes

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


def draw_labels(n_pairs: int, rng: np.random.Generator) -> Integers:
    """Let one member of each pair, chosen at random, end with YES."""
    first = rng.integers(0, 2, n_pairs)
    return np.stack([first, 1 - first], axis=1).ravel()


def draw_features(labels: Integers, n_features: int, signal: float, rng: np.random.Generator) -> Floats:
    """Draw noise shared by the members of a pair, own noise, and a first feature that tells the outcome."""
    values = rng.normal(size=(len(labels), n_features))
    values += np.repeat(rng.normal(size=(len(labels) // 2, n_features)), 2, axis=0)
    values[:, 0] = rng.normal(size=len(labels)) + signal * (labels - 0.5)
    return values


def write_features(folder: Path, reference: Reference, n_features: int, n_properties: int) -> tuple[Any, Any]:
    """Write features to fit on and test features of some properties as float32."""
    rng = np.random.default_rng(0)
    fitting, test = {}, []
    for property_ in reference.benchmark.properties[:n_properties]:
        name, inside = property_.name, reference.in_property(property_.name)
        labels = draw_labels(N_PAIRS, rng)
        ids = [f"readout-copy{copy}/{name}/{pair:04d}" for pair in range(N_PAIRS) for copy in (0, 1)]
        test_ids = [t for t, is_in in zip(reference.trial_ids, inside, strict=True) if is_in]
        fitting[name] = write_one(folder / f"fit-{name}", ids, labels, n_features, rng)
        test.append(write_one(folder / f"test-{name}", test_ids, reference.labels[inside], n_features, rng))
    return fitting, test


def write_one(
    stem: Path, ids: list[str], labels: Integers, n_features: int, rng: np.random.Generator
) -> Path:
    """Write one file and the table beside it."""
    np.save(stem.with_suffix(".npy"), draw_features(labels, n_features, 1.0, rng).astype(np.float32))
    rows = [f'"{trial_id}",{label}' for trial_id, label in zip(ids, labels.tolist(), strict=True)]
    stem.with_suffix(".csv").write_text("\n".join(["trial_id,label", *rows]) + "\n", encoding="utf-8")
    return stem.with_suffix(".npy")


def run_readout(fitting: dict[str, Path], test: list[Path], reference: Reference, model: Model) -> None:
    """Read the files and fit, as the command does."""
    own = [read_features(path, property_name=name, with_labels=True) for name, path in fitting.items()]
    others = [read_features(path, with_labels=False) for path in test]
    fit_readout(own, others, reference, Settings(model=model, n_seeds=N_SEEDS))


def run_plain(fitting: dict[str, Path], *, is_nested: bool, solver: str) -> None:
    """Fit all features with scikit-learn alone."""
    for path in fitting.values():
        features = read_features(path, with_labels=True)
        values, labels = features.values.astype(np.float64), features.labels
        assert labels is not None  # noqa: S101  (they were asked for)
        pairs = [t.replace("-copy0", "").replace("-copy1", "") for t in features.trial_ids]
        for seed in range(N_SEEDS):
            folds = split_pairs(pairs, labels, seed=seed)
            for outside, _ in list_splits(folds) if is_nested else []:
                fit_plain(values[outside], labels[outside], folds[outside], solver)
            fit_plain(values, labels, folds, solver)


def fit_plain(values: Floats, labels: Integers, folds: Integers, solver: str) -> None:
    """Standardise and choose the strength, as a careful user of scikit-learn would."""
    model = LogisticRegressionCV(
        Cs=[10.0**k / values.shape[1] for k in EXPONENTS],
        l1_ratios=(0,),
        cv=list_splits(folds),
        scoring="neg_log_loss",
        solver=solver,
        max_iter=1000,
        use_legacy_attributes=False,
    )
    make_pipeline(StandardScaler(), model).fit(values, labels)


def measure_speed(reference: Reference) -> None:
    """Print seconds beside scikit-learn's on the same files."""
    with tempfile.TemporaryDirectory() as name:
        fitting, test = write_features(Path(name), reference, N_FEATURES, 4)
        runs: dict[str, Callable[[], None]] = {
            "this project, logistic": lambda: run_readout(fitting, test, reference, "logistic"),
            "scikit-learn, all features, lbfgs": lambda: run_plain(fitting, is_nested=False, solver="lbfgs"),
            "the same with held-out predictions": lambda: run_plain(fitting, is_nested=True, solver="lbfgs"),
            "this project, mlp": lambda: run_readout(fitting, test, reference, "mlp"),
        }
        print(f"| 4 properties, 192 trials, {N_FEATURES:,} features, {N_SEEDS} seeds | s | processor, s |")
        print("|---|---:|---:|")
        for what, run in runs.items():
            start, own = time.perf_counter(), time.process_time()
            run()
            seconds, own = time.perf_counter() - start, time.process_time() - own
            print(f"| {what} | {seconds:.1f} | {own:.1f} |", flush=True)


def measure_memory(reference: Reference) -> None:
    """Print the peak memory of a process that fits one property of many features."""
    with tempfile.TemporaryDirectory() as name:
        fitting, test = write_features(Path(name), reference, N_WIDE, 1)
        code = (
            "import resource, sys; from leaderboard.cli import group;"
            "group.main(sys.argv[1:], standalone_mode=False);"
            "print('MB', resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024)"
        )
        arguments = [f"--root={ROOT}", "readout", "fit", f"--output={name}/out"]
        arguments += [f"--fit={p}={path}" for p, path in fitting.items()] + [
            f"--test={path}" for path in test
        ]
        start = time.perf_counter()
        done = subprocess.run(
            [sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=True
        )
        megabytes = done.stdout.split("MB ")[1].strip()
        print(f"192 x {N_WIDE:,} float32: {time.perf_counter() - start:.1f} s, peak {megabytes} MB")


def simulate(seed: int, n_features: int, signal: float) -> tuple[float, float, bool]:
    """Fit one readout: accuracy held out and on fresh trials, and whether the interval holds the latter."""
    rng = np.random.default_rng([seed, round(10 * signal)])
    labels, hidden = draw_labels(N_PAIRS, rng), draw_labels(N_FRESH, rng)
    ids = [f"{number // 2}-copy{number % 2}" for number in range(2 * N_FRESH)]
    pairs = tuple(trial_id.split("-")[0] for trial_id in ids[: 2 * N_PAIRS])
    own = draw_features(labels, n_features, signal, rng)
    fitting = FittingSet("simulated", tuple(ids[: 2 * N_PAIRS]), pairs, own, labels)
    test = TargetSet(tuple(ids), draw_features(hidden, n_features, signal, rng))
    fit = LogisticReadout(fitting, test).fit(split_pairs(pairs, labels, seed=seed), seed)
    interval = estimate_accuracy(fit.held_out, labels, pairs)
    fresh = float(credits_of(fit.test, hidden, np.ones(len(hidden), bool)).mean())
    return interval.value, fresh, interval.low <= fresh <= interval.high


def measure_recovery(n_features: int, signals: tuple[float, ...]) -> None:
    """Print mean accuracies over simulations with their standard errors, and how often intervals hold."""
    columns = ("best possible, %", "held out, %", "fresh trials, %", "interval holds, %")
    print(f"| signal in {n_features:,} features | {' | '.join(columns)} |")
    print("|---:|---:|---:|---:|---:|")
    for signal in signals:
        found = 100 * np.array([simulate(seed, n_features, signal) for seed in range(N_REPETITIONS)])
        means, errors = found.mean(axis=0), found.std(axis=0, ddof=1) / N_REPETITIONS**0.5
        cells = [f"{mean:.2f} ± {error:.2f}" for mean, error in zip(means[:2], errors[:2], strict=True)]
        best = 100 * NormalDist().cdf(signal / 2)
        print(f"| {signal:g} | {best:.1f} | {' | '.join(cells)} | {means[2]:.1f} |", flush=True)


def main() -> None:
    """Run what is asked for."""
    reference = load_reference(Instance(ROOT))
    parts: dict[str, Callable[[], None]] = {
        "speed": lambda: measure_speed(reference),
        "memory": lambda: measure_memory(reference),
        "chance": lambda: measure_recovery(256, (0.0,)),
        "signal": lambda: measure_recovery(8, SIGNALS),
    }
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--only", choices=parts)
    only = parser.parse_args().only
    for name, run in parts.items():
        if only in (None, name):
            run()


if __name__ == "__main__":
    main()
