"""Whole files: the right bytes or none, nothing transferred twice, whatever happens on the way."""

import errno
import io
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
import requests
import urllib3

from leaderboard.errors import InstanceError, SourceError
from leaderboard.files import sha256_hex
from leaderboard.reference.fetching import Fetched, RemoteFile, downloads, sessions
from leaderboard.reference.fetching.answers import parse_whole, read_content
from leaderboard.reference.fetching.cache import Cache, CachedFile, open_cache
from leaderboard.reference.fetching.downloads import Download
from leaderboard.reference.fetching.failures import BrokenOffError
from leaderboard.reference.fetching.sessions import Connection, Patience
from release_server import Fault, ReleaseServer

Fetch = Callable[..., Fetched]
PATH = "/Mass.csv"
OLD, NEW = (bytes((place * step) % 251 for place in range(1500)) for step in (1, 7))
SHORTER = NEW[:1000]


@pytest.fixture
def server() -> Iterator[ReleaseServer]:
    with ReleaseServer({PATH: OLD}) as server:
        yield server


def take(fetch: Fetch, server: ReleaseServer, *, sha256: str = "", **options: object) -> bytes:
    """Fetch the file, and return its content."""
    fetched = fetch(RemoteFile("the list", server.url(PATH), sha256), **options)
    return fetched.files[0].content


def refuse(fetch: Fetch, server: ReleaseServer, **options: object) -> SourceError:
    """Fetch what cannot be had, and return what is said about it."""
    with pytest.raises(SourceError) as caught:
        take(fetch, server, **options)  # type: ignore[arg-type]
    return caught.value


def kept(tmp_path: Path) -> list[str]:
    """List what the cache holds beside its lock, by suffix."""
    return sorted(file.suffix for file in (tmp_path / "cache").iterdir() if file.name != "lock")


def conditions(server: ReleaseServer) -> list[dict[str, str]]:
    """List the headers of requests that make them conditional."""
    names = ("Range", "If-Range", "If-None-Match")
    return [{name: seen.headers[name] for name in names if name in seen.headers} for seen in server.log]


def test_a_whole_file(fetch: Fetch, server: ReleaseServer, tmp_path: Path) -> None:
    """It comes as it is, with what the server says of it, and stays in the cache."""
    fetched = fetch(RemoteFile("the list", server.url(PATH)))
    (file,), (source,) = fetched.files, fetched.sources
    assert (file.name, file.origin, file.content) == ("Mass.csv", server.url(PATH), OLD)
    assert (source.what, source.url, source.member) == ("the list", server.url(PATH), "")
    assert source.sha256 == sha256_hex(OLD)
    assert source.etag.startswith('"')
    assert source.last_modified == "Wed, 01 Nov 2023 00:53:20 GMT"
    assert fetched.n_bytes == len(OLD)
    assert kept(tmp_path) == ["", ".json"]
    assert server.log[0].headers["Accept-Encoding"] == "identity"


def test_an_unchanged_file(fetch: Fetch, server: ReleaseServer) -> None:
    """It is asked for again only if it is another version, and not transferred."""
    first = fetch(RemoteFile("the list", server.url(PATH)))
    second = fetch(RemoteFile("the list", server.url(PATH)))
    assert (second.files, second.sources, second.n_bytes) == (first.files, first.sources, 0)
    assert conditions(server) == [{}, {"If-None-Match": first.sources[0].etag}]
    assert server.log[1].status == 304


@pytest.mark.parametrize("content", [NEW, SHORTER, b""])
def test_a_changed_file(fetch: Fetch, server: ReleaseServer, content: bytes) -> None:
    """The new version is fetched in place of the old one."""
    take(fetch, server)
    server.files[PATH] = content
    assert take(fetch, server) == content
    assert take(fetch, server) == content


def test_a_damaged_cache(fetch: Fetch, server: ReleaseServer, tmp_path: Path) -> None:
    """Bytes that are not those that were fetched are fetched again, and so is what has no readable record."""
    take(fetch, server)
    (whole,) = (file for file in (tmp_path / "cache").iterdir() if len(file.name) == 64)
    whole.write_bytes(NEW)
    assert take(fetch, server) == OLD
    whole.with_suffix(".json").write_text('{"etag": 5}')
    assert take(fetch, server) == OLD
    assert server.bytes_sent[PATH] == 3 * len(OLD)


@pytest.mark.parametrize("offset", [*range(0, len(OLD), 23), 1, len(OLD) - 1])
def test_cut_anywhere(fetch: Fetch, server: ReleaseServer, offset: int) -> None:
    """Wherever the connection is cut, the rest is fetched and nothing twice."""
    server.set_faults(PATH, Fault(cut_after=offset, times=1))
    fetched = fetch(RemoteFile("the list", server.url(PATH)))
    assert fetched.files[0].content == OLD
    assert fetched.n_bytes == server.bytes_sent[PATH] == len(OLD)


@pytest.mark.parametrize("offset", range(0, len(OLD), 97))
@pytest.mark.parametrize("content", [OLD, NEW, SHORTER])
def test_cut_and_fetched_later(
    fetch: Fetch, server: ReleaseServer, patience: Patience, offset: int, content: bytes
) -> None:
    """Another run goes on where one was broken off, but never mixes versions."""
    server.set_faults(PATH, Fault(cut_after=offset, times=1))
    error = refuse(fetch, server, patience=Patience(retries=0))
    assert error.message == f"{server.url(PATH)}: the connection is cut again and again"
    server.files[PATH] = content
    assert take(fetch, server, patience=patience) == content
    if offset:
        assert conditions(server)[1]["Range"] == f"bytes={offset}-"


def test_cut_again_and_again(fetch: Fetch, server: ReleaseServer) -> None:
    """Patience has an end, and what has come by then counts in the next run."""
    server.set_faults(PATH, Fault(cut_after=200))
    error = refuse(fetch, server)
    assert error.message == f"{server.url(PATH)}: the connection is cut again and again"
    assert error.hint == "run the command again: a download continues where it stopped"
    assert take(fetch, server) == OLD
    assert server.bytes_sent[PATH] == len(OLD)


def test_cut_after_much_has_come(
    fetch: Fetch, server: ReleaseServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Interruptions count anew when enough has come since the last: large files may suffer many."""
    monkeypatch.setattr(sessions, "PROGRESS_SIZE", 100)
    server.set_faults(PATH, Fault(cut_after=100))
    assert take(fetch, server) == OLD
    assert server.requests[PATH] == 15


@pytest.mark.parametrize(("etag", "condition"), [('W/"1"', "date"), ("", "date"), ('"1"', "etag")])
def test_what_a_rest_is_asked_for_with(
    fetch: Fetch, server: ReleaseServer, etag: str, condition: str
) -> None:
    """A strong ETag or else the date makes sure that the rest is of the same version."""
    server.set_faults(PATH, Fault(etag=etag, cut_after=100, times=1), Fault(etag=etag))
    assert take(fetch, server) == OLD
    expected = etag if condition == "etag" else "Wed, 01 Nov 2023 00:53:20 GMT"
    assert conditions(server)[1] == {"Range": "bytes=100-", "If-Range": expected}


@pytest.mark.parametrize(
    "fault",
    [
        Fault(ignores_ranges=True),
        Fault(changes=True),
        Fault(status=503, times=2),
        Fault(drops=True, times=2),
        Fault(chunk=100, pause=0.0001),
        Fault(cut_after=0, times=2),
        Fault(redirect_to="/moved.csv", times=1),
    ],
)
def test_faults_that_do_not_matter(fetch: Fetch, server: ReleaseServer, fault: Fault) -> None:
    """The rest of a broken download comes in spite of them, if need be as the whole."""
    server.files["/moved.csv"] = OLD
    server.set_faults(PATH, Fault(cut_after=100, times=1), fault)
    assert take(fetch, server) == OLD


@pytest.mark.parametrize(
    ("faults", "message"),
    [
        ([Fault(status=404)], "is not there; the server answers 404 Not Found"),
        ([Fault(status=410)], "is not there any more; the server answers 410 Gone"),
        ([Fault(status=403)], "is not open to everyone; the server answers 403 Forbidden"),
        ([Fault(status=503)], "the server answers 503 Service Unavailable"),
        ([Fault(status=407)], "the server answers 407 Proxy Authentication Required"),
        ([Fault(status=299)], "the server answers 299"),
        ([Fault(is_gzipped=True)], "comes packed ('gzip') although it was asked for as it is"),
        (
            [Fault(length_off_by=5)],
            "the server contradicts itself: it has announced more than 1500 bytes, and now has no more",
        ),
        (
            [Fault(cut_after=100, times=1), Fault(range_off_by=10)],
            "the server contradicts itself: sends 1400 bytes as 'bytes 110-1509/1500'",
        ),
        (
            [Fault(cut_after=100, times=1), Fault(range_off_by=-10)],
            "the server contradicts itself: asked for the bytes from 100 on, it sends others",
        ),
        (
            [Fault(cut_after=100, times=1), Fault(length_off_by=3)],
            "the server contradicts itself: sends 1403 bytes as 'bytes 100-1499/1500'",
        ),
        (
            [Fault(cut_after=100, times=1), Fault(status=206)],
            "the server contradicts itself: sends a part without saying which (Content-Range '')",
        ),
        (
            [Fault(etag='"1"', cut_after=100, times=1), Fault(etag='"1"', content=SHORTER)],
            "changed while it was being fetched",
        ),
    ],
)
def test_faults_that_do(fetch: Fetch, server: ReleaseServer, faults: list[Fault], message: str) -> None:
    """They are said, and when they have passed another run succeeds."""
    server.set_faults(PATH, *faults)
    error = refuse(fetch, server)
    assert error.message == f"{server.url(PATH)}: {message}"
    assert error.hint
    server.set_faults(PATH)
    assert take(fetch, server) == OLD


def test_where_one_was_sent_on_to(fetch: Fetch, server: ReleaseServer) -> None:
    """It is named beside the address that was asked for, without its signature."""
    server.set_faults(PATH, Fault(redirect_to="/moved.csv?signature=secret"))
    error = refuse(fetch, server)
    moved = server.url("/moved.csv")
    assert error.message == (
        f"{server.url(PATH)} (which sends on to {moved}): is not there; the server answers 404 Not Found"
    )


def test_a_known_checksum(fetch: Fetch, server: ReleaseServer, tmp_path: Path) -> None:
    """Another content is refused, naming both, and nothing of it is kept."""
    known = sha256_hex(OLD)
    assert take(fetch, server, sha256=known) == OLD
    server.files[PATH] = NEW
    error = refuse(fetch, server, sha256=known)
    said = f"has the sha256 {sha256_hex(NEW)}, but the official file is known to have {known}"
    assert error.message == f"{server.url(PATH)}: {said}"
    assert kept(tmp_path) == []


def test_too_large_as_announced(server: ReleaseServer, patience: Patience, tmp_path: Path) -> None:
    """A file that is too large by its headers is refused before its content is read."""
    with Connection(patience) as connection:
        download = Download("the list", server.url(PATH), Cache(tmp_path).place(PATH), limit=1000)
        with pytest.raises(SourceError, match=r"Mass.csv: has 1.5 kB; at most 1.0 kB are fetched"):
            download.fetch(connection)
        assert connection.n_bytes == 0
        larger = Download("the list", server.url(PATH), Cache(tmp_path).place(PATH), limit=len(OLD))
        assert larger.fetch(connection).size == len(OLD)


def test_too_large_as_it_comes(patience: Patience) -> None:
    """A file of unannounced length is counted as it comes."""
    answer = make_answer(io.BytesIO(OLD))
    with Connection(patience) as connection, pytest.raises(SourceError, match="more than 100 bytes; at most"):
        list(read_content(answer, parse_whole(answer), connection, url="https://example.com/a", limit=100))


def test_too_short(patience: Patience) -> None:
    """Less than announced is an interruption, even if the library does not notice."""
    answer = make_answer(io.BytesIO(OLD), **{"Content-Length": "9999"})
    with Connection(patience) as connection, pytest.raises(BrokenOffError, match="1500 of 9999 bytes"):
        list(read_content(answer, parse_whole(answer), connection, url="https://example.com/a", limit=9999))


def make_answer(body: io.BytesIO, **headers: str) -> requests.Response:
    answer = requests.Response()
    answer.status_code = 200
    answer.headers.update(headers)
    answer.raw = urllib3.HTTPResponse(body, preload_content=False)
    return answer


class CrashError(Exception):
    """The end of the process, as far as a test can have one and go on."""


@pytest.mark.parametrize("n_steps", range(12))
@pytest.mark.parametrize("content", [OLD, NEW, SHORTER])
def test_killed_between_two_steps(
    fetch: Fetch, server: ReleaseServer, monkeypatch: pytest.MonkeyPatch, n_steps: int, content: bytes
) -> None:
    """Whatever is on disk when the process dies amid replacing a version, the next run is right."""
    take(fetch, server)
    server.files[PATH] = NEW
    server.set_faults(PATH, Fault(cut_after=700, times=1))
    left = [n_steps]

    def count(step: Callable[..., object]) -> Callable[..., object]:
        def counted(*arguments: object, **options: object) -> object:
            left[0] -= 1
            if left[0] < 0:
                raise CrashError
            return step(*arguments, **options)

        return counted

    with monkeypatch.context() as patch:
        for name in ("unlink", "rename"):
            patch.setattr(Path, name, count(getattr(Path, name)))
        patch.setattr(CachedFile, "_write_record", count(CachedFile._write_record))
        patch.setattr(downloads, "read_content", count(read_content))
        try:
            assert take(fetch, server) == NEW
        except CrashError:
            server.set_faults(PATH)
            server.files[PATH] = content
    assert take(fetch, server) == server.files[PATH]


def test_a_full_disk(fetch: Fetch, server: ReleaseServer, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is said, and when there is room again another run succeeds."""

    def fill_disk(*_: object, **__: object) -> Iterator[bytes]:
        yield OLD[:100]
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(downloads, "read_content", fill_disk)
        with pytest.raises(InstanceError, match="cache: No space left on device") as caught:
            take(fetch, server)
    assert (
        caught.value.hint == "is the disk full? another folder for downloads can be named by XDG_CACHE_HOME"
    )
    assert take(fetch, server) == OLD


def test_two_processes(fetch: Fetch, server: ReleaseServer, tmp_path: Path) -> None:
    """Only one uses the cache at a time; the other is told to wait."""
    with (
        open_cache(tmp_path / "cache"),
        pytest.raises(InstanceError, match="in use by another process") as caught,
    ):
        take(fetch, server)
    assert caught.value.hint == "wait until it is done"
    assert take(fetch, server) == OLD
