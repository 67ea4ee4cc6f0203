"""What is in files: the benchmark's definition, a submission's metadata, the manifest and results."""

from leaderboard.models.benchmark import Benchmark, Grading, Manifest, Property, Scenario, Source, Track
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
