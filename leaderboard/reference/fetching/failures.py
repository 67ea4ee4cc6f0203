"""What can go wrong between here and a server, in words that say what to do."""

import socket
import ssl
from collections.abc import Iterator
from http import HTTPStatus
from urllib.parse import SplitResult, urlsplit

import requests
import urllib3.exceptions
from urllib3.exceptions import LocationValueError

from leaderboard.errors import SourceError

OFFLINE_HINT = "offline? with a copy of the files: leaderboard reference import RECIPE --from PATH"
AGAIN_HINT = "run the command again"
CONTINUE_HINT = "run the command again: a download continues where it stopped"
MOVED_HINT = "have the files moved? with a copy of them: leaderboard reference import RECIPE --from PATH"
LATER_HINT = "try again later; with a copy of the files: leaderboard reference import RECIPE --from PATH"
PROXY_HINT = "look at HTTPS_PROXY, HTTP_PROXY and NO_PROXY in the environment"
CA_HINT = "does a proxy here sign with a certificate of its own? name its bundle in REQUESTS_CA_BUNDLE"


class BrokenOffError(Exception):
    """An answer began well and did not come to its end."""


# What the library raises, and what to make of it; the first that fits the error or one of its causes counts.
_EXPLANATIONS: tuple[tuple[tuple[type[BaseException], ...], str, str], ...] = (
    (
        # Addresses of files are judged before: these are of proxies, the last of kinds not supported.
        (requests.exceptions.InvalidURL, LocationValueError, requests.exceptions.InvalidSchema),
        "the proxy of the environment has an address that cannot be used",
        PROXY_HINT,
    ),
    ((urllib3.exceptions.ProxyError,), "the proxy of the environment does not let it through", PROXY_HINT),
    ((ssl.SSLError, urllib3.exceptions.SSLError), "no secure connection can be made", CA_HINT),
    ((socket.gaierror, urllib3.exceptions.NameResolutionError), "its host is not found", OFFLINE_HINT),
    # The library counts this one among the next, so it comes before.
    ((urllib3.exceptions.NewConnectionError,), "the server cannot be reached", OFFLINE_HINT),
    ((TimeoutError, urllib3.exceptions.TimeoutError), "the server does not answer in time", LATER_HINT),
    (
        (BrokenOffError, urllib3.exceptions.ProtocolError, ConnectionResetError),
        "the connection is cut again and again",
        CONTINUE_HINT,
    ),
    (
        (requests.exceptions.TooManyRedirects,),
        "sends on from one address to the next without end",
        MOVED_HINT,
    ),
)
_REFUSALS = {
    HTTPStatus.UNAUTHORIZED: "is not open to everyone",
    HTTPStatus.FORBIDDEN: "is not open to everyone",
    HTTPStatus.NOT_FOUND: "is not there",
    HTTPStatus.GONE: "is not there any more",
}


def show_url(url: str) -> str:
    """Show a URL without what may be secret: name and password, and the query, which may be signed.

    >>> show_url("https://me:secret@example.com/a%20b.zip?X-Signature=12#part")
    'https://example.com/a%20b.zip'
    """
    parts = _split_url(url)
    shown = SplitResult(parts.scheme, parts.netloc.rpartition("@")[2], parts.path, "", "").geturl()
    return "".join(character if character.isprintable() else "?" for character in shown)


def strip_credentials(url: str) -> str:
    """Leave name and password out of a URL.

    >>> strip_credentials("https://me:secret@example.com/a.zip?version=2")
    'https://example.com/a.zip?version=2'
    """
    parts = _split_url(url)
    return parts._replace(netloc=parts.netloc.rpartition("@")[2]).geturl()


def is_web(url: str) -> bool:
    """Tell whether a URL is an http or https address that can be asked."""
    parts = _split_url(url)
    if parts.scheme not in {"http", "https"} or not parts.hostname:
        return False
    try:
        requests.PreparedRequest().prepare_url(url, None)
    except requests.RequestException:
        return False
    return True


def check_url(url: str) -> None:
    """Refuse what is no http or https address.

    Raises
    ------
    SourceError
        If it is none.
    """
    if not is_web(url):
        raise SourceError(f"{show_url(url)}: is no http or https address, and only these are fetched")


def explain_failure(error: Exception, url: str) -> SourceError:
    """Say why no answer came, or not all of it."""
    causes = list(_list_causes(error))
    for kinds, saying, hint in _EXPLANATIONS:
        if any(isinstance(cause, kinds) for cause in causes):
            return SourceError(f"{show_url(url)}: {saying}{_say_reason(causes)}", hint)
    if isinstance(error, OSError) and not isinstance(error, requests.RequestException):
        # The one thing that the library says so: REQUESTS_CA_BUNDLE or CURL_CA_BUNDLE names no file.
        return SourceError(f"{show_url(url)}: {error}", CA_HINT)
    name = type(error).__name__
    return SourceError(f"{show_url(url)}: cannot be fetched ({name})", LATER_HINT)


def explain_status(answer: requests.Response, url: str) -> SourceError:
    """Say what a status means that is no success."""
    status = answer.status_code
    try:
        said = f"{status} {HTTPStatus(status).phrase}"
    except ValueError:
        said = str(status)
    place = show_url(url)
    if answer.history:
        place += f" (which sends on to {show_url(answer.url)})"
    if status in _REFUSALS:
        return SourceError(f"{place}: {_REFUSALS[HTTPStatus(status)]}; the server answers {said}", MOVED_HINT)
    hint = PROXY_HINT if status == HTTPStatus.PROXY_AUTHENTICATION_REQUIRED else LATER_HINT
    return SourceError(f"{place}: the server answers {said}", hint)


def _split_url(url: str) -> SplitResult:
    try:
        return urlsplit(url)
    except ValueError:
        raise SourceError("the address of an official file is malformed", MOVED_HINT) from None


def _list_causes(error: BaseException) -> Iterator[BaseException]:
    """Yield an error and all that it was raised for; the libraries keep causes in several places."""
    seen: set[int] = set()
    waiting = [error]
    while waiting:
        cause = waiting.pop()
        if id(cause) in seen:
            continue
        seen.add(id(cause))
        yield cause
        places = (cause.__cause__, cause.__context__, getattr(cause, "reason", None), *cause.args)
        waiting += [place for place in places if isinstance(place, BaseException)]


def _say_reason(causes: list[BaseException]) -> str:
    """Quote the system's or TLS's own words in brackets; never a library's, which may hold addresses."""
    for cause in causes:
        if isinstance(cause, ssl.SSLCertVerificationError):
            return f" ({cause.verify_message})"
        if isinstance(cause, ssl.SSLError):
            return f" ({(cause.reason or 'TLS error').replace('_', ' ').lower()})"
        if isinstance(cause, OSError) and cause.strerror and not isinstance(cause, requests.RequestException):
            return f" ({cause.strerror})"
    return ""
