"""What was published before, read from the repository's history and not from what anybody says of it."""

from collections.abc import Iterator
from dataclasses import dataclass

from leaderboard.changes.git_objects import GitError, GitRepository
from leaderboard.files import sha256_hex
from leaderboard.instance import LEDGER_FILE, RESULT_FILE, Instance
from leaderboard.ledger import SIZE_LIMIT
from leaderboard.submission import SIZE_LIMITS


@dataclass(frozen=True)
class Version:
    """A file's content in a commit."""

    commit: str
    content: bytes


@dataclass(frozen=True)
class History:
    """The versions that the checked-out branch had of an instance's files.

    Side branches count by their merge: what was never on the branch itself was never published.
    """

    repository: GitRepository
    submissions: str  # path of the folder within the repository

    def ledgers(self) -> Iterator[Version]:
        """Yield the versions of the ledger, newest first; where it was deleted, there is none."""
        return self._versions(self.submissions, LEDGER_FILE, SIZE_LIMIT)

    def find_result(self, slug: str, sha256: str) -> bytes | None:
        """Find the version of a submission's result with this checksum; None if there was none."""
        versions = self._versions(f"{self.submissions}/{slug}", RESULT_FILE, SIZE_LIMITS[RESULT_FILE])
        return next((v.content for v in versions if sha256_hex(v.content) == sha256), None)

    def _versions(self, folder: str, name: str, limit: int) -> Iterator[Version]:
        for commit in self.repository.list_commits(f"{folder}/{name}"):
            for entry in self.repository.list_folder(commit, folder):
                content = self.repository.read_blob(entry, limit) if entry.name == name else None
                if content is not None:
                    yield Version(commit, content)


def open_history(instance: Instance) -> History | None:
    """Open the history of an instance; None if it lies in no repository or nothing is committed there."""
    repository = GitRepository(instance.root)
    try:
        repository.resolve("HEAD")
        prefix = repository.prefix()
    except GitError:
        return None
    return History(repository, f"{prefix}{instance.display_path(instance.submissions_dir)}")
