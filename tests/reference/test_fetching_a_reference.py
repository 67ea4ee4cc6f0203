"""From a server to a sealed reference: the same as from disk, and nothing is replaced unasked."""

from dataclasses import replace
from pathlib import Path

import pytest

from leaderboard.errors import SourceError
from leaderboard.instance import Instance
from leaderboard.reference import load_reference
from leaderboard.reference.importing import FetchOptions, ImportReport, fetch_reference, import_reference
from leaderboard.reference.recipes import RECIPES
from leaderboard.reference.source_files import read_source_files
from release_server import Fault, ReleaseServer
from release_stand_in import SPARSE_SIZE, Release, Trap

PLUS = RECIPES["physionpp"]
SMALL = Release(pairs_per_scenario=4)


def serve(release: Release, folder: Path, *, sparse_size: int | None = None) -> ReleaseServer:
    test_zip, human_zip = release.write_zips(folder, sparse_size=sparse_size)
    return ReleaseServer({"/test_data.zip": test_zip, "/human_data.zip": human_zip})


def fetch(
    server: ReleaseServer, folder: Path, *, accept_change: bool = False, full_download: bool = False
) -> ImportReport:
    how = FetchOptions(server.address, full_download, cache=folder / "cache")
    return fetch_reference(PLUS, Instance(folder / "new"), how=how, accept_change=accept_change)


def digest_of(report: ImportReport) -> str:
    assert report.manifest is not None
    return report.manifest.digest


def test_fetching_gives_what_importing_gives(tmp_path: Path) -> None:
    """The same archives, by ranges, whole or from disk, give the same digest."""
    with serve(SMALL, tmp_path / "upstream") as server:
        fetched = fetch(server, tmp_path / "ranges")
        whole = fetch(server, tmp_path / "whole", full_download=True)
    files = read_source_files([tmp_path / "upstream"], PLUS.is_wanted)
    imported = import_reference(PLUS, files, Instance(tmp_path / "imported"))
    assert digest_of(fetched) == digest_of(whole) == digest_of(imported)


def test_sources_are_recorded(tmp_path: Path) -> None:
    """The manifest says of each list, and of people's files together, where they came from."""
    with serve(SMALL, tmp_path / "upstream") as server:
        manifest = fetch(server, tmp_path).manifest
        assert manifest is not None
        assert [source.member for source in manifest.sources] == [
            *sorted(f"testdata_v1/{name}" for name in SMALL.list_files),
            "*",
        ]
        urls = {source.url for source in manifest.sources}
        assert urls == {server.url("/test_data.zip"), server.url("/human_data.zip")}
    assert all(source.sha256 and source.etag and source.last_modified for source in manifest.sources)


def test_gigabytes_are_not_transferred(tmp_path: Path) -> None:
    """Of an archive of more than 4 GB less than 2 MB are sent."""
    with serve(SMALL, tmp_path / "upstream", sparse_size=SPARSE_SIZE) as server:
        assert fetch(server, tmp_path).manifest is not None
        assert (tmp_path / "upstream" / "test_data.zip").stat().st_size > 4_000_000_000
        assert server.bytes_sent["/test_data.zip"] < 2_000_000


def test_an_unchanged_upstream_changes_nothing(tmp_path: Path) -> None:
    """A second run finds the same, transfers the people's archive not again, and writes nothing."""
    with serve(SMALL, tmp_path / "upstream") as server:
        fetch(server, tmp_path)
        sent = server.bytes_sent["/human_data.zip"]
        report = fetch(server, tmp_path)
        assert server.bytes_sent["/human_data.zip"] == sent
    assert (report.manifest, report.is_refused, report.source_changes) == (None, False, ())


def test_a_changed_upstream_is_refused_until_accepted(tmp_path: Path) -> None:
    """Other labels and answers are shown, nothing is written, and only an explicit yes replaces them."""
    with serve(SMALL, tmp_path / "upstream") as server:
        before = digest_of(fetch(server, tmp_path))
    with serve(replace(SMALL, traps=[Trap.SAME_LABEL_PAIRS]), tmp_path / "later") as server:
        refused = fetch(server, tmp_path)
        assert refused.is_refused
        assert refused.difference is not None
        assert refused.difference.relabelled
        assert {change.kind for change in refused.source_changes} == {"content"}
        assert load_reference(Instance(tmp_path / "new")).manifest.digest == before
        accepted = fetch(server, tmp_path, accept_change=True)
    assert digest_of(accepted) == load_reference(Instance(tmp_path / "new")).manifest.digest != before


def test_other_bytes_of_the_same_trials_are_a_change_too(tmp_path: Path) -> None:
    """Files that changed upstream are told even where the reference made from them is the same."""
    with serve(SMALL, tmp_path / "upstream") as server:
        fetch(server, tmp_path)
    with serve(replace(SMALL, traps=[Trap.CRLF]), tmp_path / "later") as server:
        report = fetch(server, tmp_path)
    assert not report.difference
    assert report.is_refused
    assert {change.kind for change in report.source_changes} == {"content"}


def test_failures_leave_the_old_reference(tmp_path: Path) -> None:
    """Whatever the server does, what is there stays, and a later run succeeds."""
    with serve(SMALL, tmp_path / "upstream") as server:
        before = digest_of(fetch(server, tmp_path))
        server.set_faults("/test_data.zip", Fault(status=404))
        with pytest.raises(SourceError, match="404"):
            fetch(server, tmp_path)
        assert load_reference(Instance(tmp_path / "new")).manifest.digest == before
        server.set_faults("/test_data.zip")
        assert not fetch(server, tmp_path).is_refused


@pytest.mark.shared
def test_the_predecessor_is_the_same_fetched_or_imported(shared_dir: Path, tmp_path: Path) -> None:
    """Its nine files, served from the shared folder, give the digest that importing them gives."""
    recipe, folder = RECIPES["physion"], shared_dir / "data" / "physion-v1"
    files = {f"/{file.name}": file for file in [*folder.glob("*.csv"), *(folder / "humans").iterdir()]}
    with ReleaseServer(files) as server:
        how = FetchOptions(server.address, cache=tmp_path / "cache")
        fetched = fetch_reference(recipe, Instance(tmp_path / "fetched"), how=how)
    imported = import_reference(
        recipe, read_source_files([folder], recipe.is_wanted), Instance(tmp_path / "imported")
    )
    assert digest_of(fetched) == digest_of(imported)
    assert {problem.code for problem in fetched.problems if problem.code == "import-version"} == set()
