"""The scripts of publish.yml that touch the ledger, run as they are; a bare repository is the host."""

import base64
import subprocess
import sys
from pathlib import Path

import pytest

from git_trees import GitTrees
from leaderboard.files import sha256_hex
from leaderboard.ledger import HEADER
from site_builders import write_instance
from workflow_files import FOLDER, Runner, Step, list_steps

ROOT = Path(__file__).resolve().parents[2]
FILE = FOLDER / "publish.yml"
HEAD_LINE = ",".join(HEADER) + "\n"
OLD = f"{HEAD_LINE}2026-01-02,first,added,new submission,{'1' * 64}\n"
NEW = f"2026-01-03,second,added,new submission,{'2' * 64}\n"


def find_step(name: str) -> Step:
    return next(step for step in list_steps(FILE) if step.name == name)


@pytest.fixture
def host(tmp_path: Path) -> GitTrees:
    git = GitTrees(tmp_path / "host.git")
    git.folder.mkdir()
    git.run("init", "-q", "--bare", "-b", "main")
    git.run("update-ref", "refs/heads/main", git.commit({"submissions/ledger.csv": OLD.encode()}))
    return git


def record(
    host: GitTrees, folder: Path, *, lines: str = NEW, **changes: str
) -> subprocess.CompletedProcess[str]:
    """Run the step that writes to the branch, with what the job before it found."""
    ledger = host.run("rev-parse", "main:submissions/ledger.csv").decode().strip()
    variables = {
        "REMOTE": f"file://{host.folder}",
        "LEDGER": ledger,
        "LINES": base64.b64encode(lines.encode()).decode(),
        "LEDGER_KEY": "a key",
        **changes,
    }
    folder.mkdir()
    return Runner(folder, variables).run(find_step("Commit the new lines"))


def read_ledger(host: GitTrees) -> str:
    return host.run("cat-file", "blob", "main:submissions/ledger.csv").decode()


def test_new_lines_are_appended_and_nothing_else(host: GitTrees, tmp_path: Path) -> None:
    """One commit on the branch, that changes one file at its end."""
    done = record(host, tmp_path / "machine")
    assert (done.returncode, done.stdout) == (0, ""), done.stderr
    assert read_ledger(host) == OLD + NEW
    assert host.run("rev-list", "--count", "main") == b"2\n"
    assert host.run("diff-tree", "--name-only", "-r", "main~1", "main") == b"submissions/ledger.csv\n"
    assert b"[skip ci]" in host.run("log", "-1", "--format=%B", "main")
    assert "a key" not in done.stdout + done.stderr


def test_a_ledger_that_changed_meanwhile_is_not_written(host: GitTrees, tmp_path: Path) -> None:
    """Lines belong to the ledger that they were found for."""
    done = record(host, tmp_path / "machine", LEDGER="0" * 40)
    assert done.returncode == 1
    assert done.stdout.startswith("::error::The ledger changed meanwhile")
    assert read_ledger(host) == OLD


def test_without_a_key_the_message_says_what_to_do(host: GitTrees, tmp_path: Path) -> None:
    """A fork of the repository has no key; a maintainer can write the lines by hand."""
    done = record(host, tmp_path / "machine", LEDGER_KEY="")
    assert done.returncode == 1
    assert "Run: leaderboard ledger update" in done.stdout
    assert read_ledger(host) == OLD


def test_the_key_is_forgotten(tmp_path: Path) -> None:
    """The last step removes it, whatever happened."""
    step = find_step("Forget the key")
    machine = Runner(tmp_path, {})
    machine.temporary.mkdir()
    (machine.temporary / "key").touch()
    assert machine.run(step).returncode == 0
    assert not (machine.temporary / "key").exists()
    assert step.content["if"] == "${{ always() }}"


@pytest.mark.parametrize("new", ["", NEW, NEW * 50], ids=len)
def test_lines_reach_the_next_job_whole(tmp_path: Path, new: str) -> None:
    """What `ledger update` appended is handed on, and nothing where it appended nothing."""
    git = GitTrees(tmp_path / "checkout")
    git.folder.mkdir()
    git.init()
    commit = git.commit({"submissions/ledger.csv": OLD.encode()})
    git.run("reset", "-q", "--hard", commit)
    machine = Runner(tmp_path, {})
    program = machine.temporary / "venv/bin/leaderboard"
    program.parent.mkdir(parents=True)
    script = f"import sys; sys.argv[2] == 'update' and open('submissions/ledger.csv', 'a').write({new!r})"
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -c "{script}" "$@"\n', encoding="utf-8")
    program.chmod(0o755)
    done = machine.run(find_step("Find the ledger's new lines"), work_dir=git.folder)
    assert done.returncode == 0, done.stderr
    found = dict(line.split("=", 1) for line in machine.output.read_text(encoding="utf-8").splitlines())
    assert found["ledger"] == git.run("rev-parse", f"{commit}:submissions/ledger.csv").decode().strip()
    assert base64.b64decode(found["lines"]).decode() == new


@pytest.fixture
def grader(tmp_path: Path) -> Runner:
    """A machine on which the grader is installed."""
    machine = Runner(tmp_path, {"GITHUB_SHA": "0123456789abcdef" * 2 + "01234567", "PYTHONPATH": str(ROOT)})
    program = machine.temporary / "venv/bin/leaderboard"
    program.parent.mkdir(parents=True)
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m leaderboard "$@"\n', encoding="utf-8")
    program.chmod(0o755)
    return machine


def test_what_is_deployed_is_what_is_attested(grader: Runner, tmp_path: Path) -> None:
    """The site of the very commit is built, and the digest that is signed is of its results."""
    instance = write_instance(tmp_path / "checkout")
    done = grader.run(find_step("Build the site"), work_dir=instance.root)
    assert done.returncode == 0, done.stderr
    assert (
        b"<dt>Commit</dt><dd><code>0123456789ab</code></dd>"
        in (instance.dist_dir / "index.html").read_bytes()
    )
    results = (instance.dist_dir / "api/leaderboard.json").read_bytes()
    assert grader.output.read_text(encoding="utf-8") == f"digest=sha256:{sha256_hex(results)}\n"


def test_a_result_that_is_not_what_grading_gives_stops_everything(grader: Runner, tmp_path: Path) -> None:
    """The scores that count are computed here, whatever was merged."""
    instance = write_instance(tmp_path / "checkout")
    step = find_step("Grade everything again")
    assert grader.run(step, work_dir=instance.root).returncode == 0
    file = instance.submission_dir("good") / "result.json"
    file.write_bytes(file.read_bytes().replace(b'"accuracy"', b'"accurate"', 1))
    done = grader.run(step, work_dir=instance.root)
    assert done.returncode == 1
    assert "submissions/good" in done.stdout + done.stderr
