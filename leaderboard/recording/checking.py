"""Whether the ledger is sound: well formed, only appended to, and true of the submissions as they are."""

from dataclasses import dataclass

from leaderboard.files import sha256_hex
from leaderboard.instance import RESULT_FILE, Instance
from leaderboard.ledger import Ledger, parse_ledger, read_ledger_bytes
from leaderboard.models.ledger import LedgerLine
from leaderboard.problems import Problem, Problems
from leaderboard.recording.history import History, Version
from leaderboard.submission import read_submission

UPDATE_HINT = "leaderboard ledger update"


@dataclass(frozen=True)
class LedgerCheck:
    """What was found; ``ledger`` is None if it cannot be understood."""

    ledger: Ledger | None
    problems: tuple[Problem, ...]

    @property
    def is_sound(self) -> bool:
        """Whether nothing is wrong."""
        return not any(problem.is_error for problem in self.problems)


def check_ledger(instance: Instance, history: History | None) -> LedgerCheck:
    """Check an instance's ledger against its submissions and against every version that it had.

    Parameters
    ----------
    instance
        Whose ledger and submissions are checked.
    history
        What was committed before; None to leave that out.
    """
    problems = Problems()
    content = read_ledger_bytes(instance, problems)
    if content is None:
        return LedgerCheck(None, tuple(problems))
    if history is not None:
        judge_history(instance, content, history, problems)
    file = instance.display_path(instance.ledger_file)
    ledger = parse_ledger(content, file, problems) if content else Ledger()
    if ledger is not None:
        judge_vanished(instance, ledger, problems)
        _judge_recorded(instance, ledger, problems)
    return LedgerCheck(ledger, tuple(problems))


def judge_history(instance: Instance, content: bytes, history: History, problems: Problems) -> None:
    """Report the newest version of the ledger that was not only appended to."""
    file = instance.display_path(instance.ledger_file)
    newer = Version("", content)
    for older in history.ledgers():
        if not newer.content.startswith(older.content):
            _report_rewritten(newer, older, file, problems)
            return
        newer = older


def judge_vanished(instance: Instance, ledger: Ledger, problems: Problems) -> None:
    """Report submissions that were published and are gone, though the ledger does not withdraw them."""
    there = {folder.name for folder in instance.submission_dirs()}
    file = instance.display_path(instance.ledger_file)
    for slug in sorted(ledger.latest.keys() - there - ledger.withdrawn):
        hint = "bring its folder back, or add a line that withdraws it and says why"
        problems.add("ledger-vanished", f"{slug} was published and is gone", file, hint=hint)


def read_result(instance: Instance, slug: str) -> bytes | None:
    """Read the result that is committed for a submission; None if there is none."""
    folder = instance.submission_dir(slug)
    file = read_submission(folder, instance.display_path(folder)).find(RESULT_FILE)
    return None if file is None else file.content


def _judge_recorded(instance: Instance, ledger: Ledger, problems: Problems) -> None:
    """Report submissions whose last line is not about the result that they have, those that left aside."""
    for folder in instance.submission_dirs():
        if folder.name in ledger.withdrawn:
            continue
        line = ledger.latest.get(folder.name)
        result = read_result(instance, folder.name)
        message = _find_difference(line, None if result is None else sha256_hex(result))
        if message:
            place = instance.display_path(folder)
            problems.add("ledger-unrecorded", message, place, hint=UPDATE_HINT)


def _find_difference(line: LedgerLine | None, sha256: str | None) -> str:
    if line is None:
        return "has no line in the ledger"
    if sha256 is None:
        return f"has no {RESULT_FILE}, and the ledger records one"
    return "" if line.result_sha256 == sha256 else f"its {RESULT_FILE} is not the one that the ledger records"


def _report_rewritten(newer: Version, older: Version, file: str, problems: Problems) -> None:
    then, now = older.content.split(b"\n"), newer.content.split(b"\n")
    pairs = enumerate(zip(then, [*now, *[b""] * len(then)], strict=False), 1)
    line = next((number for number, (old, new) in pairs if old != new), len(now))
    where = f"commit {newer.commit[:12]}" if newer.commit else "the file as it is"
    message = f"{where} does not begin with what commit {older.commit[:12]} published"
    hint = "published lines stay as they are: bring them back and add a new line at the end"
    problems.add("ledger-rewritten", message, file, line=line, hint=hint)
