"""Asking GitHub's API: with patience, within its limits, and with the token for its own host alone."""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from http import HTTPStatus
from types import TracebackType
from typing import Any, Self, TypeVar
from urllib.parse import urljoin, urlsplit

import requests
from pydantic import TypeAdapter, ValidationError
from urllib3.exceptions import ProtocolError

from leaderboard.github.failures import RERUN_HINT, URL_HINT, GitHubError, explain_refusal, show_words
from leaderboard.github.limits import explain_limit, find_delay, find_wait
from leaderboard.github.sessions import Reply, Session
from leaderboard.github.tokens import Token
from leaderboard.reference.fetching.failures import CA_HINT, PROXY_HINT, explain_failure, show_url

MAX_REDIRECTS = 5
_REDIRECTS = frozenset({301, 302, 307, 308})  # each to be repeated as it was, as GitHub asks
_ABSENT = frozenset(
    {HTTPStatus.NOT_FOUND, HTTPStatus.CONFLICT}
)  # the latter: a repository without content yet

Kind = TypeVar("Kind")
Tell = Callable[[str], None]


@dataclass(frozen=True)
class Patience:
    """How long to wait and how often to try again.

    Attributes
    ----------
    connect, read
        Seconds until a connection must stand, and until something must come.
    tries
        How often a request is made at most.
    backoff
        Seconds before the second try; twice as many before each further one.
    longest_wait
        Seconds that no wait exceeds: whoever is asked to wait longer is told when to come back.
    fork_checks
        How often to look whether a new fork is ready, each time a little later.
    sleep, now
        The clock.
    """

    connect: float = 10.0
    read: float = 30.0
    tries: int = 4
    backoff: float = 1.0
    longest_wait: float = 90.0
    fork_checks: int = 20
    sleep: Callable[[float], None] = time.sleep
    now: Callable[[], float] = time.time


class Client:
    """Asks GitHub as the owner of a token.

    Reading is tried again when it fails. Writing is not, since it may have been done: whoever runs the whole
    again looks first.

    Parameters
    ----------
    api_url
        Where the API is.
    token
        Sent to that host and to no other.
    tell
        Is told what is being done, and of longer waits.
    patience
        How long to wait.
    """

    def __init__(self, api_url: str, token: Token, *, tell: Tell, patience: Patience | None = None) -> None:
        self.token = token
        self.tell = tell
        self.patience = patience or Patience()
        self.api_url = api_url.rstrip("/")
        self._doing = "asking GitHub"
        self._session = Session(self.api_url, token)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._session.close()

    def begin(self, doing: str) -> None:
        """Say what the next requests are for; messages about their failures begin so."""
        self._doing = doing
        self.tell(doing)

    def get(self, path: str, kind: type[Kind], **parameters: str) -> Kind:
        """Read what is at a path.

        Raises
        ------
        GitHubError
            If it cannot be read.
        """
        return self._read(self._ask("GET", path, parameters), kind)

    def find(self, path: str, kind: type[Kind], **parameters: str) -> Kind | None:
        """Read what is at a path; None if there is nothing.

        Raises
        ------
        GitHubError
            If it cannot be read.
        """
        answer = self._ask("GET", path, parameters)
        if answer.status in _ABSENT:
            return None
        return self._read(answer, kind)

    def post(self, path: str, content: Mapping[str, Any], kind: type[Kind]) -> Kind:
        """Make something.

        Raises
        ------
        GitHubError
            If it is refused, or if no answer comes; in the latter case it may have been made.
        """
        return self._read(self._ask("POST", path, content=content), kind)

    def patch(self, path: str, content: Mapping[str, Any], kind: type[Kind]) -> Kind:
        """Change something.

        Raises
        ------
        GitHubError
            If it is refused, or if no answer comes; in the latter case it may have been changed.
        """
        return self._read(self._ask("PATCH", path, content=content), kind)

    def fail(self, reason: str, hint: str) -> GitHubError:
        """Make the error that says why what was begun cannot be done."""
        return GitHubError(f"{self._doing}: {reason}", hint)

    def _ask(
        self,
        method: str,
        path: str,
        parameters: Mapping[str, str] | None = None,
        content: Mapping[str, Any] | None = None,
    ) -> Reply:
        n = 1
        while True:
            outcome = self._send(method, path, parameters, content)
            is_last = n >= self.patience.tries
            wait = self._judge(outcome, is_last=is_last, may_repeat=method == "GET" and not is_last)
            if wait is None:
                break
            self.patience.sleep(max(wait, self.patience.backoff * 2 ** (n - 1)))
            n += 1
        if isinstance(outcome, GitHubError):
            raise outcome
        return outcome

    def _judge(self, outcome: Reply | GitHubError, *, is_last: bool, may_repeat: bool) -> float | None:
        """Tell how many seconds to wait before the request is made again; None if it is not."""
        if isinstance(outcome, GitHubError):
            return 0.0 if may_repeat else None
        now = self.patience.now()
        wait = find_wait(outcome, now)
        if wait is not None:  # nothing was done, so that writing may be tried again as well
            if is_last or wait > self.patience.longest_wait:
                raise explain_limit(self._doing, wait, now)
            self.tell(f"GitHub asks to wait for {wait:.0f} seconds")
            return wait
        if not may_repeat or outcome.status < HTTPStatus.INTERNAL_SERVER_ERROR:
            return None
        delay = find_delay(outcome) or 0.0
        return delay if delay <= self.patience.longest_wait else None

    def _send(
        self,
        method: str,
        path: str,
        parameters: Mapping[str, str] | None,
        content: Mapping[str, Any] | None,
    ) -> Reply | GitHubError:
        """Make a request, and again where its host sends it on to; say what is wrong if no answer comes."""
        url = self.api_url + path
        for _ in range(MAX_REDIRECTS + 1):
            try:
                answer = self._session.ask(
                    method,
                    url,
                    parameters=parameters,
                    content=content,
                    timeout=(self.patience.connect, self.patience.read),
                )
            except (requests.RequestException, OSError, ValueError) as error:
                return self._explain(error, url)  # not raised here: the error would hold on to the request
            target = answer.headers.get("Location")
            if answer.status not in _REDIRECTS or target is None:
                return answer
            url, parameters = self._follow(url, target), None
        return self.fail("GitHub sends on from one address to the next without end", URL_HINT)

    def _follow(self, url: str, target: str) -> str:
        """Follow a redirect within the host; elsewhere the token would be somebody else's."""
        place = _join(url, target)
        if place is None:
            raise self.fail("GitHub sends on to a malformed address", URL_HINT)
        if _origin_of(place) != _origin_of(url):
            shown = show_words(show_url(place), self.token)
            hint = "nothing was sent there; if that is where the API is, name it with --api-url"
            raise self.fail(f"GitHub sends on to another host, {shown}", hint)
        return place

    def _explain(self, error: Exception, url: str) -> GitHubError:
        if _is_cut(error):
            return self.fail("the connection was cut", RERUN_HINT)
        found = explain_failure(error, url)
        hint = found.hint if found.hint in {CA_HINT, PROXY_HINT} else f"when it works again, {RERUN_HINT}"
        return self.fail(self.token.redact(found.message), hint)

    def _read(self, answer: Reply, kind: type[Kind]) -> Kind:
        if answer.status >= HTTPStatus.BAD_REQUEST:
            raise explain_refusal(answer, self._doing, self.token)
        try:
            return TypeAdapter(kind).validate_json(answer.content)
        except (ValidationError, RecursionError):
            pass  # the library's message quotes the answer
        raise self.fail("the answer is not one of GitHub's", URL_HINT)


def _join(url: str, target: str) -> str | None:
    try:
        place = urljoin(url, target)
        _origin_of(place)
    except ValueError:
        return None
    return place


def _origin_of(url: str) -> tuple[str, str | None, int | None]:
    parts = urlsplit(url)
    return parts.scheme, parts.hostname, parts.port or {"https": 443, "http": 80}.get(parts.scheme)


def _is_cut(error: Exception) -> bool:
    return isinstance(error, requests.exceptions.ChunkedEncodingError) or any(
        isinstance(cause, ProtocolError) for cause in error.args
    )
