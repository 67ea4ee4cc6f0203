"""Official files from a server, each with where it came from."""

import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from leaderboard.errors import SourceError
from leaderboard.files import sha256_hex
from leaderboard.reference.fetching import Fetched, Remote, RemoteArchive, RemoteFile, compare_sources
from release_server import ReleaseServer
from release_stand_in import Release

Fetch = Callable[..., Fetched]
RELEASE = Release(pairs_per_scenario=2)
CSV = b"a,b\n1,2\n"


@pytest.fixture
def server(tmp_path: Path) -> Iterator[ReleaseServer]:
    test_zip, human_zip = RELEASE.write_zips(tmp_path / "release")
    with ReleaseServer({"/test_data.zip": test_zip, "/human_data.zip": human_zip, "/a b.csv": CSV}) as server:
        yield server


def is_table(name: str) -> bool:
    return name.endswith(".csv")


def make_remotes(server: ReleaseServer) -> list[Remote]:
    return [
        RemoteArchive("lists of test trials", server.url("/test_data.zip"), is_table, is_large=True),
        RemoteArchive("people's answers", server.url("/human_data.zip"), is_table, is_large=False),
        RemoteFile("another table", server.url("/a%20b.csv"), sha256_hex(CSV)),
    ]


def test_everything(fetch: Fetch, server: ReleaseServer) -> None:
    """Files come in the order in which they were asked for, members by name, each with its source."""
    fetched = fetch(*make_remotes(server))
    lists = sorted(f"testdata_v1/{name}" for name in RELEASE.list_files)
    people = sorted(f"human_data/{name}" for name in RELEASE.people_files)
    names = [file.name for file in fetched.files]
    assert [name for name in names if name in lists] == lists
    assert names[-1 - len(people) :] == [*people, "a b.csv"]
    for file, source in zip(fetched.files, fetched.sources, strict=True):
        assert source.sha256 == sha256_hex(file.content)
        assert file.origin.startswith(source.url)
        assert source.member == ("" if file.name == "a b.csv" else file.name)
        assert source.etag
        assert source.last_modified
    assert fetched.n_bytes == sum(server.bytes_sent.values())
    assert {source.what for source in fetched.sources} == {remote.what for remote in make_remotes(server)}


def test_all_ways_give_the_same(fetch: Fetch, server: ReleaseServer, tmp_path: Path) -> None:
    """By ranges, whole because it was asked for, and whole from the cache: equal files and sources."""
    remotes = make_remotes(server)
    by_ranges = fetch(*remotes, cache=tmp_path / "other")
    whole = fetch(*remotes, full_download=True)
    cached = fetch(*remotes, full_download=True)
    assert (whole.files, whole.sources) == (by_ranges.files, by_ranges.sources)
    assert (cached.files, cached.sources, cached.n_bytes) == (whole.files, whole.sources, 0)
    assert compare_sources(by_ranges.sources, whole.sources) == ()


def test_an_archive_of_known_checksum(fetch: Fetch, server: ReleaseServer, tmp_path: Path) -> None:
    """Whole it is held against the checksum; parts of it can prove none, so they are not fetched."""
    url, content = server.url("/test_data.zip"), (tmp_path / "release/test_data.zip").read_bytes()
    right = RemoteArchive("lists", url, is_table, is_large=True, sha256=sha256_hex(content))
    with pytest.raises(SourceError, match="has a checksum, which parts of it cannot prove"):
        fetch(right)
    assert server.requests["/test_data.zip"] == 0
    assert fetch(right, full_download=True).files
    wrong = RemoteArchive("lists", url, is_table, is_large=True, sha256="0" * 64)
    with pytest.raises(SourceError, match=f"has the sha256 {right.sha256}, but the official file is known"):
        fetch(wrong, full_download=True)


def test_a_changed_release(fetch: Fetch, server: ReleaseServer) -> None:
    """It is fetched, and the difference from what was locked is told by member."""
    locked = fetch(*make_remotes(server))
    server.files["/human_data.zip"] = Release(pairs_per_scenario=2, seed=1).write_zips(
        Path(str(server.files["/human_data.zip"])).parent / "new"
    )[1]
    changes = compare_sources(locked.sources, fetch(*make_remotes(server)).sources)
    assert {change.kind for change in changes} == {"content"}
    assert {change.after.what for change in changes if change.after} == {"people's answers"}


def test_logins_are_not_written_down(fetch: Fetch, server: ReleaseServer) -> None:
    """A name and password in an address reach neither messages nor sources."""
    url = server.url("/a%20b.csv")
    fetched = fetch(RemoteFile("a table", url.replace("//", "//me:secret@")))
    assert fetched.sources[0].url == fetched.files[0].origin == url
    assert server.log[0].headers["Authorization"].startswith("Basic ")


def test_a_whole_archive_that_is_none(fetch: Fetch, server: ReleaseServer) -> None:
    """It is named by its address, not by its place in the cache."""
    url = server.url("/a%20b.csv")
    with pytest.raises(SourceError) as caught:
        fetch(RemoteArchive("a table", url, is_table, is_large=False))
    assert caught.value.message.startswith(f"{url}: is no zip archive, or a damaged one")


class Recorder:
    """Writes down what it is told."""

    def __init__(self) -> None:
        self.told: list[tuple[str, int | None, int]] = []

    def start(self, what: str, total: int | None) -> None:
        self.told.append((what, total, 0))

    def advance(self, n_bytes: int) -> None:
        what, total, n_done = self.told[-1]
        self.told[-1] = (what, total, n_done + n_bytes)

    def finish(self) -> None:
        """Do nothing: the next transfer starts."""


def test_progress(fetch: Fetch, server: ReleaseServer) -> None:
    """Each transfer is followed from its beginning to its whole size."""
    recorder = Recorder()
    fetch(*make_remotes(server), progress=recorder, full_download=True)
    assert [what for what, *_ in recorder.told] == [remote.what for remote in make_remotes(server)]
    assert all(total == n_done for _, total, n_done in recorder.told)
    recorder.told.clear()
    fetch(make_remotes(server)[0], progress=recorder)
    assert [what for what, *_ in recorder.told] == ["lists of test trials: directory", "lists of test trials"]


def test_naming_files_is_light() -> None:
    """Whoever only says what to fetch, or compares, imports nothing that talks to the network."""
    code = (
        "import sys, leaderboard.reference.fetching;"
        "print(*sorted({'requests', 'urllib3', 'remotezip', 'platformdirs', 'rich'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.split() == []
