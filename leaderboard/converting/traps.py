"""Counts that give away what usually goes wrong between a model's answers and a submission."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from leaderboard.metrics.pairs import find_pairs
from leaderboard.submission import Status

if TYPE_CHECKING:
    from leaderboard.converting.merging import Prediction
    from leaderboard.reference import Reference


@dataclass(frozen=True)
class Traps:
    """What was met, over all trials that the run answers, whether their scenario is whole or not.

    Attributes
    ----------
    n_trials, n_matched
        Trials of the benchmark; those that an answer means, and only that one.
    n_duplicated, n_ambiguous
        Trials with more than one answer for the same repeat; answers whose name fits several trials.
    statuses
        How many of the matched trials have which status, those that occur.
    n_yes, n_ties
        Of the trials with an answer, those with YES, and those with exactly one half.
    n_pairs, n_alike
        Pairs of which both members are answered, and those of them with the same answer to both.
    repeats
        How often trials were asked: pairs of a number of repeats and how many trials have it.
    n_answers, n_unanswered
        Single answers behind the matched trials; those of them without YES or NO.
    """

    n_trials: int = 0
    n_matched: int = 0
    n_duplicated: int = 0
    n_ambiguous: int = 0
    statuses: tuple[tuple[Status, int], ...] = ()
    n_yes: int = 0
    n_ties: int = 0
    n_pairs: int = 0
    n_alike: int = 0
    repeats: tuple[tuple[int, int], ...] = ()
    n_answers: int = 0
    n_unanswered: int = 0

    @property
    def n_missing(self) -> int:
        """Trials of the benchmark that no answer means, or several that differ."""
        return self.n_trials - self.n_matched

    @property
    def n_answered(self) -> int:
        """Matched trials with an answer."""
        return dict(self.statuses).get(Status.ANSWERED, 0)


def count_traps(
    predictions: Sequence["Prediction"], reference: "Reference", *, n_duplicated: int, n_ambiguous: int
) -> Traps:
    """Count over the predictions for all trials that a run answers."""
    sides = np.full(reference.n_trials, np.nan)
    for prediction in predictions:
        if prediction.status is Status.ANSWERED:
            sides[reference.trial_index[prediction.trial_id]] = np.sign(float(prediction.probability) - 0.5)
    members = sides[find_pairs(reference.pairs)]
    members = members[~np.isnan(members).any(axis=1)]
    statuses = Counter(prediction.status for prediction in predictions)
    return Traps(
        n_trials=reference.n_trials,
        n_matched=len(predictions),
        n_duplicated=n_duplicated,
        n_ambiguous=n_ambiguous,
        statuses=tuple((status, statuses[status]) for status in Status if status in statuses),
        n_yes=int((sides > 0).sum()),
        n_ties=int((sides == 0).sum()),
        n_pairs=len(members),
        n_alike=int((members[:, 0] == members[:, 1]).sum()),
        repeats=tuple(sorted(Counter(prediction.n_repeats for prediction in predictions).items())),
        n_answers=sum(prediction.n_repeats for prediction in predictions),
        n_unanswered=sum(prediction.n_repeats - prediction.n_answered for prediction in predictions),
    )
