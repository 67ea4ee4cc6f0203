"""What a readout did, for files and for the eye."""

from dataclasses import asdict
from importlib.metadata import version
from typing import Any

import numpy as np

from leaderboard import __version__
from leaderboard.files import canonical_json, csv_text
from leaderboard.readout.evaluation import bin_probabilities
from leaderboard.readout.features import Origin
from leaderboard.readout.folds import N_FOLDS
from leaderboard.readout.outcome import PartOutcome, Readout, SeedOutcome
from leaderboard.reference.cells import quote

DECIMALS = 6

METADATA = {"protocol": {"selection": "readout"}}
"""What a readout knows of ``submission.toml``: strength, epoch and threshold are chosen on its own trials."""

_METHODS = {
    "logistic": "logistic regression",
    "mlp": "multilayer perceptron",
    "distance": "logistic regression on the smallest distance",
    "threshold": "threshold on the smallest distance",
}


def render_predictions(readout: Readout) -> bytes:
    """Render the predictions as the content of ``predictions.csv``."""
    return csv_text(("trial_id", "probability"), readout.probabilities.items()).encode()


def render_report(readout: Readout) -> bytes:
    """Render everything that was found as the content of ``report.json``."""
    return canonical_json(readout_data(readout)).encode()


def readout_data(readout: Readout) -> dict[str, Any]:
    """Gather what was found as values for JSON; ``metadata`` are those of ``submission.toml``."""
    return {
        "schema": 1,
        "benchmark": readout.benchmark,
        "metadata": METADATA,
        "model": readout.model,
        "scope": readout.scope,
        "versions": {
            "leaderboard": __version__,
            "numpy": np.__version__,
            "scikit-learn": version("scikit-learn"),
        },
        "features": {
            "fit": [_describe_origin(origin) for origin in readout.fitting],
            "test": [_describe_origin(origin) for origin in readout.test],
        },
        "coverage": {
            "trials": len(readout.probabilities),
            "scenarios": list(readout.coverage.scenarios),
            "omitted": {
                scenario: {"with_features": n_found, "trials": n}
                for scenario, (n_found, n) in readout.coverage.omitted.items()
            },
            "unmatched": list(readout.coverage.unmatched),
        },
        "unused": list(readout.unused),
        "parts": [_describe_part(part) for part in readout.parts],
    }


def render_account(readout: Readout) -> str:
    """Say in a few lines how good the readout is on trials that it did not see, and what it leaves out.

    None of these numbers comes from the test trials: how they end is not known here.
    """
    per = "property" if readout.scope == "property" else "benchmark"
    n_seeds = len(readout.parts[0].seeds)
    seeds = "1 seed" if n_seeds == 1 else f"the mean of {n_seeds} seeds"
    lines = [
        f"{readout.benchmark}: {_METHODS[readout.model]}, one per {per}, {seeds}",
        f"  on the trials to fit on, {N_FOLDS} folds, pairs never split:",
    ]
    width = max(len(part.name) for part in readout.parts)
    lines += [f"    {part.name:<{width}}  {_summarise(part)}" for part in readout.parts]
    coverage = readout.coverage
    n_scenarios = len(coverage.scenarios) + len(coverage.omitted)
    lines.append(
        f"  predicts {len(readout.probabilities):,} test trials,"
        f" {len(coverage.scenarios)} of {n_scenarios} scenarios; how they end was not looked at"
    )
    return "\n".join([*lines, *(f"  left out: {what}" for what in _list_left_out(readout))]) + "\n"


def _summarise(part: PartOutcome) -> str:
    accuracy, seeds = part.accuracy, part.seeds
    choices = ", ".join(
        f"{name} {_show_range([seed.choices[name] for seed in seeds])}" for name in seeds[0].choices
    )
    size = f"{part.n_trials:,} trials, {_count(part.n_features, 'feature')}"
    return (
        f"accuracy {accuracy.value:.3f} ({accuracy.low:.3f} to {accuracy.high:.3f}),"
        f" AUC {part.agreement.auc:.3f}; {size}; {choices}"
    )


def _count(n: int, noun: str) -> str:
    return f"{n:,} {noun}" if n == 1 else f"{n:,} {noun}s"


def _show_range(values: list[float]) -> str:
    low, high = f"{min(values):.3g}", f"{max(values):.3g}"
    return low if low == high else f"{low} to {high}"


def _list_left_out(readout: Readout) -> list[str]:
    coverage = readout.coverage
    lines = [
        f"{scenario}, features of {n_found:,} of its {n:,} trials"
        for scenario, (n_found, n) in coverage.omitted.items()
    ]
    if coverage.unmatched:
        names = coverage.unmatched
        lines.append(
            f"{_count(len(names), 'name')} that fit no test trial or several, such as {quote(names[0])}"
        )
    lines += [f"{name}: trials to fit on, and no test trials" for name in readout.unused]
    lines += [
        f"{part.name}: {part.n_constant:,} features that are the same on all trials to fit on"
        for part in readout.parts
        if part.n_constant
    ]
    return lines


def _describe_origin(origin: Origin) -> dict[str, Any]:
    return asdict(origin) | {"shape": list(origin.shape)}


def _describe_part(part: PartOutcome) -> dict[str, Any]:
    accuracies = [seed.agreement.accuracy for seed in part.seeds]
    return {
        "name": part.name,
        "trials": part.n_trials,
        "features": part.n_features,
        "constant_features": part.n_constant,
        "held_out": {
            "accuracy": _round({name: getattr(part.accuracy, name) for name in ("value", "low", "high")}),
            **_round({name: value for name, value in asdict(part.agreement).items() if name != "accuracy"}),
            "bins": [_round(bin_.model_dump()) for bin_ in bin_probabilities(part.held_out, part.labels)],
        },
        "spread_over_seeds": _round(
            {"held_out_accuracy": _spread(accuracies), "test_probability": part.test_spread}
        ),
        "test_trials": part.n_test,
        "pairs": list(part.pair_ids),
        "seeds": [_describe_seed(seed) for seed in part.seeds],
    }


def _describe_seed(seed: SeedOutcome) -> dict[str, Any]:
    return {
        "seed": seed.seed,
        **seed.choices,
        "held_out": _round(asdict(seed.agreement)),
        "folds": seed.folds,
    }


def _spread(values: list[float]) -> float:
    return float(np.std(values, ddof=1)) if len(values) > 1 else 0.0


def _round(values: dict[str, Any]) -> dict[str, Any]:
    return {
        name: round(value, DECIMALS) if isinstance(value, float) else value for name, value in values.items()
    }
