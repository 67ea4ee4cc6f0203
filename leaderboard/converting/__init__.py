"""Other tools' logs to predictions: one module per format, and this registry."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from leaderboard.converting.conversion import Conversion, write_predictions, write_runs
from leaderboard.converting.physopt import convert_physopt, split_runs
from leaderboard.reference import Reference


@dataclass(frozen=True)
class Format:
    """A tool's log format.

    ``split_runs`` turns files of this format into one conversion per run, by the run's name.
    """

    name: str
    title: str
    split_runs: Callable[[Sequence[Path], Reference], dict[str, Conversion]]


FORMATS = {
    format_.name: format_
    for format_ in (Format("physopt", "results of physopt, one row per trial (CSV)", split_runs),)
}

__all__ = ["FORMATS", "Conversion", "Format", "convert_physopt", "write_predictions", "write_runs"]
