"""Members of a large archive: the right bytes of one version, and hardly any others."""

import io
import random
import zipfile
from collections.abc import Callable, Iterator
from contextlib import suppress
from http import HTTPStatus
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from remotezip import RemoteZipError

from leaderboard.errors import SourceError
from leaderboard.reference.fetching import Fetched, RemoteArchive, remote_archives
from leaderboard.reference.fetching.remote_archives import TAIL, RemoteRanges, fetch_members, find_spans
from leaderboard.reference.fetching.sessions import Connection, Patience
from leaderboard.reference.source_files import SourceFile, read_members
from release_server import Content, Fault, ReleaseServer
from release_stand_in import SPARSE_SIZE, Release

Fetch = Callable[..., Fetched]
Members = dict[str, bytes]
PATH = "/test_data.zip"
FAST = Patience(connect=5, read=5, longest_wait=0)


def is_list(name: str) -> bool:
    return name.endswith(".csv")


def draw_bytes(n: int, seed: int = 0) -> bytes:
    return random.Random(seed).randbytes(n)


def pack(members: Members) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_STORED) as archive:
        for name, content in members.items():
            archive.writestr(zipfile.ZipInfo(name, (2023, 11, 1, 10, 0, 0)), content)
    return stream.getvalue()


# Two lists far from each other and from the directory, which is longer than what is read at first.
LISTS = {"Mass.csv": b"a,b\n" + draw_bytes(3000), "Friction.csv": b"c,d\n" + draw_bytes(2000, 1)}
FAR_APART = pack(
    {
        "first.mp4": draw_bytes(90_000),
        "Mass.csv": LISTS["Mass.csv"],
        "second.mp4": draw_bytes(90_000),
        "Friction.csv": LISTS["Friction.csv"],
        "third.mp4": draw_bytes(90_000),
        **{f"{number:0200d}.mp4": b"" for number in range(600)},
    }
)
SMALL = pack({"a.mp4": draw_bytes(50), "Mass.csv": b"a,b\n1,2\n"})


@pytest.fixture
def server() -> Iterator[ReleaseServer]:
    with ReleaseServer({PATH: FAR_APART}) as server:
        yield server


def take(fetch: Fetch, server: ReleaseServer, **options: object) -> Members:
    """Fetch the lists by ranges, and return their contents."""
    remote = RemoteArchive("the lists", server.url(PATH), is_list, is_large=True)
    return {file.name: file.content for file in fetch(remote, **options).files}


def refuse(fetch: Fetch, server: ReleaseServer) -> SourceError:
    """Fetch what cannot be had, and return what is said about it."""
    with pytest.raises(SourceError) as caught:
        take(fetch, server)
    return caught.value


def ranges_of(server: ReleaseServer) -> list[str]:
    return [seen.headers["Range"].removeprefix("bytes=") for seen in server.log]


def test_a_huge_archive(fetch: Fetch, tmp_path: Path) -> None:
    """Of gigabytes, the lists of the stand-in are fetched by three requests that bring kilobytes."""
    release = Release(pairs_per_scenario=2)
    test_zip, _ = release.write_zips(tmp_path, sparse_size=SPARSE_SIZE)
    with ReleaseServer({PATH: test_zip}) as server:
        found = take(fetch, server)
        assert server.requests[PATH] == 3
        assert server.bytes_sent[PATH] < 200_000
    assert {
        f"testdata_v1/{name}": content for name, content in release.list_files.items()
    }.items() <= found.items()


def test_what_is_asked_for(fetch: Fetch, server: ReleaseServer) -> None:
    """One byte, the end, the directory before it, and each list; all but the first in the same version."""
    assert take(fetch, server) == LISTS
    with zipfile.ZipFile(io.BytesIO(FAR_APART)) as archive:
        start, (mass, friction) = archive.start_dir, map(archive.getinfo, LISTS)
    first, tail, directory, *lists = ranges_of(server)
    size = len(FAR_APART)
    assert (first, tail) == ("0-0", f"{size - TAIL}-{size - 1}")
    assert directory.startswith(f"{start}-")
    assert lists == [
        f"{info.header_offset}-{info.header_offset + 30 + len(info.filename) + info.file_size - 1}"
        for info in (mass, friction)
    ]
    assert "If-Match" not in server.log[0].headers
    assert {seen.headers["If-Match"] for seen in server.log[1:]} == {fetch_etag(server)}


def fetch_etag(server: ReleaseServer) -> str:
    with Connection(FAST) as connection:
        return RemoteRanges(connection, server.url(PATH)).upstream.etag


@pytest.mark.parametrize("content", [FAR_APART, SMALL])
def test_the_same_as_on_disk(server: ReleaseServer, content: bytes) -> None:
    """Files are those that the archive on disk gives, under the archive's address."""
    server.files[PATH] = content
    found, upstream = fetch_from(server)
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        assert found == read_members(archive, server.url(PATH), is_list)
    assert upstream == fetch_etag(server)


def fetch_from(server: ReleaseServer) -> tuple[tuple[SourceFile, ...], str]:
    with Connection(FAST) as connection:
        files, upstream = fetch_members(
            connection, RemoteArchive("it", server.url(PATH), is_list, is_large=True)
        )
        return files, upstream.etag


@pytest.mark.parametrize("n_before", range(5))
@pytest.mark.parametrize("share", [0, 0.0005, 0.1, 0.5, 0.9, 0.999])
def test_cut_anywhere(fetch: Fetch, server: ReleaseServer, n_before: int, share: float) -> None:
    """Whichever request is cut, wherever: the rest is fetched, and nothing twice."""
    take(fetch, server)
    n_requests, n_bytes = server.requests[PATH], server.bytes_sent[PATH]
    lengths = [1, *(last - first + 1 for first, last in map(parse_span, ranges_of(server)[1:]))]
    cut = Fault(cut_after=int(share * lengths[n_before]), times=1)
    server.set_faults(PATH, *after(n_before), cut)
    assert take(fetch, server) == LISTS
    assert server.requests[PATH] == 2 * n_requests + (n_before > 0)  # of the first, the headers are enough
    assert server.bytes_sent[PATH] == 2 * n_bytes - (n_before == 0)


def parse_span(text: str) -> tuple[int, int]:
    first, _, last = text.partition("-")
    return int(first), int(last)


def after(n: int, etag: str | None = None) -> list[Fault]:
    """Let nothing go wrong before so many requests."""
    return [Fault(times=n, etag=etag)] if n else []


@pytest.mark.parametrize("offset", range(0, len(SMALL), 7))
def test_cut_anywhere_in_a_small_archive(fetch: Fetch, server: ReleaseServer, offset: int) -> None:
    """The same, byte by byte."""
    server.files[PATH] = SMALL
    server.set_faults(PATH, Fault(times=1), Fault(cut_after=offset, times=1))
    assert take(fetch, server) == {"Mass.csv": b"a,b\n1,2\n"}
    assert server.bytes_sent[PATH] == 1 + len(SMALL)


@pytest.mark.parametrize(
    "fault",
    [
        Fault(status=503, times=3),
        Fault(status=429, retry_after="0", times=3),
        Fault(drops=True, times=3),
        Fault(cut_after=0, times=3),
        Fault(chunk=30_000, pause=0.0001),
        Fault(redirect_to="/moved.zip", times=1),
        Fault(etag=""),
        Fault(etag='W/"1"'),
    ],
)
@pytest.mark.parametrize("n_before", [0, 3])
def test_faults_that_do_not_matter(fetch: Fetch, server: ReleaseServer, fault: Fault, n_before: int) -> None:
    """The lists come in spite of them."""
    server.files["/moved.zip"] = FAR_APART
    server.set_faults(PATH, *after(n_before, fault.etag), fault)
    assert take(fetch, server) == LISTS


@pytest.mark.parametrize("n_before", [1, 2, 3, 4])
@pytest.mark.parametrize(
    ("before", "fault"),
    [
        (Fault(), Fault(changes=True)),
        (Fault(), Fault(content=SMALL)),
        (Fault(etag='W/"1"'), Fault(etag='W/"2"')),
        (Fault(etag='"1"'), Fault(etag='"1"', content=FAR_APART + b"\0")),
        (Fault(etag=""), Fault(etag="", content=SMALL)),
        (Fault(), Fault(ignores_ranges=True)),
    ],
)
def test_a_change_in_the_middle(
    fetch: Fetch, server: ReleaseServer, before: Fault, fault: Fault, n_before: int
) -> None:
    """Parts of two versions are never put together; the next run has the new one."""
    server.set_faults(PATH, *after(n_before, before.etag), fault)
    error = refuse(fetch, server)
    assert error.message == f"{server.url(PATH)}: changed while it was being fetched"
    assert error.hint == "run the command again"
    server.set_faults(PATH)
    assert take(fetch, server) == LISTS


def test_no_ranges(fetch: Fetch, tmp_path: Path) -> None:
    """A server that sends only the whole is not made to, unless one asks for it knowing the cost."""
    test_zip, _ = Release(pairs_per_scenario=1).write_zips(tmp_path, sparse_size=SPARSE_SIZE)
    with ReleaseServer({PATH: test_zip}) as server:
        server.set_faults(PATH, Fault(ignores_ranges=True))
        error = refuse(fetch, server)
        assert error.message == f"{server.url(PATH)}: its server sends files only as a whole"
        assert error.hint == "--full-download takes all of it, 4.4 GB"
        assert server.requests[PATH] == 1
        server.files[PATH] = FAR_APART
        assert take(fetch, server, full_download=True) == LISTS


@pytest.mark.parametrize(
    ("faults", "message"),
    [
        ([Fault(status=404)], "is not there; the server answers 404 Not Found"),
        ([Fault(times=2), Fault(status=403)], "is not open to everyone; the server answers 403 Forbidden"),
        ([Fault(times=2), Fault(status=503)], "the server answers 503 Service Unavailable"),
        ([Fault(times=2), Fault(cut_after=0)], "the connection is cut again and again"),
        (
            [Fault(range_off_by=-10)],
            "the server contradicts itself: sends a part without saying which (Content-Range 'bytes -10--10/",
        ),
        (
            [Fault(times=1), Fault(range_off_by=-1)],
            "the server contradicts itself: asked for the bytes from",
        ),
        (
            [Fault(times=1), Fault(length_off_by=-1)],
            "the server contradicts itself: sends 131071 bytes as 'bytes",
        ),
        (
            [Fault(times=1), Fault(length_off_by=1)],
            "the server contradicts itself: sends 131073 bytes as 'bytes",
        ),
        ([Fault(content=b"")], f"the server answers 416 {HTTPStatus(416).phrase}"),  # Python 3.13 reworded it
        ([Fault(content=b"a")], "is no zip archive, or a damaged one"),
        ([Fault(content=draw_bytes(300_000))], "is no zip archive, or a damaged one"),
        ([Fault(content=pack({"a.mp4": b""}))], "holds no official file; among its files are 'a.mp4'"),
    ],
)
def test_faults_that_do(fetch: Fetch, server: ReleaseServer, faults: list[Fault], message: str) -> None:
    """They are said, and when they have passed another run succeeds."""
    server.set_faults(PATH, *faults)
    error = refuse(fetch, server)
    assert error.message.startswith(f"{server.url(PATH)}: {message}")
    assert error.hint
    server.set_faults(PATH)
    assert take(fetch, server) == LISTS


@given(data=st.data())
def test_damaged_archives(data: st.DataObject) -> None:
    """Whatever bytes are changed or missing, the lists are right or the archive is refused."""
    content = bytearray(SMALL)
    for place in data.draw(st.lists(st.integers(0, len(SMALL) - 1), min_size=1, max_size=8)):
        content[place] = data.draw(st.integers(0, 255))
    content = content[data.draw(st.integers(0, 20)) :][: data.draw(st.integers(1, len(SMALL)))]
    files: dict[str, Content] = {PATH: bytes(content) or b"\0"}
    with ReleaseServer(files) as server, suppress(SourceError):
        found, _ = fetch_from(server)
        assert {file.content for file in found} == {b"a,b\n1,2\n"}


def test_what_the_library_cannot_read(
    fetch: Fetch, server: ReleaseServer, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its own errors are a fault of the archive too."""

    def lose_place(*_: object) -> None:
        raise RemoteZipError("Position out of buffer bound")

    monkeypatch.setattr(remote_archives, "read_members", lose_place)
    error = refuse(fetch, server)
    message = f"{server.url(PATH)}: is a damaged zip archive (Position out of buffer bound)"
    assert (error.message, error.hint) == (message, "run the command again")


def test_an_archive_that_would_take_too_much(server: ReleaseServer) -> None:
    """No more is read than was planned, whatever the archive's directory says."""
    with Connection(FAST) as connection:
        ranges = RemoteRanges(connection, server.url(PATH))
        ranges.plan([(0, 2000)], 1000)
        with pytest.raises(SourceError, match=r"test_data.zip: 2.0 kB of it would have to be read"):
            ranges.read(0, 10)
        assert connection.n_bytes == 1  # the first, by which it was opened


def test_places_that_are_not_there(server: ReleaseServer) -> None:
    """They are a fault of the archive."""
    with Connection(FAST) as connection:
        ranges = RemoteRanges(connection, server.url(PATH))
        for start, end in [(-1, 5), (5, 5), (0, len(FAR_APART) + 1)]:
            with pytest.raises(zipfile.BadZipFile, match="places that it does not have"):
                ranges.read(start, end)


def test_close_members_are_read_at_once() -> None:
    """A gap of some kilobytes costs less than another request; what lies far apart is not read in between."""
    with zipfile.ZipFile(io.BytesIO(pack({"a.csv": b"1", "b.mp4": bytes(60_000), "c.csv": b"2"}))) as archive:
        wanted = [info for info in archive.infolist() if is_list(info.filename)]
        assert find_spans(archive, wanted) == [(0, archive.start_dir)]
    with zipfile.ZipFile(io.BytesIO(pack({"a.csv": b"1", "b.mp4": bytes(70_000), "c.csv": b"2"}))) as archive:
        wanted = [info for info in archive.infolist() if is_list(info.filename)]
        assert find_spans(archive, wanted[::-1]) == [
            (0, wanted[0].compress_size + 35),
            (wanted[1].header_offset, archive.start_dir),
        ]


def test_gaps_in_an_archive_are_not_read() -> None:
    """Where nothing follows a member for long, no more is read than it can have."""
    content = pack({"a.csv": b"1"})
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        (info,) = archive.infolist()
        archive.start_dir = 10_000_000
        ((start, end),) = find_spans(archive, [info])
        archive.start_dir = len(content)
    assert (start, end) == (0, 1 + 30 + 2 * 65_535 + 24)
