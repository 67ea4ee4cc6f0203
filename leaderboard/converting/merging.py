"""From all answers to one trial to the one prediction for it."""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from leaderboard.converting.log import Answer
from leaderboard.submission import Status

_MEAN = ".10g"  # so many digits that no share of fewer than a billion answers is rounded to one half


@dataclass(frozen=True)
class Prediction:
    """A line of ``predictions.csv``; the probability keeps the log's digits.

    Where a trial was asked more than once, ``n_repeats`` says how often and ``n_answered`` how many of these
    gave an answer; the probability is the mean of these answers.
    """

    trial_id: str
    probability: str
    status: Status = Status.ANSWERED
    n_repeats: int = 1
    n_answered: int = 1


def group_by_repeat(answers: Sequence[Answer]) -> list[list[Answer]]:
    """Sort the answers to one trial by their repeats; more than one in a group are too many."""
    groups: dict[str, list[Answer]] = {}
    for answer in answers:
        groups.setdefault(answer.repeat, []).append(answer)
    return list(groups.values())


def are_equal(answers: Sequence[Answer]) -> bool:
    """Tell whether answers say the same."""
    return len({(answer.probability, answer.status) for answer in answers}) == 1


def merge_repeats(trial_id: str, answers: Sequence[Answer]) -> Prediction:
    """Make one prediction of the answers to a trial, one for each repeat.

    Several answers of YES or NO give the share of YES, several probabilities their mean. Repeats without an
    answer do not count; if none has one, the prediction has the most frequent reason, and of equally
    frequent ones the first by name.

    Examples
    --------
    >>> from leaderboard.converting.log import Answer
    >>> merge_repeats("a", [Answer("log", n, "a", "", yes, None) for n, yes in enumerate("110")]).probability
    '0.6666666667'
    """
    given = [answer.probability for answer in answers if answer.status is Status.ANSWERED]
    if not given:
        counts = Counter(answer.status for answer in answers)
        status = min(counts, key=lambda reason: (-counts[reason], reason.value))
        return Prediction(trial_id, "", status, len(answers), 0)
    probability = given[0] if len(given) == 1 else _mean(given)
    return Prediction(trial_id, probability, Status.ANSWERED, len(answers), len(given))


def _mean(probabilities: Sequence[str]) -> str:
    return format(math.fsum(map(float, probabilities)) / len(probabilities), _MEAN)
