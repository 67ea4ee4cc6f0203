"""Which trials a score is about: overall, a property or a scenario; all, easy or hard."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from leaderboard.metrics.accuracy import Booleans, is_above, is_below, right_counts
from leaderboard.metrics.undefined import Undefined
from leaderboard.models.benchmark import OVERALL
from leaderboard.reference import Reference

CROSSFIT_SUBSETS = ("easy_crossfit", "hard_crossfit")
EMPTY_SUBSET = Undefined("no trial is in this subset")
SUBSETS = ("all", "easy", "hard", *CROSSFIT_SUBSETS)


@dataclass(frozen=True)
class Scope:
    """A named set of trials; ``mask`` has shape (n_trials,)."""

    name: str
    kind: Literal["overall", "property", "scenario"]
    mask: Booleans


def list_scopes(reference: Reference, covered: Booleans) -> tuple[Scope, ...]:
    """List the scopes that are wholly covered: overall, then each property with its scenarios.

    Parameters
    ----------
    covered : (n_trials,)
        Which trials a submission gives.
    """
    everything = np.ones(reference.n_trials, bool)
    scopes = [Scope(OVERALL, "overall", everything)]
    for property_ in reference.benchmark.properties:
        scopes.append(Scope(property_.name, "property", reference.in_property(property_.name)))
        scopes += [
            Scope(scenario.id, "scenario", reference.in_scenario(scenario.id))
            for scenario in reference.benchmark.scenarios_of(property_.name)
        ]
    return tuple(scope for scope in scopes if scope.mask.any() and covered[scope.mask].all())


def subset_masks(reference: Reference) -> dict[str, Booleans]:
    """Say which trials are in each subset; without human data there is only ``all``.

    A pair is easy if at least one member's human accuracy is above the benchmark's bound, and hard if at
    least one member's is below; both members of the pair are then in the subset. Comparisons are exact.

    Returns
    -------
    dict of (n_trials,)
    """
    masks = {"all": np.ones(reference.n_trials, bool)}
    people = reference.people
    if people is None:
        return masks
    right = right_counts(people.n, people.n_yes, reference.labels)
    easy, hard = reference.benchmark.grading.easy_above, reference.benchmark.grading.hard_below
    masks["easy"] = _spread_to_pairs(is_above(right, people.n, easy), reference)
    masks["hard"] = _spread_to_pairs(is_below(right, people.n, hard), reference)
    return masks


def _spread_to_pairs(mask: Booleans, reference: Reference) -> Booleans:
    has_one = np.zeros(len(reference.pair_ids), bool)
    has_one[reference.pairs[mask]] = True
    spread: Booleans = has_one[reference.pairs]
    return spread
