"""Which pairs lists choose: by how hard they are for people, and by who gets them right."""

from collections.abc import Iterator
from dataclasses import dataclass

from leaderboard.grading import subset_masks
from leaderboard.metrics.accuracy import Booleans, right_counts
from leaderboard.reference import People
from leaderboard.website.describing import describe_subset
from leaderboard.website.material import Material
from leaderboard.website.trial_rows import TrialRows


@dataclass(frozen=True)
class Choice:
    """Trials with something in common, whole pairs of them; ``mask`` has shape (n_trials,)."""

    key: str
    title: str
    meaning: str
    mask: Booleans


def list_choices(material: Material, rows: TrialRows) -> Iterator[Choice]:
    """List the choices that the reference and the submissions have the data for."""
    people = material.reference.people
    if people is not None:
        yield from _choose_by_people(material, people, rows)
    if rows.n_ranked:
        yield from _choose_by_submissions(rows)
    if people is not None and rows.n_ranked:
        yield from _choose_by_both(people, rows)


def _choose_by_people(material: Material, people: People, rows: TrialRows) -> Iterator[Choice]:
    masks = subset_masks(material.reference)
    easy, hard = masks["easy"], masks["hard"]
    yield Choice("easy", "Easy for people", describe_subset("easy", material), easy)
    yield Choice("hard", "Hard for people", describe_subset("hard", material), hard)
    neither = rows.any_of_row(people.n > 0) & ~easy & ~hard
    yield Choice("between", "Neither easy nor hard", "Judged by people, and neither easy nor hard.", neither)


def _choose_by_submissions(rows: TrialRows) -> Iterator[Choice]:
    right = rows.n_right
    yield Choice(
        "solved", "Solved by all submissions", "Every ranked submission is right.", right == rows.n_ranked
    )
    yield Choice("unsolved", "Solved by none", "No ranked submission is right on all of it.", right == 0)


def _choose_by_both(people: People, rows: TrialRows) -> Iterator[Choice]:
    n_right = right_counts(people.n, people.n_yes, rows.reference.labels)
    are_right, are_wrong = 2 * n_right > people.n, 2 * n_right < people.n
    few, many = 2 * rows.n_right < rows.n_ranked, 2 * rows.n_right > rows.n_ranked
    yield Choice(
        "people-ahead",
        "People ahead",
        "Most people are right throughout, and fewer than half of the ranked submissions are.",
        rows.all_of_row(are_right) & few,
    )
    yield Choice(
        "submissions-ahead",
        "Submissions ahead",
        "More than half of the ranked submissions are right throughout, and most people are wrong somewhere.",
        rows.any_of_row(are_wrong) & many,
    )
