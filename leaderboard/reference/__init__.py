"""The benchmark's trials, labels and people: loading, checking, sealing, making."""

from leaderboard.reference.data import People, Reference, Responses
from leaderboard.reference.loading import load_reference

__all__ = ["People", "Reference", "Responses", "load_reference"]
