"""Why a published result may be replaced by another, or which of its numbers changed without a reason.

Results are compared as plain JSON: an older one may be of a form that the models no longer know.
"""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from leaderboard.models.ledger import MAX_REASON_LENGTH
from leaderboard.problems import Problems

SHOWN_DIGITS = 12
MAX_SHOWN = 80

# What describes the grader and its remarks: not a number of the board.
_REMARKS = ("grader", "checks")

_SCORES = "scores"


@dataclass(frozen=True)
class Origin:
    """What a result says of where its numbers come from."""

    predictions: str
    digest: str
    kind: str
    metrics_version: int
    grader: str

    @classmethod
    def of(cls, result: dict[str, Any]) -> "Origin":
        """Read it from a result; KeyError or TypeError if that is none."""
        inputs = result["inputs"]
        return cls(
            str(inputs["predictions_sha256"]),
            str(inputs["reference_digest"]),
            str(inputs["reference_kind"]),
            int(result["metrics_version"]),
            str(result["grader"]),
        )


def explain_regrading(published: bytes, fresh: bytes, file: str, problems: Problems) -> str | None:
    """Say why a result may replace a published one.

    It may with a higher ``metrics_version`` or another reference, and where every number stays.

    Parameters
    ----------
    published, fresh
        The two results, as the bytes of their files.
    file
        How messages name the fresh one.
    problems
        Receives each number that changed without a reason.

    Returns
    -------
    str or None
        The reason, for the ledger; None, and problems, if there is none.
    """
    old, new = _load(published), _load(fresh)
    try:
        before, after = Origin.of(old), Origin.of(new)
    except (KeyError, TypeError, ValueError):
        problems.add("ledger-result", "is not a result, or the published one was not", file)
        return None
    if after.predictions != before.predictions:
        hint = "bring the published predictions back, and send the others under a new slug"
        problems.add(
            "ledger-predictions", "is made from other predictions than were published", file, hint=hint
        )
        return None
    if after.metrics_version < before.metrics_version:
        message = f"metrics_version goes back from {before.metrics_version} to {after.metrics_version}"
        problems.add("ledger-score", message, file, hint="metrics_version only goes up")
        return None
    reason = _find_reason(before, after) or _judge_numbers(old, new, file, problems)
    return None if reason is None else reason[:MAX_REASON_LENGTH].rstrip()


def _load(content: bytes) -> dict[str, Any]:
    try:
        value = json.loads(content)
    except (ValueError, RecursionError):
        return {}
    return value if isinstance(value, dict) else {}


def _find_reason(before: Origin, after: Origin) -> str:
    reasons = []
    if after.metrics_version > before.metrics_version:
        reasons.append(f"metrics_version {before.metrics_version} -> {after.metrics_version}")
    old, new = (_plain(f"{o.digest[:SHOWN_DIGITS]} ({o.kind})") for o in (before, after))
    if (after.digest, after.kind) != (before.digest, before.kind):
        reasons.append(f"reference {old} -> {new}")
    return ", ".join(reasons)


def _judge_numbers(old: dict[str, Any], new: dict[str, Any], file: str, problems: Problems) -> str | None:
    """Report every number that differs; the reason if none does."""
    cause = _find_cause(old, new)
    changes = list(_list_changes(old, new))
    for message in changes:
        hint = "raise METRICS_VERSION if the change is meant; else grade with what graded before"
        problems.add("ledger-score", f"{message} ({cause})", file, hint=hint)
    return None if changes else f"no number changed: {cause}"


def _find_cause(old: dict[str, Any], new: dict[str, Any]) -> str:
    if new["grader"] != old["grader"]:
        return _plain(f"grader {_show(old['grader'])} -> {_show(new['grader'])}")
    if new.get("checks") != old.get("checks"):
        return "other remarks by the same grader"
    return "other bytes by the same grader"


def _list_changes(old: dict[str, Any], new: dict[str, Any]) -> Iterator[str]:
    before, after = (dict(_spread(result)) for result in (old, new))
    for name in [*before, *(name for name in after if name not in before)]:
        was, is_now = (_show(values[name]) if name in values else "absent" for values in (before, after))
        if before.get(name) != after.get(name) or (name in before) != (name in after):
            yield _plain(f"{name} was {was}, is now {is_now}")


def _spread(value: object, *path: str) -> Iterator[tuple[str, object]]:
    """Name every number of a result by its path: ``<scope> <subset> <metric>`` for a score."""
    if not isinstance(value, dict) or "value" in value:
        yield " ".join(path[1:] if path[:1] == (_SCORES,) else path), value
        return
    for key, inner in value.items():
        if path or key not in _REMARKS:
            yield from _spread(inner, *path, key)


def _show(value: object) -> str:
    """Show a score as its value with its interval, anything else as JSON, in one short printable line."""
    if isinstance(value, dict) and isinstance(value.get("value"), int | float):
        ends = [value[end] for end in ("low", "high") if end in value]
        text = f"{value['value']}" + (f" [{ends[0]}, {ends[1]}]" if len(ends) > 1 else "")
    else:
        text = json.dumps(value)
    return text if len(text) <= MAX_SHOWN else text[: MAX_SHOWN - 3] + "..."


def _plain(text: str) -> str:
    """Escape a text with anything but printable ASCII in it: names and values may come from any file."""
    return text if text.isascii() and text.isprintable() else ascii(text)[1:-1]
