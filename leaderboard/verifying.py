"""Proof that every committed result is what grading gives today."""

import datetime as dt
import json
from collections.abc import Iterator
from dataclasses import dataclass

from leaderboard.assessing import assess
from leaderboard.errors import BrokenReferenceError
from leaderboard.files import TEMPORARY_PREFIX
from leaderboard.grading import Yardstick, result_bytes
from leaderboard.instance import LEDGER_FILE, RESULT_FILE, Instance
from leaderboard.models import Manifest
from leaderboard.reference import load_reference
from leaderboard.submission import read_submission

MAX_DIFFERENCES = 20
MAX_SHOWN = 80


@dataclass(frozen=True)
class Verdict:
    """The outcome for one submission; ``differences`` is empty if its result is proven."""

    slug: str
    differences: tuple[str, ...]

    @property
    def is_proven(self) -> bool:
        """Whether the committed result equals the fresh one, byte for byte."""
        return not self.differences


@dataclass(frozen=True)
class Verification:
    """The outcome for an instance: the reference's seal, each submission, and files that do not belong."""

    manifest: Manifest | None
    reference_problem: str
    verdicts: tuple[Verdict, ...]
    strays: tuple[str, ...]

    @property
    def is_proven(self) -> bool:
        """Whether the reference is as sealed, every result is proven, and nothing else lies there."""
        return not self.reference_problem and not self.strays and all(v.is_proven for v in self.verdicts)


def verify_instance(instance: Instance, *, today: dt.date) -> Verification:
    """Grade every submission again and compare with what is committed.

    A reference that differs from its manifest is reported and nothing is graded with it.
    """
    try:
        reference = load_reference(instance)
    except BrokenReferenceError as error:
        return Verification(None, error.message, (), _find_strays(instance))
    verdicts = []
    yardstick = Yardstick.of(reference)
    for folder in instance.submission_dirs():
        raw = read_submission(folder, instance.display_path(folder))
        assessment = assess(raw, reference, today=today, yardstick=yardstick)
        committed = raw.find(RESULT_FILE)
        if assessment.result is None:
            errors = [problem for problem in assessment.problems if problem.is_error]
            differences = [f"is not valid: {errors[0].message}" + _count_rest(len(errors) - 1, "problem")]
        else:
            differences = list_differences(
                committed.content if committed else None, result_bytes(assessment.result)
            )
        verdicts.append(Verdict(folder.name, tuple(differences)))
    return Verification(reference.manifest, "", tuple(verdicts), _find_strays(instance))


def list_differences(committed: bytes | None, fresh: bytes) -> list[str]:
    """Name each difference between a committed result and a fresh one, at most 20 and a count of the rest.

    >>> list_differences(b'{"a": {"b": 1}}', b'{"a": {"b": 2}}')
    ['a.b is 1, should be 2']
    """
    if committed == fresh:
        return []
    if committed is None:
        return [f"has no {RESULT_FILE}"]
    try:
        found = json.loads(committed)
    except (ValueError, RecursionError):
        return [f"{RESULT_FILE} is not JSON"]
    differences = list(_compare(found, json.loads(fresh), ""))
    if not differences:
        return [f"{RESULT_FILE} has the right content in other bytes (spacing or order of keys)"]
    rest = len(differences) - MAX_DIFFERENCES
    return differences[:MAX_DIFFERENCES] + ([f"... and {rest} more differences"] if rest > 0 else [])


def _compare(found: object, expected: object, path: str) -> Iterator[str]:
    if isinstance(found, dict) and isinstance(expected, dict):
        for key in sorted(found.keys() | expected.keys(), key=str):
            where = f"{path}.{key}" if path else str(key)
            if key not in expected:
                yield f"{_shorten(where)} should not be there"
            elif key not in found:
                yield f"{_shorten(where)} is missing"
            else:
                yield from _compare(found[key], expected[key], where)
    elif found != expected or type(found) is not type(expected):
        yield f"{_shorten(path)} is {_shorten(json.dumps(found))}, should be {_shorten(json.dumps(expected))}"


def _shorten(text: str) -> str:
    plain = text.encode("unicode_escape").decode("ascii")
    return plain if len(plain) <= MAX_SHOWN else plain[: MAX_SHOWN - 3] + "..."


def _count_rest(count: int, noun: str) -> str:
    return f" (and {count} more {noun}{'s' if count > 1 else ''})" if count > 0 else ""


def _find_strays(instance: Instance) -> tuple[str, ...]:
    if not instance.submissions_dir.is_dir():
        return ()
    known = {folder.name for folder in instance.submission_dirs()} | {LEDGER_FILE}
    names = sorted(path.name for path in instance.submissions_dir.iterdir())
    return tuple(name for name in names if name not in known and not name.startswith(TEMPORARY_PREFIX))
