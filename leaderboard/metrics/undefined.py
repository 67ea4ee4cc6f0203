"""What a metric returns where its formula has no value."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Undefined:
    """The metric has no value here; ``why`` completes the sentence "undefined because ..."."""

    why: str


Estimate = float | Undefined

# Reasons that several modules give.
NO_TRIALS = Undefined("there are no trials")
NO_RATED_TRIALS = Undefined("nobody rated these trials")
