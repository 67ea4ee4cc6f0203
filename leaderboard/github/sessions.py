"""Requests to one API: what goes with each of them, and what is kept of an answer."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import islice
from typing import Any
from urllib.parse import urlsplit

import requests
from requests.auth import AuthBase

from leaderboard import __version__
from leaderboard.github.tokens import Token

API_VERSION = "2022-11-28"
HEADERS = {
    "Accept": "application/vnd.github+json",
    "X-GitHub-Api-Version": API_VERSION,
    "User-Agent": f"leaderboard/{__version__}",
}
CHUNK = 1 << 16
MAX_CHUNKS = 1 << 8  # 16 MiB: no answer to what is asked here comes near it


@dataclass(frozen=True)
class Reply:
    """What is kept of an answer: its request, which holds the token, is not.

    Attributes
    ----------
    status
        Such as 200.
    headers
        By name, whatever its capitals.
    content
        At most 16 MiB; of more the rest is left out.
    """

    status: int
    headers: Mapping[str, str]
    content: bytes


class Session(requests.Session):
    """Sends a token to an API, and redirects nowhere by itself.

    Parameters
    ----------
    api_url
        Where the API is. If it is not encrypted it is on this machine, and no proxy is asked for it: it would
        read the token.
    token
        Goes with every request.
    """

    def __init__(self, api_url: str, token: Token) -> None:
        super().__init__()
        self.headers.update(HEADERS)
        self.auth = _Bearer(token)
        self.trust_env = urlsplit(api_url).scheme == "https"

    def ask(
        self,
        method: str,
        url: str,
        *,
        parameters: Mapping[str, str] | None,
        content: Mapping[str, Any] | None,
        timeout: tuple[float, float],
    ) -> Reply:
        """Make a request, with seconds to connect and to read in ``timeout``.

        Raises
        ------
        requests.RequestException
            If no answer comes.
        """
        answer = self.request(
            method, url, params=parameters, json=content, timeout=timeout, allow_redirects=False, stream=True
        )
        with answer:
            return Reply(
                answer.status_code,
                answer.headers,
                b"".join(islice(answer.iter_content(CHUNK), MAX_CHUNKS)),
            )

    def get_redirect_target(self, resp: requests.Response) -> None:
        """Name no address to go on to: whether a redirect is followed is not decided here."""
        del resp


class _Bearer(AuthBase):
    """Puts the token into requests; what a file such as ``.netrc`` may hold does not get in."""

    def __init__(self, token: Token) -> None:
        self._token = token

    def __call__(self, r: requests.PreparedRequest) -> requests.PreparedRequest:
        r.headers["Authorization"] = f"Bearer {self._token.value}"
        return r
