"""What a readout found, as values: predictions, and an account of how they came about."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.resampling import Interval
from leaderboard.readout.features import Integers, Origin
from leaderboard.readout.matching import Coverage, Scope

Floats = NDArray[np.float64]
Model = Literal["logistic", "mlp", "distance", "threshold"]


@dataclass(frozen=True)
class Fit:
    """What one seed gives.

    Attributes
    ----------
    held_out : (n_fitting,)
        P(YES) of each trial to fit on, from a readout that saw no trial of its fold, neither for fitting nor
        for choosing.
    test : (n_test,)
        P(YES) of each test trial, from the readout that is fitted on all.
    choices
        What was chosen for that readout, by name.
    """

    held_out: Floats
    test: Floats
    choices: Mapping[str, float]


@dataclass(frozen=True)
class Agreement:
    """How well held-out probabilities agree with the labels: see docs/method.md for each metric."""

    accuracy: float
    auc: float
    brier: float
    ece: float


@dataclass(frozen=True)
class SeedOutcome:
    """What one seed gave.

    Attributes
    ----------
    seed
        The seed.
    folds
        One digit for each pair, in the order of pair ids: the number of its fold.
    choices
        What was chosen, such as the strength, by name.
    agreement
        On held-out trials.
    """

    seed: int
    folds: str
    choices: Mapping[str, float]
    agreement: Agreement


@dataclass(frozen=True)
class PartOutcome:
    """One readout: of a property, or of all.

    Attributes
    ----------
    name
        The property, or ``all``.
    pair_ids : n_pairs texts
        The pairs that it was fitted on, sorted.
    labels : (n_trials,)
        Of the trials that it was fitted on.
    held_out : (n_trials,)
        P(YES) of the same trials while their folds were held out, averaged over seeds.
    agreement
        Of these with the labels.
    accuracy
        With its 95 % interval over pairs.
    seeds
        Each seed by itself.
    n_features, n_constant
        Features that vary, and features that were left out because they do not.
    n_test
        Number of test trials that it answers.
    test_spread
        Standard deviation of P(YES) over seeds, averaged over test trials; 0 with one seed.
    """

    name: str
    pair_ids: tuple[str, ...]
    labels: Integers
    held_out: Floats
    agreement: Agreement
    accuracy: Interval
    seeds: tuple[SeedOutcome, ...]
    n_features: int
    n_constant: int
    n_test: int
    test_spread: float

    @property
    def n_trials(self) -> int:
        """Number of trials that it was fitted on."""
        return len(self.labels)


@dataclass(frozen=True)
class Readout:
    """Predictions for the test trials, and where they come from.

    Attributes
    ----------
    benchmark
        Title of the benchmark.
    model, scope
        What was fitted, and on which trials together.
    fitting, test
        Where the features of either come from.
    parts
        One for each property in the order of the benchmark, or one for all.
    unused
        Properties with trials to fit on and no test trials.
    coverage
        What of the benchmark is predicted.
    probabilities
        P(YES) by trial id, in the order of the reference.
    """

    benchmark: str
    model: Model
    scope: Scope
    fitting: tuple[Origin, ...]
    test: tuple[Origin, ...]
    parts: tuple[PartOutcome, ...]
    unused: tuple[str, ...]
    coverage: Coverage
    probabilities: Mapping[str, float]

    def to_columns(self) -> dict[str, list[str] | list[float]]:
        """Give the predictions as columns, from which any library makes its data frame.

        With pandas: ``pandas.DataFrame(readout.to_columns())``.
        """
        return {"trial_id": list(self.probabilities), "probability": list(self.probabilities.values())}
