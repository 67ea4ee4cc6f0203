"""What every tool's log comes down to: runs, and their answers to trials."""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from leaderboard.submission import Status


@dataclass(frozen=True)
class Answer:
    """One answer in a log.

    Attributes
    ----------
    file, line
        Where it is.
    trial_name
        The trial as the log names it.
    scenario_name
        The scenario as the log names it; empty if it names none.
    probability
        P(YES) in the log's own digits; empty if there is no answer.
    outcome
        What the log takes to be the trial's true outcome; None if it does not say.
    doubts
        Where the log does not agree with itself about it, in words.
    status
        Whether there is an answer, and if not, why.
    repeat
        Tells the answers to one trial apart that were asked for on purpose, such as an epoch. Two answers of
        one trial and one repeat are one too many.
    unit
        What ``line`` counts where the file is no text with an answer on each line, such as ``sample``.
    """

    file: str
    line: int
    trial_name: str
    scenario_name: str
    probability: str
    outcome: bool | None
    doubts: tuple[str, ...] = ()
    status: Status = Status.ANSWERED
    repeat: str = ""
    unit: str = ""

    @property
    def place(self) -> str:
        """Where it is, by the name of its file.

        >>> Answer("logs/run.json", 3, "ramp_1", "", "1", None, unit="sample").place
        'run.json, sample 3'
        """
        name = Path(self.file).name
        return f"{name}, {self.unit} {self.line}" if self.unit else f"{name}:{self.line}"


@dataclass(frozen=True)
class Run:
    """One system's answers under one protocol.

    ``name`` can serve as a slug; ``reader`` is the version of the reader that turned texts into answers, None
    if there were no texts to read.
    """

    name: str
    answers: tuple[Answer, ...]
    reader: int | None = None


def list_runs(answers: Iterable[tuple[str, Answer]], name: str, reader: int | None = None) -> list[Run]:
    """Make a run for each model that answers come from, since those of two are no repeats of one.

    Parameters
    ----------
    answers
        Pairs of a model's name, empty where the log names none, and an answer.
    name
        That of the log; of several models each has its own beside it.
    reader
        As for `Run`.
    """
    groups: dict[str, list[Answer]] = {}
    for model, answer in answers:
        groups.setdefault(model, []).append(answer)
    if len(groups) == 1:
        return [Run(name_run(name), tuple(found), reader) for found in groups.values()]
    return [Run(name_run(f"{name}-{model}"), tuple(groups[model]), reader) for model in sorted(groups)]


def name_run(text: str) -> str:
    """Make a run's name of a model's, a task's or a file's.

    >>> name_run("Qwen/Qwen2.5-VL (7B)"), name_run("--")
    ('qwen-qwen2-5-vl-7b', 'run')
    """
    return re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-")[:64].strip("-") or "run"
