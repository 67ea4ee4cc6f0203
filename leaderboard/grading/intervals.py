"""From the sums on each resample to the intervals of a submission's scores."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from leaderboard.grading.cells import Cell
from leaderboard.grading.columns import share_sums, tabulate_fine, tabulate_halves
from leaderboard.grading.metrics import METRICS
from leaderboard.grading.observations import Observations
from leaderboard.grading.resampled import RESAMPLED, limit
from leaderboard.grading.sums import Sums, sum_halves
from leaderboard.grading.yardstick import Yardstick
from leaderboard.metrics import calibration, influence
from leaderboard.metrics.accuracy import Floats
from leaderboard.metrics.agreement import answers_of
from leaderboard.metrics.resampling import INFLUENCE_BITS, on_grid
from leaderboard.metrics.undefined import Estimate, Undefined

KAPPAS = ("error_consistency", "cohen_kappa")
RANGES = {metric.name: (metric.low, metric.high) for metric in METRICS}


@dataclass(frozen=True)
class Measured:
    """A submission in one cell: what is seen of it there, and its metrics."""

    cell: Cell
    observed: Observations
    estimates: Mapping[str, Estimate]

    @cached_property
    def values(self) -> Mapping[str, float]:
        """The metrics that have a value."""
        return {name: value for name, value in self.estimates.items() if not isinstance(value, Undefined)}

    @cached_property
    def kappas(self) -> Mapping[str, tuple[Floats, Floats]]:
        """Derivatives of both kappas by the weights of trials and of people; none where none is wanted."""
        o = self.observed
        if o.responses is None or self.estimates.keys().isdisjoint(KAPPAS):
            return {}
        trials, persons, answers = o.responses
        is_right = (answers == o.labels[trials]).astype(np.int64)
        answered = answers_of(o.probabilities)
        return {
            "error_consistency": influence.kappa_influences(o.credits, (trials, persons, is_right)),
            "cohen_kappa": influence.kappa_influences(answered, (trials, persons, answers)),
        }

    @property
    def columns(self) -> dict[str, Floats]:
        """What is summed over the drawn pairs, trial by trial."""
        slopes = {name: on_grid(by_trial, INFLUENCE_BITS) for name, (by_trial, _) in self.kappas.items()}
        return tabulate_fine(self.observed) | slopes

    @cached_property
    def pulls(self) -> Mapping[str, Floats]:
        """Derivatives of metrics by people's weights, by way of the human means they move; (n_people,)."""
        o, slopes = self.observed, _find_slopes(self.observed, self.values)
        by_person = {name: pull for name, (_, pull) in self.kappas.items() if name in self.values}
        if o.responses is None or o.n is None or o.n_yes is None or not slopes:
            return by_person
        moved = influence.spread_to_responses(np.array(list(slopes.values())), o.responses, o.n, o.n_yes)
        gathered = [influence.gather_people(row, o.responses[1]) for row in moved]
        return dict(zip(slopes, gathered, strict=True)) | by_person


def resample_cells(
    measured: Sequence[Measured], sums: Sequence[Sums], yardstick: Yardstick
) -> Iterator[dict[str, Floats]]:
    """Compute, on every resample, each metric that has a value in some cells of one property.

    Pairs are drawn within scenarios, and with them every sum is computed anew. People are drawn within the
    sets that saw the same trials; what they move is added to first order (the infinitesimal jackknife of
    Jaeckel 1972), less what drawing trials accounts for already (``gather_people``). For the two kappas,
    which are averages over people, trials enter to first order as well.

    Parameters
    ----------
    sums
        Those of ``columns`` over the drawn pairs, for each cell.

    Yields
    ------
    dict of (n_resamples,)
        For each cell in turn; NaN where a resample leaves the metric undefined.
    """
    cells = [m.cell for m in measured]
    share_sums([cell for cell in cells if not cell.shared_sums])
    halves = sum_halves(cells, [tabulate_halves(m.observed) for m in measured])
    effects = iter(yardstick.draw_effects(cells[0], [pull for m in measured for pull in m.pulls.values()]))
    for m, fine, of_halves in zip(measured, sums, halves, strict=True):
        o, cell = m.observed, m.cell
        s = {**cell.shared_sums, **fine, **of_halves}
        if "auc" in m.values:  # which takes as long as many others
            s["outranked"] = calibration.count_outranked(
                o.probabilities, o.labels, cell.positions, cell.whole_weights
            )
        yield _resample(m, s, {name: next(effects) for name in m.pulls}, yardstick.resample_ceiling(cell))


def _resample(
    m: Measured, s: Sums, effects: Mapping[str, Floats], ceiling: Floats | None
) -> dict[str, Floats]:
    """Compute the metrics of one cell, with what drawn people add to them."""
    with np.errstate(invalid="ignore"):  # 0 / 0
        resampled = {name: RESAMPLED[name](s) for name in m.values if name in RESAMPLED}
    resampled |= {name: m.values[name] + s[name] for name in m.kappas if name in m.values}
    for name, effect in effects.items():
        moved = np.add(resampled[name], effect, out=resampled[name])
        limit(moved, *RANGES[name])
    if ceiling is not None and "human_r_normalized" in m.values:
        resampled["human_r_normalized"] = resampled["human_r"] / ceiling
    return resampled


def _find_slopes(o: Observations, values: Mapping[str, float]) -> dict[str, Floats]:
    """Derivatives of the defined metrics by the human mean of each trial, (n_trials,) each."""
    rated = o.rated
    q, h, labels = o.probabilities[rated], o.human_means, o.labels[rated]
    n_rated = max(q.size, 1)
    bins = calibration.find_bins(q)
    excess = np.bincount(bins, q - h, minlength=calibration.N_BINS)
    found = {
        "human_r": lambda: influence.correlation_slopes(q, h, np.zeros(q.size, np.int64)),
        "human_r_partial": lambda: influence.correlation_slopes(q, h, labels),
        "human_rmse": lambda: (h - q) / (n_rated * values["human_rmse"]) if values["human_rmse"] else 0 * q,
        "human_ece": lambda: -np.sign(excess[bins]) / n_rated,
        "human_gap": lambda: (1.0 - 2 * labels) / n_rated,
    }
    slopes = {name: np.zeros(rated.size) for name in found if name in values}
    for name, slope in slopes.items():
        slope[rated] = found[name]()
    return slopes
