"""What GitHub's refusals mean, in words that say what to do."""

import json
from collections.abc import Iterator
from http import HTTPStatus
from typing import TYPE_CHECKING

from leaderboard.errors import LeaderboardError
from leaderboard.github.tokens import Token
from leaderboard.report.problems import escape_line

if TYPE_CHECKING:  # the network's library is loaded only by what uses the network
    from leaderboard.github.sessions import Reply

MAX_WORDS = 300
RERUN_HINT = "run the command again: it goes on where it stopped"
LOGIN_HINT = "it may have expired or been revoked: make another, or run gh auth login"
SCOPE_HINT = "gh auth refresh --scopes {scope}, or a classic token with that scope"
PERMISSION_HINT = (
    "a fine-grained token reaches repositories of one owner only: "
    "use gh auth login, or a classic token with the scope public_repo"
)
SYNC_HINT = "press Sync fork on your fork's page on GitHub, then run the command again"
URL_HINT = "is --api-url the address of GitHub's API, and the network not one that asks to log in first?"


class GitHubError(LeaderboardError):
    """GitHub refuses, is not reached, or answers what it should not."""


def explain_refusal(answer: "Reply", doing: str, token: Token) -> GitHubError:
    """Say what a status means that is no success.

    Parameters
    ----------
    answer
        What came.
    doing
        What was being done, such as ``making a fork``.
    token
        The one that was sent; nothing of it gets into the message.
    """
    status = answer.status
    for explain in (_explain_token, _explain_sign_on, _explain_scopes, _explain_permissions):
        found = explain(answer, token)
        if found is not None:
            reason, hint = found
            return GitHubError(f"{doing}: {reason}", hint)
    words = read_words(answer, token)
    said = f"{_name_status(status)}{f' ({words})' if words else ''}"
    return GitHubError(f"{doing}: GitHub answers {said}", _choose_hint(status, words))


def read_words(answer: "Reply", token: Token) -> str:
    """Quote what GitHub says of a refusal, in one printable line without the token."""
    try:
        content = json.loads(answer.content)
    except (ValueError, RecursionError):
        return ""
    return show_words("; ".join(_find_words(content)), token)


def show_words(text: str, token: Token) -> str:
    r"""Show what a server says in one printable line, cut, and without the token.

    >>> print(show_words("no\n::error::abcdefgh", Token("abcdefgh", "gh")))
    no\n::error::***
    """
    shown = escape_line(token.redact(text))
    return shown if len(shown) <= MAX_WORDS else f"{shown[: MAX_WORDS - 3]}..."


def _find_words(content: object) -> Iterator[str]:
    if not isinstance(content, dict):
        return
    if isinstance(content.get("message"), str):
        yield content["message"]
    errors = content.get("errors")
    for error in errors if isinstance(errors, list) else []:
        if isinstance(error, str):
            yield error
        elif isinstance(error, dict):
            message = error.get("message")
            yield message if isinstance(message, str) else f"{error.get('field')}: {error.get('code')}"


def _explain_token(answer: "Reply", token: Token) -> tuple[str, str] | None:
    if answer.status != HTTPStatus.UNAUTHORIZED:
        return None
    return f"GitHub does not accept the token of {token.origin}", LOGIN_HINT


def _explain_sign_on(answer: "Reply", token: Token) -> tuple[str, str] | None:
    """Read ``X-GitHub-SSO: required; url=https://...``."""
    told = answer.headers.get("X-GitHub-SSO", "")
    if answer.status != HTTPStatus.FORBIDDEN or not told.startswith("required"):
        return None
    url = show_words(told.partition("url=")[2].strip(), token)
    place = f" at {url}" if url.startswith("https://") else ""
    return "the organisation asks for single sign-on", f"authorise the token{place}, then run this again"


def _explain_scopes(answer: "Reply", token: Token) -> tuple[str, str] | None:
    """Compare the scopes that would do with those of the token; GitHub hides things with a 404, too."""
    accepted = _parse_scopes(answer.headers.get("X-Accepted-OAuth-Scopes", ""))
    held = answer.headers.get("X-OAuth-Scopes")
    if answer.status not in {HTTPStatus.FORBIDDEN, HTTPStatus.NOT_FOUND} or held is None:
        return None
    if not accepted or set(accepted) & set(_parse_scopes(held)):
        return None
    scope = "public_repo" if "public_repo" in accepted else show_words(accepted[0], token)
    return f"the token of {token.origin} lacks the scope {scope}", SCOPE_HINT.format(scope=scope)


def _explain_permissions(answer: "Reply", token: Token) -> tuple[str, str] | None:
    words = read_words(answer, token)
    if answer.status != HTTPStatus.FORBIDDEN or not words.startswith("Resource not accessible"):
        return None
    needed = show_words(answer.headers.get("X-Accepted-GitHub-Permissions", ""), token)
    return (
        f"the token of {token.origin} lacks the permission{f' {needed}' if needed else ''}",
        PERMISSION_HINT,
    )


def _parse_scopes(text: str) -> list[str]:
    return [scope.strip() for scope in text.split(",") if scope.strip()]


def _name_status(status: int) -> str:
    try:
        return f"{status} {HTTPStatus(status).phrase}"
    except ValueError:
        return str(status)


def _choose_hint(status: int, words: str) -> str:
    if any(sign in words.lower() for sign in ("workflow", "does not exist", "merge conflict")):
        return SYNC_HINT
    if "fork" in words.lower() and status == HTTPStatus.FORBIDDEN:
        return "ask the maintainers to allow forks, or to take the folder in another way"
    if status == HTTPStatus.NOT_FOUND:
        return "it is not there, or the token may not see it"
    if status == HTTPStatus.CONFLICT or status >= HTTPStatus.INTERNAL_SERVER_ERROR:
        return RERUN_HINT
    if status in {HTTPStatus.FORBIDDEN, HTTPStatus.UNPROCESSABLE_ENTITY}:
        return "mend what GitHub names, then run the command again"
    return URL_HINT
