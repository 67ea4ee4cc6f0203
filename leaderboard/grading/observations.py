"""What metrics see: a submission's values and people's, trial by trial, for some of the trials."""

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.accuracy import Booleans, Floats, Integers, credits_of
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.reference import Reference
from leaderboard.submission import Submission

NOT_A_PROPERTY = Undefined("people's reliability is estimated for whole properties")


@dataclass(frozen=True)
class Observations:
    """Arrays of equal length, one element per trial; and one element per response of a single person.

    Attributes
    ----------
    probabilities, credits, answered, labels, pairs : (n_trials,)
        The submission's values (0.5 and credit 0 where not answered), and the reference's.
    n, n_yes : (n_trials,), or None without human data
        Number of people who judged the trial, and of these YES.
    responses : (n_responses,) each, or None where responses of single people are unknown
        Position of the trial in the arrays above, the person, and the answer.
    reliability
        That of the human means, where these are the trials of a whole property.
    """

    probabilities: Floats
    credits: Floats
    answered: Booleans
    labels: Integers
    pairs: Integers
    n: Integers | None
    n_yes: Integers | None
    responses: tuple[Integers, Integers, Integers] | None
    reliability: Estimate = NOT_A_PROPERTY

    @classmethod
    def of(cls, submission: Submission, reference: Reference) -> Self:
        """Line up a submission with the whole reference."""
        people = reference.people
        single = people.responses if people else None
        return cls(
            probabilities=submission.probabilities,
            credits=credits_of(submission.probabilities, reference.labels, submission.answered),
            answered=submission.answered,
            labels=reference.labels,
            pairs=reference.pairs,
            n=people.n if people else None,
            n_yes=people.n_yes if people else None,
            responses=(single.trials, single.participants, single.answers) if single else None,
        )

    def select(self, mask: Booleans, *, reliability: Estimate = NOT_A_PROPERTY) -> Self:
        """Keep only some of the trials, and the responses to them."""
        kept = np.flatnonzero(mask)
        return type(self)(
            probabilities=self.probabilities[kept],
            credits=self.credits[kept],
            answered=self.answered[kept],
            labels=self.labels[kept],
            pairs=self.pairs[kept],
            n=None if self.n is None else self.n[kept],
            n_yes=None if self.n_yes is None else self.n_yes[kept],
            responses=self._select_responses(mask),
            reliability=reliability,
        )

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

    def _select_responses(self, mask: Booleans) -> tuple[Integers, Integers, Integers] | None:
        if self.responses is None:
            return None
        trials, persons, answers = self.responses
        kept = mask[trials]
        position = np.cumsum(mask) - 1
        return position[trials[kept]], persons[kept], answers[kept]
