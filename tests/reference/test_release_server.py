"""The stand-in's web server is faithful where it should be, and goes wrong as ordered."""

import gzip
import os
from collections.abc import Iterator, Mapping
from email.utils import formatdate
from http.client import HTTPConnection, IncompleteRead, RemoteDisconnected
from pathlib import Path
from typing import NamedTuple

import pytest

from release_server import Fault, ReleaseServer

CONTENT = bytes(range(256)) * 4
PATH = "/test_data.zip"


class Got(NamedTuple):
    """An answer as it came."""

    status: int
    headers: Mapping[str, str]
    body: bytes


@pytest.fixture
def server() -> Iterator[ReleaseServer]:
    with ReleaseServer({PATH: CONTENT, "/human data.zip": b"people"}) as server:
        yield server


def get(server: ReleaseServer, path: str = PATH, *, method: str = "GET", **headers: str) -> Got:
    """Ask for a path with headers like ``If_Range``, on a connection of its own."""
    connection = HTTPConnection(server.address.removeprefix("http://"), timeout=10)
    try:
        connection.request(method, path, headers={k.replace("_", "-"): v for k, v in headers.items()})
        response = connection.getresponse()
        return Got(response.status, dict(response.headers.items()), response.read())
    finally:
        connection.close()


def test_a_whole_file(server: ReleaseServer) -> None:
    """Without a range it comes whole, with all that a client needs to ask for parts and to see changes."""
    status, headers, body = get(server)
    assert (status, body) == (200, CONTENT)
    assert headers["Content-Length"] == "1024"
    assert headers["Accept-Ranges"] == "bytes"
    assert headers["ETag"].startswith('"')
    assert headers["Last-Modified"] == "Wed, 01 Nov 2023 00:53:20 GMT"
    assert get(server).headers["ETag"] == headers["ETag"] != get(server, "/human%20data.zip").headers["ETag"]


@pytest.mark.parametrize(
    ("asked", "told", "body"),
    [
        ("bytes=0-0", "bytes 0-0/1024", CONTENT[:1]),
        ("bytes=5-260", "bytes 5-260/1024", CONTENT[5:261]),
        ("bytes=1000-", "bytes 1000-1023/1024", CONTENT[1000:]),
        ("bytes=1000-5000", "bytes 1000-1023/1024", CONTENT[1000:]),
        ("bytes=-3", "bytes 1021-1023/1024", CONTENT[-3:]),
        ("bytes=-5000", "bytes 0-1023/1024", CONTENT),
    ],
)
@pytest.mark.parametrize("is_file", [False, True])
def test_a_range(
    server: ReleaseServer, tmp_path: Path, asked: str, told: str, body: bytes, is_file: bool
) -> None:
    """Of bytes and of a file, a range comes as 206 with its place."""
    if is_file:
        server.files[PATH] = tmp_path / "file"
        (tmp_path / "file").write_bytes(CONTENT)
    got = get(server, Range=asked)
    assert (got.status, got.headers["Content-Range"], got.body) == (206, told, body)
    assert got.headers["Content-Length"] == str(len(body))
    assert server.bytes_sent[PATH] == len(body)


@pytest.mark.parametrize("asked", ["bytes=1024-", "bytes=5000-6000", "bytes=-0"])
def test_a_range_beyond_the_end(server: ReleaseServer, asked: str) -> None:
    """It is answered 416 with the size."""
    got = get(server, Range=asked)
    assert (got.status, got.headers["Content-Range"], got.body) == (416, "bytes */1024", b"")


@pytest.mark.parametrize("asked", ["bytes=5-4", "bytes=-", "bytes=0-1,4-5", "lines=0-1", "bytes=a-b"])
def test_a_range_that_is_none(server: ReleaseServer, asked: str) -> None:
    """What is malformed, or several ranges at once, is answered with the whole."""
    assert get(server, Range=asked)[::2] == (200, CONTENT)


def test_head(server: ReleaseServer) -> None:
    """The answer to HEAD is that to GET without the body."""
    whole, part = get(server, method="HEAD"), get(server, method="HEAD", Range="bytes=0-9")
    assert (whole.status, whole.headers["Content-Length"], whole.body) == (200, "1024", b"")
    assert (part.status, part.headers["Content-Length"], part.body) == (206, "10", b"")
    assert server.bytes_sent[PATH] == 0


def test_conditions(server: ReleaseServer) -> None:
    """If-Range, If-Match and If-None-Match compare with the ETag, If-Range with the date too."""
    headers = get(server).headers
    part, etag, date = "bytes=0-1", headers["ETag"], headers["Last-Modified"]
    assert get(server, Range=part, If_Range=etag).status == 206
    assert get(server, Range=part, If_Range=date).status == 206
    assert get(server, Range=part, If_Range='"other"').status == 200
    assert get(server, Range=part, If_Match=etag).status == 206
    assert get(server, Range=part, If_Match='"other"').status == 412
    assert get(server, If_None_Match=etag).status == 304


def test_a_changed_file(server: ReleaseServer, tmp_path: Path) -> None:
    """A file is read anew at each request, and its date and ETag follow it."""
    server.files[PATH] = file = tmp_path / "file"
    file.write_bytes(b"old")
    os.utime(file, (1_000_000_000, 1_000_000_000))
    before = get(server)
    file.write_bytes(b"new")
    after = get(server)
    assert (before.body, after.body) == (b"old", b"new")
    assert before.headers["Last-Modified"] == formatdate(1_000_000_000, usegmt=True)
    assert before.headers["ETag"] != after.headers["ETag"]


def test_what_came_in_is_recorded(server: ReleaseServer) -> None:
    """Requests are counted by path and kept with their headers, those for nothing too."""
    get(server, Range="bytes=0-9", User_Agent="test/1")
    get(server, PATH)
    assert get(server, "/nothing").status == 404
    assert server.requests == {PATH: 2, "/nothing": 1}
    assert server.bytes_sent == {PATH: 10 + 1024}
    assert [(seen.method, seen.path, seen.status) for seen in server.log] == [
        ("GET", PATH, 206),
        ("GET", PATH, 200),
        ("GET", "/nothing", 404),
    ]
    assert server.log[0].headers["User-Agent"] == "test/1"


def test_a_connection_is_kept() -> None:
    """Several requests go over one connection, until the server is closed."""
    with ReleaseServer({PATH: CONTENT}) as server:
        connection = HTTPConnection(server.address.removeprefix("http://"), timeout=10)
        for _ in range(2):
            connection.request("GET", PATH, headers={"Range": "bytes=0-1"})
            assert connection.getresponse().read() == CONTENT[:2]
            assert connection.sock is not None
    assert connection.sock.recv(1) == b""
    connection.close()


def test_it_answers_as_a_proxy(server: ReleaseServer) -> None:
    """A request for another host, as proxies get them, is answered by its path."""
    assert get(server, f"http://example.com{PATH}").body == CONTENT


def test_faults_befall_one_after_the_other(server: ReleaseServer) -> None:
    """Each takes its number of requests; then all is well, and other paths never notice."""
    server.set_faults(PATH, Fault(status=503, retry_after="0", times=2), Fault(status=429, times=1))
    got = [get(server) for _ in range(4)]
    assert [each.status for each in got] == [503, 503, 429, 200]
    assert [each.headers.get("Retry-After") for each in got] == ["0", "0", None, None]
    server.set_faults(PATH, Fault(status=500))
    assert [get(server).status for _ in range(3)] == [500, 500, 500]
    assert get(server, "/human%20data.zip").status == 200
    server.set_faults(PATH)
    assert get(server).status == 200


def test_redirects(server: ReleaseServer) -> None:
    """A path redirects to any other place, or to itself."""
    elsewhere = server.url("/human%20data.zip")
    server.set_faults(PATH, Fault(redirect_to=elsewhere, times=1), Fault(redirect_to=PATH))
    got = [get(server) for _ in range(3)]
    assert [each.status for each in got] == [302, 302, 302]
    assert [each.headers["Location"] for each in got] == [elsewhere, PATH, PATH]


def test_no_ranges(server: ReleaseServer) -> None:
    """Asked for a part, it gives the whole and announces nothing else."""
    server.set_faults(PATH, Fault(ignores_ranges=True))
    got = get(server, Range="bytes=0-1")
    assert (got.status, got.body) == (200, CONTENT)
    assert "Accept-Ranges" not in got.headers


def test_cut_connections(server: ReleaseServer) -> None:
    """The body ends early, at the byte that was ordered, or there is no answer at all."""
    server.set_faults(PATH, Fault(cut_after=100, times=1), Fault(drops=True, times=1))
    with pytest.raises(IncompleteRead) as cut:
        get(server)
    assert cut.value.partial == CONTENT[:100]
    with pytest.raises(RemoteDisconnected):
        get(server)
    assert get(server).body == CONTENT
    assert server.bytes_sent[PATH] == 100 + 1024
    assert [seen.status for seen in server.log] == [200, 0, 200]


def test_slow_transfers(server: ReleaseServer) -> None:
    """The body dribbles in and is complete in the end."""
    server.set_faults(PATH, Fault(chunk=256, pause=0.001))
    assert get(server).body == CONTENT


def test_hanging() -> None:
    """No answer comes, and closing the server ends the wait."""
    with ReleaseServer({PATH: CONTENT}) as server:
        server.set_faults(PATH, Fault(hangs=True))
        connection = HTTPConnection(server.address.removeprefix("http://"), timeout=0.02)
        connection.request("GET", PATH)
        with pytest.raises(TimeoutError):
            connection.getresponse()
        connection.close()


def test_changing_contents(server: ReleaseServer) -> None:
    """ETag and content change between requests, or a condition that held holds no more."""
    first = get(server).headers["ETag"]
    server.set_faults(PATH, Fault(changes=True))
    seen = {first, get(server).headers["ETag"], get(server).headers["ETag"]}
    assert len(seen) == 3
    assert get(server, Range="bytes=0-1", If_Range=first).status == 200
    server.set_faults(PATH, Fault(content=b"another", times=1), Fault(etag='"x"', times=1), Fault(etag=""))
    other = get(server)
    assert other.body == b"another"
    assert other.headers["ETag"] not in seen
    assert get(server).headers["ETag"] == '"x"'
    assert "ETag" not in get(server).headers


def test_wrong_lengths_and_places(server: ReleaseServer) -> None:
    """Content-Length and Content-Range lie as ordered while the bytes are right."""
    server.set_faults(PATH, Fault(length_off_by=5, times=1), Fault(length_off_by=-5, times=1))
    with pytest.raises(IncompleteRead):
        get(server)
    assert get(server).body == CONTENT[:-5]
    server.set_faults(PATH, Fault(range_off_by=10))
    got = get(server, Range="bytes=0-9")
    assert (got.headers["Content-Range"], got.body) == ("bytes 10-19/1024", CONTENT[:10])


def test_compressed_contents(server: ReleaseServer) -> None:
    """The whole comes compressed, whatever was asked for."""
    server.set_faults(PATH, Fault(is_gzipped=True))
    got = get(server, Range="bytes=0-1")
    assert (got.status, got.headers["Content-Encoding"]) == (200, "gzip")
    assert gzip.decompress(got.body) == CONTENT
