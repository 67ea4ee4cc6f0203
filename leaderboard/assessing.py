"""From the bytes of a submission to its verdict and, if it is valid, its result."""

import datetime as dt
from collections.abc import Sequence
from dataclasses import dataclass

from leaderboard.grading import Yardstick, grade
from leaderboard.models import Check, Result
from leaderboard.problems import Problem
from leaderboard.reference import Reference
from leaderboard.submission import RawSubmission, Submission
from leaderboard.validation import validate
from leaderboard.validation.warnings import COPY_CODE


@dataclass(frozen=True)
class Assessment:
    """What was found: problems, and a result if none of them is an error."""

    raw: RawSubmission
    problems: tuple[Problem, ...]
    submission: Submission | None
    result: Result | None


def assess(
    raw: RawSubmission,
    reference: Reference,
    *,
    today: dt.date,
    others: Sequence[Submission] = (),
    yardstick: Yardstick | None = None,
) -> Assessment:
    """Validate a submission and grade it if it is valid.

    Warnings become the result's checks, but for resemblance to ``others``: a result depends on nothing but
    the submission and the reference, so that the same inputs always give the same result.

    Parameters
    ----------
    yardstick
        That of the reference, if several submissions are graded.
    """
    validation = validate(raw, reference, today=today, others=others)
    if validation.submission is None:
        return Assessment(raw, validation.problems, None, None)
    own = [problem for problem in validation.problems if problem.code != COPY_CODE]
    checks = [Check(code=problem.code, message=problem.message) for problem in own]
    result = grade(validation.submission, reference, yardstick=yardstick, checks=checks)
    return Assessment(raw, validation.problems, validation.submission, result)
