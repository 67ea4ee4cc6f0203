"""Cross-validation in which the members of a pair are never on different sides."""

from collections.abc import Sequence
from itertools import combinations

import numpy as np

from leaderboard.errors import SourceError
from leaderboard.readout.features import Integers

N_FOLDS = 5


def split_pairs(pair_ids: Sequence[str], labels: Integers, *, seed: int, name: str = "readout") -> Integers:
    """Deal pairs out into five folds at random, by scikit-learn's ``GroupKFold``.

    Parameters
    ----------
    pair_ids : n_trials texts
        Each trial's pair.
    labels : (n_trials,)
        0 or 1.
    seed
        Equal seeds give equal folds.
    name
        How messages name the trials.

    Returns
    -------
    (n_trials,), the number of each trial's fold, from 0

    Raises
    ------
    SourceError
        If there are fewer pairs than folds, or the trials outside of two folds all have the same label.

    Examples
    --------
    >>> pairs = ["a", "a", "b", "b", "c", "c", "d", "d", "e", "e"]
    >>> split_pairs(pairs, np.array([0, 1] * 5), seed=0).tolist()
    [1, 1, 2, 2, 0, 0, 3, 3, 4, 4]
    """
    n_pairs = len(set(pair_ids))
    if n_pairs < N_FOLDS:
        message = f"a readout is fitted on {N_FOLDS} pairs at least; given are {n_pairs}"
        raise SourceError(f"{name}: {message}", "give more trials, and of each both members")
    folds = _deal_pairs(pair_ids, seed)
    for held_out in combinations(range(N_FOLDS), 2):  # one is predicted, another chooses
        outside = labels[~np.isin(folds, held_out)]
        if outside.min() == outside.max():
            answer = "YES" if outside[0] else "NO"
            message = f"{name}: all or nearly all trials to fit on end with {answer}"
            raise SourceError(message, "give more trials, and of both outcomes")
    return folds


def list_splits(folds: Integers) -> list[tuple[Integers, Integers]]:
    """List for each fold that occurs the trials outside and inside of it, as scikit-learn takes them."""
    return [(np.flatnonzero(folds != f), np.flatnonzero(folds == f)) for f in sorted(set(folds.tolist()))]


def _deal_pairs(pair_ids: Sequence[str], seed: int) -> Integers:
    from sklearn.model_selection import GroupKFold

    splitter = GroupKFold(N_FOLDS, shuffle=True, random_state=seed)
    folds = np.empty(len(pair_ids), np.int64)
    for fold, (_, inside) in enumerate(splitter.split(folds, groups=np.array(pair_ids))):
        folds[inside] = fold
    return folds
