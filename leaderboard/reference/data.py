"""A reference as a value: trials, labels and people as arrays in one fixed order."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from leaderboard.models import Benchmark, Errata, Manifest

Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]


@dataclass(frozen=True)
class Responses:
    """Answers of single people, one element per answer, by participant and then by trial.

    Attributes
    ----------
    participant_ids
        Opaque names, sorted.
    participants : (n_responses,)
        Index into ``participant_ids``.
    trials : (n_responses,)
        Index into the reference's trials.
    answers : (n_responses,)
        1 for YES, 0 for NO.
    rows : (n_responses,)
        Row of each answer in its file, from 0; None where they come from no file.
    """

    participant_ids: tuple[str, ...]
    participants: Integers
    trials: Integers
    answers: Integers
    rows: Integers | None = None


@dataclass(frozen=True)
class People:
    """How people judged each trial.

    Attributes
    ----------
    n : (n_trials,)
        Number of responses; 0 where nobody judged the trial.
    n_yes : (n_trials,)
        Of these, YES.
    responses
        The single responses behind the counts, where they are known.
    """

    n: Integers
    n_yes: Integers
    responses: Responses | None = None


@dataclass(frozen=True)
class DroppedTrial:
    """A trial of the lists that errata take out of the reference.

    Attributes
    ----------
    property_index, scenario_index
        Index into ``benchmark.properties`` and ``benchmark.scenarios``.
    position
        Among all trials of the lists, from 0.
    participant_ids
        Who judged it, as far as single responses are known.
    """

    trial_id: str
    pair_id: str
    property_index: int
    scenario_index: int
    position: int
    participant_ids: tuple[str, ...]
    reason: str


@dataclass(frozen=True)
class Reference:
    """The benchmark's definition, its trials in the order of their files, and human data if there are any.

    Attributes
    ----------
    benchmark, manifest
        The definition and the seal.
    trial_ids : n_trials texts
        Unique over the whole reference.
    pair_ids : n_pairs texts
        Unique, in the order of first appearance.
    properties, scenarios, pairs : (n_trials,)
        Index into ``benchmark.properties``, ``benchmark.scenarios`` and ``pair_ids``.
    copies, labels : (n_trials,)
        0 or 1; label 1 is YES.
    people
        None if the reference lacks human data.
    start_frames : (n_trials,)
        First frame of the prediction phase, -1 where it is not given; None if it was not read.
    errata
        What a maintainer accepts and drops; the trials above are those that are left.
    dropped_trials
        Those that are not, in the order of the lists.
    """

    benchmark: Benchmark
    manifest: Manifest
    trial_ids: tuple[str, ...]
    pair_ids: tuple[str, ...]
    properties: Integers
    scenarios: Integers
    pairs: Integers
    copies: Integers
    labels: Integers
    people: People | None = None
    start_frames: Integers | None = None
    errata: Errata = field(default_factory=Errata)
    dropped_trials: tuple[DroppedTrial, ...] = ()

    @property
    def n_trials(self) -> int:
        """Number of trials."""
        return len(self.trial_ids)

    @property
    def is_synthetic(self) -> bool:
        """Whether labels and people are simulated."""
        return self.manifest.kind == "synthetic"

    @cached_property
    def trial_index(self) -> dict[str, int]:
        """Position of each trial id."""
        return {trial_id: index for index, trial_id in enumerate(self.trial_ids)}

    @cached_property
    def dropped(self) -> Mapping[str, str]:
        """Why each dropped trial was dropped, by its id."""
        return {trial.trial_id: trial.reason for trial in self.dropped_trials}

    def in_scenario(self, scenario_id: str) -> Booleans:
        """Mask of the trials of a scenario, shape (n_trials,)."""
        index = [scenario.id for scenario in self.benchmark.scenarios].index(scenario_id)
        mask: Booleans = self.scenarios == index
        return mask

    def in_property(self, property_name: str) -> Booleans:
        """Mask of the trials of a property, shape (n_trials,)."""
        index = [property_.name for property_ in self.benchmark.properties].index(property_name)
        mask: Booleans = self.properties == index
        return mask
