"""A connection that tries again, waits only so long, and says in words what goes wrong."""

import io
import socket
import ssl
import time
from pathlib import Path

import pytest
import requests

from leaderboard.errors import LeaderboardError, SourceError
from leaderboard.reference.fetching.failures import explain_failure, show_url
from leaderboard.reference.fetching.sessions import Connection, Patience
from release_server import Fault, ReleaseServer

PATH, CONTENT = "/Mass.csv", b"a,b\n1,2\n"
AT = "http://127.0.0.1:[0-9]+"
OFFLINE = "offline? with a copy of the files: leaderboard reference import RECIPE --from PATH"
PROXY = "look at HTTPS_PROXY, HTTP_PROXY and NO_PROXY in the environment"
FREE_PORT_HOST = "127.0.0.1:1"  # nothing listens there


def ask(url: str, patience: Patience) -> bytes:
    """Ask for a file, and return its content."""
    with Connection(patience) as connection, connection.get(url, {}) as answer:
        assert answer.status_code == 200
        return answer.content


def refuse(url: str, patience: Patience) -> SourceError:
    """Ask for what cannot be had, and return what is said about it."""
    with pytest.raises(SourceError) as caught:
        ask(url, patience)
    return caught.value


@pytest.mark.parametrize(
    "fault",
    [
        Fault(status=503, times=5),
        Fault(status=500, times=1),
        Fault(status=429, retry_after="0", times=2),
        Fault(status=503, retry_after="3600", times=1),
        Fault(status=429, retry_after="Sat, 01 Jan 2000 00:00:00 GMT", times=1),
        Fault(status=429, retry_after="in a while", times=1),
        Fault(status=429, retry_after="9" * 5000, times=1),
        Fault(drops=True, times=5),
        Fault(redirect_to=PATH, times=5),
    ],
)
def test_passing_faults(patience: Patience, fault: Fault) -> None:
    """What passes within five more requests is never noticed."""
    with ReleaseServer({PATH: CONTENT}) as server:
        server.set_faults(PATH, fault)
        assert ask(server.url(PATH), patience) == CONTENT
        assert server.requests[PATH] == (fault.times or 0) + 1


def test_a_server_that_hangs_once() -> None:
    """After the timeout it is asked again."""
    with ReleaseServer({PATH: CONTENT}) as server:
        server.set_faults(PATH, Fault(hangs=True, times=1))
        assert ask(server.url(PATH), Patience(read=0.1, longest_wait=0)) == CONTENT


def test_waits_grow_up_to_a_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each wait is twice the one before; the server's wish counts instead, and the limit before all."""
    waits: list[float] = []
    monkeypatch.setattr(time, "sleep", waits.append)
    patience = Patience(longest_wait=3)
    with ReleaseServer({PATH: CONTENT}) as server:
        server.set_faults(PATH, Fault(status=503, times=5))
        ask(server.url(PATH), patience)
        assert waits == [1.0, 2.0, 3.0, 3.0]
        waits.clear()
        asked_for = [Fault(status=503, retry_after=seconds, times=1) for seconds in ("2", "3600")]
        server.set_faults(PATH, *asked_for)
        ask(server.url(PATH), patience)
        assert waits == [2, 3]


@pytest.mark.parametrize(
    ("fault", "message", "hint"),
    [
        (
            Fault(drops=True),
            "the connection is cut again and again",
            "run the command again: a download continues where it stopped",
        ),
        (
            Fault(redirect_to=PATH),
            "sends on from one address to the next without end",
            "have the files moved? with a copy of them: leaderboard reference import RECIPE --from PATH",
        ),
        (
            Fault(redirect_to="file:///etc/passwd"),
            "sends on to file:///etc/passwd, which is no http or https address",
            "have the files moved? with a copy of them: leaderboard reference import RECIPE --from PATH",
        ),
        (
            Fault(redirect_to="//[::1"),
            "sends on to a malformed address",
            "have the files moved? with a copy of them: leaderboard reference import RECIPE --from PATH",
        ),
    ],
)
def test_lasting_faults(patience: Patience, fault: Fault, message: str, hint: str) -> None:
    """What does not pass is said, with what to do about it."""
    with ReleaseServer({PATH: CONTENT}) as server:
        server.set_faults(PATH, fault)
        error = refuse(server.url(PATH), patience)
        assert (error.message, error.hint) == (f"{server.url(PATH)}: {message}", hint)


def test_a_server_that_hangs() -> None:
    """The wait has an end."""
    with ReleaseServer({PATH: CONTENT}) as server:
        server.set_faults(PATH, Fault(hangs=True))
        error = refuse(server.url(PATH), Patience(read=0.02, longest_wait=0))
    assert error.message.endswith("/Mass.csv: the server does not answer in time")
    assert error.hint.startswith("try again later")


def test_nobody_listens(patience: Patience) -> None:
    """It is asked whether one is offline."""
    error = refuse(f"http://me:secret@{FREE_PORT_HOST}/Mass.csv?key=secret", patience)
    assert error.message == "http://127.0.0.1:1/Mass.csv: the server cannot be reached (Connection refused)"
    assert error.hint == OFFLINE


def test_an_unknown_host(patience: Patience, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is asked whether one is offline."""

    def find_nothing(*_: object, **__: object) -> None:
        raise socket.gaierror(socket.EAI_NONAME, "Name or service not known")

    monkeypatch.setattr(socket, "getaddrinfo", find_nothing)
    error = refuse("https://example.com/Mass.csv", patience)
    assert error.message == "https://example.com/Mass.csv: its host is not found (Name or service not known)"
    assert error.hint == OFFLINE


def test_no_secure_connection(patience: Patience) -> None:
    """A server that does not speak TLS, or not with a known certificate, is not trusted."""
    with ReleaseServer({PATH: CONTENT}) as server:
        url = server.url(PATH).replace("http:", "https:")
        error = refuse(url, patience)
    assert error.message.startswith(f"{url}: no secure connection can be made (")
    assert error.hint.endswith("name its bundle in REQUESTS_CA_BUNDLE")


def test_an_unknown_certificate() -> None:
    """TLS's own words for it are quoted."""
    cause = ssl.SSLCertVerificationError(1, "verification failed")
    cause.verify_message = "self-signed certificate"
    error = explain_failure(requests.exceptions.SSLError(cause), "https://example.com/a")
    assert error.message.endswith("/a: no secure connection can be made (self-signed certificate)")


def test_a_missing_bundle(patience: Patience, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """The bundle of the environment is used, and named if it is not there."""
    monkeypatch.setenv("REQUESTS_CA_BUNDLE", str(tmp_path / "bundle.pem"))
    error = refuse("https://example.com/Mass.csv", patience)
    assert error.message.startswith(
        "https://example.com/Mass.csv: Could not find a suitable TLS CA certificate"
    )
    assert str(tmp_path / "bundle.pem") in error.message


def test_the_proxy_of_the_environment(patience: Patience, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is asked for files of any host, unless an exception is made for the host."""
    with ReleaseServer({PATH: CONTENT}) as server:
        monkeypatch.setenv("http_proxy", server.address)
        monkeypatch.setenv("no_proxy", "127.0.0.1")
        assert ask(f"http://example.com{PATH}", patience) == CONTENT
        monkeypatch.setenv("http_proxy", f"http://{FREE_PORT_HOST}")
        assert ask(server.url(PATH), patience) == CONTENT


@pytest.mark.parametrize(
    ("proxy", "message"),
    [
        (f"http://me:secret@{FREE_PORT_HOST}", "does not let it through (Connection refused)"),
        ("http://me:secret@:bad:port", "has an address that cannot be used"),
        ("ftp://me:secret@127.0.0.1", "has an address that cannot be used"),
    ],
)
@pytest.mark.parametrize("scheme", ["http", "https"])
def test_a_bad_proxy(
    patience: Patience, monkeypatch: pytest.MonkeyPatch, scheme: str, proxy: str, message: str
) -> None:
    """The environment's settings are named, never the password in them."""
    monkeypatch.setenv(f"{scheme}_proxy", proxy)
    error = refuse(f"{scheme}://example.com{PATH}", patience)
    assert error.message == f"{scheme}://example.com/Mass.csv: the proxy of the environment {message}"
    assert error.hint == PROXY


@pytest.mark.parametrize(
    "url", ["file:///etc/passwd", "ftp://example.com/a", "https:///a", "http://a b/", "a"]
)
def test_other_addresses(patience: Patience, url: str) -> None:
    """Only the web is asked."""
    assert refuse(url, patience).message == f"{url}: is no http or https address, and only these are fetched"


def test_a_malformed_address(patience: Patience) -> None:
    """What cannot be taken apart is not shown: it may hold a password anywhere."""
    assert refuse("https://[me:secret@x", patience).message == "the address of an official file is malformed"


@pytest.mark.parametrize(
    ("target", "is_followed"),
    [
        ("https://other.example.com/a", True),
        ("/elsewhere/a", True),
        ("http://example.com/a", False),
        ("HTTP://example.com/a", False),
    ],
)
def test_redirects_from_encrypted_connections(patience: Patience, target: str, is_followed: bool) -> None:
    """They lead to encrypted ones only."""
    answer = requests.Response()
    answer.status_code, answer.url, answer.raw = 302, "https://example.com/Mass.csv", io.BytesIO()
    answer.headers["Location"] = target
    with Connection(patience) as connection:
        session = connection._session
        if is_followed:
            assert session.get_redirect_target(answer) == target
            return
        with pytest.raises(SourceError, match="where the files could be changed on the way"):
            session.get_redirect_target(answer)


def test_other_failures() -> None:
    """What nobody thought of is named by its kind, without its words."""
    error = explain_failure(requests.RequestException("http://me:secret@example.com"), "http://example.com/a")
    assert error.message == "http://example.com/a: cannot be fetched (RequestException)"


def test_secrets_are_not_shown() -> None:
    """Neither names and passwords, nor signed queries, nor what would move a terminal's cursor."""
    assert show_url("https://me:secret@example.com:8443/a.zip?X=1#b") == "https://example.com:8443/a.zip"
    assert show_url("https://example.com/\x1b[2Ja") == "https://example.com/?[2Ja"
    with pytest.raises(LeaderboardError, match="the address of an official file is malformed"):
        show_url("https://[")
