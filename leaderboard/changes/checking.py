"""Whether a branch adds or amends one submission as it may, judged with this side's engine and reference."""

import datetime as dt
from dataclasses import dataclass

from leaderboard.assessing import Assessment, assess
from leaderboard.changes.git_objects import GitRepository
from leaderboard.changes.proposals import read_proposal
from leaderboard.changes.rights import judge_author, judge_frozen, judge_metadata_change
from leaderboard.changes.scope import find_slug
from leaderboard.grading import result_bytes
from leaderboard.instance import RESULT_FILE, SUBMISSION_FILE, Instance
from leaderboard.ledger import read_ledger
from leaderboard.models import Metadata
from leaderboard.originality import load_others
from leaderboard.problems import Problem, Problems
from leaderboard.reference import Reference
from leaderboard.submission import RawSubmission
from leaderboard.validation.metadata import judge_metadata
from leaderboard.verifying import list_differences


@dataclass(frozen=True)
class ChangeCheck:
    """The verdict on a branch.

    Attributes
    ----------
    slug
        The submission that it changes; None if that is not exactly one.
    head
        The commit that was judged.
    problems
        All that was found; the branch may be taken if none is an error.
    assessment
        Of the submission, as far as it could be read.
    """

    slug: str | None
    head: str
    problems: tuple[Problem, ...]
    assessment: Assessment | None

    @property
    def is_fine(self) -> bool:
        """Whether nothing speaks against the change."""
        return not any(problem.is_error for problem in self.problems)


@dataclass(frozen=True)
class _Judge:
    """What judges: this side's submissions and reference, and the day."""

    instance: Instance
    reference: Reference
    today: dt.date

    def assess(self, raw: RawSubmission) -> Assessment:
        others = load_others(self.instance, raw, self.reference, today=self.today)
        return assess(raw, self.reference, today=self.today, others=others)

    def parse_metadata(self, raw: RawSubmission) -> Metadata | None:
        file = raw.find(SUBMISSION_FILE)
        if file is None or file.content is None:
            return None
        where = raw.path_of(SUBMISSION_FILE)
        return judge_metadata(file.content, self.reference.benchmark, where, self.today, Problems())


def check_changes(
    instance: Instance,
    reference: Reference,
    revisions: tuple[str, str],
    *,
    author: str | None,
    today: dt.date,
) -> ChangeCheck:
    """Judge what a branch changes, without checking it out.

    Parameters
    ----------
    instance, reference
        This side's: what is published and what grades. Nothing but the submission is read from the branch.
    revisions
        Base and head; what counts is what the head changed since the two went apart.
    author
        Login of whoever sent the branch; None if that is not known.
    today
        A submission may be dated tomorrow at the latest.

    Raises
    ------
    GitError
        If the commits cannot be read or share no history.
    """
    repository = GitRepository(instance.root)
    base, head = (repository.resolve(revision) for revision in revisions)
    submissions = f"{repository.prefix()}{instance.display_path(instance.submissions_dir)}/"
    problems = Problems()
    paths = [change.path for change in repository.list_changes(repository.merge_base(base, head), head)]
    slug = find_slug(paths, submissions, problems)
    if slug is None:
        return ChangeCheck(None, head, tuple(problems), None)
    _judge_slug(slug, instance, problems)
    proposed = read_proposal(repository, head, f"{submissions}{slug}", problems)
    published = read_proposal(repository, base, f"{submissions}{slug}", Problems())
    judge = _Judge(instance, reference, today)
    if not proposed.files:
        message = f"{slug} is removed; a published submission leaves the board by the ledger alone"
        problems.add("change-frozen", message, proposed.location)
        return ChangeCheck(slug, head, tuple(problems), None)
    assessment = judge.assess(proposed)
    problems.found += assessment.problems
    judge_frozen(published, proposed, problems)
    _judge_metadata(
        judge.parse_metadata(published), judge.parse_metadata(proposed), proposed, author, problems
    )
    _judge_result(assessment, problems)
    return ChangeCheck(slug, head, tuple(problems), assessment)


def _judge_slug(slug: str, instance: Instance, problems: Problems) -> None:
    """Report a slug that was withdrawn; a ledger that cannot be understood stops publishing, not this."""
    ledger = read_ledger(instance, Problems())
    if ledger is not None and slug in ledger.withdrawn:
        message = f"{slug} was withdrawn, and the slug is not used again"
        file = instance.display_path(instance.ledger_file)
        problems.add("change-frozen", message, file, hint="choose another slug")


def _judge_metadata(
    published: Metadata | None,
    proposed: Metadata | None,
    raw: RawSubmission,
    author: str | None,
    problems: Problems,
) -> None:
    """Judge who changes what; metadata that cannot be read have their problems already."""
    if proposed is None:
        return
    file = raw.path_of(SUBMISSION_FILE)
    judge_metadata_change(published, proposed, file, problems)
    judge_author(author, published, proposed, file, problems)


def _judge_result(assessment: Assessment, problems: Problems) -> None:
    """Report a committed result that is not what grading gives."""
    if assessment.result is None:
        return
    raw = assessment.raw
    committed = raw.find(RESULT_FILE)
    content = None if committed is None else committed.content
    for difference in list_differences(content, result_bytes(assessment.result)):
        hint = f"leaderboard grade {raw.location}"
        problems.add("change-result", difference, raw.path_of(RESULT_FILE), hint=hint)
