"""What is frozen once a submission is published, and who may change the rest."""

from leaderboard.instance import PREDICTIONS_FILE
from leaderboard.models import Metadata
from leaderboard.problems import Problems
from leaderboard.submission import RawSubmission

NEW_SLUG_HINT = "send it under a new slug; the older one is then marked as superseded in the ledger"


def judge_frozen(published: RawSubmission, proposed: RawSubmission, problems: Problems) -> None:
    """Report predictions that are not those that were published."""
    old, new = (raw.find(PREDICTIONS_FILE) for raw in (published, proposed))
    if old is not None and (new is None or new.content != old.content):
        message = "published predictions never change"
        problems.add("change-frozen", message, proposed.path_of(PREDICTIONS_FILE), hint=NEW_SLUG_HINT)


def judge_metadata_change(
    published: Metadata | None, proposed: Metadata, file: str, problems: Problems
) -> None:
    """Report what may not change in a published submission's metadata: what decides its board."""
    if published is None:
        return
    if published.protocol != proposed.protocol:
        message = "the protocol of a published submission never changes: it decides the board"
        problems.add("change-frozen", message, file, hint=NEW_SLUG_HINT)
    if published.submission.system != proposed.submission.system:
        message = "the system of a published submission never changes: it ties its entries together"
        problems.add("change-frozen", message, file, hint=NEW_SLUG_HINT)


def judge_author(
    author: str | None, published: Metadata | None, proposed: Metadata, file: str, problems: Problems
) -> None:
    """Report a change by somebody who is not the submission's contact.

    Logins are compared without regard to capitals, as GitHub does.
    """
    if proposed.is_baseline:
        message = "the family baseline is for the rows that `leaderboard baselines` writes"
        problems.add("change-baseline", message, file, hint="choose the family that fits, or other")
    owner = (published or proposed).contact.github
    if author is not None and author.lower() == owner.lower():
        return
    if author is None:
        message = f"the contact is {owner}; whether the change is theirs was not checked"
        problems.add("change-unchecked-author", message, file, hint="name who sent it with --author")
    elif published is not None:
        message = f"this submission is {owner}'s, and the change is {author}'s"
        problems.add(
            "change-foreign", message, file, hint="choose a slug of your own, or ask its contact to send it"
        )
    else:
        message = f"the contact is {owner}, but the change is {author}'s"
        problems.add("change-contact", message, file, hint="[contact] github is who may amend it later")
