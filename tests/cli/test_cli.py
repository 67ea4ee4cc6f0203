"""The command line as a whole: help, exit status, messages, and what it loads."""

import importlib
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from leaderboard import __version__
from leaderboard.cli import COMMANDS, group

HEAVY = {"pandas", "scipy", "sklearn", "jinja2", "rich", "requests"}


def _run(*arguments: str, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "leaderboard", *arguments]
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)


def test_help_names_every_command_with_the_help_of_its_module() -> None:
    """The list that help prints without importing anything is true."""
    output = CliRunner().invoke(group, ["--help"]).output
    for name, text in COMMANDS.items():
        command = importlib.import_module(f"leaderboard.cli.{name.replace('-', '_')}").command
        assert name in output
        assert command.name == name
        assert command.help.startswith(text.rstrip("."))


@pytest.mark.parametrize("name", list(COMMANDS))
def test_each_command_has_help(name: str) -> None:
    """Help of a command needs no instance."""
    result = CliRunner().invoke(group, [name, "-h"])
    assert result.exit_code == 0
    assert result.output.startswith(f"Usage: group {name}")


def test_version_is_that_of_the_package() -> None:
    """The version is printed with the program's name."""
    assert _run("--version").stdout == f"leaderboard {__version__}\n"


def test_an_unknown_command_is_wrong_usage() -> None:
    """Exit status 2 and the name of what is unknown."""
    result = _run("rnak")
    assert result.returncode == 2
    assert "No such command 'rnak'" in result.stderr


def test_outside_an_instance_the_message_helps(tmp_path: Path) -> None:
    """One line that says what is missing, one that says what to do, no traceback, exit status 1."""
    result = _run("rank", cwd=tmp_path)
    assert result.returncode == 1
    found = f"neither {tmp_path} nor a folder above it holds reference/benchmark.toml"
    assert result.stderr.splitlines() == [
        f"error: no leaderboard here: {found}",
        "  go to a leaderboard's folder or name it with --root DIR",
    ]


def test_a_root_without_a_reference_is_named(tmp_path: Path) -> None:
    """--root must point to an instance."""
    result = _run("--root", str(tmp_path), "verify")
    assert result.returncode == 1
    assert result.stderr == f"error: {tmp_path} is no leaderboard: it has no reference/benchmark.toml\n"


@pytest.mark.parametrize(
    ("arguments", "allowed"),
    [
        (["--help"], set()),
        (["validate", "submissions/example-slots"], {"numpy", "pydantic"}),
        (["grade", "--json", "--check", "submissions/example-slots"], {"numpy", "pydantic", "rich"}),
    ],
)
def test_a_command_loads_only_what_it_needs(arguments: list[str], allowed: set[str], repo_root: Path) -> None:
    """Start-up is a promise: no heavy library without need, and for help not even NumPy."""
    code = (
        "import sys, leaderboard.cli as cli\n"
        f"try: cli.group.main({arguments!r})\n"
        "except SystemExit as stop: assert not stop.code, stop.code\n"
        "print(*sorted({name.partition('.')[0] for name in sys.modules}), file=sys.stderr)"
    )
    command = [sys.executable, "-c", code]
    result = subprocess.run(command, cwd=repo_root, capture_output=True, text=True, check=True)
    loaded = set(result.stderr.splitlines()[-1].split())
    assert not loaded & ((HEAVY | {"numpy", "pydantic"}) - allowed)


def test_an_unreadable_file_is_one_line_and_no_traceback(tmp_path: Path) -> None:
    """What the system refuses is passed on with the file's name."""
    (tmp_path / "reference/benchmark.toml").mkdir(parents=True)
    result = _run("--root", str(tmp_path), "rank")
    assert result.returncode == 1
    assert "Traceback" not in result.stderr


def test_output_is_whole_when_it_goes_to_a_pipe(repo_root: Path) -> None:
    """The process ends early, but never before everything is written."""
    text = _run("rank", "--json", cwd=repo_root).stdout
    assert text.endswith("}\n")
    assert len(text) > 100_000


def test_a_full_disk_is_not_success(repo_root: Path) -> None:
    """If standard output cannot be written, the exit status says so."""
    command = [sys.executable, "-m", "leaderboard", "rank", "--json"]
    with Path("/dev/full").open("w") as full:
        result = subprocess.run(command, cwd=repo_root, stdout=full, stderr=subprocess.PIPE, check=False)
    assert result.returncode == 1
