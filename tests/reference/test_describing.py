"""What is counted for `reference show`."""

import dataclasses

import numpy as np
import pytest

from builders import build_reference
from leaderboard.metrics.undefined import Undefined
from leaderboard.reference import People, Reference
from leaderboard.reference.describing import NO_HUMAN_DATA, describe_reference


@pytest.fixture
def reference() -> Reference:
    """Twelve pairs; the first pair is easy, the second hard, the third both, the others neither."""
    plain = build_reference(pairs_per_scenario=4, n_people=0)
    n, right = np.full(24, 6), np.full(24, 3)
    right[[0, 3, 4, 5]] = 5, 1, 6, 0
    n_yes = np.where(plain.labels == 1, right, n - right)
    return dataclasses.replace(plain, people=People(n, n_yes))


def test_properties_are_followed_by_their_scenarios(reference: Reference) -> None:
    """Parts come in the order of the definition."""
    parts = [(part.kind, part.name) for part in describe_reference(reference).parts]
    assert parts == [
        ("property", "Alpha"),
        ("scenario", "alpha_one"),
        ("scenario", "alpha_two"),
        ("property", "Beta"),
        ("scenario", "beta_one"),
    ]


def test_a_scenario_is_counted(reference: Reference) -> None:
    """Trials, labels, pairs, ratings, accuracy, and the pairs that are easy, hard and both."""
    part = describe_reference(reference).parts[1]
    assert (part.n_trials, part.n_yes_labels, part.n_pairs, part.expected) == (8, 4, 4, None)
    assert (part.n_rated, part.ratings_min, part.ratings_max) == (8, 6, 6)
    assert part.human_accuracy == pytest.approx((5 + 1 + 6 + 0 + 4 * 3) / 48)
    assert (part.n_easy, part.n_hard, part.n_easy_and_hard) == (2, 2, 1)


def test_bounds_are_strict(reference: Reference) -> None:
    """Four of six right is exactly two thirds, which is not easy; two of six is not hard."""
    right = np.full(24, 3)
    right[0], right[2] = 4, 2
    n = np.full(24, 6)
    people = People(n, np.where(reference.labels == 1, right, n - right))
    part = describe_reference(dataclasses.replace(reference, people=people)).parts[0]
    assert (part.n_easy, part.n_hard) == (0, 0)


def test_overall_accuracy_is_the_mean_of_the_properties(reference: Reference) -> None:
    """Properties weigh the same, however many trials they have."""
    description = describe_reference(reference)
    values = [part.human_accuracy for part in description.parts if part.kind == "property"]
    assert values == [pytest.approx(24 / 48 / 2 + 0.25), pytest.approx(0.5)]
    assert description.human_accuracy == pytest.approx(np.mean(np.array(values, float)))
    assert (description.n_trials, description.n_pairs, description.n_rated) == (24, 12, 24)


def test_people_are_counted_where_they_are_known(reference: Reference) -> None:
    """Counts alone do not say how many people there were."""
    description = describe_reference(reference)
    assert (description.n_people, description.trials_per_person, description.n_responses) == (None, None, 144)
    description = describe_reference(build_reference(n_people=12))
    assert (description.n_people, description.trials_per_person, description.n_responses) == (
        12,
        (12, 12),
        144,
    )


def test_without_human_data_there_is_no_accuracy() -> None:
    """What nobody measured is undefined, not 0."""
    description = describe_reference(build_reference(n_people=0))
    assert description.human_accuracy == NO_HUMAN_DATA
    assert {part.human_accuracy for part in description.parts} == {NO_HUMAN_DATA}
    part = description.parts[0]
    assert (part.n_rated, part.ratings_min, part.ratings_max, part.n_easy) == (0, 0, 0, 0)
    assert description.n_responses == 0


def test_an_unrated_property_makes_the_mean_undefined(reference: Reference) -> None:
    """There is no overall human accuracy while one property has none."""
    assert reference.people is not None
    n = np.where(reference.in_property("Beta"), 0, reference.people.n)
    n_yes = np.where(reference.in_property("Beta"), 0, reference.people.n_yes)
    description = describe_reference(dataclasses.replace(reference, people=People(n, n_yes)))
    assert isinstance(description.human_accuracy, Undefined)
    assert isinstance(description.parts[0].human_accuracy, float)


def test_the_reference_names_itself(reference: Reference) -> None:
    """Title, version, kind and digest come from definition and seal."""
    description = describe_reference(reference)
    assert (description.title, description.version, description.kind) == ("Tiny", "1", "synthetic")
    assert description.digest == reference.manifest.digest
