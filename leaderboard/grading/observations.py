"""What metrics see: a submission's values and people's, trial by trial, for some of the trials."""

from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.accuracy import Booleans, Floats, Integers, credits_of
from leaderboard.metrics.agreement import human_r
from leaderboard.metrics.pairs import find_opposite_pairs, find_pairs
from leaderboard.metrics.resampling import on_grid
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.reference import Reference
from leaderboard.submission import Submission

NOT_A_PROPERTY = Undefined("people's reliability is estimated for whole properties")


@dataclass(frozen=True)
class Ground:
    """What the reference knows of trials: arrays, one element per trial; and one per response of a person.

    Attributes
    ----------
    labels, pairs : (n_trials,)
        Which label each trial has, and which pair it belongs to.
    n, n_yes : (n_trials,), or None without human data
        Number of people who judged the trial, and of these YES.
    responses : (n_responses,) each, or None where responses of single people are unknown
        Position of the trial in the arrays above, the person, and the answer.
    reliability
        That of the human means, where these are the trials of a whole property.
    """

    labels: Integers
    pairs: Integers
    n: Integers | None
    n_yes: Integers | None
    responses: tuple[Integers, Integers, Integers] | None
    reliability: Estimate = field(default=NOT_A_PROPERTY, kw_only=True)

    def select(self, mask: Booleans, *, reliability: Estimate = NOT_A_PROPERTY) -> Self:
        """Keep only some of the trials, and the responses to them."""
        kept = np.flatnonzero(mask)
        values = {item.name: getattr(self, item.name) for item in fields(self)}
        arrays: dict[str, Any] = {
            name: value[kept] for name, value in values.items() if isinstance(value, np.ndarray)
        }
        return replace(self, **arrays, responses=self._select_responses(mask), reliability=reliability)

    @cached_property
    def rated(self) -> Booleans:
        """Which trials people judged, shape (n_trials,); none without human data."""
        return np.zeros(self.labels.size, bool) if self.n is None else self.n > 0

    @cached_property
    def human_means(self) -> Floats:
        """Share of people who said YES on each rated trial, shape (n_rated,)."""
        if self.n is None or self.n_yes is None:
            return np.zeros(0)
        shares: NDArray[np.float64] = self.n_yes[self.rated] / self.n[self.rated]
        return shares

    @cached_property
    def members(self) -> NDArray[np.intp]:
        """The two trials of each pair that has two, shape (n_pairs, 2)."""
        return find_pairs(self.pairs)

    @cached_property
    def opposites(self) -> NDArray[np.intp]:
        """The same of pairs with opposite labels, the YES member first."""
        return find_opposite_pairs(self.pairs, self.labels)

    @cached_property
    def by_label(self) -> dict[int, Booleans]:
        """Which trials are rated and have each label, shape (n_trials,)."""
        return {label: self.rated & (self.labels == label) for label in (0, 1)}

    @cached_property
    def gridded_means(self) -> Floats:
        """Human means on the grid, shape (n_trials,); 0 where nobody judged."""
        if self.n is None or self.n_yes is None:
            return np.zeros(self.labels.size)
        return on_grid(self.n_yes / np.maximum(self.n, 1))

    @cached_property
    def scaled_means(self) -> Floats:
        """Human means, centred and scaled on the grid, shape (n_trials,)."""
        if self.n is None or self.n_yes is None:
            return np.zeros(self.labels.size)
        return on_grid(self.standardize(self.n_yes / np.maximum(self.n, 1)))

    def standardize(self, values: Floats) -> Floats:
        """Centre values of rated trials and scale to at most 1, so that a grid is fine enough; else 0.

        No correlation notices.
        """
        if not self.rated.any():
            return np.zeros(values.size)
        centred: Floats = np.where(self.rated, values - values[self.rated].mean(), 0)
        return centred / (np.abs(centred).max() or 1)

    def _select_responses(self, mask: Booleans) -> tuple[Integers, Integers, Integers] | None:
        if self.responses is None:
            return None
        trials, persons, answers = self.responses
        kept = mask[trials]
        position = np.cumsum(mask) - 1
        return position[trials[kept]], persons[kept], answers[kept]


@dataclass(frozen=True)
class Observations(Ground):
    """A submission's values beside what the reference knows.

    Attributes
    ----------
    probabilities, credits, answered : (n_trials,)
        0.5 and credit 0 where not answered.
    """

    probabilities: Floats
    credits: Floats
    answered: Booleans

    @classmethod
    def of(cls, submission: Submission, reference: Reference) -> Self:
        """Line up a submission with the whole reference."""
        return cls(
            **vars(lay_ground(reference)),
            probabilities=submission.probabilities,
            credits=credits_of(submission.probabilities, reference.labels, submission.answered),
            answered=submission.answered,
        )

    @cached_property
    def human_r(self) -> Estimate:
        """The correlation with people's means, which two metrics are made of."""
        return human_r(self.probabilities[self.rated], self.human_means)


def lay_ground(reference: Reference) -> Ground:
    """Line up what a reference knows of all its trials."""
    people = reference.people
    single = people.responses if people else None
    return Ground(
        labels=reference.labels,
        pairs=reference.pairs,
        n=people.n if people else None,
        n_yes=people.n_yes if people else None,
        responses=(single.trials, single.participants, single.answers) if single else None,
    )
