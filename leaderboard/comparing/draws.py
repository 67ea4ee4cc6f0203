"""The resamples that all comparisons share: of pairs, and of the people who judged them."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Self

import numpy as np

from leaderboard.metrics.accuracy import Booleans, Floats, Integers
from leaderboard.metrics.resampling import Counts, draw_weights
from leaderboard.reference import People, Reference, Responses

PAIR_STREAM = 0
PEOPLE_STREAM = 1
CHUNK = 1000  # resamples at a time: as fast as all at once, in a tenth of the memory


@dataclass(frozen=True)
class Draws:
    """Bootstrap weights for a whole reference.

    Attributes
    ----------
    pairs : (n_resamples, n_pairs)
        How often each pair is drawn, within its scenario.
    people : (n_resamples, n_participants), or None where responses of single people are unknown
        How often each person is drawn, within the set of people who saw the same trials.
    """

    pairs: Counts
    people: Counts | None

    @classmethod
    def of(cls, reference: Reference) -> Self:
        """Draw as many resamples as the benchmark says, from its seed."""
        grading = reference.benchmark.grading
        strata = np.zeros(len(reference.pair_ids), np.int64)
        strata[reference.pairs] = reference.scenarios
        pairs = draw_weights(strata, grading.resamples, seed=grading.seed, stream=PAIR_STREAM)
        responses = reference.people.responses if reference.people else None
        if responses is None:
            return cls(pairs, None)
        sets = find_sets(responses, reference)
        return cls(pairs, draw_weights(sets, grading.resamples, seed=grading.seed, stream=PEOPLE_STREAM))

    def resample_people(
        self, reference: Reference, people: People, mask: Booleans
    ) -> Iterator[tuple[Floats, Floats]]:
        """Resample the human means of some trials together with the trials themselves, chunk by chunk.

        Yields
        ------
        weights : (n_chunk, n_trials)
            How often each trial is drawn; 0 where none of the drawn people judged it.
        means : (n_chunk, n_trials) or (n_trials,)
            Share of YES among the drawn people; among all, where single responses are unknown.
        """
        trials = np.flatnonzero(mask)
        for start in range(0, len(self.pairs), CHUNK):
            rows = slice(start, start + CHUNK)
            weights = self.pairs[rows][:, reference.pairs[trials]].astype(np.float64)
            if self.people is None or people.responses is None:
                yield weights, people.n_yes[trials] / people.n[trials]
                continue
            judged, said_yes = _tabulate(people.responses, reference.n_trials)
            persons = self.people[rows].astype(np.float64)
            n, n_yes = persons @ judged[:, trials], persons @ said_yes[:, trials]
            yield np.where(n > 0, weights, 0.0), n_yes / np.maximum(n, 1)


def find_sets(responses: Responses, reference: Reference) -> Integers:
    """Number the sets of people who saw the same trials, shape (n_participants,).

    Where all people of a property saw different trials, they are one set.
    """
    seen: dict[int, list[int]] = {}
    for person, trial in zip(responses.participants.tolist(), responses.trials.tolist(), strict=True):
        seen.setdefault(person, []).append(trial)
    properties = {person: int(reference.properties[trials[0]]) for person, trials in seen.items()}
    keys = {person: (properties[person], tuple(sorted(trials))) for person, trials in seen.items()}
    for index in set(properties.values()):
        members = [person for person in seen if properties[person] == index]
        if len({keys[person] for person in members}) == len(members):
            keys |= dict.fromkeys(members, (index, ()))
    numbers = {key: number for number, key in enumerate(sorted(set(keys.values())))}
    return np.array([numbers[keys[person]] for person in range(len(responses.participant_ids))])


def _tabulate(responses: Responses, n_trials: int) -> tuple[Floats, Floats]:
    """Lay out who judged what and who said YES, each (n_participants, n_trials)."""
    judged = np.zeros((len(responses.participant_ids), n_trials))
    said_yes = np.zeros_like(judged)
    judged[responses.participants, responses.trials] = 1
    said_yes[responses.participants, responses.trials] = responses.answers
    return judged, said_yes
