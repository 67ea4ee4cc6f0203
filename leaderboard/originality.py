"""Other teams' submissions, for a new one to be compared with."""

import datetime as dt

from leaderboard.instance import SUBMISSION_FILE, Instance
from leaderboard.models import Metadata
from leaderboard.problems import Problems
from leaderboard.reference import Reference
from leaderboard.submission import RawSubmission, Submission, read_submission
from leaderboard.validation import validate
from leaderboard.validation.metadata import judge_metadata


def load_others(
    instance: Instance, raw: RawSubmission, reference: Reference, *, today: dt.date
) -> tuple[Submission, ...]:
    """Load the valid submissions of other teams, by slug.

    Baselines are no one's work, and a team may resemble itself: neither is loaded, and for a bare
    predictions file, whose team is not known, nothing is. A team is a name with a contact: the name alone
    anybody could write. What is not valid is skipped: it is on no board.
    """
    if raw.slug is None:
        return ()
    own = _read_metadata(raw, reference, today)
    others = []
    for folder in instance.submission_dirs():
        other = read_submission(folder, instance.display_path(folder))
        metadata = _read_metadata(other, reference, today)
        if folder.name == raw.slug or metadata is None or metadata.is_baseline:
            continue
        if own is None or metadata.owner != own.owner:
            found = validate(other, reference, today=today).submission
            others += [] if found is None else [found]
    return tuple(others)


def _read_metadata(raw: RawSubmission, reference: Reference, today: dt.date) -> Metadata | None:
    file = raw.find(SUBMISSION_FILE)
    if file is None or file.content is None:
        return None
    return judge_metadata(file.content, reference.benchmark, raw.path_of(SUBMISSION_FILE), today, Problems())
