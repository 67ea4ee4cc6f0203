"""Where a submission and people part ways most."""

import numpy as np

from leaderboard.ranking import Entry
from leaderboard.website.material import Material
from leaderboard.website.numbers import show_exactly, show_number
from leaderboard.website.pages import Disagreement, Link
from leaderboard.website.trial_cards import judge
from leaderboard.website.trial_paths import trial_path
from leaderboard.website.trial_tables import LABELS

N_LISTED = 20


def find_disagreements(entry: Entry, material: Material) -> tuple[Disagreement, ...]:
    """Find the trials with the largest |P(YES) - share of people who said YES|, largest first.

    Only trials that the submission answered and people judged count; equal ones keep the reference's order.
    """
    reference, people = material.reference, material.reference.people
    if people is None:
        return ()
    compared = np.flatnonzero((people.n > 0) & ~np.isnan(entry.probabilities))
    shares = people.n_yes[compared] / people.n[compared]
    distances = np.abs(entry.probabilities[compared] - shares)
    worst = np.argsort(-distances, kind="stable")[:N_LISTED]
    return tuple(
        Disagreement(
            trial=Link(reference.trial_ids[trial], trial_path(reference.trial_ids[trial])),
            probability=show_number(float(entry.probabilities[trial])),
            exact=show_exactly(float(entry.probabilities[trial])),
            people=show_number(float(share)),
            n=f"{people.n[trial]:,}",
            label=LABELS[reference.labels[trial]],
            verdict=" ".join(judge(float(entry.credits[trial]))),
        )
        for trial, share in zip(compared[worst].tolist(), shares[worst].tolist(), strict=True)
    )
