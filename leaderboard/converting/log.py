"""What every tool's log comes down to: runs, and their answers to trials."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Answer:
    """One row of a log.

    Attributes
    ----------
    file, line
        Where it is.
    trial_name
        The trial as the log names it.
    scenario_name
        The scenario as the log names it.
    probability
        P(YES) in the log's own digits.
    outcome
        What the log takes to be the trial's true outcome.
    doubts
        What is odd about its numbers, in words.
    """

    file: str
    line: int
    trial_name: str
    scenario_name: str
    probability: str
    outcome: bool
    doubts: tuple[str, ...] = ()


@dataclass(frozen=True)
class Run:
    """One system's answers under one protocol; ``name`` can serve as a slug."""

    name: str
    answers: tuple[Answer, ...]
