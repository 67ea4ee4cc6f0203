"""The people who judged a property: how well they agree, and which trials are easy or hard for them."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from leaderboard.grading.draws import SPLIT_STREAM, find_sets
from leaderboard.metrics.accuracy import Booleans, Integers
from leaderboard.metrics.crossfit import CrossFit, cross_fit
from leaderboard.metrics.reliability import (
    Reliability,
    SplitHalf,
    count_reliability,
    split_half_reliability,
)
from leaderboard.metrics.splits import Halves, Tables, count_halves, split_people
from leaderboard.reference import People, Reference

N_SPLITS = 1000
N_CROSSFIT_SPLITS = 250


@dataclass(frozen=True)
class Panel:
    """The people who judged the trials of one property.

    Attributes
    ----------
    reference, counts
        The whole reference and its human data.
    mask : (n_trials,)
        The property's trials.
    sets : (n_participants,)
        Which of the reference's participants saw the same trials; empty where single responses are unknown.
    number
        The property's place in the benchmark: each has splits of its own.
    """

    reference: Reference
    counts: People
    mask: Booleans
    sets: Integers
    number: int

    @cached_property
    def people(self) -> Integers:
        """Who judged a trial, as ascending indices of the reference's participants; none if unknown."""
        responses = self.counts.responses
        if responses is None:
            return np.zeros(0, np.int64)
        return np.unique(responses.participants[self.mask[responses.trials]])

    @cached_property
    def halves(self) -> Halves | None:
        """Both halves of the people in 1,000 splits; None where single responses are unknown."""
        responses = self.counts.responses
        if responses is None or not self.people.size:
            return None
        kept = self.mask[responses.trials]
        trials = (np.cumsum(self.mask) - 1)[responses.trials[kept]]
        persons = np.searchsorted(self.people, responses.participants[kept])
        seed, stream = self.reference.benchmark.grading.seed, SPLIT_STREAM + self.number
        is_first = split_people(self.sets[self.people], N_SPLITS, seed=seed, stream=stream)
        return count_halves(is_first, persons, trials, responses.answers[kept], int(self.mask.sum()))

    @cached_property
    def split_half(self) -> SplitHalf | None:
        """Reliability from the halves; None where single responses are unknown."""
        return split_half_reliability(self.halves) if self.halves else None

    @cached_property
    def from_counts(self) -> Reliability:
        """Reliability from the counts alone."""
        tables: Tables | None = self.halves.tables if self.halves else None
        return count_reliability(self.counts.n[self.mask], self.counts.n_yes[self.mask], tables)

    @property
    def reliability(self) -> Reliability:
        """The reliability that ceilings are made of: from the halves if there are any, else from counts."""
        return self.split_half.reliability if self.split_half else self.from_counts

    @cached_property
    def crossfit(self) -> CrossFit | None:
        """Easy and hard trials chosen by one half and measured on the other; None without responses.

        The first 250 splits with either half choosing are 500 cases, of which the mean is as sure as of more.
        """
        if self.halves is None:
            return None
        first = replace(self.halves, is_first=self.halves.is_first[:N_CROSSFIT_SPLITS])
        labels, pairs = self.reference.labels[self.mask], self.reference.pairs[self.mask]
        grading = self.reference.benchmark.grading
        return cross_fit(first, labels, pairs, easy=grading.easy_above, hard=grading.hard_below)


def find_panels(reference: Reference) -> Mapping[str, Panel]:
    """Give the panel of each property; none without human data."""
    people = reference.people
    if people is None:
        return {}
    sets = find_sets(people.responses, reference) if people.responses else np.zeros(0, np.int64)
    names = [property_.name for property_ in reference.benchmark.properties]
    return {
        name: Panel(reference, people, reference.in_property(name), sets, number)
        for number, name in enumerate(names)
    }
