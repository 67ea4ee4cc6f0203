"""The campaigns of docs/security.md in short, and what they found."""

import datetime as dt
import errno
import fcntl
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchmarks.campaigns.mutations import VALID_RESULT, Entry, judge, lay, mutate, run
from benchmarks.campaigns.parsers import PARSERS, SEEDS
from benchmarks.campaigns.scenes import make_instance, prepare, read_files, submit_arguments
from leaderboard import files
from leaderboard.files import hold_folder, remove_leftovers, write_atomic, write_folder
from leaderboard.instance import Instance
from leaderboard.models.ledger import LedgerLine
from leaderboard.problems import Problems
from leaderboard.recording.regrading import explain_regrading
from leaderboard.submission import read_submission
from leaderboard.verifying import verify_instance

DAY = dt.date(2026, 5, 21)


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """Make an instance with one graded submission."""
    root = tmp_path / "instance"
    make_instance(root)
    prepare(root, submit_arguments(root, "first"))
    return root


def run_campaign(repo_root: Path, name: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run a campaign as `make campaign` does, but shorter."""
    return subprocess.run(
        [sys.executable, "-m", f"benchmarks.campaigns.{name}", *arguments],
        cwd=repo_root,
        capture_output=True,
        text=True,
        check=False,
    )


def test_every_branch_of_the_validator_is_taken(repo_root: Path) -> None:
    """By its own tests and the corpus, without help from those of other modules."""
    done = run_campaign(repo_root, "branches")
    assert done.returncode == 0, done.stdout[-2000:]


def test_mutated_submissions_are_judged() -> None:
    """Three hundred of them are graded or get problems, and there are some of both."""
    found = run(300)
    assert found.total() == 300
    assert found["problems"] > 30
    assert found["graded"] > 3


def test_the_mutations_know_the_valid_submission(tmp_path: Path) -> None:
    """A campaign that only ever met refusals would prove little."""
    entries = [
        Entry("predictions.csv", "file", SEEDS["predictions"][0]),
        Entry("submission.toml", "file", SEEDS["metadata"][0]),
        Entry("result.json", "file", VALID_RESULT),
    ]
    lay(tmp_path / "example", entries)
    assert judge(tmp_path / "example") == "graded"


@pytest.mark.parametrize("name", PARSERS)
def test_parsers_have_an_answer_to_any_bytes(name: str) -> None:
    """Whatever is changed in a valid input, the parser that atheris fuzzes keeps its promises."""

    @given(st.sampled_from(SEEDS[name]).flatmap(mutate))
    def parse(content: bytes) -> None:
        PARSERS[name](content)

    parse()


def test_killed_commands_tear_nothing(repo_root: Path) -> None:
    """After each of 24 kills every file is the old or the new one, and the next run mends the rest."""
    done = run_campaign(repo_root, "kills", "24")
    assert (done.returncode, done.stderr) == (0, "")
    rows = [line.split(" | ") for line in done.stdout.splitlines()[2:]]
    assert [(row[0], row[1], row[2]) for row in rows] == [
        ("| grade", "6", "0"),
        ("| submit", "6", "0"),
        ("| ledger update", "6", "0"),
        ("| baselines", "6", "0"),
    ]


def test_failing_calls_lose_nothing(repo_root: Path) -> None:
    """A full disk is told in plain words and leaves what was there."""
    if shutil.which("strace") is None:
        reason = "strace is not there: `make tracer` installs it"
        if os.environ.get("CI"):
            pytest.fail(f"{reason} (with CI set, calls must be made to fail)")
        pytest.skip(f"NO CALL IS MADE TO FAIL: {reason}")
    done = run_campaign(repo_root, "failing_calls", "--only", "submit", "--every", "8")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines()[-1].endswith(" | 8 | 0 |")


def test_without_strace_no_call_counts_as_made_to_fail(repo_root: Path, tmp_path: Path) -> None:
    """Where it is missing, nobody takes silence for success."""
    done = subprocess.run(
        [sys.executable, "-m", "benchmarks.campaigns.failing_calls", "--only", "submit"],
        cwd=repo_root,
        env=os.environ | {"PATH": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert "strace is not installed, so no call was made to fail" in done.stderr


def test_concurrent_writers_lose_nothing(repo_root: Path) -> None:
    """What a command said it had written is there, once, and in the ledger."""
    done = run_campaign(repo_root, "concurrent_writers", "4", "2")
    assert (done.returncode, done.stderr) == (0, "")
    assert "| submit | 8 | 0 |" in done.stdout
    assert "| contested | 2 | 6 |" in done.stdout
    assert "| lost, torn or unclear | 0 | |" in done.stdout


def test_fuzzing_without_atheris_says_so(repo_root: Path) -> None:
    """Where it is missing, nobody takes silence for success."""
    code = (
        "import sys; sys.modules['atheris'] = None; sys.argv = ['fuzzing'];"
        "import importlib.util; importlib.util.find_spec = lambda name: None;"
        "from benchmarks.campaigns.fuzzing import main; main()"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=repo_root, capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert "atheris is not installed, so nothing was fuzzed" in done.stderr


@pytest.mark.parametrize("odd", ["\x7f", "\u202e", "\n::error::x", "\U0001f600" * 400])
@pytest.mark.parametrize("place", ["scores", "low", "grader", "synthetic"])
def test_a_strange_result_is_told_in_one_line(place: str, odd: str) -> None:
    """Keys and values of a result that replaces a published one may be anything; messages stay printable."""
    published = SEEDS["result"][0]
    strange = published.replace(f'"{place}"'.encode(), json.dumps(f"{place}{odd}").encode())
    strange = strange.replace(b"0.75", json.dumps(odd).encode()).replace(b'"1.0"', json.dumps(odd).encode())
    for old, new in ((published, strange), (strange, published)):
        problems = Problems()
        reason = explain_regrading(old, new, "result.json", problems)
        if reason is not None:
            LedgerLine(date=DAY, slug="a-b-c", event="regraded", reason=reason, result_sha256="0" * 64)
        assert all(problem.message.isprintable() for problem in problems)
        assert problems.has_errors == (place != "synthetic")


def test_a_leftover_is_no_part_of_a_submission(root: Path) -> None:
    """A run that was killed while it wrote does not make the submission invalid; the next one tidies up."""
    before = read_files(root)
    folder = root / "submissions/first"
    (folder / ".tmp-x1").write_bytes(b"half")
    assert [file.name for file in read_submission(folder, "first").files] == [
        "predictions.csv",
        "result.json",
        "submission.toml",
    ]
    prepare(root, ("grade", str(folder)))
    assert not (folder / ".tmp-x1").exists()
    assert read_files(root) == before


def test_leftovers_among_submissions_are_removed(root: Path) -> None:
    """Half a folder and half a ledger disturb nobody, and go when something is written there."""
    leftovers = [root / "submissions/.tmp-folder/second", root / "submissions/.tmp-file"]
    for arguments in (submit_arguments(root, "second"), ("ledger", "update"), ("baselines",)):
        leftovers[0].mkdir(parents=True)
        (leftovers[0] / "result.json").write_bytes(b"half")
        leftovers[1].write_bytes(b"half")
        assert verify_instance(Instance(root), today=DAY).strays == ()
        prepare(root, arguments)
        assert list((root / "submissions").glob(".tmp-*")) == []


def test_what_is_being_written_is_no_leftover(tmp_path: Path) -> None:
    """A lock tells it; other files stay too."""
    at_work, folder, left = (tmp_path / f".tmp-{n}" for n in ("file", "folder", "left"))
    folder.mkdir()
    for path in (at_work, left, tmp_path / "mine", tmp_path / "x.tmp-y"):
        path.write_bytes(b"")
    (tmp_path / ".tmp-link").symlink_to(tmp_path / "mine")
    with hold_folder(folder):
        descriptor = os.open(at_work, os.O_RDONLY)
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        remove_leftovers(tmp_path)
        os.close(descriptor)
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        ".tmp-file",
        ".tmp-folder",
        ".tmp-link",
        "mine",
        "x.tmp-y",
    ]
    remove_leftovers(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == [".tmp-link", "mine", "x.tmp-y"]


def test_a_file_that_was_taken_for_a_leftover_is_made_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Between a file's making and its lock another run may remove it; the write succeeds all the same."""
    n_locked = 0

    def remove_first(_descriptor: int, _operation: int) -> None:
        nonlocal n_locked
        n_locked += 1
        if n_locked == 1:
            next(tmp_path.glob(".tmp-*")).unlink()

    monkeypatch.setattr(fcntl, "flock", remove_first)
    write_atomic(tmp_path / "file", b"new")
    assert n_locked == 2
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
    assert (tmp_path / "file").read_bytes() == b"new"


def test_a_disk_without_locks_is_written_to(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing can be told from a leftover there, so nothing is removed."""

    def refuse(_descriptor: int, _operation: int) -> None:
        raise OSError(errno.ENOLCK, os.strerror(errno.ENOLCK))

    monkeypatch.setattr(fcntl, "flock", refuse)
    (tmp_path / ".tmp-left").write_bytes(b"")
    with hold_folder(tmp_path):
        remove_leftovers(tmp_path)
        write_folder(tmp_path / "folder", {"a.txt": b"1"})
    assert sorted(path.name for path in tmp_path.iterdir()) == [".tmp-left", "folder"]


def test_a_folder_is_held_by_one(tmp_path: Path) -> None:
    """While one run holds it no other can, and nobody holds one that is not there."""
    descriptor = os.open(tmp_path, os.O_RDONLY)
    with hold_folder(tmp_path), pytest.raises(BlockingIOError):
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    os.close(descriptor)
    with hold_folder(tmp_path / "nowhere"):
        pass
    with pytest.raises(FileNotFoundError, match="inside"), hold_folder(tmp_path):
        raise FileNotFoundError("inside")


def test_who_comes_second_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where two make the same folder at once, one makes it whole and the other hears of it."""
    target = tmp_path / "same"
    write = files.write_atomic

    def write_late(path: Path, content: bytes) -> None:
        write(path, content)
        target.mkdir()
        (target / "a.txt").write_bytes(b"first")

    monkeypatch.setattr("leaderboard.files.write_atomic", write_late)
    with pytest.raises(FileExistsError, match="same exists: another run has just made it"):
        write_folder(target, {"a.txt": b"second"})
    assert (target / "a.txt").read_bytes() == b"first"
    assert [path.name for path in tmp_path.iterdir()] == ["same"]


def test_a_rename_that_fails_otherwise_is_told_as_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A full disk is not taken for another run."""

    def fail(_self: Path, _target: Path) -> Path:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(Path, "rename", fail)
    with pytest.raises(OSError, match="No space left"):
        write_folder(tmp_path / "folder", {})
    assert list(tmp_path.iterdir()) == []
