"""Gathering estimates and their resamples by scope and subset, and turning them into scores."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from leaderboard.grading.metrics import P_VALUES
from leaderboard.grading.scopes import SUBSETS
from leaderboard.metrics.accuracy import Floats
from leaderboard.metrics.resampling import Interval, percentile_interval
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.models import Score, SubsetScores
from leaderboard.models.benchmark import OVERALL

DECIMALS = 6

Counts = Mapping[str, int | float]
Key = tuple[str, str, str]


@dataclass(frozen=True)
class Tally:
    """Estimates by scope, subset and metric; and the resamples, (n_resamples,), of those that have them."""

    estimates: dict[str, dict[str, dict[str, Estimate]]] = field(default_factory=dict)
    resampled: dict[Key, Floats] = field(default_factory=dict)
    counts: dict[tuple[str, str], Counts] = field(default_factory=dict)

    def add(
        self,
        key: tuple[str, str],
        counts: Counts,
        estimates: Mapping[str, Estimate],
        resampled: Mapping[str, Floats],
    ) -> None:
        """Add the metrics of one subset of one scope."""
        scope, subset = key
        self.estimates.setdefault(scope, {})[subset] = dict(estimates)
        self.counts[key] = counts
        self.resampled.update({(scope, subset, metric): values for metric, values in resampled.items()})

    def average(self, properties: Sequence[str]) -> None:
        """Add the overall values: plain means of the properties', resample by resample; counts are added.

        What is not computed for every property, such as agreement within people where nobody judged one, has
        no overall value.
        """
        for subset in self.estimates[properties[0]]:
            if not all(subset in self.estimates[name] for name in properties):
                continue
            parts = {name: self.estimates[name][subset] for name in properties}
            metrics = [m for m in parts[properties[0]] if all(m in part for part in parts.values())]
            estimates = {m: _mean({name: part[m] for name, part in parts.items()}) for m in metrics}
            resampled = {
                m: np.mean([self.resampled[name, subset, m] for name in properties], axis=0)
                for m in metrics
                if all((name, subset, m) in self.resampled for name in properties)
            }
            counts = [self.counts[name, subset] for name in properties]
            total = {key: round(sum(count[key] for count in counts), DECIMALS) for key in counts[0]}
            self.add((OVERALL, subset), total, estimates, resampled)

    def assemble(self, scopes: Sequence[str]) -> dict[str, dict[str, SubsetScores]]:
        """Compute the intervals and lay the scores of some scopes out in that order."""
        return {
            scope: {subset: self._assemble(scope, subset) for subset in self._subsets_of(scope)}
            for scope in scopes
        }

    def _assemble(self, scope: str, subset: str) -> SubsetScores:
        estimates = self.estimates[scope][subset]
        scores = {m: _to_score(m, e, self.resampled.get((scope, subset, m))) for m, e in estimates.items()}
        return SubsetScores(**self.counts[scope, subset], metrics=scores)

    def _subsets_of(self, scope: str) -> list[str]:
        return sorted(self.estimates[scope], key=SUBSETS.index)


def _mean(parts: Mapping[str, Estimate]) -> Estimate:
    """Average the properties' values; undefined if one of them is, for the first reason."""
    defined = [value for value in parts.values() if not isinstance(value, Undefined)]
    if len(defined) == len(parts):
        return float(np.mean(defined))
    name, first = next((name, value) for name, value in parts.items() if isinstance(value, Undefined))
    return Undefined(first.why if not defined and len({*parts.values()}) == 1 else f"{name}: {first.why}")


def _to_score(metric: str, estimate: Estimate, resampled: Floats | None) -> Score:
    """Round to 6 decimals; a smaller p-value keeps 6 significant digits, since it is never 0."""
    if isinstance(estimate, Undefined):
        return Score(value=None, why=estimate.why)
    rounded = round(estimate, DECIMALS)
    if rounded == 0 and metric in P_VALUES:
        rounded = float(f"{estimate:.{DECIMALS}g}")
    interval = None if resampled is None else percentile_interval(estimate, resampled)
    if not isinstance(interval, Interval):
        return Score(value=rounded + 0.0)
    return Score(
        value=rounded + 0.0,
        low=round(interval.low, DECIMALS) + 0.0,
        high=round(interval.high, DECIMALS) + 0.0,
        undefined_resamples=interval.n_undefined or None,
    )
