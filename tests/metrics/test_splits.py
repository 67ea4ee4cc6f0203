"""Halves of the people: who falls into which, and what each half said."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from leaderboard.metrics.splits import Halves, count_halves, split_people

SETS = np.array([0, 1, 1, 0, 0, 1, 0, 4, 1, 1])
FIRST = ["0010111101", "0101110001", "1001010110", "0111100101"]


def test_the_first_splits_are_these_for_ever() -> None:
    """Committed numbers: a NumPy that drew others would change every reliability."""
    splits = split_people(SETS, 4, seed=20231105, stream=2).astype(int)
    assert ["".join(map(str, row)) for row in splits.tolist()] == FIRST
    other = split_people(SETS, 4, seed=20231105, stream=3).astype(int)
    assert other.tolist() != splits.tolist()


def test_splits_follow_from_the_published_stream_of_pcg64() -> None:
    """Those whose raw number is below the median of their set are on one side, computed here one by one."""
    raw = iter(np.random.PCG64(np.random.SeedSequence([7, 3])).random_raw(3 * (4 + 1 + 3 + 1)).tolist())
    expected = [[False] * 7 for _ in range(3)]
    for people in ([1, 3, 4, 6], [0, 2, 5]):
        for row in expected:
            keys = [next(raw) for _ in people]
            is_swapped = next(raw) >= 2**63
            median = sorted(keys)[len(people) // 2]
            for person, key in zip(people, keys, strict=True):
                row[person] = (key < median) != is_swapped
    sets = np.array([5, 2, 5, 2, 2, 5, 2])
    assert split_people(sets, 3, seed=7, stream=3).tolist() == expected


@given(sets=st.lists(st.integers(0, 3), max_size=20), seed=st.integers(0, 2**63))
def test_every_set_is_halved(sets: list[int], seed: int) -> None:
    """Whatever the sets, of each as many are in one half as in the other, but for one person at most."""
    numbers = np.array(sets, np.int64)
    splits = split_people(numbers, 7, seed=seed, stream=0)
    assert splits.shape == (7, len(sets))
    for number in set(sets):
        n_first = splits[:, numbers == number].sum(axis=1)
        n_second = (~splits[:, numbers == number]).sum(axis=1)
        assert set((n_first - n_second).tolist()) <= ({0} if sets.count(number) % 2 == 0 else {-1, 1})


def test_all_ways_to_halve_a_set_are_equally_likely() -> None:
    """Over many splits of four and of three people a chi-square test finds nothing."""
    splits = split_people(np.array([0, 0, 0, 0, 1, 1, 1]), 30_000, seed=1, stream=0)
    of_four = np.unique(splits[:, :4], axis=0, return_counts=True)
    of_three = np.unique(splits[:, 4:], axis=0, return_counts=True)
    assert len(of_four[0]) == len(list(combinations(range(4), 2)))
    assert len(of_three[0]) == 6
    assert stats.chisquare(of_four[1]).pvalue > 0.001
    assert stats.chisquare(of_three[1]).pvalue > 0.001


def test_sets_are_split_independently() -> None:
    """Who is first in one set tells nothing of another."""
    splits = split_people(np.array([0, 0, 1, 1]), 30_000, seed=2, stream=0)
    table = [[(splits[:, 0] & ~splits[:, 2]).sum(), (splits[:, 0] & splits[:, 2]).sum()]]
    table.append([(~splits[:, 0] & ~splits[:, 2]).sum(), (~splits[:, 0] & splits[:, 2]).sum()])
    assert stats.chi2_contingency(np.array(table)).pvalue > 0.001


@given(st.data())
def test_halves_count_their_own_answers(data: st.DataObject) -> None:
    """The counts are those of a loop over the answers, and the means their quotients."""
    judgments = data.draw(st.sets(st.tuples(st.integers(0, 4), st.integers(0, 3))))
    persons, trials = (np.array([pair[k] for pair in sorted(judgments)], np.int64) for k in (0, 1))
    answers = np.array([data.draw(st.integers(0, 1)) for _ in judgments], np.int64)
    is_first = split_people(np.zeros(5, np.int64), 3, seed=data.draw(st.integers(0, 99)), stream=0)
    halves = count_halves(is_first, persons, trials, answers, 4)
    n, n_yes = np.zeros((2, 2, 3, 4))
    for person, trial, answer in zip(persons, trials, answers, strict=True):
        for split in range(3):
            half = 0 if is_first[split, person] else 1
            n[half, split, trial] += 1
            n_yes[half, split, trial] += answer
    assert (halves.n == n).all()
    assert (halves.n_yes == n_yes).all()
    assert halves.means == pytest.approx(np.divide(n_yes, n, out=np.zeros(n.shape), where=n > 0))


def test_batches_are_the_splits_in_their_order() -> None:
    """Nothing is lost or doubled where one batch ends and the next begins."""
    rng = np.random.default_rng(0)
    is_first = split_people(np.zeros(6, np.int64), 301, seed=1, stream=0)
    persons, trials = (grid.ravel() for grid in np.mgrid[:6, :4])
    halves = count_halves(is_first, persons, trials, rng.integers(0, 2, persons.size), 4)
    batches: list[Halves] = list(halves.batches())
    assert len(batches) > 1
    assert (np.concatenate([batch.n for batch in batches], axis=1) == halves.n).all()
    assert (np.concatenate([batch.n_yes for batch in batches], axis=1) == halves.n_yes).all()
