"""Submissions as they are on disk (raw, unjudged) and as they are once found valid."""

import stat
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from leaderboard.files import TEMPORARY_PREFIX, read_regular
from leaderboard.instance import PREDICTIONS_FILE, RESULT_FILE, SUBMISSION_FILE
from leaderboard.models import Metadata

SIZE_LIMITS = {PREDICTIONS_FILE: 5_000_000, SUBMISSION_FILE: 64_000, RESULT_FILE: 5_000_000}

Kind = Literal["file", "folder", "symlink", "special"]


class Status(StrEnum):
    """Whether a trial was answered, and if not, why."""

    ANSWERED = "answered"
    REFUSED = "refused"
    UNPARSABLE = "unparsable"
    ERROR = "error"


@dataclass(frozen=True)
class RawFile:
    """A directory entry: ``content`` is None unless it is a regular file within its size limit."""

    name: str
    kind: Kind
    size: int
    content: bytes | None


@dataclass(frozen=True)
class RawSubmission:
    """The bytes of a submission's folder, or of a bare predictions file.

    ``location`` is the path to show in messages; ``slug`` is None for a bare file.
    """

    location: str
    slug: str | None
    files: tuple[RawFile, ...]

    def find(self, name: str) -> RawFile | None:
        """Return the entry of that name, if it is there."""
        return next((file for file in self.files if file.name == name), None)

    def path_of(self, name: str) -> str:
        """The path of one of its files, to show in messages."""
        return self.location if self.slug is None else f"{self.location}/{name}"


@dataclass(frozen=True)
class Submission:
    """A valid submission, its predictions in the order of the reference's trials.

    Attributes
    ----------
    slug, metadata
        None for a bare predictions file.
    predictions_sha256
        Checksum of the predictions file as it was sent.
    probabilities : (n_trials,)
        P(YES) in [0, 1]; 0.5 where not answered or not covered.
    answered : (n_trials,)
        Whether a probability was given.
    covered : (n_trials,)
        Whether the trial's scenario is part of the submission.
    """

    slug: str | None
    metadata: Metadata | None
    predictions_sha256: str
    probabilities: NDArray[np.float64]
    answered: NDArray[np.bool_]
    covered: NDArray[np.bool_]


def read_submission(folder: Path, location: str) -> RawSubmission:
    """Read a submission's folder without judging or following anything in it.

    What a killed run left half-written, or another is about to write, is no part of it.

    Parameters
    ----------
    folder
        Where it is.
    location
        How messages should name it.
    """
    paths = sorted(path for path in folder.iterdir() if not path.name.startswith(TEMPORARY_PREFIX))
    files = tuple(_read_entry(path) for path in paths)
    return RawSubmission(location, folder.absolute().name, files)


def read_predictions(file: Path, location: str) -> RawSubmission:
    """Read a bare predictions file, whatever its name, as a submission without metadata."""
    entry = _read_entry(file, PREDICTIONS_FILE)
    return RawSubmission(location, None, (entry,))


def read_any(path: Path, location: str) -> RawSubmission:
    """Read a submission's folder or a bare predictions file, whichever the path is."""
    return read_submission(path, location) if path.is_dir() else read_predictions(path, location)


def _read_entry(path: Path, name: str | None = None) -> RawFile:
    name = name or path.name
    status = path.lstat()
    kind = _kind_of(status.st_mode)
    content = None
    if kind == "file" and name in SIZE_LIMITS:
        content = read_regular(path, SIZE_LIMITS[name])
    return RawFile(name, kind, status.st_size, content)


def _kind_of(mode: int) -> Kind:
    if stat.S_ISREG(mode):
        return "file"
    if stat.S_ISDIR(mode):
        return "folder"
    return "symlink" if stat.S_ISLNK(mode) else "special"
