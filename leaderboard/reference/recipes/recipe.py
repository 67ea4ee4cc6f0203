"""What a recipe is and what it reports."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from leaderboard.instance import Instance
from leaderboard.models import Manifest
from leaderboard.problems import Problem


@dataclass(frozen=True)
class ImportedProperty:
    """What was imported of one property.

    ``human_accuracy`` is the mean over the trials that people judged, in [0, 1]; None if they judged none.
    """

    name: str
    n_trials: int
    n_rated: int
    human_accuracy: float | None


@dataclass(frozen=True)
class ImportReport:
    """What an import made, and every oddity of the official files that it met."""

    title: str
    root: Path
    manifest: Manifest
    properties: tuple[ImportedProperty, ...]
    problems: tuple[Problem, ...]


@dataclass(frozen=True)
class Recipe:
    """One benchmark's way from official files to a new instance.

    ``run`` takes the folder of the official files and the instance to make.
    """

    name: str
    title: str
    run: Callable[[Path, Instance], ImportReport]
