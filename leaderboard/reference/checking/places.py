"""Where the trials of a reference are listed, dropped ones counted."""

import numpy as np

from leaderboard.models.benchmark import Property
from leaderboard.reference.cells import FIRST_LINE
from leaderboard.reference.data import Booleans, Integers, Reference
from leaderboard.reference.definition import shown


def place_of(reference: Reference, trial: int) -> tuple[str, int]:
    """Tell where a trial is listed: its file, and the line in it."""
    index = int(reference.properties[trial])
    first = int(list_properties(reference).searchsorted(index))
    position = int(_positions(reference)[trial])
    return file_of(reference.benchmark.properties[index]), position - first + FIRST_LINE


def file_of(property_: Property) -> str:
    """Return how messages name the file of a property's trials."""
    return shown(property_.file)


def list_properties(reference: Reference) -> Integers:
    """Index of the property of every listed trial, in the order of the lists."""
    counts = np.bincount(reference.properties, minlength=len(reference.benchmark.properties))
    for trial in reference.dropped_trials:
        counts[trial.property_index] += 1
    return np.repeat(np.arange(counts.size), counts)


def count_dropped(reference: Reference, *, property_: str = "", scenario: str = "") -> int:
    """Count the dropped trials of a property or scenario."""
    benchmark = reference.benchmark
    return sum(
        benchmark.properties[trial.property_index].name == property_
        or benchmark.scenarios[trial.scenario_index].id == scenario
        for trial in reference.dropped_trials
    )


def mention_dropped(count: int) -> str:
    """Say how many trials were dropped, after a count of the listed ones; nothing if none were."""
    return f", {count} of them dropped" if count else ""


def _positions(reference: Reference) -> Integers:
    """Position of each trial among all that are listed."""
    is_kept: Booleans = np.ones(reference.n_trials + len(reference.dropped_trials), bool)
    is_kept[[trial.position for trial in reference.dropped_trials]] = False
    return np.flatnonzero(is_kept)
