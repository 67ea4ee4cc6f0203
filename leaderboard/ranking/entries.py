"""A graded submission as it is committed: what it says of itself, its predictions and its result."""

import tomllib
from dataclasses import dataclass

import numpy as np
from pydantic import ValidationError

from leaderboard.errors import InstanceError
from leaderboard.files import sha256_hex
from leaderboard.grading import METRICS_VERSION
from leaderboard.instance import PREDICTIONS_FILE, RESULT_FILE, SUBMISSION_FILE, Instance
from leaderboard.ledger import published_dirs
from leaderboard.metrics.accuracy import Floats, credits_of
from leaderboard.models import Metadata, Result, Score
from leaderboard.models.benchmark import OVERALL
from leaderboard.problems import Problems
from leaderboard.reference import Reference
from leaderboard.submission import RawSubmission, read_submission
from leaderboard.validation.predictions import Predictions, judge_predictions


@dataclass(frozen=True)
class Entry:
    """One graded submission.

    Attributes
    ----------
    slug, metadata, result
        Its name, what it says of itself, and what grading found.
    credits : (n_trials,)
        What each trial earned; 0 where not covered.
    probabilities : (n_trials,)
        P(YES) as submitted; NaN where there is no answer.
    """

    slug: str
    metadata: Metadata
    result: Result
    credits: Floats
    probabilities: Floats

    @property
    def is_baseline(self) -> bool:
        """Whether it is shown as a reference line and not ranked."""
        return self.metadata.is_baseline

    @property
    def is_complete(self) -> bool:
        """Whether it covers every property; only then it is ranked."""
        return self.result.coverage.complete

    def score(self, metric: str, scope: str = OVERALL, subset: str = "all") -> Score | None:
        """Look up one score; None where the scope, subset or metric was not graded."""
        scores = self.result.scores.get(scope, {}).get(subset)
        return scores.metrics.get(metric) if scores else None


def load_entries(instance: Instance, reference: Reference) -> tuple[Entry, ...]:
    """Read the committed results of all submissions that the ledger does not withdraw, by slug.

    Raises
    ------
    InstanceError
        If the ledger cannot be understood, or if a submission has no result, or one made from other
        predictions or another reference.
    """
    return tuple(
        load_entry(read_submission(folder, instance.display_path(folder)), reference)
        for folder in published_dirs(instance)
    )


def load_entry(raw: RawSubmission, reference: Reference) -> Entry:
    """Read one committed result and refuse it if it does not belong to the files beside it."""
    metadata = _parse_metadata(raw)
    result = _parse_result(raw)
    hint = f"grade it again: leaderboard grade {raw.location}"
    if result.inputs.predictions_sha256 != sha256_hex(_content(raw, PREDICTIONS_FILE)):
        raise InstanceError(f"{raw.location}: {RESULT_FILE} was made from other predictions", hint)
    if result.metrics_version != METRICS_VERSION:
        raise InstanceError(f"{raw.location}: {RESULT_FILE} was made by another version of the metrics", hint)
    seal = (reference.manifest.digest, reference.manifest.kind)
    if (result.inputs.reference_digest, result.inputs.reference_kind) != seal:
        raise InstanceError(f"{raw.location}: {RESULT_FILE} was made with another reference", hint)
    predictions = _load_predictions(raw, reference)
    return Entry(
        raw.slug or "",
        metadata,
        result,
        credits=credits_of(predictions.probabilities, reference.labels, predictions.answered),
        probabilities=np.where(predictions.answered, predictions.probabilities, np.nan),
    )


def _content(raw: RawSubmission, name: str) -> bytes:
    file = raw.find(name)
    if file is None or file.content is None:
        what = "is missing" if file is None else "is not a plain file within its size limit"
        hint = f"grade it first: leaderboard grade {raw.location}" if name == RESULT_FILE else ""
        raise InstanceError(
            f"{raw.path_of(name)} {what}", hint or f"see: leaderboard validate {raw.location}"
        )
    return file.content


def _parse_metadata(raw: RawSubmission) -> Metadata:
    try:
        return Metadata.model_validate(tomllib.loads(_content(raw, SUBMISSION_FILE).decode()))
    except ValueError as error:
        raise InstanceError(
            f"{raw.path_of(SUBMISSION_FILE)} is not valid", f"see: leaderboard validate {raw.location}"
        ) from error


def _parse_result(raw: RawSubmission) -> Result:
    try:
        return Result.model_validate_json(_content(raw, RESULT_FILE))
    except ValidationError as error:
        raise InstanceError(
            f"{raw.path_of(RESULT_FILE)} is not a result of this version",
            f"grade it again: leaderboard grade {raw.location}",
        ) from error


def _load_predictions(raw: RawSubmission, reference: Reference) -> Predictions:
    content, path = _content(raw, PREDICTIONS_FILE), raw.path_of(PREDICTIONS_FILE)
    predictions = judge_predictions(content, sha256_hex(content), reference, path, Problems())
    if predictions is None:
        raise InstanceError(f"{path} is not valid", f"see: leaderboard validate {raw.location}")
    return predictions
