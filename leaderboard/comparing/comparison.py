"""What comparing two submissions finds."""

from dataclasses import dataclass
from typing import Literal

from leaderboard.metrics.resampling import Interval
from leaderboard.metrics.undefined import Estimate, Undefined


@dataclass(frozen=True)
class Overlap:
    """On how many trials and pairs each of the two does better.

    Trials count as right if the answer earns full credit. A pair goes to who earns more credit on it.
    """

    n_both_right: int
    n_only_a: int
    n_only_b: int
    n_neither: int
    n_pairs_a: int
    n_pairs_b: int
    n_pairs_equal: int


@dataclass(frozen=True)
class ScopeComparison:
    """The comparison on one scope that both cover.

    Attributes
    ----------
    accuracy_a, accuracy_b, difference
        Mean credits, and that of A minus that of B with its interval.
    p
        Exact two-sided p of the paired sign-flip test over pairs.
    human_r_difference
        Human r of A minus that of B, with its interval.
    kappa
        Cohen's kappa between the answers of the two.
    """

    name: str
    kind: Literal["overall", "property", "scenario"]
    n: int
    n_pairs: int
    accuracy_a: float
    accuracy_b: float
    difference: Interval
    p: float
    overlap: Overlap
    human_r_difference: Interval | Undefined
    kappa: Estimate


@dataclass(frozen=True)
class TrialDifference:
    """A trial on which the two differ; ``human_mean`` is None where nobody judged it."""

    trial_id: str
    label: int
    probability_a: float
    probability_b: float
    human_mean: float | None


@dataclass(frozen=True)
class Comparison:
    """Everything that two submissions differ in, on the trials that both cover.

    ``property_gain`` says which difference it is, if the two are one system with and without property
    inference.
    """

    a: str
    b: str
    property_gain: Literal["A-B", "B-A"] | None
    resamples: int
    seed: int
    scopes: tuple[ScopeComparison, ...]
    trials: tuple[TrialDifference, ...]
