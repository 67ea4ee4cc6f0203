"""Gathering estimates and their resamples by scope and subset, and turning them into scores."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from leaderboard.grading.cells import Counts
from leaderboard.grading.metrics import P_VALUES
from leaderboard.grading.scopes import SUBSETS
from leaderboard.metrics.accuracy import Floats
from leaderboard.metrics.resampling import Interval, percentile_interval
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.models import Score, SubsetScores
from leaderboard.models.benchmark import OVERALL

DECIMALS = 6

Key = tuple[str, str, str]


@dataclass(frozen=True)
class Tally:
    """Estimates by scope, subset and metric; where there are resamples, these or the intervals from them.

    Attributes
    ----------
    properties
        The scopes that overall values are averaged from.
    keeps_resamples
        Whether to keep ``resampled``, of (n_resamples,). If not, intervals are made at once, while resamples
        are in the processor's cache, and their memory serves the next.
    """

    properties: Sequence[str]
    keeps_resamples: bool = True
    estimates: dict[str, dict[str, dict[str, Estimate]]] = field(default_factory=dict)
    resampled: dict[Key, Floats] = field(default_factory=dict)
    counts: dict[tuple[str, str], Counts] = field(default_factory=dict)
    _intervals: dict[Key, Interval | Undefined] = field(default_factory=dict)
    _totals: dict[tuple[str, str], tuple[Floats, int]] = field(default_factory=dict)

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
        for metric, values in resampled.items():
            if scope in self.properties:
                self._add_up(subset, metric, values)
            if self.keeps_resamples:
                self.resampled[scope, subset, metric] = values
            else:
                self._intervals[scope, subset, metric] = _find_interval(estimates[metric], values)

    def average(self) -> None:
        """Add the overall values: plain means of the properties', resample by resample; counts are added.

        What is not computed for every property, such as agreement within people where nobody judged one, has
        no overall value.
        """
        for subset in self.estimates[self.properties[0]]:
            if not all(subset in self.estimates[name] for name in self.properties):
                continue
            parts = {name: self.estimates[name][subset] for name in self.properties}
            metrics = [m for m in parts[self.properties[0]] if all(m in part for part in parts.values())]
            estimates = {m: _mean({name: part[m] for name, part in parts.items()}) for m in metrics}
            totals = {m: self._totals[subset, m] for m in metrics if (subset, m) in self._totals}
            means = {m: sums / n for m, (sums, n) in totals.items() if n == len(self.properties)}
            counts = [self.counts[name, subset] for name in self.properties]
            total = {key: round(sum(count[key] for count in counts), DECIMALS) for key in counts[0]}
            self.add((OVERALL, subset), total, estimates, means)

    def assemble(self, scopes: Sequence[str]) -> dict[str, dict[str, SubsetScores]]:
        """Lay the scores of some scopes out in that order, with their intervals."""
        return {
            scope: {subset: self._assemble(scope, subset) for subset in self._subsets_of(scope)}
            for scope in scopes
        }

    def _add_up(self, subset: str, metric: str, values: Floats) -> None:
        """Add resamples of one property to those of the others."""
        if (subset, metric) not in self._totals:
            self._totals[subset, metric] = values.copy(), 1
        else:
            total, n = self._totals[subset, metric]
            self._totals[subset, metric] = np.add(total, values, out=total), n + 1

    def _assemble(self, scope: str, subset: str) -> SubsetScores:
        estimates = self.estimates[scope][subset]
        for metric in estimates:
            key = scope, subset, metric
            if key in self.resampled and key not in self._intervals:
                self._intervals[key] = _find_interval(estimates[metric], self.resampled[key])
        scores = {m: _to_score(m, e, self._intervals.get((scope, subset, m))) for m, e in estimates.items()}
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


def _find_interval(estimate: Estimate, resampled: Floats) -> Interval | Undefined:
    return estimate if isinstance(estimate, Undefined) else percentile_interval(estimate, resampled)


def _to_score(metric: str, estimate: Estimate, interval: Interval | Undefined | None) -> Score:
    """Round to 6 decimals; a smaller p-value keeps 6 significant digits, since it is never 0."""
    if isinstance(estimate, Undefined):
        return Score(value=None, why=estimate.why)
    rounded = round(estimate, DECIMALS)
    if rounded == 0 and metric in P_VALUES:
        rounded = float(f"{estimate:.{DECIMALS}g}")
    if not isinstance(interval, Interval):
        return Score(value=rounded + 0.0)
    return Score(
        value=rounded + 0.0,
        low=round(interval.low, DECIMALS) + 0.0,
        high=round(interval.high, DECIMALS) + 0.0,
        undefined_resamples=interval.n_undefined or None,
    )
