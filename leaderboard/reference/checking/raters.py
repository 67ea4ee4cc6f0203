"""Single people: whether their names are opaque, and whether their answers form improbable patterns.

Nobody is left out for a pattern: it is a note for whoever reads the scores. Three patterns are looked for in
everybody's answers, each with a test that is small where the pattern is improbable:

- one answer throughout: 2 / 2^n, the chance that n fair coins agree;
- a long streak of one answer: the number of runs as long that a random order of the same answers has;
- alternation: the chance that a random order of the same answers has as many runs (Wald & Wolfowitz).

The last two need the order in which somebody answered. A file whose rows stand in the order of the trial
lists for everybody has not kept it.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from leaderboard.instance import HUMAN_RESPONSES_FILE
from leaderboard.metrics.runs import expect_streaks, measure_runs, runs_p
from leaderboard.problems import Problems
from leaderboard.reference.checking.datasheet import Row, Section, make_row
from leaderboard.reference.data import Integers, Responses
from leaderboard.reference.definition import shown

LEVEL = 0.01
"""How likely a note on anybody is if everybody's answers come in random order."""
N_TESTS = 3
FILE = shown(HUMAN_RESPONSES_FILE)

_OPAQUE = re.compile(r"p[0-9]+")


@dataclass(frozen=True)
class Rater:
    """One person's answers, 0 or 1, in the order of their file."""

    name: str
    answers: Integers

    @property
    def n(self) -> int:
        """Number of answers."""
        return self.answers.size

    @property
    def n_yes(self) -> int:
        """Of these, YES."""
        return int(self.answers.sum())


Judge = Callable[[Rater], tuple[float, str]]


def check_raters(responses: Responses) -> Section:
    """Report names that are not opaque and answers in improbable patterns."""
    raters = list(list_raters(responses))
    bound = LEVEL / (N_TESTS * len(raters))
    has_order = keeps_order(responses)
    order = "kept" if has_order else "not kept: rows follow the trial lists"
    rows = [
        _check_names(responses),
        make_row("Order of a person's answers", order),
        _check_pattern("Who gave one answer throughout", raters, judge_sameness, bound),
    ]
    for assumption, judge in (
        ("Who gave one answer in long streaks", judge_streak),
        ("Who alternated", judge_alternation),
    ):
        rows.append(
            _check_pattern(assumption, raters, judge, bound)
            if has_order
            else make_row(assumption, "cannot be told without the order")
        )
    return Section("People", tuple(rows), _explain_patterns(len(raters), bound))


def _explain_patterns(n_people: int, bound: float) -> str:
    return (
        f"A pattern is noted where its p is below {bound:.1e}, which is {LEVEL} shared out over {N_TESTS} "
        f"tests of {n_people:,} people. One answer to n trials has p = 2 / 2^n; a streak, the number of "
        "streaks as long to expect in a random order of the same answers; alternation, the chance of as many "
        "changes in such an order (runs test, exact). Nobody is left out for a pattern."
    )


def list_raters(responses: Responses) -> Iterator[Rater]:
    """List everybody who answered, with the answers in the order of the file."""
    rows = np.arange(responses.answers.size) if responses.rows is None else responses.rows
    order = np.lexsort((rows, responses.participants))
    people, answers = responses.participants[order], responses.answers[order]
    for person, start, end in _stretches(people):
        yield Rater(responses.participant_ids[person], answers[start:end])


def keeps_order(responses: Responses) -> bool:
    """Tell whether the rows of anybody stand in another order than that of the trials."""
    if responses.rows is None:
        return False
    return bool(((np.diff(responses.rows) < 0) & (np.diff(responses.participants) == 0)).any())


def judge_sameness(rater: Rater) -> tuple[float, str]:
    """Return the p of one answer throughout, and what to say of it."""
    if rater.n_yes not in (0, rater.n):
        return 1.0, ""
    return 2.0 ** (1 - rater.n), f"answered {_word(rater.answers[0])} to all {rater.n} trials"


def judge_streak(rater: Rater) -> tuple[float, str]:
    """Return the p of the longest run of equal answers, and what to say of it."""
    lengths = measure_runs(rater.answers)
    longest = int(lengths.max())
    if longest == rater.n:
        return 1.0, ""  # one answer throughout: there is no order to speak of
    answer = rater.answers[int(lengths[: int(lengths.argmax())].sum())]
    p = expect_streaks(rater.n_yes, rater.n - rater.n_yes, longest)
    return p, f"answered {_word(answer)} {longest} times in a row, of {rater.n} answers"


def judge_alternation(rater: Rater) -> tuple[float, str]:
    """Return the p of so many runs, and what to say of it."""
    n_runs = measure_runs(rater.answers).size
    p = runs_p(rater.n_yes, rater.n - rater.n_yes, n_runs)
    return p, f"changed the answer {n_runs - 1} times in {rater.n} answers"


def _check_names(responses: Responses) -> Row:
    names = responses.participant_ids
    telling = [name for name in names if not _OPAQUE.fullmatch(name)]
    problems = Problems()
    if telling:
        problems.add(
            "reference-participant-id",
            f"{len(telling)} of {len(names)} participants are not named p and a number, "
            f"for instance {telling[0]}",
            FILE,
            hint="ids of a recruiting service must not be published: number the participants instead",
        )
    found = f"{len(names) - len(telling)} of {len(names)} are"
    return make_row("Names are p and a number", found, expected="all", problems=problems)


def _check_pattern(assumption: str, raters: list[Rater], judge: Judge, bound: float) -> Row:
    problems = Problems()
    for rater in raters:
        p, message = judge(rater)
        if p < bound:
            problems.add("reference-rater", f"{rater.name} {message} (p = {p:.1e})", FILE)
    found = f"{len(problems)} of {len(raters)} people" if problems else "nobody"
    return make_row(assumption, found, expected="nobody", problems=problems)


def _stretches(people: Integers) -> Iterator[tuple[int, int, int]]:
    """Cut sorted people into stretches of one person: who, first place, and the place after the last."""
    starts = np.flatnonzero(np.diff(people, prepend=-1)).tolist()
    for start, end in zip(starts, [*starts[1:], people.size], strict=True):
        yield int(people[start]), start, end


def _word(answer: int) -> str:
    return "YES" if answer else "NO"
