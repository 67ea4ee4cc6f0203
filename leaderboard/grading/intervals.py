"""From the sums on each resample to the intervals of a submission's scores."""

from collections.abc import Mapping

import numpy as np

from leaderboard.grading.metrics import METRICS
from leaderboard.grading.observations import Observations
from leaderboard.grading.resampled import RESAMPLED, sum_resamples
from leaderboard.grading.yardstick import Cell, Yardstick
from leaderboard.metrics import calibration, influence
from leaderboard.metrics.accuracy import Floats
from leaderboard.metrics.agreement import answers_of
from leaderboard.metrics.undefined import Estimate, Undefined

RANGES = {metric.name: (metric.low, metric.high) for metric in METRICS}


def resample_cell(
    o: Observations, cell: Cell, estimates: Mapping[str, Estimate], yardstick: Yardstick
) -> dict[str, Floats]:
    """Compute, on every resample, each metric of a cell that has a value.

    Pairs are drawn within scenarios, and with them every sum is computed anew. People are drawn within the
    sets that saw the same trials; what they move is added to first order (the infinitesimal jackknife of
    Jaeckel 1972), less what drawing trials accounts for already (``gather_people``). For the two kappas,
    which are averages over people, trials enter to first order as well.

    Returns
    -------
    dict of (n_resamples,), NaN where a resample leaves the metric undefined
    """
    values = {name: value for name, value in estimates.items() if not isinstance(value, Undefined)}
    kappas = _kappa_influences(o)
    sums = sum_resamples(o, cell, {name: by_trial for name, (by_trial, _) in kappas.items()})
    resampled = {name: RESAMPLED[name](sums) for name in values if name in RESAMPLED}
    resampled |= {name: values[name] + sums[name] for name in kappas if name in values}
    pulls = _pull_people(o, values) | {name: by_person for name, (_, by_person) in kappas.items()}
    pulls = {name: pull for name, pull in pulls.items() if name in resampled}
    for name, effect in zip(pulls, yardstick.draw_effects(cell, list(pulls.values())), strict=True):
        resampled[name] = np.clip(resampled[name] + effect, *RANGES[name])
    reliability = yardstick.find_reliability(cell)
    if reliability is not None and "human_r_normalized" in values:
        ceiling = yardstick.resample_reliability(reliability, cell)
        resampled["human_r_normalized"] = _divide_by_root(resampled["human_r"], ceiling)
    return resampled


def _divide_by_root(r: Floats, reliability: Floats) -> Floats:
    """Divide by the square root; NaN where there is none, since the reliability is not above 0."""
    roots = np.sqrt(np.where(reliability > 0, reliability, np.nan))
    return r / roots


def _kappa_influences(o: Observations) -> dict[str, tuple[Floats, Floats]]:
    """Derivatives of both kappas by the weights of trials and of people; none without responses."""
    if o.responses is None:
        return {}
    trials, persons, answers = o.responses
    is_right = (answers == o.labels[trials]).astype(np.int64)
    answered = answers_of(o.probabilities)
    return {
        "error_consistency": influence.kappa_influences(o.credits, (trials, persons, is_right)),
        "cohen_kappa": influence.kappa_influences(answered, (trials, persons, answers)),
    }


def _pull_people(o: Observations, values: Mapping[str, float]) -> dict[str, Floats]:
    """Derivatives of metrics by people's weights, (n_people,) each, by way of the human means they move."""
    if o.responses is None or o.n is None or o.n_yes is None:
        return {}
    return {
        name: influence.gather_people(
            influence.spread_to_responses(slopes, o.responses, o.n, o.n_yes), o.responses[1]
        )
        for name, slopes in _slopes(o, values).items()
    }


def _slopes(o: Observations, values: Mapping[str, float]) -> dict[str, Floats]:
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
