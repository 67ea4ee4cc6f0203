"""Which figures can be had as files of their own, and in which formats."""

from dataclasses import dataclass

from leaderboard.website.figures.marks import Drawing

PICTURED = ("svg", "png", "csv")
MAX_PICTURE = 1500
"""How high a figure may be to be had as PNG: some seventy rows."""


@dataclass(frozen=True)
class Export:
    """Drawings that can be had as files: under which name, in which formats, and how many abreast."""

    name: str
    drawings: tuple[Drawing, ...]
    formats: tuple[str, ...]
    n_abreast: int = 1
