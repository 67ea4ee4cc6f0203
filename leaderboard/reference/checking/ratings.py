"""How many people judged each trial."""

import numpy as np

from leaderboard.instance import HUMAN_TRIALS_FILE
from leaderboard.models.benchmark import Property
from leaderboard.problems import Problems
from leaderboard.reference.checking.datasheet import Row, Section, make_row
from leaderboard.reference.data import Integers, People, Reference
from leaderboard.reference.definition import shown

TITLE = "Ratings"


def check_ratings(reference: Reference) -> Section:
    """Report trials that nobody judged, and how many people judged the others."""
    people = reference.people
    if people is None:
        problems = Problems()
        problems.add("reference-unrated", "there are no human data", shown(HUMAN_TRIALS_FILE))
        return Section(TITLE, (make_row("Human data", "none", problems=problems),))
    rows = [make_row("Responses", f"{int(people.n.sum()):,}")]
    for property_ in reference.benchmark.properties:
        rows += _check_property(reference, people, property_)
    return Section(TITLE, tuple(rows))


def _check_property(reference: Reference, people: People, property_: Property) -> list[Row]:
    counts = people.n[reference.in_property(property_.name)]
    n_unrated = int((counts == 0).sum())
    problems = Problems()
    if n_unrated:
        message = f"nobody judged {n_unrated} of the {counts.size} trials of {property_.name}"
        problems.add("reference-unrated", message, shown(HUMAN_TRIALS_FILE))
    judged = f"Judged trials of {property_.name}"
    return [
        make_row(judged, str(counts.size - n_unrated), expected=f"all {counts.size}", problems=problems),
        make_row(f"People per trial of {property_.name}", describe_spread(counts)),
    ]


def describe_spread(counts: Integers) -> str:
    """Say how far counts spread.

    >>> describe_spread(np.array([8, 9, 9])), describe_spread(np.array([4, 4]))
    ('8 to 9, median 9', '4')
    """
    low, high = int(counts.min()), int(counts.max())
    return str(low) if low == high else f"{low} to {high}, median {float(np.median(counts)):g}"
