"""The scores of people themselves: how often they are right, and how well they agree with each other."""

from collections.abc import Mapping

import numpy as np

from leaderboard.grading.cells import Cell
from leaderboard.grading.crossfitted import CrossCell, resample_people_crossfit
from leaderboard.grading.panels import Panel
from leaderboard.grading.scopes import EMPTY_SUBSET, list_scopes
from leaderboard.grading.sums import share
from leaderboard.grading.tally import Tally
from leaderboard.grading.yardstick import Yardstick, root
from leaderboard.metrics.accuracy import Floats, human_accuracy, right_counts
from leaderboard.metrics.crossfit import human_accuracy_on
from leaderboard.metrics.influence import gather_people, spread_to_responses
from leaderboard.metrics.reliability import Reliability, ceiling_of
from leaderboard.metrics.resampling import INFLUENCE_BITS, on_grid
from leaderboard.metrics.undefined import NO_RATED_TRIALS, Estimate, Undefined
from leaderboard.models import SubsetScores
from leaderboard.reference import People, Reference

Scores = Mapping[str, Mapping[str, SubsetScores]]
Resampled = dict[str, Floats]


def grade_people(reference: Reference, *, yardstick: Yardstick | None = None) -> Scores:
    """Score people themselves, for the human row; overall is the mean of the properties.

    Everywhere: accuracy, the mean over rated trials of the share of people who were right, and the rate of
    YES. On cross-fitted subsets: accuracy of the half that did not choose them. On whole properties: the
    correlation of random halves of the people, the reliability of the human means from it and from counts,
    and the ceiling of ``human_r``, the root of the reliability. Empty without human data.

    Parameters
    ----------
    yardstick
        That of the reference, if it is there already.
    """
    people = reference.people
    if people is None:
        return {}
    yardstick = yardstick or Yardstick.of(reference)
    tally = Tally(yardstick.properties, keeps_resamples=False)
    everything = np.ones(reference.n_trials, bool)
    for cell in yardstick.list_cells(everything):
        estimates = _estimate(people, reference, cell)
        resampled = _resample(people, reference, cell, yardstick)
        panel = yardstick.find_panel(cell)
        if panel:
            agreement, resampled_agreement = _measure_agreement(panel, cell, yardstick)
            estimates, resampled = estimates | agreement, resampled | resampled_agreement
        tally.add(cell.key, cell.counts, estimates, resampled)
        for cross in yardstick.find_cross_cells(cell):
            accuracy = {"accuracy": human_accuracy_on(cross.weighed)}
            tally.add(cross.key, cross.counts, accuracy, _resample_crossfit(cross, accuracy))
    tally.average()
    return tally.assemble([scope.name for scope in list_scopes(reference, everything)])


def _estimate(people: People, reference: Reference, cell: Cell) -> dict[str, Estimate]:
    if not cell.mask.any():
        return {"accuracy": EMPTY_SUBSET, "yes_rate": EMPTY_SUBSET}
    n, n_yes, labels = people.n[cell.mask], people.n_yes[cell.mask], reference.labels[cell.mask]
    rated = n > 0
    said_yes: Estimate = float(np.mean(n_yes[rated] / n[rated])) if rated.any() else NO_RATED_TRIALS
    return {"accuracy": human_accuracy(n, n_yes, labels), "yes_rate": said_yes}


def _resample(people: People, reference: Reference, cell: Cell, yardstick: Yardstick) -> Resampled:
    """Draw pairs and, to first order, people; as for submissions."""
    n, n_yes, labels = people.n[cell.mask], people.n_yes[cell.mask], reference.labels[cell.mask]
    rated = n > 0
    if not rated.any():
        return {}
    shares = np.array([right_counts(n, n_yes, labels), n_yes, n]) / np.maximum(n, 1)
    right, said_yes, drawn = cell.sum_by_pair(on_grid(shares, INFLUENCE_BITS)) @ cell.drawn.weights
    slopes = np.array([2.0 * labels - 1, np.ones(labels.size)]) * rated / rated.sum()
    effects = yardstick.draw_effects(cell, _pull(people, cell, slopes))
    return {
        "accuracy": np.clip(share(right, drawn) + effects[0], 0, 1),
        "yes_rate": np.clip(share(said_yes, drawn) + effects[1], 0, 1),
    }


def _pull(people: People, cell: Cell, slopes: Floats) -> list[Floats]:
    """Turn derivatives by human means into derivatives by people's weights; zeros without responses."""
    responses = people.responses
    if responses is None:
        return [np.zeros(0) for _ in slopes]
    kept = cell.mask[responses.trials]
    trials = (np.cumsum(cell.mask) - 1)[responses.trials[kept]]
    single = trials, responses.participants[kept], responses.answers[kept]
    n, n_yes = people.n[cell.mask], people.n_yes[cell.mask]
    return [gather_people(spread_to_responses(row, single, n, n_yes), single[1]) for row in slopes]


def _measure_agreement(
    panel: Panel, cell: Cell, yardstick: Yardstick
) -> tuple[dict[str, Estimate], Resampled]:
    found: dict[str, Reliability] = {"reliability": panel.reliability}
    if panel.split_half:
        found = {
            "split_half_r": panel.split_half.split_half_r,
            **found,
            "reliability_from_counts": panel.from_counts,
        }
    estimates: dict[str, Estimate] = {name: reliability.value for name, reliability in found.items()}
    estimates["ceiling"] = ceiling_of(panel.reliability.value)
    resampled = {
        name: yardstick.resample_reliability(reliability, cell)
        for name, reliability in found.items()
        if not isinstance(reliability.value, Undefined)
    }
    if not isinstance(estimates["ceiling"], Undefined):
        resampled["ceiling"] = root(resampled["reliability"])
    return estimates, resampled


def _resample_crossfit(cross: CrossCell, estimates: Mapping[str, Estimate]) -> Resampled:
    is_defined = not isinstance(estimates["accuracy"], Undefined)
    return {"accuracy": resample_people_crossfit(cross)} if is_defined else {}
