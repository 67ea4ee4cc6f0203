"""Official files are found in folders and archives, and nothing else is."""

import errno
import os
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest
from remotezip import RemoteZip

from leaderboard.errors import SourceError
from leaderboard.files import sha256_hex
from leaderboard.reference.source_archives import LIMITS, Limits
from leaderboard.reference.source_files import SourceFile, read_members, read_source_files
from release_server import ReleaseServer
from source_zips import LISTED, is_csv, write_zip_file, zip_bytes


def write_folder(folder: Path, contents: dict[str, bytes]) -> Path:
    for name, content in contents.items():
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content)
    return folder


def read(*paths: Path, limits: Limits = LIMITS) -> dict[str, bytes]:
    files = read_source_files(paths, is_csv, limits=limits)
    assert [file.name for file in files] == sorted(file.name for file in files)
    return {file.name: file.content for file in files}


def origins(*paths: Path) -> list[str]:
    return [file.origin for file in read_source_files(paths, is_csv)]


def refusal(*paths: Path, limits: Limits = LIMITS) -> tuple[str, str]:
    with pytest.raises(SourceError) as caught:
        read_source_files(paths, is_csv, limits=limits)
    return caught.value.message, caught.value.hint


def test_a_folder_is_read_to_its_depths(tmp_path: Path) -> None:
    """Wanted files are named by their path below the folder, with the whole path as origin."""
    folder = write_folder(tmp_path / "official", LISTED | {"data/a.txt": b"", "b/c/d.csv": b"1"})
    files = read_source_files([folder], is_csv)
    assert files[0] == SourceFile("b/c/d.csv", f"{folder}/b/c/d.csv", b"1")
    assert files[0].sha256 == sha256_hex(b"1")
    assert [file.name for file in files] == ["b/c/d.csv", "data/Friction.csv", "data/Mass.csv"]


def test_a_zip_is_read_whatever_its_name(tmp_path: Path) -> None:
    """What the caller names is opened by what it is."""
    path = write_zip_file(tmp_path / "test_data.zip.part")
    assert read(path) == LISTED
    assert origins(path) == [f"{path}/data/Friction.csv", f"{path}/data/Mass.csv"]


def test_zips_in_a_folder_are_read_too(tmp_path: Path) -> None:
    """The maintainer downloaded the archives into a folder; those with nothing wanted are passed over."""
    write_zip_file(tmp_path / "downloads/deep/TEST.ZIP")
    write_zip_file(tmp_path / "downloads/videos.zip", {"a.mp4": b""})
    write_folder(tmp_path / "downloads", {"people.csv": b"1"})
    assert read(tmp_path / "downloads") == LISTED | {"people.csv": b"1"}
    assert origins(tmp_path / "downloads")[0] == f"{tmp_path}/downloads/deep/TEST.ZIP/data/Friction.csv"


def test_zips_in_zips_are_not_opened(tmp_path: Path) -> None:
    """One level is what a release has; more would be a way to hide bombs."""
    path = write_zip_file(tmp_path / "outer.zip", {"inner.zip": zip_bytes()})
    message, _ = refusal(path)
    assert message == f"{path}: holds no official file; among its files are 'inner.zip'"
    assert refusal(tmp_path)[0] == f"{tmp_path}: holds no official file; among its files are 'outer.zip'"


def test_several_sources_are_put_together(tmp_path: Path) -> None:
    """Trials come from one archive and people from another."""
    first = write_zip_file(tmp_path / "test.zip")
    second = write_zip_file(tmp_path / "human.zip", {"people.csv": b"1"})
    assert read(first, second) == read(second, first) == LISTED | {"people.csv": b"1"}


def test_no_sources_are_no_files() -> None:
    """Whoever names nothing gets nothing."""
    assert read() == {}


def test_junk_is_passed_over(tmp_path: Path) -> None:
    """Files and whole folders that operating systems leave are not looked at, zips among them neither."""
    junk = {"__MACOSX/Mass.csv": b"x", "._Mass.csv": b"x", "._test.zip": b"x", ".DS_Store": b"x"}
    assert read(write_folder(tmp_path, junk | LISTED)) == LISTED


@pytest.mark.parametrize("second", ["again.zip", "unpacked", "data"])
def test_equal_files_count_once(tmp_path: Path, second: str) -> None:
    """The same archive twice, or what was unpacked from it, or only the folder in it, adds nothing."""
    first = write_zip_file(tmp_path / "test.zip")
    write_zip_file(tmp_path / "again.zip")
    write_folder(tmp_path / "unpacked", LISTED)
    write_folder(tmp_path, LISTED)
    assert read(first, tmp_path / second) == LISTED
    assert len(read(tmp_path / second, first)) == len(LISTED)


def test_equal_files_beside_their_archive_count_once(tmp_path: Path) -> None:
    """Where the archive was unpacked into a folder of its own, the longer path tells of the same file."""
    write_zip_file(tmp_path / "test.zip")
    write_folder(tmp_path / "test", LISTED)
    assert len(read(tmp_path)) == len(LISTED)


def test_equal_files_of_other_names_stay_apart(tmp_path: Path) -> None:
    """Two people may have given the same answers: only name and content together make a copy."""
    write_folder(tmp_path, {"a/people.csv": b"1", "b/people.csv": b"1", "people.csv": b"1"})
    assert len(read(tmp_path)) == 3


def test_different_files_of_one_name_are_refused(tmp_path: Path) -> None:
    """Which counts is for a person to say; both are named."""
    first = write_zip_file(tmp_path / "test.zip")
    second = write_folder(tmp_path / "unpacked", LISTED | {"data/Mass.csv": b"edited"})
    message, hint = refusal(first, second)
    assert message == f"{first}/data/Mass.csv and {second}/data/Mass.csv have the same name and differ"
    assert hint == "keep the one that counts, and move the other away"


def test_names_that_differ_in_case_are_one_name(tmp_path: Path) -> None:
    """On other disks they would be the same file."""
    first = write_folder(tmp_path / "first", {"Mass.csv": b"1"})
    second = write_folder(tmp_path / "second", {"mass.csv": b"2"})
    assert refusal(first, second)[0].endswith(
        "/Mass.csv and " + f"{second}/mass.csv have the same name and differ"
    )


def test_the_named_path_may_be_a_link(tmp_path: Path) -> None:
    """It is the caller's own."""
    write_folder(tmp_path / "real", LISTED)
    (tmp_path / "folder").symlink_to("real")
    (tmp_path / "link.zip").symlink_to(write_zip_file(tmp_path / "real.zip"))
    assert read(tmp_path / "folder") == read(tmp_path / "link.zip") == LISTED


@pytest.mark.parametrize("name", ["secret.csv", "archive.zip"])
def test_links_inside_a_folder_are_refused_if_wanted(tmp_path: Path, name: str) -> None:
    """A link could lead anywhere; what it leads to can be named instead."""
    folder = write_folder(tmp_path / "official", LISTED)
    (folder / name).symlink_to(write_zip_file(tmp_path / "elsewhere"))
    message, hint = refusal(folder)
    assert message == f"{folder}/{name}: is a symbolic link, and only plain files are read"
    assert hint == "put the file itself there, or name what the link points to as another source"


def test_other_links_inside_a_folder_are_passed_over(tmp_path: Path) -> None:
    """Linked folders are not entered, and so links in a circle do no harm."""
    folder = write_folder(tmp_path / "official", LISTED)
    write_folder(tmp_path / "elsewhere", {"other.csv": b"1"})
    (folder / "elsewhere").symlink_to(tmp_path / "elsewhere")
    (folder / "circle").symlink_to(".")
    (folder / "notes.txt").symlink_to("nowhere")
    assert read(folder) == LISTED


def test_pipes_are_refused_if_wanted(tmp_path: Path) -> None:
    """A pipe would keep us waiting for ever."""
    folder = write_folder(tmp_path, LISTED)
    os.mkfifo(folder / "notes.txt")
    assert read(folder) == LISTED
    os.mkfifo(folder / "pipe.csv")
    assert refusal(folder)[0] == f"{folder}/pipe.csv: is a special file, and only plain files are read"


@pytest.mark.parametrize("name", ["data\\Mass.csv", "bad\nname.csv", "a\\test.zip"])
def test_odd_names_in_a_folder_are_refused_if_wanted(tmp_path: Path, name: str) -> None:
    """The rule for names is that for archives."""
    folder = write_folder(tmp_path, LISTED | {"fine\\.txt": b""})
    assert read(folder) == LISTED
    (folder / name).write_bytes(b"")
    message, hint = refusal(folder)
    assert message.startswith(f"{folder}: the name '")
    assert message.endswith(
        " holds " + ("backslashes" if "\\" in name else "characters that cannot be shown")
    )
    assert hint == "rename it, or move it out of the folder"


def make_pipe(path: Path) -> None:
    os.mkfifo(path)


def make_text(path: Path) -> None:
    path.write_text("trial_id")


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (make_pipe, "is neither a folder nor a zip archive"),
        (make_text, "is no zip archive, or a damaged one (File is not a zip file)"),
        (lambda path: path.mkdir(), "holds no official file; it is empty"),
        (lambda path: path.symlink_to("nowhere"), "cannot be read: No such file or directory"),
        (lambda path: path.symlink_to(path), "cannot be read: Too many levels of symbolic links"),
    ],
)
def test_other_paths_are_refused(tmp_path: Path, make: Callable[[Path], None], message: str) -> None:
    """The message says what was found where an archive or a folder should be."""
    path = tmp_path / "source"
    make(path)
    assert refusal(path)[0] == f"{path}: {message}"


def test_a_source_without_wanted_files_is_refused(tmp_path: Path) -> None:
    """Even if another has some: nobody names a folder for nothing. Some names tell what it is instead."""
    folder = write_folder(tmp_path / "photos", {f"{number}.jpg": b"" for number in range(5)})
    message, hint = refusal(write_zip_file(tmp_path / "test.zip"), folder)
    said = "holds no official file; among its files are '0.jpg', '1.jpg', '2.jpg' and 2 more"
    assert message == f"{folder}: {said}"
    assert hint == "is it the right folder or archive?"


def test_a_broken_zip_in_a_folder_is_refused(tmp_path: Path) -> None:
    """Half a download may lack just the lists."""
    write_folder(tmp_path, LISTED | {"test.zip": zip_bytes()[:-1]})
    message, hint = refusal(tmp_path)
    assert message == f"{tmp_path}/test.zip: is no zip archive, or a damaged one (File is not a zip file)"
    assert hint == "download it again, and compare its size with that at its source"


def test_limits_hold_for_folders(tmp_path: Path) -> None:
    """A file, all files together, and the number of names."""
    folder = write_folder(tmp_path, {"a.csv": b"12345", "b.csv": b"67890", "c.txt": b""})
    hint = "name a folder that holds the official files only"
    assert refusal(folder, limits=Limits(file_size=4)) == (
        f"{folder}/a.csv: has more than 4 bytes",
        "is it the right file?",
    )
    assert refusal(folder, limits=Limits(total_size=9)) == (
        f"with {folder}/b.csv there are more than 9 bytes of wanted files",
        hint,
    )
    assert refusal(folder, limits=Limits(n_names=2)) == (
        f"{folder}: holds more than 2 files and folders; no more are looked at",
        hint,
    )
    assert len(read(folder, limits=Limits(file_size=5, total_size=10, n_names=3))) == 2


def test_limits_hold_over_all_sources(tmp_path: Path) -> None:
    """Archives that are small enough each may be too much together."""
    first = write_zip_file(tmp_path / "first.zip")
    second = write_zip_file(tmp_path / "second.zip", {"people.csv": b"1"})
    message, _ = refusal(first, second, limits=Limits(total_size=32))
    assert message == f"with {second}/people.csv there are more than 32 bytes of wanted files"


def test_what_cannot_be_read_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Errors of the disk become one line."""

    def fail(path: Path, _limit: int) -> bytes:
        raise OSError(errno.EIO, os.strerror(errno.EIO), str(path))

    monkeypatch.setattr("leaderboard.reference.source_files.read_regular", fail)
    message, _ = refusal(write_folder(tmp_path, {"Mass.csv": b"1"}))
    assert message == f"{tmp_path}/Mass.csv: cannot be read: Input/output error"


def test_members_are_read_over_the_network(tmp_path: Path) -> None:
    """An archive that is fetched piece by piece gives the same files, at a request for each and one more."""
    noise = Random(0).randbytes(300_000)
    path = write_zip_file(tmp_path / "test.zip", {"1.bin": noise} | LISTED | {"2.bin": noise})
    with ReleaseServer({"/test.zip": path}) as server:
        with RemoteZip(server.url("/test.zip"), initial_buffer_size=1000) as archive:
            files = read_members(archive, "remote", is_csv)
        assert server.requests["/test.zip"] == 3
        assert server.bytes_sent["/test.zip"] < 5000
    assert [file.origin for file in files] == ["remote/data/Friction.csv", "remote/data/Mass.csv"]
    assert {file.name: file.content for file in files} == LISTED
