"""How long GitHub asks to wait, and when to come back if that is too long."""

import datetime as dt
import math
from http import HTTPStatus
from typing import TYPE_CHECKING

from leaderboard.github.failures import GitHubError

if TYPE_CHECKING:
    from leaderboard.github.sessions import Reply

UNTOLD_WAIT = 60.0  # GitHub: without a header, wait for at least one minute
MAX_DIGITS = 12


def find_wait(answer: "Reply", now: float) -> float | None:
    """Tell how many seconds an answer asks to wait because there were too many requests; None if it does not.

    Parameters
    ----------
    answer
        What came: a 429, or a 403 that says so by ``Retry-After``, by ``X-RateLimit-Remaining`` or in words.
    now
        Seconds since 1970, as ``X-RateLimit-Reset`` counts.
    """
    if answer.status not in {HTTPStatus.FORBIDDEN, HTTPStatus.TOO_MANY_REQUESTS}:
        return None
    asked = find_delay(answer)
    if asked is not None:
        return asked
    if answer.headers.get("X-RateLimit-Remaining") == "0":
        reset = _parse_count(answer.headers.get("X-RateLimit-Reset", ""))
        return UNTOLD_WAIT if reset is None else max(0.0, reset - now) + 1
    is_limited = answer.status == HTTPStatus.TOO_MANY_REQUESTS or b"rate limit" in answer.content.lower()
    return UNTOLD_WAIT if is_limited else None


def find_delay(answer: "Reply") -> float | None:
    """Read ``Retry-After`` as a number of seconds; None if there is none."""
    return _parse_count(answer.headers.get("Retry-After", ""))


def explain_limit(doing: str, wait: float, now: float) -> GitHubError:
    """Say that GitHub takes no more requests for a while, and when it does again."""
    minutes = math.ceil(wait / 60)
    try:
        moment = dt.datetime.fromtimestamp(now + wait, dt.UTC)
    except (OverflowError, ValueError):
        return GitHubError(f"{doing}: GitHub takes no more requests from you", "try again tomorrow")
    when = f"{moment:%Y-%m-%d %H:%M} UTC, in {minutes:,} minute{'' if minutes == 1 else 's'}"
    hint = f"run the command again after {when}: it goes on where it stopped"
    return GitHubError(f"{doing}: GitHub takes no more requests from you for now", hint)


def _parse_count(text: str) -> float | None:
    """Parse a whole number of ASCII digits.

    >>> _parse_count("60"), _parse_count("-1"), _parse_count("soon")
    (60.0, None, None)
    """
    is_count = text.isascii() and text.isdigit() and len(text) <= MAX_DIGITS
    return float(text) if is_count else None
