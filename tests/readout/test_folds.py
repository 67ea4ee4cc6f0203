"""Folds: no pair on two sides, all of about the same size, the same for the same seed."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.errors import SourceError
from leaderboard.readout.folds import N_FOLDS, list_splits, split_pairs


@given(st.integers(5, 60), st.integers(0, 1000))
def test_pairs_are_never_split(n_pairs: int, seed: int) -> None:
    """Both members of a pair are in one fold, and folds differ by at most one pair."""
    pair_ids = [f"p{number}" for number in range(n_pairs) for _ in (0, 1)]
    folds = split_pairs(pair_ids, np.array([0, 1] * n_pairs), seed=seed)
    assert folds[::2].tolist() == folds[1::2].tolist()
    sizes = np.bincount(folds[::2], minlength=N_FOLDS)
    assert sizes.max() - sizes.min() <= 1


@given(st.permutations(range(20)))
def test_order_of_trials_does_not_matter(order: list[int]) -> None:
    """A trial is in the same fold, wherever it stands in the file."""
    pair_ids = np.array([f"p{number // 2}" for number in range(20)])
    labels = np.array([0, 1] * 10)
    folds = split_pairs(pair_ids.tolist(), labels, seed=3)
    assert split_pairs(pair_ids[order].tolist(), labels[order], seed=3).tolist() == folds[order].tolist()


def test_seeds_deal_differently() -> None:
    """Another seed gives other folds, the same seed the same."""
    pair_ids, labels = [f"p{number // 2}" for number in range(40)], np.array([0, 1] * 20)
    first, again, other = (split_pairs(pair_ids, labels, seed=seed).tolist() for seed in (0, 0, 1))
    assert first == again != other


def test_splits_cover_each_trial_once() -> None:
    """Every trial is inside of one fold and outside of the others, also where a fold was taken out."""
    splits = list_splits(np.array([0, 2, 2, 4, 0]))
    assert [(outside.tolist(), inside.tolist()) for outside, inside in splits] == [
        ([1, 2, 3], [0, 4]),
        ([0, 3, 4], [1, 2]),
        ([0, 1, 2, 4], [3]),
    ]


@pytest.mark.parametrize(
    ("n_pairs", "labels", "message"),
    [
        (4, [0, 1] * 4, "^Alpha: a readout is fitted on 5 pairs at least; given are 4$"),
        (10, [0] * 20, "^Alpha: all or nearly all trials to fit on end with NO$"),
        (10, [0] + [1] * 19, "^Alpha: all or nearly all trials to fit on end with YES$"),
    ],
)
def test_what_cannot_be_split_is_refused(n_pairs: int, labels: list[int], message: str) -> None:
    """Too few pairs, or trials of one outcome, are refused before anything is fitted."""
    pair_ids = [f"p{number}" for number in range(n_pairs) for _ in (0, 1)]
    with pytest.raises(SourceError, match=message):
        split_pairs(pair_ids, np.array(labels), seed=0, name="Alpha")
