"""What a reference holds, counted."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from leaderboard.metrics.accuracy import Booleans, human_accuracy, is_above, is_below, right_counts
from leaderboard.metrics.pairs import find_pairs
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.models.benchmark import ReferenceKind
from leaderboard.reference.data import Integers, People, Reference

NO_HUMAN_DATA = Undefined("there are no human data")


@dataclass(frozen=True)
class PartDescription:
    """The trials of one property or scenario.

    Attributes
    ----------
    expected
        Number of trials that the definition expects, if it says.
    n_trials, n_yes_labels, n_pairs
        Trials, those that end in YES, and pairs with two trials.
    n_rated, ratings_min, ratings_max
        Trials that people judged, and the range of the number of people over them (0 if there are none).
    human_accuracy
        Mean over rated trials of the share of people who were right, in [0, 1].
    n_easy, n_hard, n_easy_and_hard
        Pairs (and trials without a partner) that are easy for people, hard for people, and both.
    """

    kind: Literal["property", "scenario"]
    name: str
    title: str
    expected: int | None
    n_trials: int
    n_yes_labels: int
    n_pairs: int
    n_rated: int
    ratings_min: int
    ratings_max: int
    human_accuracy: Estimate
    n_easy: int
    n_hard: int
    n_easy_and_hard: int


@dataclass(frozen=True)
class Description:
    """A whole reference.

    Attributes
    ----------
    parts
        Each property, followed by its scenarios, in the order of the definition.
    n_trials, n_pairs, n_rated
        Over all properties.
    human_accuracy
        Mean of the properties' values, in [0, 1].
    n_people, trials_per_person
        Number of people whose single responses are known, and the fewest and most trials one of them judged;
        None where single responses are unknown.
    n_responses
        Number of responses behind all counts.
    dropped
        Why each trial that errata drop was dropped, by its id; it is in none of the counts.
    """

    title: str
    version: str
    kind: ReferenceKind
    digest: str
    parts: tuple[PartDescription, ...]
    n_trials: int
    n_pairs: int
    n_rated: int
    human_accuracy: Estimate
    n_people: int | None
    trials_per_person: tuple[int, int] | None
    n_responses: int
    dropped: dict[str, str]


def describe_reference(reference: Reference) -> Description:
    """Count what a reference holds: trials, pairs, labels, people, easy and hard."""
    people = reference.people
    properties = tuple(_describe_property(reference, index) for index in range(_n_properties(reference)))
    parts = tuple(part for property_parts in properties for part in property_parts)
    n_people, trials_per_person = _count_people(people)
    return Description(
        title=reference.benchmark.title,
        version=reference.benchmark.version,
        kind=reference.manifest.kind,
        digest=reference.manifest.digest,
        parts=parts,
        n_trials=reference.n_trials,
        n_pairs=len(find_pairs(reference.pairs)),
        n_rated=sum(property_parts[0].n_rated for property_parts in properties),
        human_accuracy=_average([property_parts[0].human_accuracy for property_parts in properties]),
        n_people=n_people,
        trials_per_person=trials_per_person,
        n_responses=0 if people is None else int(people.n.sum()),
        dropped=dict(reference.dropped),
    )


def _n_properties(reference: Reference) -> int:
    return len(reference.benchmark.properties)


def _describe_property(reference: Reference, index: int) -> tuple[PartDescription, ...]:
    property_ = reference.benchmark.properties[index]
    whole = _describe_part(
        reference,
        "property",
        (property_.name, property_.name, property_.trials),
        reference.properties == index,
    )
    scenarios = (
        _describe_part(
            reference,
            "scenario",
            (scenario.id, scenario.title, scenario.trials),
            reference.scenarios == position,
        )
        for position, scenario in enumerate(reference.benchmark.scenarios)
        if scenario.property == property_.name
    )
    return (whole, *scenarios)


def _describe_part(
    reference: Reference,
    kind: Literal["property", "scenario"],
    labelled: tuple[str, str, int | None],
    mask: Booleans,
) -> PartDescription:
    name, title, expected = labelled
    n = np.zeros(int(mask.sum()), np.int64) if reference.people is None else reference.people.n[mask]
    rated = n[n > 0]
    easy, hard = _find_easy_and_hard(reference, mask)
    return PartDescription(
        kind=kind,
        name=name,
        title=title,
        expected=expected,
        n_trials=int(mask.sum()),
        n_yes_labels=int(reference.labels[mask].sum()),
        n_pairs=len(find_pairs(reference.pairs[mask])),
        n_rated=int(rated.size),
        ratings_min=int(rated.min()) if rated.size else 0,
        ratings_max=int(rated.max(initial=0)),
        human_accuracy=_human_accuracy(reference, mask),
        n_easy=len(easy),
        n_hard=len(hard),
        n_easy_and_hard=len(easy & hard),
    )


def _human_accuracy(reference: Reference, mask: Booleans) -> Estimate:
    people = reference.people
    if people is None:
        return NO_HUMAN_DATA
    return human_accuracy(people.n[mask], people.n_yes[mask], reference.labels[mask])


def _find_easy_and_hard(reference: Reference, mask: Booleans) -> tuple[set[int], set[int]]:
    """Find the pairs of which a member is above, and below, the benchmark's bounds."""
    people, grading = reference.people, reference.benchmark.grading
    if people is None:
        return set(), set()
    n, pairs = people.n[mask], reference.pairs[mask]
    right: Integers = right_counts(n, people.n_yes[mask], reference.labels[mask])
    easy = pairs[is_above(right, n, grading.easy_above)]
    hard = pairs[is_below(right, n, grading.hard_below)]
    return set(easy.tolist()), set(hard.tolist())


def _average(values: list[Estimate]) -> Estimate:
    numbers = [value for value in values if not isinstance(value, Undefined)]
    if len(numbers) < len(values):
        return next(value for value in values if isinstance(value, Undefined))
    return sum(numbers) / len(numbers)


def _count_people(people: People | None) -> tuple[int | None, tuple[int, int] | None]:
    if people is None or people.responses is None:
        return None, None
    counts = np.bincount(people.responses.participants)
    return len(people.responses.participant_ids), (int(counts.min()), int(counts.max()))
