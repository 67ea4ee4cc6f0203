"""From features to predictions: one readout for each property, or one for all."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from typing import Protocol

import numpy as np

from leaderboard.errors import LeaderboardError, SourceError
from leaderboard.readout.distance import DistanceReadout, ThresholdReadout, check_distances
from leaderboard.readout.evaluation import estimate_accuracy, measure_agreement
from leaderboard.readout.features import Features, Integers
from leaderboard.readout.folds import split_pairs
from leaderboard.readout.logistic import LogisticReadout
from leaderboard.readout.matching import (
    FittingSet,
    Scope,
    TargetSet,
    TrialList,
    check_separate,
    gather_fitting_sets,
    list_test_trials,
    match_test_sets,
)
from leaderboard.readout.mlp import MlpReadout
from leaderboard.readout.outcome import Fit, Model, PartOutcome, Readout, SeedOutcome
from leaderboard.readout.projection import Projection
from leaderboard.reference import Reference

DEFAULT_SEEDS = 3
OLDEST_SCIKIT_LEARN = (1, 8)  # its logistic regression takes arguments that older ones do not know

DECIMALS = 6
"""Of a probability: more than any score needs, and few enough to be the same on every machine."""


class _Method(Protocol):
    """A way of fitting a readout, ready to be fitted with any seed."""

    @property
    def projection(self) -> Projection:
        """The features as they are fitted."""

    def fit(self, folds: Integers, seed: int) -> Fit:
        """Fit, and predict."""


_METHODS: dict[Model, Callable[[FittingSet, TargetSet], _Method]] = {
    "logistic": LogisticReadout,
    "mlp": MlpReadout,
    "distance": DistanceReadout,
    "threshold": ThresholdReadout,
}


@dataclass(frozen=True)
class Settings:
    """How to fit.

    Attributes
    ----------
    model
        ``logistic``, the appendix's ``mlp``, or of distances a logistic ``distance`` or a ``threshold``.
    scope
        One readout for each ``property``, or one for ``all``.
    n_seeds
        How many ways of dealing out pairs into folds, and starts of a network, to average over.
    """

    model: Model = "logistic"
    scope: Scope = "property"
    n_seeds: int = DEFAULT_SEEDS


def fit_readout(
    fitting: Sequence[Features],
    test: Sequence[Features],
    reference: Reference,
    settings: Settings | None = None,
) -> Readout:
    """Fit readouts and predict the test trials; how these end plays no part.

    Parameters
    ----------
    fitting
        Features of the trials to fit on, with labels.
    test
        Features of the test trials. Names of trials are translated to ids; labels are not looked at.
    reference
        Which test trials there are, and which property each belongs to.
    settings
        How to fit; without them, a logistic regression for each property, averaged over 3 seeds.

    Raises
    ------
    SourceError
        If features are missing, do not fit together, or cannot be fitted.
    LeaderboardError
        If scikit-learn is not installed, or too old.
    """
    _require_scikit_learn()
    return _fit_parts(fitting, test, list_test_trials(reference), settings or Settings())


def _require_scikit_learn() -> None:
    oldest = ".".join(map(str, OLDEST_SCIKIT_LEARN))
    try:
        found = version("scikit-learn")
    except PackageNotFoundError:
        found = "none"
    numbers = tuple(int(part) for part in found.split(".")[:2] if part.isdecimal())
    if numbers < OLDEST_SCIKIT_LEARN:
        message = f"readouts are fitted by scikit-learn {oldest} or newer; installed is {found}"
        raise LeaderboardError(message, "pip install 'scikit-learn>=1.8' installs it")


def _fit_parts(
    fitting: Sequence[Features], test: Sequence[Features], trials: TrialList, settings: Settings
) -> Readout:
    if settings.model in ("distance", "threshold"):
        for features in (*fitting, *test):
            check_distances(features)
    test_sets, coverage = match_test_sets(test, trials, settings.scope)
    fitting_sets = gather_fitting_sets(fitting, trials, settings.scope)
    _check_parts(fitting_sets, test_sets)
    parts: list[PartOutcome] = []
    probabilities: dict[str, float] = {}
    for name, test_set in test_sets.items():
        part, predicted = _fit_part(fitting_sets[name], test_set, settings)
        parts.append(part)
        probabilities.update(zip(test_set.trial_ids, predicted, strict=True))
    return Readout(
        benchmark=trials.benchmark,
        model=settings.model,
        scope=settings.scope,
        fitting=tuple(features.origin for features in fitting),
        test=tuple(features.origin for features in test),
        parts=tuple(parts),
        unused=tuple(name for name in fitting_sets if name not in test_sets),
        coverage=coverage,
        probabilities={t: probabilities[t] for t in trials.trial_ids if t in probabilities},
    )


def _check_parts(fitting: Mapping[str, FittingSet], test: Mapping[str, TargetSet]) -> None:
    missing = [name for name in test if name not in fitting]
    if missing:
        message = f"there are features of {len(test[missing[0]].trial_ids):,} test trials of {missing[0]}"
        hint = f"give --fit {missing[0]}=FILE, or leave its test trials out"
        raise SourceError(f"{message}, and no trials of it to fit on", hint)


def _fit_part(fitting: FittingSet, test: TargetSet, settings: Settings) -> tuple[PartOutcome, list[float]]:
    check_separate(fitting, test)
    method = _METHODS[settings.model](fitting, test)
    folds = [
        split_pairs(fitting.pair_ids, fitting.labels, seed=seed, name=fitting.name)
        for seed in range(settings.n_seeds)
    ]
    fits = [method.fit(own, seed) for seed, own in enumerate(folds)]
    held_out = np.mean([fit.held_out for fit in fits], axis=0)
    predicted = np.array([fit.test for fit in fits])
    outcome = PartOutcome(
        name=fitting.name,
        pair_ids=tuple(sorted(set(fitting.pair_ids))),
        labels=fitting.labels,
        held_out=held_out,
        agreement=measure_agreement(held_out, fitting.labels),
        accuracy=estimate_accuracy(held_out, fitting.labels, fitting.pair_ids),
        seeds=tuple(_describe_seed(fitting, seed, folds[seed], fit) for seed, fit in enumerate(fits)),
        n_features=method.projection.n_features,
        n_constant=method.projection.n_constant,
        n_test=len(test.trial_ids),
        test_spread=float(predicted.std(axis=0, ddof=1).mean()) if len(fits) > 1 else 0.0,
    )
    return outcome, [round(p, DECIMALS) for p in predicted.mean(axis=0).tolist()]


def _describe_seed(fitting: FittingSet, seed: int, folds: Integers, fit: Fit) -> SeedOutcome:
    fold_of = dict(zip(fitting.pair_ids, folds.tolist(), strict=True))
    digits = "".join(str(fold_of[pair_id]) for pair_id in sorted(fold_of))
    return SeedOutcome(seed, digits, fit.choices, measure_agreement(fit.held_out, fitting.labels))
