"""``leaderboard submit --pr`` from a predictions file to an open pull request, and again."""

import datetime as dt
import os
import pty
import re
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from git_trees import GitTrees
from github_double import Fault
from github_stage import BRANCH, SECRET, UPSTREAM, Stage
from leaderboard.cli import group
from leaderboard.instance import Instance
from raw_submissions import predictions_csv

Send = Callable[..., Result]

FLAGS = {
    "name": "Example",
    "team": "Example Lab",
    "date": "2026-05-20",
    "description": "One or two sentences.",
    "training": "separate",
    "testing": "with_property",
    "family": "object-centric",
    "inputs": "rgb",
    "github": "someone",
}
ANSWERS = [value for name, value in FLAGS.items() if name != "date"]


@pytest.fixture
def root(tmp_path: Path, stage: Stage) -> Path:
    """A clone of the leaderboard, as git has it."""
    folder = tmp_path / "clone"
    subprocess.run(["git", "clone", "-q", stage.upstream.folder, folder], check=True)  # noqa: S607
    GitTrees(folder).run("remote", "set-url", "origin", f"git@github.com:{UPSTREAM}.git")
    return folder


@pytest.fixture
def predictions(tmp_path: Path, stage: Stage) -> Path:
    file = tmp_path / "mine.csv"
    file.write_text(predictions_csv(stage.material.reference))
    return file


@pytest.fixture
def send(root: Path, stage: Stage, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Send:
    """Run the command as who has the token; wherever it may have got, the token is looked for afterwards."""
    monkeypatch.setenv("GITHUB_TOKEN", SECRET)
    monkeypatch.setenv("GITHUB_API_URL", stage.github.api_url)

    def run(*arguments: object, exit_code: int = 0) -> Result:
        result = CliRunner().invoke(group, ["--root", str(root), "submit", *map(str, arguments)])
        assert result.exit_code == exit_code, result.output
        assert SECRET not in result.output
        files = [path for path in tmp_path.rglob("*") if path.is_file() and not path.is_symlink()]
        assert [path for path in files if SECRET.encode() in path.read_bytes()] == []
        assert SECRET not in repr(stage.hub.describe())
        assert [
            call for call in stage.github.calls if SECRET in str(call) or SECRET.encode() in call.content
        ] == []
        return result

    return run


def flags(**changes: str | None) -> list[str]:
    values = {**FLAGS, **changes}
    return [text for name, value in values.items() if value is not None for text in (f"--{name}", value)]


def test_one_command_makes_and_sends_it(
    send: Send, predictions: Path, root: Path, stage: Stage, tmp_path: Path
) -> None:
    """Scores, the folder, what goes where, each step, and the address of the pull request."""
    result = send(predictions, *flags(), "--pr")
    shown = result.stdout.splitlines()
    assert "wrote submissions/example/" in shown
    place = shown.index(f"sending to {UPSTREAM}, as one commit on a branch of yours, {BRANCH}:")
    assert [line.split()[0] for line in shown[place + 1 : place + 4]] == [
        f"submissions/example/{name}" for name in ("predictions.csv", "result.json", "submission.toml")
    ]
    assert shown[-2:] == [
        'with a pull request "Submit example"',
        "opened pull request #1: https://github.example/lab/board/pull/1",
    ]
    assert result.stderr.splitlines()[0] == "asking GitHub whose token it is"
    for name in ("predictions.csv", "result.json", "submission.toml"):
        sent = stage.fork.git("show", f"{BRANCH}:submissions/example/{name}")
        assert sent == (root / "submissions/example" / name).read_bytes()
    assert stage.judge(tmp_path / "judge").problems == ()


def test_the_same_command_goes_on(
    send: Send, predictions: Path, root: Path, stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Interrupted when the folder is written and something is sent, it is run again on another day."""
    stage.github.faults = [Fault("POST /repos/someone/board/git/trees", "drop", times=1)]
    result = send(predictions, *flags(date=None), "--pr", exit_code=1)
    assert result.stderr.splitlines()[-2:] == [
        "error: sending 3 files to someone/board: the connection was cut",
        "  run the command again: it goes on where it stopped",
    ]
    written = (root / "submissions/example/submission.toml").read_bytes()
    later = dt.datetime.now(dt.UTC).date() + dt.timedelta(days=1)
    monkeypatch.setattr("leaderboard.cli.submit.today", lambda: later)
    result = send(predictions, *flags(date=None), "--pr")
    assert "wrote submissions/example/" not in result.stdout
    assert result.stdout.splitlines()[-1].startswith("opened pull request #1: ")
    assert (root / "submissions/example/submission.toml").read_bytes() == written
    assert (
        send(predictions, *flags(date=None), "--pr")
        .stdout.splitlines()[-1]
        .startswith("pull request #1 is up to")
    )
    assert len(stage.hub.pulls) == 1


@pytest.mark.parametrize(
    "fault",
    [
        Fault("POST /repos/lab/board/forks", "stall", times=1),
        Fault("POST /repos/someone/board/git/trees", "hang", times=1),
        Fault("POST /repos/someone/board/git/refs", "stall", times=1),
        Fault("POST /repos/lab/board/pulls", "stall", times=1),
    ],
)
def test_a_killed_process_leaves_nothing_in_the_way(
    send: Send, predictions: Path, root: Path, stage: Stage, repo_root: Path, fault: Fault
) -> None:
    """Killed while it waits for an answer, it is run again: one branch, one pull request, no remains."""
    stage.github.faults = [fault]
    arguments = ["--root", str(root), "submit", str(predictions), *flags(), "--pr"]
    path = os.pathsep.join([str(repo_root), *sys.path])
    with subprocess.Popen(
        [sys.executable, "-m", "leaderboard", *arguments],
        env=os.environ | {"PYTHONPATH": path},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    ) as process:
        assert stage.github.is_silent.wait(60)
        process.kill()
    assert "pull request #1" in send(predictions, *flags(), "--pr").stdout.splitlines()[-1]
    assert len(stage.hub.pulls) == 1
    assert [path.name for path in sorted((root / "submissions").rglob("*"))] == [
        "example",
        "predictions.csv",
        "result.json",
        "submission.toml",
    ]


def test_the_branch_passes_the_check_on_pull_requests(
    send: Send, predictions: Path, root: Path, stage: Stage
) -> None:
    """Fetched from the host as git objects, it is judged by the command that the workflow runs."""
    send(predictions, *flags(), "--pr")
    git = GitTrees(root)
    git.run("fetch", "-q", stage.fork.folder.as_uri(), BRANCH)
    head = git.run("rev-parse", "FETCH_HEAD").decode().strip()
    arguments = ["--root", str(root), "check-changes", "origin/main", head, "--author", "someone"]
    judged = CliRunner().invoke(group, arguments)
    assert (judged.exit_code, judged.stdout) == (0, f"example at {head[:12]} may be merged\n")
    stranger = CliRunner().invoke(group, [*arguments[:-1], "stranger"])
    assert "change-contact" in stranger.stdout


@pytest.mark.parametrize("change", [{"team": "Another Lab"}, {"date": "2026-05-21"}])
def test_another_submission_of_the_name_is_refused(
    send: Send, predictions: Path, stage: Stage, change: dict[str, str]
) -> None:
    """Only the very same is gone on with; other metadata, or another date that was given, are another one."""
    send(predictions, *flags(), "--pr")
    n_calls = len(stage.lines())
    result = send(predictions, *flags(**change), "--pr", exit_code=1)
    assert "submissions/example: slug-taken: there is a submission example already" in result.stdout
    assert result.stderr == "nothing was sent\n"
    assert len(stage.lines()) == n_calls


def test_a_folder_with_broken_metadata_is_another_submission(
    send: Send, predictions: Path, stage: Stage, root: Path
) -> None:
    """It is not overwritten, and not sent."""
    toml = stage.material.write(root) / "submission.toml"
    toml.write_bytes(b"[submission\n\xff")
    assert "slug-taken" in send(predictions, *flags(), "--pr", exit_code=1).stdout
    assert toml.read_bytes() == b"[submission\n\xff"


def test_a_folder_is_sent_as_it_is(send: Send, stage: Stage, root: Path) -> None:
    """Made before, by this command or by hand; mended and graded, it is sent again."""
    folder = stage.material.write(root)
    assert send(folder, "--pr").stdout.splitlines()[-1].startswith("opened pull request #1")
    toml = folder / "submission.toml"
    toml.write_text(toml.read_text().replace("One or two", "Two"))
    assert send(folder, "--pr").stdout.splitlines()[-1].startswith("updated pull request #1")


def test_a_result_that_is_not_fresh_is_not_sent(send: Send, stage: Stage, root: Path) -> None:
    """It would be refused, so it is named here, with the command that mends it."""
    result_file = stage.material.write(root) / "result.json"
    result_file.write_text(result_file.read_text().replace('"answered": 12', '"answered": 11'))
    shown = send(root / "submissions/example", "--pr", exit_code=1).stderr.splitlines()
    assert shown == [
        "error: submissions/example/result.json: coverage.answered is 11, should be 12",
        "  leaderboard grade submissions/example",
    ]
    result_file.unlink()
    assert "leaderboard grade" in send(root / "submissions/example", "--pr", exit_code=1).stderr
    assert stage.lines() == []


def test_what_is_not_valid_is_not_sent(send: Send, stage: Stage, root: Path, tmp_path: Path) -> None:
    """Neither a file nor a folder: the problems are named, and nobody is asked."""
    bad = tmp_path / "bad.csv"
    bad.write_text("trial_id,probability\n")
    assert send(bad, *flags(), "--pr", exit_code=1).stderr == "nothing was sent\n"
    folder = stage.material.write(root)
    (folder / "predictions.csv").write_bytes(b"")
    assert "submissions/example/predictions.csv" in send(folder, "--pr", exit_code=1).stdout
    assert stage.lines() == []


def test_a_dry_run_writes_and_sends_nothing(send: Send, predictions: Path, stage: Stage, root: Path) -> None:
    """It shows the scores, what would go where, and the text of the pull request; it needs no token."""
    shown = send(predictions, *flags(), "--pr", "--dry-run").stdout
    assert "\nwould write submissions/example/\n" in shown
    assert f"\nwould send to {UPSTREAM}, as one commit on a branch of yours, {BRANCH}:\n" in shown
    assert "\n## Submission `example`\n" in shown
    assert stage.lines() == []
    assert not (root / "submissions").exists()
    assert "would send" not in send(predictions, *flags(), "--dry-run").stdout


def test_without_sending_nothing_of_the_network_is_loaded(predictions: Path, root: Path) -> None:
    """Neither making a submission nor a dry run pays for it."""
    arguments = ["--root", str(root), "submit", str(predictions), *flags(), "--pr", "--dry-run"]
    code = (
        "import sys, leaderboard.cli as cli\n"
        f"try: cli.group.main({arguments!r})\n"
        "except SystemExit as stop: assert not stop.code\n"
        "assert not {'requests', 'urllib3'} & set(sys.modules)"
    )
    subprocess.run(
        [sys.executable, "-c", code],
        check=True,
        capture_output=True,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
    )


def test_without_a_token_it_is_made_and_not_sent(
    send: Send, predictions: Path, root: Path, stage: Stage, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """What to do is said; then the same command goes on."""
    git = Path(subprocess.run(["which", "git"], capture_output=True, text=True, check=True).stdout.strip())  # noqa: S607
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/git").symlink_to(git)
    with monkeypatch.context() as patch:
        patch.delenv("GITHUB_TOKEN")
        patch.setenv("PATH", str(tmp_path / "bin"))
        shown = send(predictions, *flags(), "--pr", exit_code=1).stderr.splitlines()
    assert shown == [
        "error: no token for 127.0.0.1: neither GITHUB_TOKEN nor GH_TOKEN is set, and gh has none to give",
        "  run gh auth login, or put a classic token with the scope public_repo into GITHUB_TOKEN",
    ]
    assert (root / "submissions/example").is_dir()
    assert stage.lines() == []
    assert "opened pull request #1" in send(predictions, *flags(), "--pr").stdout


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["submissions/example"], "is made already: send it with --pr, or grade it with leaderboard grade"),
        (
            ["submissions/example", "mine.csv", "--pr"],
            "give prediction files, or with --pr one folder of submissions/",
        ),
        (["reference", "--pr"], "give prediction files, or with --pr one folder of submissions/"),
    ],
)
def test_folders_are_for_sending(
    send: Send, stage: Stage, root: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], said: str
) -> None:
    """One of submissions/, and only with --pr; else it is wrong usage."""
    stage.material.write(root)
    (root / "mine.csv").write_text("")
    monkeypatch.chdir(root)
    assert said in send(*arguments, exit_code=2).stderr


def test_the_guide_leads_to_a_pull_request_in_three_commands(
    stage: Stage, predictions: Path, repo_root: Path, tmp_path: Path
) -> None:
    """From an empty folder with a file, following docs/submitting.md to the letter, by hand at a terminal.

    The double stands for github.com; instead of pip, a program puts the package that is tested into place.
    """
    stage.hub.advance(stage.upstream, {"pyproject.toml": b"[project]\n"})
    guide = (repo_root / "docs/submitting.md").read_text()
    block = next(
        block
        for block in re.findall(r"^```sh\n(.*?)^```$", guide, re.MULTILINE | re.DOTALL)
        if "clone" in block
    )
    commands = block.replace("OWNER/REPOSITORY", UPSTREAM).splitlines()
    assert len(commands) <= 3
    empty, programs = tmp_path / "empty", tmp_path / "programs"
    empty.mkdir()
    (empty / "predictions.csv").write_bytes(predictions.read_bytes())
    _install_pip(programs)
    environment = {
        **os.environ,
        "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}",
        "PYTHONPATH": os.pathsep.join([str(repo_root), *sys.path]),
        "GITHUB_TOKEN": SECRET,
        "GITHUB_API_URL": stage.github.api_url,
        "GIT_CONFIG_COUNT": "1",
        "GIT_CONFIG_KEY_0": f"url.{stage.github.address}/.insteadOf",
        "GIT_CONFIG_VALUE_0": "https://github.com/",
    }
    outputs = [_type(command, ANSWERS, empty, environment) for command in commands]
    assert outputs[-1].splitlines()[-1] == "opened pull request #1: https://github.example/lab/board/pull/1"
    assert stage.judge(tmp_path / "judge", today=dt.datetime.now(dt.UTC).date()).problems == ()
    assert Instance(empty / "leaderboard").submission_dir("example").is_dir()


def _install_pip(folder: Path) -> None:
    """Put a pip into a folder that installs the program beside itself."""
    folder.mkdir()
    call = f'exec {shlex.quote(sys.executable)} -m leaderboard "$@"'
    (folder / "pip").write_text(
        "#!/bin/sh\n"
        '[ "$1" = install ] && [ -f "$2/pyproject.toml" ] || exit 1\n'
        f"printf '#!/bin/sh\\n%s\\n' {shlex.quote(call)} > {shlex.quote(str(folder / 'leaderboard'))}\n"
        f"chmod +x {shlex.quote(str(folder / 'leaderboard'))}\n"
    )
    (folder / "pip").chmod(0o755)


def _type(command: str, answers: list[str], folder: Path, environment: dict[str, str]) -> str:
    """Run a command whose input is a terminal at which somebody answers in advance."""
    keyboard, terminal = pty.openpty()
    os.write(keyboard, "".join(f"{answer}\n" for answer in answers).encode())
    try:
        done = subprocess.run(
            ["/bin/sh", "-c", command],
            cwd=folder,
            env=environment,
            stdin=terminal,
            capture_output=True,
            text=True,
            check=False,
        )
    finally:
        os.close(keyboard)
        os.close(terminal)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout
