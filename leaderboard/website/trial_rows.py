"""Trials as lists show them: pairs and trials without a twin, and who got how much of each right."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from leaderboard.metrics.accuracy import Booleans, Floats, right_counts
from leaderboard.metrics.pairs import find_pairs
from leaderboard.reference import Reference
from leaderboard.reference.data import Integers
from leaderboard.website.material import Material

HALF_CREDIT = 0.5


@dataclass(frozen=True)
class TrialRows:
    """All rows of a reference; ``credits`` are those of ranked submissions, (n_ranked, n_trials)."""

    reference: Reference
    credits: Floats

    @classmethod
    def of(cls, material: Material) -> "TrialRows":
        """Stack what every ranked submission earned, board by board."""
        credits = [row.entry.credits for board in material.boards for row in board.ranked]
        shape = (len(credits), material.reference.n_trials)
        return cls(material.reference, np.array(credits, float).reshape(shape))

    @property
    def n_ranked(self) -> int:
        """How many submissions are ranked, on all boards."""
        return len(self.credits)

    @property
    def has_halves(self) -> bool:
        """Whether any ranked submission is undecided on any trial."""
        return bool((self.credits == HALF_CREDIT).any())

    @cached_property
    def twins(self) -> Integers:
        """Find the other trial of each trial's pair, -1 where there is none; (n_trials,)."""
        members = find_pairs(self.reference.pairs)
        twins = np.full(self.reference.n_trials, -1)
        twins[members] = members[:, ::-1]
        return twins

    @cached_property
    def firsts(self) -> Integers:
        """Find the trial that each trial's row begins with: that of the lower copy; (n_trials,)."""
        own, twins, copies = np.arange(len(self.twins)), self.twins, self.reference.copies
        comes_later = (copies[twins] < copies) | ((copies[twins] == copies) & (twins < own))
        firsts: Integers = np.where((twins >= 0) & comes_later, twins, own)
        return firsts

    @cached_property
    def n_right(self) -> Integers:
        """Count the ranked submissions that are right on every trial of each trial's row; (n_trials,)."""
        counts: Integers = self.all_of_row(self.credits == 1).sum(axis=0)
        return counts

    def list_rows(self, scenario_id: str) -> tuple[Integers, Integers]:
        """List a scenario's pairs, (n, 2) by their copies, and its trials without a twin, (n, 1)."""
        inside = self.reference.in_scenario(scenario_id)
        own = np.arange(len(self.twins))
        begins = inside & (self.firsts == own)
        pairs = np.flatnonzero(begins & (self.twins >= 0))
        return np.column_stack([pairs, self.twins[pairs]]), np.flatnonzero(begins & (self.twins < 0))[:, None]

    def all_of_row(self, holds: Booleans) -> Booleans:
        """Say of each trial whether something holds of all trials of its row; (..., n_trials)."""
        whole: Booleans = holds & (holds[..., self.twins] | (self.twins < 0))
        return whole

    def any_of_row(self, holds: Booleans) -> Booleans:
        """Say of each trial whether something holds of any trial of its row; (..., n_trials)."""
        any_: Booleans = holds | (holds[..., self.twins] & (self.twins >= 0))
        return any_

    def share_right(self) -> Floats:
        """Give the share of people's answers right on each trial's row, NaN without any; (n_trials,)."""
        people = self.reference.people
        n = np.zeros(len(self.twins), int) if people is None else people.n
        right = right_counts(people.n, people.n_yes, self.reference.labels) if people else n
        with_twin = self.twins >= 0
        total = n + np.where(with_twin, n[self.twins], 0)
        n_right = right + np.where(with_twin, right[self.twins], 0)
        shares: Floats = np.divide(n_right, total, out=np.full(len(total), np.nan), where=total > 0)
        return shares
