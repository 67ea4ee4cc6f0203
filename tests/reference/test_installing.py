"""A reference is replaced as a whole: at every moment the old one is there, or the new one."""

import errno
import fcntl
import json
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path
from typing import Any

import pytest

from killed_installs import contents, snapshot
from leaderboard import files
from leaderboard.errors import BrokenReferenceError, InstanceError
from leaderboard.files import set_aside, sha256_hex
from leaderboard.instance import Instance, find_instance
from leaderboard.models import Source
from leaderboard.reference import load_reference
from leaderboard.reference.checking import check_reference
from leaderboard.reference.installing import STAGED, STAGING_PREFIX, install_reference
from leaderboard.reference.sealing import seal_reference

SOURCE = Source(what="everything", url="https://example.com/all.zip", sha256="0" * 64)
FILES = [
    "Alpha.csv",
    "Beta.csv",
    "benchmark.toml",
    "human_responses.csv",
    "human_trials.csv",
    "manifest.json",
]


def install(instance: Instance, title: str = "New") -> None:
    install_reference(instance, contents(title), "official", sources=[SOURCE])


@pytest.fixture
def instance(tmp_path: Path) -> Instance:
    """An instance with a reference in a folder of its own."""
    instance = Instance(tmp_path / "place/instance")
    install(instance, "Old")
    return instance


def title_of(instance: Instance) -> str:
    return load_reference(instance).benchmark.title


def leave_behind(folder: Path, title: str = "Half") -> Path:
    """Leave what a killed run leaves: a staged reference that is not sealed yet."""
    leftover = folder / f"{STAGING_PREFIX}x1y2z3"
    staged = Instance(leftover / STAGED)
    staged.reference_dir.mkdir(parents=True)
    for name, content in contents(title).items():
        staged.reference_file(name).write_bytes(content)
    return leftover


def test_a_new_instance_is_made_whole(tmp_path: Path) -> None:
    """Folders on the way are made; the reference is sealed, and the other two folders are empty."""
    instance = Instance(tmp_path / "deep/new")
    manifest = install_reference(instance, contents("New"), "synthetic", sources=[SOURCE])
    assert load_reference(instance).manifest == manifest
    assert (manifest.kind, manifest.sources) == ("synthetic", (SOURCE,))
    assert manifest.files["Alpha.csv"] == sha256_hex(contents("New")["Alpha.csv"])
    expected = {"reference", "site", "submissions", *(f"reference/{name}" for name in FILES)}
    assert snapshot(instance.root).keys() == expected
    assert sorted(path.name for path in instance.root.parent.iterdir()) == ["new"]


def test_a_folder_without_a_reference_keeps_what_it_has(tmp_path: Path) -> None:
    """An instance may be made in a folder that holds other things, such as a repository."""
    (tmp_path / "submissions").mkdir()
    (tmp_path / "submissions/notes.txt").write_text("mine")
    install(Instance(tmp_path))
    assert title_of(Instance(tmp_path)) == "New"
    assert (tmp_path / "submissions/notes.txt").read_text() == "mine"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["reference", "site", "submissions"]


def test_a_reference_is_replaced_as_a_whole(instance: Instance) -> None:
    """What is not among the new contents is gone, nothing temporary stays, and all else is untouched."""
    instance.reference_file("published.csv").write_text("old")
    instance.ledger_file.write_text("mine")
    install(instance)
    assert title_of(instance) == "New"
    assert sorted(path.name for path in instance.reference_dir.iterdir()) == FILES
    assert instance.ledger_file.read_text() == "mine"
    assert sorted(path.name for path in instance.root.iterdir()) == ["reference", "site", "submissions"]


def test_the_same_contents_give_the_same_bytes(instance: Instance) -> None:
    """Where it lies and what was there before make no difference."""
    install(instance, "New")
    other = Instance(instance.root.parent / "other")
    install(other, "New")
    assert snapshot(instance.root) == snapshot(other.root)


def test_readers_may_read_it_whoever_they_are(instance: Instance) -> None:
    """The permissions are those of folders and files made by hand, not those of temporary ones."""
    mask = os.umask(0o022)
    os.umask(mask)
    install(instance)
    assert instance.reference_dir.stat().st_mode & 0o777 == 0o777 & ~mask
    assert instance.benchmark_file.stat().st_mode & 0o777 == 0o644


def test_what_cannot_be_graded_against_is_not_installed(instance: Instance) -> None:
    """Sealing refuses it before anything is replaced, and the problem is named as that of the reference."""
    before = snapshot(instance.root.parent)
    broken = contents("New") | {"Alpha.csv": b"trial_id\n"}
    with pytest.raises(BrokenReferenceError, match=r"^reference/Alpha\.csv:1: "):
        install_reference(instance, broken, "official", sources=[])
    assert snapshot(instance.root.parent) == before


def test_an_unusable_first_reference_leaves_nothing(tmp_path: Path) -> None:
    """Not even the folder of the instance."""
    with pytest.raises(BrokenReferenceError, match=r"^reference/benchmark\.toml"):
        install_reference(Instance(tmp_path / "new"), {"benchmark.toml": b"="}, "official", sources=[])
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("kind", ["link", "dangling link", "file"])
def test_only_folders_are_replaced(tmp_path: Path, kind: str) -> None:
    """A link to a reference elsewhere stays a link."""
    instance = Instance(tmp_path)
    (tmp_path / "elsewhere").mkdir()
    make: dict[str, Callable[[], object]] = {
        "link": lambda: instance.reference_dir.symlink_to("elsewhere"),
        "dangling link": lambda: instance.reference_dir.symlink_to("nowhere"),
        "file": lambda: instance.reference_dir.write_text("mine"),
    }
    make[kind]()
    said = f"{instance.reference_dir}: is a link or a file, and only a folder can be replaced"
    with pytest.raises(InstanceError, match=f"^{re.escape(said)}$") as caught:
        install(instance)
    assert caught.value.hint == "put a folder in its place, or name another instance with --root DIR"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["elsewhere", "reference"]


class FullDisk:
    """Refuses the n-th thing that may take room on the disk, and nothing before or after it."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, moment: int) -> None:
        self._n_left = moment
        monkeypatch.setattr(os, "fsync", lambda _descriptor: None)
        for owner, name in (
            (os, "fsync"),
            (os, "rename"),
            (os, "replace"),
            (files, "_exchange"),
        ):
            monkeypatch.setattr(owner, name, self._limit(getattr(owner, name)))
        os_open, fdopen, mkdir = os.open, os.fdopen, os.mkdir

        def open_limited(path: Any, flags: int, *arguments: Any, **options: Any) -> Any:
            action = self._limit(os_open) if flags & os.O_CREAT else os_open
            return action(path, flags, *arguments, **options)

        def fdopen_limited(*arguments: Any, **options: Any) -> Any:
            stream = fdopen(*arguments, **options)
            stream.write = self._limit(stream.write)
            return stream

        def mkdir_limited(path: Any, *arguments: Any) -> None:
            action = mkdir if os.path.lexists(path) else self._limit(mkdir)
            action(path, *arguments)

        monkeypatch.setattr(os, "open", open_limited)
        monkeypatch.setattr(os, "fdopen", fdopen_limited)
        monkeypatch.setattr(os, "mkdir", mkdir_limited)

    def _limit(self, action: Callable[..., Any]) -> Callable[..., Any]:
        def limited(*arguments: Any, **options: Any) -> Any:
            self._n_left -= 1
            if self._n_left == -1:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            return action(*arguments, **options)

        return limited


def fill_disk(instance: Instance, monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[str, str]]:
    """Install with a disk that is full at each moment in turn, and yield what is said each time."""
    for moment in count():
        with monkeypatch.context() as patches:
            FullDisk(patches, moment)
            try:
                install(instance)
            except InstanceError as error:
                said = error.message, error.hint
            else:
                return
        yield said


def full(instance: Instance) -> tuple[str, str]:
    message = f"{instance.reference_dir}: cannot be written: No space left on device"
    return message, "it is as it was before"


def test_a_full_disk_leaves_the_old_reference(instance: Instance, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whenever it happens, every byte is as before, and nothing is left over."""
    before = snapshot(instance.root.parent)
    n_moments = 0
    for said in fill_disk(instance, monkeypatch):
        n_moments += 1
        assert said == full(instance)
        assert snapshot(instance.root.parent) == before
    assert n_moments > 30
    assert title_of(instance) == "New"


def test_a_full_disk_leaves_no_half_instance(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where nothing was, nothing is."""
    instance = Instance(tmp_path / "new")
    for said in fill_disk(instance, monkeypatch):
        assert said == full(instance)
        assert list(tmp_path.iterdir()) == []
    assert title_of(instance) == "New"


def test_a_full_disk_leaves_no_half_reference(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In a folder that was there, the two empty folders may be made already."""
    instance = Instance(tmp_path)
    for said in fill_disk(instance, monkeypatch):
        assert said == full(instance)
        assert snapshot(tmp_path).keys() <= {"submissions", "site"}
    assert title_of(instance) == "New"


ALL = ["instance", "reference", "site", "submissions"]
NO_GAP = {("Old", ""), ("New", "")}


@pytest.mark.parametrize(
    ("before", "found"),
    [
        ("replaced", NO_GAP),
        ("renamed", NO_GAP | {("none", "was gone since an import was killed, and is back now")}),
        ("bare", {("none", ""), ("New", "")}),
        ("new", {("none", ""), ("New", "")}),
    ],
)
def test_a_killed_install_leaves_one_reference_or_the_other(
    repo_root: Path, tmp_path: Path, before: str, found: set[tuple[str, str]]
) -> None:
    """Killed before any step, it leaves one to the last byte; a later one succeeds and leaves nothing over.

    ``renamed`` is a file system without exchanges of names: it has a moment without a reference, after which
    the next run puts the old one back. ``bare`` is a folder without a reference, ``new`` is none at all.
    """
    run = subprocess.run(
        [sys.executable, repo_root / "tests/killed_installs.py", tmp_path / "instance", before],
        env=os.environ | {"PYTHONPATH": str(repo_root), "OPENBLAS_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.stderr == ""
    records = [json.loads(line) for line in run.stdout.splitlines()]
    assert len(records) > 60
    assert {(record["found"], record["said"]) for record in records} == found
    assert {record["put back"] for record in records if record["said"]} <= {"Old"}
    assert [record["found"] for record in records] == sorted(
        (record["found"] for record in records), key=["Old", "none", "New"].index
    )
    assert records[-1]["found"] == "New"
    assert {record["later"] for record in records} == {"Old"}
    assert all(record["later names"] == ALL for record in records)
    assert {name for record in records for name in record["names"]} <= {*ALL, STAGING_PREFIX}


def test_leftovers_disturb_nothing(instance: Instance) -> None:
    """Neither finding the instance nor loading nor checking its reference sees them."""
    before = check_reference(instance).problems
    leave_behind(instance.root)
    assert find_instance(instance.submissions_dir) == instance
    assert title_of(instance) == "Old"
    assert check_reference(instance).problems == before
    assert instance.submission_dirs() == []


def test_leftovers_are_not_committed(repo_root: Path) -> None:
    """Git ignores them wherever they are."""
    names = [f"{STAGING_PREFIX}x1y2z3/{STAGED}/reference/Mass.csv", f"below/{STAGING_PREFIX}x1y2z3/file"]
    command = ["git", "check-ignore", *names]
    run = subprocess.run(command, cwd=repo_root, capture_output=True, text=True, check=False)
    assert run.stdout.splitlines() == names


@pytest.mark.parametrize("place", ["inside", "beside"])
def test_leftovers_of_killed_runs_are_removed(instance: Instance, place: str) -> None:
    """Those in the instance, and those beside it from when it was to be made."""
    leftover = leave_behind(instance.root if place == "inside" else instance.root.parent)
    install(instance)
    assert not leftover.exists()


def test_nothing_else_is_removed(instance: Instance) -> None:
    """Other temporary folders, files, links and what they lead to are none of ours."""
    others = [instance.root / ".tmp-other", instance.root / f"x{STAGING_PREFIX}", instance.root / "mine"]
    for folder in others:
        folder.mkdir()
    file, link = (instance.root / f"{STAGING_PREFIX}{name}" for name in ("file", "link"))
    file.write_text("mine")
    link.symlink_to("mine")
    install(instance)
    assert all(path.is_dir() for path in others)
    assert file.read_text() == "mine"
    assert link.is_symlink()


def test_the_folder_of_a_run_at_work_is_left_alone(instance: Instance) -> None:
    """Its lock tells that it is no leftover."""
    at_work = leave_behind(instance.root)
    descriptor = os.open(at_work, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        install(instance)
        assert at_work.exists()
    finally:
        os.close(descriptor)
    install(instance)
    assert not at_work.exists()


def test_two_runs_at_once_do_not_hinder_each_other(
    instance: Instance, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A run that begins and ends while another is at work leaves that one's folder alone; the last counts."""
    n_sealed = 0

    def seal_slowly(*arguments: Any, **options: Any) -> Any:
        nonlocal n_sealed
        n_sealed += 1
        if n_sealed == 1:
            install(instance, "Second")
            assert title_of(instance) == "Second"
        return seal_reference(*arguments, **options)

    monkeypatch.setattr("leaderboard.reference.installing.seal_reference", seal_slowly)
    install(instance, "First")
    assert title_of(instance) == "First"
    assert sorted(path.name for path in instance.root.iterdir()) == ["reference", "site", "submissions"]


def test_disks_without_locks_are_fine(instance: Instance, monkeypatch: pytest.MonkeyPatch) -> None:
    """There a leftover cannot be told from the folder of a run at work, and stays."""

    def refuse(_descriptor: int, _operation: int) -> None:
        raise OSError(errno.ENOLCK, os.strerror(errno.ENOLCK))

    monkeypatch.setattr(fcntl, "flock", refuse)
    leftover = leave_behind(instance.root)
    install(instance)
    assert title_of(instance) == "New"
    assert leftover.exists()


def test_a_reference_set_aside_is_put_back(instance: Instance) -> None:
    """The only copy is never taken for a leftover; the run stops, since it began as if there were none."""
    before = snapshot(instance.reference_dir)
    leftover = leave_behind(instance.root)
    instance.reference_dir.rename(set_aside(Instance(leftover / STAGED).reference_dir))
    said = f"{instance.reference_dir}: was gone since an import was killed, and is back now"
    with pytest.raises(InstanceError, match=f"^{re.escape(said)}$") as caught:
        install(instance)
    assert caught.value.hint == "start the command again"
    assert snapshot(instance.reference_dir) == before
    install(instance)
    assert title_of(instance) == "New"
    assert not leftover.exists()
