"""A connection to servers that tries again, waits only so long, and follows redirects only so far."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import TracebackType
from typing import Self
from urllib.parse import urljoin, urlsplit

import requests
from requests.adapters import HTTPAdapter
from urllib3.exceptions import HTTPError, InvalidHeader, MaxRetryError
from urllib3.util import Retry

from leaderboard.errors import SourceError
from leaderboard.reference.fetching.failures import (
    MOVED_HINT,
    BrokenOffError,
    check_url,
    explain_failure,
    is_web,
    show_url,
)
from leaderboard.reference.fetching.progress import SILENT, Progress

MAX_REDIRECTS = 5
TRY_AGAIN = frozenset({429, *range(500, 600)})
PROGRESS_SIZE = 1_000_000  # whoever gets so far before an interruption may be interrupted as often as ever
HEADERS = {"Accept-Encoding": "identity"}  # bytes as they are: ranges and lengths are of these


@dataclass(frozen=True)
class Patience:
    """How long to wait and how often to try again.

    Attributes
    ----------
    connect, read
        Seconds until a connection must stand, and until something must come.
    retries
        How often to try again.
    backoff
        The second retry waits twice so many seconds, each further one twice as long as the one before.
    longest_wait
        Seconds that no wait exceeds, whatever the server asks for by ``Retry-After``.
    """

    connect: float = 10.0
    read: float = 60.0
    retries: int = 5
    backoff: float = 0.5
    longest_wait: int = 60

    def make_retry(self) -> Retry:
        """Make the library's description of it."""
        return _Retry(
            total=self.retries,
            backoff_factor=self.backoff,
            backoff_max=self.longest_wait,
            retry_after_max=self.longest_wait,
            status_forcelist=TRY_AGAIN,
            raise_on_status=False,
        )


PATIENCE = Patience()


class Connection:
    """Asks servers with the proxies, certificates and logins of the environment.

    Parameters
    ----------
    patience
        How long to wait and how often to try again.
    progress
        Is told of every byte of content that comes.

    Attributes
    ----------
    n_bytes
        How many bytes of content have come.
    """

    def __init__(self, patience: Patience = PATIENCE, progress: Progress = SILENT) -> None:
        self.patience = patience
        self.progress = progress
        self.n_bytes = 0
        self._session = _Session()
        self._session.max_redirects = MAX_REDIRECTS
        for scheme in ("http://", "https://"):
            self._session.mount(scheme, HTTPAdapter(max_retries=patience.make_retry()))

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._session.close()

    def get(self, url: str, headers: Mapping[str, str]) -> requests.Response:
        """Ask for a file; its status is not judged and its content not read yet.

        Raises
        ------
        SourceError
            If no answer comes.
        """
        check_url(url)
        timeout = (self.patience.connect, self.patience.read)
        try:
            return self._session.get(url, headers={**HEADERS, **headers}, stream=True, timeout=timeout)
        except (requests.RequestException, HTTPError, OSError, ValueError) as error:
            raise explain_failure(error, url) from error

    def note(self, n_bytes: int) -> None:
        """Count content that has come."""
        self.n_bytes += n_bytes
        self.progress.advance(n_bytes)


class Attempts:
    """Counts the interruptions of one transfer and waits after each, longer and longer.

    Parameters
    ----------
    connection
        What the transfer goes over.
    url
        Where it comes from.
    """

    def __init__(self, connection: Connection, url: str) -> None:
        self._connection = connection
        self._url = url
        self._retry = connection.patience.make_retry()
        self._n_bytes = connection.n_bytes

    def wait_after(self, error: BrokenOffError) -> None:
        """Wait before the next attempt.

        Raises
        ------
        SourceError
            If there were enough of them.
        """
        if self._connection.n_bytes - self._n_bytes >= PROGRESS_SIZE:
            self._retry = self._connection.patience.make_retry()
        self._n_bytes = self._connection.n_bytes
        try:
            self._retry = self._retry.increment("GET", self._url, error=error)
        except MaxRetryError:
            raise explain_failure(error, self._url) from error
        self._retry.sleep()


class _Retry(Retry):
    """Waits as after any failure where a server's ``Retry-After`` cannot be understood."""

    def parse_retry_after(self, retry_after: str) -> float:
        try:
            return super().parse_retry_after(retry_after)
        except (InvalidHeader, ValueError):
            return 0.0


class _Session(requests.Session):
    """Follows no redirect from an encrypted to a plain connection, nor away from the web."""

    def get_redirect_target(self, resp: requests.Response) -> str | None:
        target = super().get_redirect_target(resp)
        if target is None:
            return None
        resp.close()  # the library would read the content first, however long
        try:
            place = urljoin(resp.url, target)
        except ValueError:
            raise SourceError(f"{show_url(resp.url)}: sends on to a malformed address", MOVED_HINT) from None
        saying = f"{show_url(resp.url)}: sends on to {show_url(place)}"
        if not is_web(place):
            raise SourceError(f"{saying}, which is no http or https address", MOVED_HINT)
        if urlsplit(resp.url).scheme == "https" and urlsplit(place).scheme == "http":
            raise SourceError(f"{saying}, where the files could be changed on the way", MOVED_HINT)
        return target
