"""Reading a submission out of a commit: as its bytes, or as what it is instead of plain files."""

from leaderboard.changes.git_objects import PLAIN_MODE, GitRepository, TreeEntry
from leaderboard.problems import Problems
from leaderboard.submission import SIZE_LIMITS, Kind, RawFile, RawSubmission

_KINDS: dict[str, Kind] = {"100644": "file", "100755": "file", "120000": "symlink", "040000": "folder"}


def read_proposal(repository: GitRepository, commit: str, folder: str, problems: Problems) -> RawSubmission:
    """Read a submission's folder from a commit; it has no files if the folder is not there.

    Parameters
    ----------
    repository, commit
        Where to read.
    folder
        Path of the submission's folder within the repository.
    problems
        Receives files that are marked as programs; all else is for validation to judge.
    """
    entries = repository.list_folder(commit, folder)
    for entry in entries:
        if _KINDS.get(entry.mode) == "file" and entry.mode != PLAIN_MODE:
            message = "is marked as a program; it must be a plain file"
            hint = f"git update-index --chmod=-x {folder}/{entry.name}" if entry.name.isidentifier() else ""
            problems.add("change-mode", message, f"{folder}/{ascii(entry.name)[1:-1]}", hint=hint)
    files = tuple(_read_entry(repository, entry) for entry in entries)
    return RawSubmission(folder, folder.rpartition("/")[2], files)


def _read_entry(repository: GitRepository, entry: TreeEntry) -> RawFile:
    kind = _KINDS.get(entry.mode, "special")
    limit = SIZE_LIMITS.get(entry.name) if kind == "file" else None
    content = None if limit is None else repository.read_blob(entry, limit)
    return RawFile(entry.name, kind, entry.size or 0, content)
