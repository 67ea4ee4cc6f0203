"""Submissions that were made before: sending them, or going on where sending them stopped."""

import datetime as dt
import tomllib
from collections.abc import Sequence

from leaderboard.assessing import Assessment, assess
from leaderboard.errors import InstanceError
from leaderboard.grading import result_bytes
from leaderboard.ids import is_slug
from leaderboard.instance import PREDICTIONS_FILE, RESULT_FILE, SUBMISSION_FILE, Instance
from leaderboard.originality import load_others
from leaderboard.reference import Reference
from leaderboard.submission import read_submission
from leaderboard.submitting import Metadata, PredictionFile, merge_predictions, render_metadata
from leaderboard.verifying import list_differences


def is_made(
    instance: Instance,
    slug: str,
    *,
    metadata: Metadata,
    files: Sequence[PredictionFile],
    is_dated: bool = True,
) -> bool:
    """Tell whether there is a submission of that slug already, made of these very files and metadata.

    Without ``is_dated`` its date may be another.
    """
    folder = instance.submission_dir(slug)
    if not is_slug(slug) or not folder.is_dir():
        return False
    raw = read_submission(folder, instance.display_path(folder))
    known, toml = (
        (file and file.content) or b"" for file in map(raw.find, (PREDICTIONS_FILE, SUBMISSION_FILE))
    )
    try:
        old, new = (tomllib.loads(text.decode()) for text in (toml, render_metadata(metadata)))
    except ValueError:
        return False
    if not is_dated and "date" in old.get("submission", {}):
        old["submission"]["date"] = new["submission"]["date"]
    return known == merge_predictions(files) and old == new


def load_made(instance: Instance, reference: Reference, slug: str, *, today: dt.date) -> Assessment:
    """Assess a submission that is there already.

    Raises
    ------
    InstanceError
        If it is valid and its result is not what grading gives.
    """
    folder = instance.submission_dir(slug)
    raw = read_submission(folder, instance.display_path(folder))
    others = load_others(instance, raw, reference, today=today)
    assessment = assess(raw, reference, today=today, others=others)
    if assessment.result is not None:
        committed = raw.find(RESULT_FILE)
        content = None if committed is None else committed.content
        for difference in list_differences(content, result_bytes(assessment.result)):
            message = f"{raw.path_of(RESULT_FILE)}: {difference}"
            raise InstanceError(message, f"leaderboard grade {raw.location}")
    return assessment
