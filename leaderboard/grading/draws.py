"""The resamples that all submissions share: of pairs, and of the people who judged them."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.accuracy import Floats, Integers
from leaderboard.metrics.resampling import draw_weights
from leaderboard.reference import Reference, Responses

PAIR_STREAM = 0
PEOPLE_STREAM = 1
SPLIT_STREAM = 2
EXACT_IN_FLOAT32 = 2**24

Weights = NDArray[np.floating[Any]]


@dataclass(frozen=True)
class Draws:
    """Bootstrap weights for a whole reference; whole numbers, as float64 for fast sums.

    Attributes
    ----------
    pairs : (n_pairs, n_resamples)
        How often each pair is drawn, within its scenario.
    people : (n_participants, n_resamples), or None where responses of single people are unknown
        How often each person is drawn, within the set of people who saw the same trials.
    """

    pairs: Floats
    people: Floats | None

    @cached_property
    def small_pairs(self) -> Weights:
        """The weights of pairs as float32, if sums of quarters over two drawn trials of each fit in it.

        Twice as fast, and as exact.
        """
        return self.pairs.astype(np.float32) if 8 * len(self.pairs) ** 2 < EXACT_IN_FLOAT32 else self.pairs

    @cached_property
    def whole_pairs(self) -> NDArray[np.uint16]:
        """The weights of pairs as whole numbers, of which four times as many fit in the cache."""
        return self.pairs.astype(np.uint16)

    @cached_property
    def further_people(self) -> Floats | None:
        """How often each person is drawn, less the once that the data have, (n_participants, n_resamples)."""
        return None if self.people is None else self.people - 1

    @classmethod
    def of(cls, reference: Reference) -> Self:
        """Draw as many resamples as the benchmark says, from its seed."""
        grading = reference.benchmark.grading
        n_resamples, seed = grading.resamples, grading.seed
        pairs = draw_weights(find_strata(reference), n_resamples, seed=seed, stream=PAIR_STREAM)
        responses = reference.people.responses if reference.people else None
        people = None
        if responses is not None:
            sets = find_sets(responses, reference)
            people = draw_weights(sets, n_resamples, seed=seed, stream=PEOPLE_STREAM).T.astype(np.float64)
        return cls(pairs.T.astype(np.float64), people)


def find_run(rows: Integers) -> slice | Integers:
    """Give ascending rows as a slice, which copies nothing, if they follow each other."""
    if rows.size and rows[-1] - rows[0] + 1 == rows.size:
        return slice(rows[0], rows[-1] + 1)
    return rows


def find_strata(reference: Reference) -> Integers:
    """Say within what each pair is drawn: its scenario, shape (n_pairs,)."""
    strata = np.zeros(len(reference.pair_ids), np.int64)
    strata[reference.pairs] = reference.scenarios
    return strata


def find_sets(responses: Responses, reference: Reference) -> Integers:
    """Number the sets of people who saw the same trials, shape (n_participants,).

    Where all people of a property saw different trials, they are one set; so are those who saw none.
    """
    seen: dict[int, list[int]] = {person: [] for person in range(len(responses.participant_ids))}
    for person, trial in zip(responses.participants.tolist(), responses.trials.tolist(), strict=True):
        seen[person].append(trial)
    properties = {p: int(reference.properties[trials[0]]) if trials else -1 for p, trials in seen.items()}
    keys = {person: (properties[person], tuple(sorted(trials))) for person, trials in seen.items()}
    for index in set(properties.values()):
        members = [person for person in seen if properties[person] == index]
        if len({keys[person] for person in members}) == len(members):
            keys |= dict.fromkeys(members, (index, ()))
    numbers = {key: number for number, key in enumerate(sorted(set(keys.values())))}
    return np.array([numbers[keys[person]] for person in seen], np.int64)
