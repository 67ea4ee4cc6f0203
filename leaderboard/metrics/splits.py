"""Halves of the people: who is in which, and how each half judged each trial."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]

BATCH = 125
"""Splits whose counts are made at a time; with 192 trials an array of both halves then takes 384 kB."""


@dataclass(frozen=True)
class Tables:
    """Who answered what, as whole numbers.

    Attributes
    ----------
    judged, said_yes : (n_people, n_trials)
        How often a person judged a trial, and how often the answer was YES.
    """

    judged: Floats
    said_yes: Floats


@dataclass(frozen=True)
class Halves:
    """Both halves of the people in every split; how they judged each trial is counted when asked for.

    Attributes
    ----------
    is_first : (n_splits, n_people)
        Who is in the first half.
    tables
        The answers of single people.
    """

    is_first: Booleans
    tables: Tables

    @cached_property
    def n(self) -> Floats:
        """Answers in the first and in the second half, whole numbers; (2, n_splits, n_trials)."""
        return self._share_out(self.tables.judged)

    @cached_property
    def n_yes(self) -> Floats:
        """Of these YES, whole numbers; (2, n_splits, n_trials)."""
        return self._share_out(self.tables.said_yes)

    @cached_property
    def means(self) -> Floats:
        """Share of YES, 0 where there is no answer; (2, n_splits, n_trials)."""
        shares: Floats = self.n_yes / np.maximum(self.n, 1)
        return shares

    def batches(self) -> Iterator["Halves"]:
        """Give the splits in batches small enough for what is computed from them to stay in the cache."""
        for start in range(0, len(self.is_first), BATCH):
            yield Halves(self.is_first[start : start + BATCH], self.tables)

    def _share_out(self, table: Floats) -> Floats:
        """Sum a table over the people of either half; whole numbers, so exact in any order of addition."""
        first = self.is_first.astype(np.float64) @ table
        return np.stack([first, table.sum(axis=0) - first])


def split_people(sets: Integers, n_splits: int, *, seed: int, stream: int) -> Booleans:
    """Split the people of each set into halves at random, independently in every split.

    Everyone draws a 64-bit number, and those below the set's median are on one side; one number more decides
    which half that is. So all ways to halve a set are equally likely, and of an odd set either half may be
    the larger. The numbers are raw ones of PCG64, whose stream NumPy keeps between versions (NEP 19); the
    sets take theirs in ascending order.

    Parameters
    ----------
    sets : (n_people,)
        Number of the set of people who saw the same trials.
    n_splits
        How many splits.
    seed, stream
        Equal numbers give equal splits; different streams of one seed are independent.

    Returns
    -------
    (n_splits, n_people), true for the first half

    Examples
    --------
    >>> split_people(np.array([0, 0, 1, 1, 1]), 3, seed=1, stream=2).astype(int)
    array([[0, 1, 0, 1, 1],
           [1, 0, 0, 0, 1],
           [0, 1, 1, 0, 1]])
    """
    bits = np.random.PCG64(np.random.SeedSequence([seed, stream]))
    is_first = np.zeros((n_splits, sets.size), bool)
    for number in sorted(set(sets.tolist())):
        people = np.flatnonzero(sets == number)
        raw = bits.random_raw(n_splits * (people.size + 1)).reshape(n_splits, people.size + 1)
        keys, is_swapped = raw[:, :-1], raw[:, -1:] >= np.uint64(2**63)
        medians = np.sort(keys, axis=1)[:, people.size // 2, None]
        is_first[:, people] = (keys < medians) ^ is_swapped
    return is_first


def tabulate_people(
    persons: Integers, trials: Integers, answers: Integers, *, n_people: int, n_trials: int
) -> Tables:
    """Lay out the answers of single people.

    Parameters
    ----------
    persons, trials, answers : (n_responses,)
        Who judged which trial, and 1 for YES or 0 for NO.

    Examples
    --------
    >>> tables = tabulate_people(np.array([0, 1]), np.array([2, 2]), np.array([1, 0]), n_people=2, n_trials=3)
    >>> tables.judged
    array([[0., 0., 1.],
           [0., 0., 1.]])
    >>> tables.said_yes
    array([[0., 0., 1.],
           [0., 0., 0.]])
    """
    cells, shape = persons * n_trials + trials, (n_people, n_trials)
    judged = np.bincount(cells, minlength=n_people * n_trials).astype(np.float64)
    said_yes = np.bincount(cells, answers, minlength=n_people * n_trials).astype(np.float64)
    return Tables(judged.reshape(shape), said_yes.reshape(shape))


def count_halves(
    is_first: Booleans, persons: Integers, trials: Integers, answers: Integers, n_trials: int
) -> Halves:
    """Count the answers of both halves of the people in every split.

    Parameters
    ----------
    is_first : (n_splits, n_people)
        Who is in the first half, from ``split_people``.
    persons, trials, answers : (n_responses,)
        Who judged which trial, and 1 for YES or 0 for NO.
    n_trials
        How many trials there are, judged or not.

    Examples
    --------
    >>> is_first = np.array([[True, False, False]])
    >>> halves = count_halves(is_first, np.array([0, 1, 2]), np.array([0, 0, 0]), np.array([1, 0, 1]), 1)
    >>> halves.n.ravel(), halves.n_yes.ravel()
    (array([1., 2.]), array([1., 1.]))
    """
    tables = tabulate_people(persons, trials, answers, n_people=is_first.shape[1], n_trials=n_trials)
    return Halves(is_first, tables)
