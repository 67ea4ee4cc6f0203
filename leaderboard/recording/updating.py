"""Appending to the ledger what is new, and refusing what must not change without a reason."""

import datetime as dt
from collections.abc import Callable
from dataclasses import dataclass

from leaderboard.files import sha256_hex
from leaderboard.instance import RESULT_FILE, Instance
from leaderboard.ledger import Ledger, read_ledger, render_ledger
from leaderboard.models.ledger import Event, LedgerLine
from leaderboard.problems import Problem, Problems
from leaderboard.recording.checking import judge_vanished, read_result
from leaderboard.recording.regrading import explain_regrading

NEW = "new submission"
UNSEEN_HINT = (
    "in a shallow clone: git fetch --unshallow; "
    "if its line was never committed, take that line out of the ledger"
)

FindPublished = Callable[[str, str], bytes | None]


@dataclass(frozen=True)
class LedgerUpdate:
    """What is appended, and the whole file with it; nothing may be written if a problem is an error."""

    added: tuple[LedgerLine, ...]
    content: bytes
    problems: tuple[Problem, ...]

    @property
    def is_allowed(self) -> bool:
        """Whether nothing speaks against publishing what is there."""
        return not any(problem.is_error for problem in self.problems)


@dataclass(frozen=True)
class _Recorder:
    """What decides about one submission after the other."""

    instance: Instance
    ledger: Ledger
    find_published: FindPublished
    today: dt.date

    def record(self, slug: str, problems: Problems) -> LedgerLine | None:
        """Make the line that a submission needs; None if it needs none, or may not have one."""
        file = self.instance.display_path(self.instance.submission_dir(slug) / RESULT_FILE)
        result = read_result(self.instance, slug)
        if result is None:
            problems.add("ledger-result", "is missing", file, hint=f"leaderboard grade submissions/{slug}")
            return None
        sha256 = sha256_hex(result)
        before = self.ledger.latest.get(slug)
        if before is None:
            return self._line(slug, "added", NEW, sha256)
        if before.result_sha256 == sha256:
            return None
        reason = self._explain(before, result, file, problems)
        return None if reason is None else self._line(slug, "regraded", reason, sha256)

    def _explain(self, before: LedgerLine, result: bytes, file: str, problems: Problems) -> str | None:
        published = self.find_published(before.slug, before.result_sha256)
        if published is None:
            message = (
                f"replaces one that the ledger records ({before.result_sha256[:12]}) and no commit here holds"
            )
            problems.add("ledger-result", message, file, hint=UNSEEN_HINT)
            return None
        return explain_regrading(published, result, file, problems)

    def _line(self, slug: str, event: Event, reason: str, sha256: str) -> LedgerLine:
        return LedgerLine(date=self.today, slug=slug, event=event, reason=reason, result_sha256=sha256)


def update_ledger(instance: Instance, find_published: FindPublished, *, today: dt.date) -> LedgerUpdate:
    """Find what the ledger must say before an instance's submissions may be published as they are.

    A submission without a line is added; one with another result than its last line is regraded if its
    metrics or its reference changed, and refused otherwise.

    Parameters
    ----------
    instance
        Whose submissions are recorded; nothing is written.
    find_published
        Given a slug and the checksum of a published result, returns that result; None if it is not known.
    today
        The date of the new lines.
    """
    problems = Problems()
    ledger = read_ledger(instance, problems)
    if ledger is None:
        return LedgerUpdate((), b"", tuple(problems))
    judge_vanished(instance, ledger, problems)
    recorder = _Recorder(instance, ledger, find_published, _not_before(ledger, today))
    slugs = [folder.name for folder in instance.submission_dirs() if folder.name not in ledger.withdrawn]
    lines = [recorder.record(slug, problems) for slug in slugs]
    added = tuple(line for line in lines if line is not None)
    return LedgerUpdate(added, render_ledger((*ledger.lines, *added)).encode(), tuple(problems))


def _not_before(ledger: Ledger, today: dt.date) -> dt.date:
    """The date of new lines: never before the last one, wherever the clock of the machine stands."""
    return max([today, *(line.date for line in ledger.lines[-1:])])
