"""A leaderboard on the double of GitHub, and a participant with a graded submission to send."""

import datetime as dt
import traceback
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from git_trees import GitTrees
from github_double import GitHubDouble
from github_hub import Hub, Repo
from leaderboard.assessing import Assessment, assess
from leaderboard.changes import ChangeCheck, check_changes
from leaderboard.github.client import Client, Patience
from leaderboard.github.failures import GitHubError
from leaderboard.github.proposals import Proposal, draft_proposal
from leaderboard.github.proposing import propose
from leaderboard.github.tokens import Token
from leaderboard.instance import Instance
from leaderboard.reference import Reference
from leaderboard.report.proposal import Outcome
from leaderboard.submission import RawFile, RawSubmission
from leaderboard.submitting import submission_contents
from raw_submissions import SUBMISSION_TOML, TODAY, predictions_csv, spread_probabilities

UPSTREAM, FORK, BRANCH = "lab/board", "someone/board", "submission-example"
SECRET = "ghp_thisIsTheSecretOfTheTests0123456789"  # noqa: S105


@dataclass
class Clock:
    """A clock that sleeping moves on."""

    time: float = 1_800_000_000.0
    slept: list[float] = field(default_factory=list)

    def sleep(self, seconds: float) -> None:
        self.slept.append(seconds)
        self.time += seconds


@dataclass(frozen=True)
class Material:
    """A reference on disk, and two submissions for it."""

    instance: Instance
    reference: Reference

    def assess(self, *, is_reversed: bool = False, toml: str = SUBMISSION_TOML) -> Assessment:
        """Grade the submission, or one with other predictions."""
        spread = spread_probabilities(self.reference)
        predictions = predictions_csv(self.reference, spread[::-1] if is_reversed else spread)
        contents = {"predictions.csv": predictions.encode(), "submission.toml": toml.encode()}
        files = tuple(RawFile(name, "file", len(data), data) for name, data in contents.items())
        return assess(RawSubmission("submissions/example", "example", files), self.reference, today=TODAY)

    def draft(self, *, is_reversed: bool = False, toml: str = SUBMISSION_TOML) -> Proposal:
        """Put together what is sent."""
        return draft_proposal(self.instance, self.reference, self.assess(is_reversed=is_reversed, toml=toml))

    def write(self, root: Path) -> Path:
        """Write reference and submission into a folder, as participants have them; return the latter's."""
        folder = root / "submissions/example"
        files = {f"submissions/example/{n}": c for n, c in submission_contents(self.assess()).items()}
        for path, content in {**self.reference_files(), **files}.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_bytes(content)
        return folder

    def reference_files(self) -> dict[str, bytes]:
        """What the leaderboard's repository has of the reference, by path."""
        folder = self.instance.reference_dir
        return {f"reference/{file.name}": file.read_bytes() for file in sorted(folder.iterdir())}


@dataclass
class Stage:
    """Everything that a test needs to send something and to see what became of it."""

    github: GitHubDouble
    material: Material
    clock: Clock
    told: list[str] = field(default_factory=list)
    tries: int = 1

    @property
    def hub(self) -> Hub:
        return self.github.hub

    @property
    def upstream(self) -> Repo:
        return self.hub.repos[UPSTREAM]

    @property
    def fork(self) -> Repo:
        return self.hub.repos[FORK]

    def send(
        self,
        proposal: Proposal | None = None,
        repository: str = UPSTREAM,
        *,
        is_named: bool = False,
        api_url: str = "",
        token: str = SECRET,
    ) -> Outcome:
        """Send the submission, or another one."""
        patience = Patience(
            connect=5,
            read=5,
            tries=self.tries,
            fork_checks=5,
            sleep=self.clock.sleep,
            now=lambda: self.clock.time,
        )
        url = api_url or self.github.api_url
        with Client(url, Token(token, "GITHUB_TOKEN"), tell=self.told.append, patience=patience) as client:
            return propose(client, proposal or self.material.draft(), repository, is_named=is_named)

    def refuse(self, **options: Any) -> tuple[str, str]:
        """Send, be refused, and return message and hint; neither they nor their causes know the token."""
        with pytest.raises(GitHubError) as failure:
            self.send(**options)
        error = failure.value
        shown = "".join(traceback.format_exception(error)) + repr(vars(error))
        assert SECRET not in shown
        assert (error.__cause__, error.__context__) == (None, None)
        return error.message, error.hint

    def judge(self, folder: Path, *, today: dt.date = TODAY) -> ChangeCheck:
        """Judge the branch as the leaderboard does: fetched as git objects beside the published side."""
        instance = Instance(folder)
        for path, content in self.material.reference_files().items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_bytes(content)
        git = GitTrees(folder).init()
        git.run("fetch", "-q", str(self.upstream.folder), "main:published")
        git.run("fetch", "-q", str(self.fork.folder), f"{BRANCH}:proposed")
        revisions = ("published", "proposed")
        return check_changes(instance, self.material.reference, revisions, author="someone", today=today)

    def lines(self) -> list[str]:
        """The requests that were made."""
        return [str(call) for call in self.github.calls]
