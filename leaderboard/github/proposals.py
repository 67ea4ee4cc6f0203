"""What is sent: files for one folder, and the words that go with them."""

from collections.abc import Mapping
from dataclasses import dataclass

from leaderboard.assessing import Assessment
from leaderboard.changes.git_objects import blob_id
from leaderboard.github.addresses import find_prefix
from leaderboard.instance import Instance
from leaderboard.reference import Reference
from leaderboard.report.proposal import render_proposal_body
from leaderboard.submitting import submission_contents


@dataclass(frozen=True)
class Proposal:
    """A submission on its way.

    Attributes
    ----------
    slug, contact
        Of the submission.
    folder
        Path of its folder within the repository.
    files
        Names of its files, and their bytes.
    manifest
        Path of the reference's manifest within the repository, and its bytes here.
    body
        Text of the pull request, in Markdown.
    """

    slug: str
    contact: str
    folder: str
    files: Mapping[str, bytes]
    manifest: tuple[str, bytes]
    body: str

    @property
    def branch(self) -> str:
        """The branch that carries it."""
        return f"submission-{self.slug}"

    @property
    def title(self) -> str:
        """What commit and pull request are called."""
        return f"Submit {self.slug}"

    @property
    def contents(self) -> dict[str, bytes]:
        """The files' paths within the repository, and their bytes."""
        return {f"{self.folder}/{name}": content for name, content in sorted(self.files.items())}

    @property
    def blob_ids(self) -> dict[str, str]:
        """The ids that git gives to the files' contents."""
        return {name: blob_id(content) for name, content in sorted(self.files.items())}


def draft_proposal(instance: Instance, reference: Reference, assessment: Assessment) -> Proposal:
    """Put together what is sent for a valid submission.

    Raises
    ------
    ValueError
        If it is not valid, or not one with metadata.
    """
    submission, slug = assessment.submission, assessment.raw.slug
    if submission is None or submission.metadata is None or slug is None or assessment.result is None:
        raise ValueError("only a valid submission is sent")
    prefix = find_prefix(instance)
    folder = f"{prefix}{instance.display_path(instance.submission_dir(slug))}"
    files = dict(sorted(submission_contents(assessment).items()))
    body = render_proposal_body(
        assessment, reference, {f"{folder}/{name}": content for name, content in files.items()}
    )
    return Proposal(
        slug=slug,
        contact=submission.metadata.contact.github,
        folder=folder,
        files=files,
        manifest=(
            f"{prefix}{instance.display_path(instance.manifest_file)}",
            instance.manifest_file.read_bytes(),
        ),
        body=body,
    )
