"""Judging a submission: every problem in one run, or the submission as arrays in the reference's order."""

import datetime as dt
from collections.abc import Sequence
from dataclasses import dataclass

from leaderboard.files import sha256_hex
from leaderboard.instance import PREDICTIONS_FILE, SUBMISSION_FILE
from leaderboard.models import Metadata
from leaderboard.problems import Problem, Problems
from leaderboard.reference import Reference
from leaderboard.submission import RawSubmission, Submission
from leaderboard.validation.folder import judge_folder
from leaderboard.validation.metadata import judge_metadata
from leaderboard.validation.predictions import Predictions, judge_predictions
from leaderboard.validation.warnings import find_suspicions, judge_inputs


@dataclass(frozen=True)
class Validation:
    """The verdict: all problems found, and the submission if none of them is an error."""

    submission: Submission | None
    problems: tuple[Problem, ...]


def validate(
    raw: RawSubmission,
    reference: Reference,
    *,
    today: dt.date,
    others: Sequence[Submission] = (),
) -> Validation:
    """Judge a submission's folder, or a bare predictions file.

    Parameters
    ----------
    raw
        The bytes; nothing else of the submission is looked at.
    reference
        What the trial ids are compared with, byte for byte.
    today
        A submission may be dated tomorrow at the latest (UTC), for those who live ahead of it.
    others
        Valid submissions of other teams that this one should not copy.
    """
    problems = Problems()
    metadata = None
    if raw.slug is not None:
        judge_folder(raw, problems)
        metadata = _judge_metadata(raw, reference, today, problems)
    predictions = _judge_predictions(raw, reference, problems)
    if problems.has_errors or predictions is None:
        return Validation(None, tuple(problems))
    submission = Submission(
        slug=raw.slug,
        metadata=metadata,
        predictions_sha256=predictions.sha256,
        probabilities=predictions.probabilities,
        answered=predictions.answered,
        covered=predictions.covered,
    )
    find_suspicions(submission, reference, others, raw.path_of(PREDICTIONS_FILE), problems)
    judge_inputs(submission, reference, raw.path_of(SUBMISSION_FILE), problems)
    return Validation(submission, tuple(problems))


def _judge_metadata(
    raw: RawSubmission, reference: Reference, today: dt.date, problems: Problems
) -> Metadata | None:
    file = raw.find(SUBMISSION_FILE)
    if file is None or file.content is None:
        return None
    return judge_metadata(file.content, reference.benchmark, raw.path_of(SUBMISSION_FILE), today, problems)


def _judge_predictions(raw: RawSubmission, reference: Reference, problems: Problems) -> Predictions | None:
    file = raw.find(PREDICTIONS_FILE)
    if file is None or file.content is None:
        if raw.slug is None:
            judge_folder(raw, problems)
        return None
    path = raw.path_of(PREDICTIONS_FILE)
    return judge_predictions(file.content, sha256_hex(file.content), reference, path, problems)
