"""What is in files: the benchmark's definition, a submission's metadata, the manifest and results."""

from leaderboard.models.benchmark import (
    Benchmark,
    Design,
    Grading,
    Manifest,
    Property,
    Scenario,
    Source,
    Track,
)
from leaderboard.models.errata import Errata
from leaderboard.models.metadata import Metadata, Protocol
from leaderboard.models.result import (
    Bin,
    Bootstrap,
    Calibration,
    Check,
    Coverage,
    Inputs,
    Result,
    Score,
    SubsetScores,
)

__all__ = [
    "Benchmark",
    "Bin",
    "Bootstrap",
    "Calibration",
    "Check",
    "Coverage",
    "Design",
    "Errata",
    "Grading",
    "Inputs",
    "Manifest",
    "Metadata",
    "Property",
    "Protocol",
    "Result",
    "Scenario",
    "Score",
    "Source",
    "SubsetScores",
    "Track",
]
