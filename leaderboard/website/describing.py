"""Words and addresses that several pages share."""

from collections.abc import Collection

import numpy as np

from leaderboard.grading.panels import N_CROSSFIT_SPLITS
from leaderboard.grading.scopes import CROSSFIT_SUBSETS
from leaderboard.metrics.accuracy import Floats
from leaderboard.models import Benchmark
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Board, Entry
from leaderboard.website.material import Material
from leaderboard.website.numbers import show_bound
from leaderboard.website.quantities import Described

SUBSET_TITLES = {
    "all": "All",
    "easy": "Easy",
    "hard": "Hard",
    "easy_crossfit": "Easy, cross-fitted",
    "hard_crossfit": "Hard, cross-fitted",
}


def board_path(board: Board) -> str:
    """Say where a track's board is: the default one is the site's first page."""
    return "index.html" if board.track.default else f"tracks/{board.track.id}/index.html"


def figure_path(board: Board) -> str:
    """Say where the paper's figure of a track is."""
    return "figure.html" if board.track.default else f"tracks/{board.track.id}/figure.html"


def property_path(name: str) -> str:
    """Say where a property's page is."""
    return f"properties/{name.lower()}/index.html"


def scenario_path(property_name: str, scenario_id: str) -> str:
    """Say where a scenario's page is, for the several scenarios of one property."""
    return f"properties/{property_name.lower()}/{scenario_id}/index.html"


def submission_path(slug: str) -> str:
    """Say where a submission's page is."""
    return f"submissions/{slug}/index.html"


def submission_trials_path(slug: str) -> str:
    """Say where the page of a submission's trials is."""
    return f"submissions/{slug}/trials.html"


def count_of(count: int, one: str, many: str = "") -> str:
    """Count things in words.

    >>> count_of(1, "trial"), count_of(1200, "trial"), count_of(2, "person", "people")
    ('1 trial', '1,200 trials', '2 people')
    """
    return f"{count:,} {one if count == 1 else many or one + 's'}"


def badges_of(entry: Entry) -> tuple[str, ...]:
    """Say in words what a reader must know before comparing an entry with others."""
    marks = {
        "baseline": entry.is_baseline,
        "partial": not entry.is_complete,
        "ground-truth state as input": entry.metadata.model.inputs == "state",
        "see its checks": bool(entry.result.checks) and not entry.is_baseline,
    }
    return tuple(badge for badge, applies in marks.items() if applies)


def describe_coverage(entry: Entry, material: Material) -> str:
    """Say how much of the benchmark a submission attempts."""
    coverage = entry.result.coverage
    properties = ", ".join(coverage.properties) or "no whole property"
    return f"covers {properties}; {coverage.trials:,} of {material.reference.n_trials:,} trials"


def describe_people(material: Material) -> str:
    """Say how many people judged the trials, as far as that is known."""
    people = material.reference.people
    if people is None:
        return ""
    responses = f"{int(people.n.sum()):,} responses"
    if people.responses is None:
        return responses
    return f"{count_of(len(people.responses.participant_ids), 'person', 'people')}, {responses}"


def warn_of_simulation(material: Material) -> str:
    """Say what every figure of a simulated reference must say itself, since it may be shown alone."""
    return "Synthetic reference: labels and people are simulated." if material.reference.is_synthetic else ""


def title_scopes(names: Collection[str], benchmark: Benchmark) -> list[tuple[str, str, int]]:
    """Give scopes in their order: name, title, and 0 for overall, 1 for a property, 2 for a scenario.

    A property of which only some scenarios are named is listed too, as the heading of these. The only
    scenario of a property is left out: its scores are the property's.
    """
    scopes = [(OVERALL, "Overall", 0)] if OVERALL in names else []
    for name in (property_.name for property_ in benchmark.properties):
        members = benchmark.scenarios_of(name)
        scenarios = [(s.id, s.title, 2) for s in members if s.id in names and len(members) > 1]
        if scenarios or name in names:
            scopes += [(name, name, 1), *scenarios]
    return scopes


def answers_of(entry: Entry) -> Floats:
    """Give P(YES) of each trial, 0.5 where there is no answer, as metrics do; (n_trials,)."""
    return np.nan_to_num(entry.probabilities, nan=0.5)


def describe_chance(quantity: Described) -> str:
    """Print what guessing gives, or nothing where that is not one number."""
    if quantity.chance is None:
        return ""
    return show_bound(quantity, quantity.chance)


def list_subsets(material: Material) -> tuple[str, ...]:
    """Name the subsets that the reference has the human data for."""
    return tuple(material.people[OVERALL]) if material.people else ("all",)


def is_crossfit(subset: str) -> bool:
    """Tell whether one half of the people chooses the trials, so that their numbers are averages."""
    return subset in CROSSFIT_SUBSETS


def describe_subset(subset: str, material: Material) -> str:
    """Say which trials are in a subset."""
    grading = material.reference.benchmark.grading
    what = "Pairs of which at least one trial was" if material.has_pairs else "Trials"
    rule = f"{what} answered rightly by"
    crossfit = (
        "for one random half of the people, measured on the other half; "
        f"means over {N_CROSSFIT_SPLITS:,} halvings, "
        "each both ways."
    )
    return {
        "all": "Every trial.",
        "easy": f"{rule} more than {grading.easy} of the people.",
        "hard": f"{rule} fewer than {grading.hard} of the people.",
        "easy_crossfit": f"Easy {crossfit}",
        "hard_crossfit": f"Hard {crossfit}",
    }[subset]
