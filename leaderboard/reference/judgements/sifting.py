"""Telling the answers of a file that count from those that do not, and saying why they do not."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum, auto

from leaderboard.reference.judgements.answers import is_empty, parse_answer
from leaderboard.reference.judgements.matching import TrialMatcher
from leaderboard.reference.judgements.practice import is_practice
from leaderboard.reference.judgements.unfolding import RawAnswer
from leaderboard.trial_names import Ambiguous


class Fate(Enum):
    """What becomes of an answer."""

    PRACTICE = auto()
    EMPTY = auto()
    UNMATCHED = auto()
    AMBIGUOUS = auto()
    UNCLEAR = auto()
    ANONYMOUS = auto()
    USED = auto()


Piles = Mapping[Fate, Sequence[RawAnswer]]


@dataclass(frozen=True)
class Answer:
    """An answer that counts: where it is, who gave it (None if nobody is named), about what, and what.

    ``label`` is the outcome that its file takes to be true, the reference's where the file has none;
    ``is_right`` is what the file says of its correctness, None if nothing. ``is_derived`` tells whether the
    answer was worked out from these two. ``place`` orders the answers of one person in one file.
    """

    file: str
    line: int
    person: str | None
    trial_id: str
    is_yes: bool
    label: bool
    is_right: bool | None
    is_derived: bool
    place: tuple[int, int]


def sort_answers(answers: Iterable[RawAnswer], matcher: TrialMatcher) -> dict[Fate, list[RawAnswer]]:
    """Sort answers by what becomes of them."""
    piles: dict[Fate, list[RawAnswer]] = {fate: [] for fate in Fate}
    for answer in answers:
        piles[_decide(answer, matcher)].append(answer)
    return piles


def _decide(answer: RawAnswer, matcher: TrialMatcher) -> Fate:
    if answer.is_practice or is_practice(answer.name, matcher):
        return Fate.PRACTICE
    said = _said(answer)
    # Correctness is no answer where the response is empty: experiments compute it for every screen.
    if is_empty(said) or is_empty(answer.name):
        return Fate.EMPTY
    if matcher.find(answer.name) is None:
        is_ambiguous = isinstance(matcher.resolve(answer.name), Ambiguous)
        return Fate.AMBIGUOUS if is_ambiguous else Fate.UNMATCHED
    if parse_answer(said) is None:
        return Fate.UNCLEAR
    return Fate.ANONYMOUS if answer.person == "" else Fate.USED


def _said(answer: RawAnswer) -> str:
    return (answer.correct or "") if answer.response is None else answer.response


def understand_answers(answers: Iterable[RawAnswer], file: str, matcher: TrialMatcher) -> list[Answer]:
    """Turn answers that count into YES and NO.

    A response is taken as it is, whatever correctness says: it is what the person did, while correctness was
    worked out from it. Without response, YES is what is right where the label is YES and wrong where it is
    NO; the label is then the file's own if it has one, since correctness was worked out with that.
    """
    understood = []
    for answer in answers:
        trial_id = matcher.find(answer.name)
        if trial_id is None:
            raise ValueError("only answers that name a trial can be understood")
        told = None if answer.label is None else parse_answer(answer.label)
        label = matcher.labels[trial_id] if told is None else told
        is_right = None if answer.correct is None else parse_answer(answer.correct)
        said = parse_answer(_said(answer)) is True
        is_derived = answer.response is None
        is_yes = (said == label) if is_derived else said
        understood.append(
            Answer(
                file,
                answer.line,
                answer.person,
                trial_id,
                is_yes,
                label,
                is_right,
                is_derived,
                answer.place,
            )
        )
    return understood
