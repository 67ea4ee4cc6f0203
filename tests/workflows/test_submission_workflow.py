"""The scripts of check-submission.yml, run as they are against a bare repository in the host's place.

One step is not run: installing the grader, which needs a package index. In its place stands a program that
runs the grader of the checked-out base branch with the packages of the tests.
"""

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from git_trees import LINK, GitTrees, Tree
from leaderboard.assessing import assess
from leaderboard.cli.location import today
from leaderboard.grading import result_bytes
from leaderboard.instance import Instance
from leaderboard.reference import load_reference
from leaderboard.submission import RawFile, RawSubmission
from raw_submissions import SUBMISSION_TOML, predictions_csv
from reference_folders import ReferenceFolder
from workflow_files import FOLDER, ROOT, Runner, list_steps

INSTALL = "Install the base branch's grader"
FILE = FOLDER / "check-submission.yml"


@dataclass(frozen=True)
class Host:
    """The host's repository with a base branch, and a machine that checks what is sent to it."""

    git: GitTrees
    base: str
    base_files: Tree
    submission: Tree
    runner: Runner

    def send(self, files: Tree) -> str:
        """Commit what a branch holds beside the base's files, where the host keeps pull requests."""
        head = self.git.commit({**self.base_files, **files}, self.base)
        self.git.run("update-ref", "refs/pull/7/head", head)
        return head

    def check(self, head: str, *, author: str = "someone") -> subprocess.CompletedProcess[str]:
        """Run the workflow's scripts one after the other, until one fails."""
        machine = Runner(self.runner.folder, {**self.runner.variables, "HEAD_SHA": head, "AUTHOR": author})
        done = subprocess.CompletedProcess[str]([], 0, "", "")
        for step in list_steps(FILE):
            if step.name == INSTALL:
                install_grader(machine)
            elif step.script is not None:
                done = machine.run(step)
                if done.returncode:
                    break
        return done

    @property
    def summary(self) -> str:
        """What the job's page shows."""
        return self.runner.summary.read_text(encoding="utf-8")


def install_grader(machine: Runner) -> None:
    program = machine.temporary / "venv/bin/leaderboard"
    program.parent.mkdir(parents=True, exist_ok=True)
    # With its own folder first on the path, Python takes the engine that stands there: the base branch's.
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m leaderboard "$@"\n', encoding="utf-8")
    program.chmod(0o755)


def read_folder(folder: Path, prefix: str) -> dict[str, bytes]:
    return {
        f"{prefix}/{path.relative_to(folder).as_posix()}": path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and "__pycache__" not in path.parts
    }


def make_submission(instance: Instance) -> dict[str, bytes]:
    reference = load_reference(instance)
    files = {
        "submission.toml": SUBMISSION_TOML.encode(),
        "predictions.csv": predictions_csv(reference).encode(),
    }
    raw_files = tuple(RawFile(name, "file", len(data), data) for name, data in files.items())
    raw = RawSubmission("submissions/example", "example", raw_files)
    result = assess(raw, reference, today=today()).result
    assert result is not None
    files["result.json"] = result_bytes(result)
    return {f"submissions/example/{name}": data for name, data in files.items()}


@pytest.fixture
def host(tmp_path: Path) -> Host:
    instance = ReferenceFolder().write(tmp_path / "instance")
    store = tmp_path / "host/owner/repository"
    store.mkdir(parents=True)
    git = GitTrees(store)
    git.run("init", "-q", "--bare", "-b", "main")
    for name in ("allowFilter", "allowAnySHA1InWant"):  # as the host allows it
        git.run("config", f"uploadpack.{name}", "true")
    files = read_folder(instance.reference_dir, "reference") | read_folder(
        ROOT / "leaderboard", "leaderboard"
    )
    base = git.commit(files)
    git.run("update-ref", "refs/heads/main", base)
    folder = tmp_path / "machine"
    folder.mkdir()
    # A local path would be copied file by file; a URL goes through the same protocol as the host's.
    variables = {
        "REPOSITORY": f"file://{tmp_path}/host/owner/repository",
        "BASE_REF": "main",
        "GIT_CONFIG_GLOBAL": os.devnull,
    }
    return Host(git, base, files, make_submission(instance), Runner(folder, variables))


def test_every_step_but_one_is_run_here() -> None:
    """Besides the installation, whose commands are named, only uploading the verdict is left out."""
    steps = list(list_steps(FILE))
    assert [step.name for step in steps] == [
        "Check out the base branch",
        INSTALL,
        "Fetch the branch as git objects",
        "Judge it",
        "Keep the verdict",
    ]
    assert [step.name for step in steps if step.script is None] == ["Keep the verdict"]
    script = next(step.script for step in steps if step.name == INSTALL)
    assert script is not None
    assert "cd base" in script
    assert "--require-hashes --only-binary :all: -r requirements.lock" in script


def test_a_good_submission_passes_with_its_scores(host: Host) -> None:
    """Green, with a page that shows what grading gives, and a file for programs."""
    head = host.send(host.submission)
    done = host.check(head)
    assert (done.returncode, done.stdout) == (0, ""), done.stderr
    assert "## `example` may be merged" in host.summary
    assert f"Commit `{head[:12]}`" in host.summary
    assert "| overall | 12 |" in host.summary
    verdict = json.loads((host.runner.temporary / "verdict.json").read_text(encoding="utf-8"))
    assert (verdict["fine"], verdict["slug"], verdict["head"]) == (True, "example", head)
    assert verdict["result"]["submission"] == "example"


def test_a_branch_cannot_bring_its_own_grader(host: Host) -> None:
    """The engine and the reference of the branch are named as changes, and never used."""
    cheat = b"import pathlib\npathlib.Path('hacked').touch()\n"
    files = {**host.submission, "leaderboard/__init__.py": cheat, "reference/benchmark.toml": b"name = 1"}
    done = host.check(host.send(files))
    assert done.returncode == 1
    assert "::error file=leaderboard/__init__.py,title=change-outside::" in done.stdout
    assert "::error file=reference/benchmark.toml,title=change-outside::" in done.stdout
    assert list(host.runner.folder.rglob("hacked")) == []
    assert list(host.runner.folder.rglob("predictions.csv")) == []


def test_large_files_are_not_even_fetched(host: Host) -> None:
    """30 MB stay where they are, and the message says so."""
    noise = os.urandom(30_000_000)
    done = host.check(host.send({**host.submission, "submissions/example/predictions.csv": noise}))
    assert done.returncode == 1
    assert "is too large to have been fetched; the limit is 5,000,000" in done.stdout
    stored = sum(path.stat().st_size for path in host.runner.folder.rglob("*") if path.is_file())
    assert stored < 10_000_000


def test_links_are_refused(host: Host) -> None:
    """A link in the branch is no file here, wherever it points."""
    files = {**host.submission, "submissions/example/result.json": (LINK, b"/etc/passwd")}
    done = host.check(host.send(files))
    assert done.returncode == 1
    assert "not-a-plain-file" in done.stdout
    assert "root:" not in done.stdout + host.summary


@pytest.mark.parametrize("name", [".git", "..", ".GIT", "git~1"])
def test_trees_that_would_harm_a_checkout_are_not_taken_in(host: Host, name: str) -> None:
    """Git itself refuses to fetch them, so that the job fails before anything is judged."""
    done = host.check(host.send({**host.submission, f"submissions/example/{name}": b"x"}))
    assert done.returncode != 0
    assert "fsck error" in done.stderr
    assert not host.runner.summary.exists()


HOSTILE = [
    "a\n::error::x",
    "$(touch hacked)",
    "`touch hacked`",
    "-rf",
    "::stop-commands::x",
    "\x1b[2J",
    "\u202ex",
]


def test_names_of_files_command_nothing(host: Host) -> None:
    """Whatever files are called: nothing is run, no line of the log is their command, the page shows text."""
    done = host.check(host.send({**host.submission, **{f"submissions/example/{n}": b"x" for n in HOSTILE}}))
    assert done.returncode == 1
    lines = done.stdout.splitlines()
    assert [line for line in lines if not line.startswith("::error file=submissions/example/")] == []
    assert len(lines) == len(HOSTILE)
    assert all(line.isprintable() for line in [*lines, *host.summary.splitlines()])
    assert list(host.runner.folder.rglob("hacked")) == []


@pytest.mark.parametrize("author", ["", "$(touch hacked)", "--format=json", "x\n::error::y"])
def test_authors_command_nothing(host: Host, author: str) -> None:
    """A login is compared and shown, never run."""
    done = host.check(host.send(host.submission), author=author)
    assert done.returncode == 0, done.stderr
    assert [line for line in done.stdout.splitlines() if not line.startswith("::warning file=")] == []
    assert list(host.runner.folder.rglob("hacked")) == []


def test_a_branch_that_is_pushed_anew_is_judged_as_it_was(host: Host) -> None:
    """The commit that was asked for is judged, not what the branch holds by then."""
    head = host.send(host.submission)
    host.send({**host.submission, "submissions/other/predictions.csv": b"x"})
    assert host.check(head).returncode == 0
    assert head[:12] in host.summary
