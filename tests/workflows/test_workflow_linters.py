"""Three linters find nothing in the workflows, and each finds what it is there for in a bad one."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from workflow_files import ROOT, WORKFLOWS

TOOLS = Path(sys.executable).parent
BAD = Path(__file__).parent / "bad"

ZIZMOR = ("zizmor", "--offline", "--no-progress", "--persona", "auditor", "--format", "plain")
JACTIONLINT = ("jactionlint", "--no-color", "--oneline")
SCHEMA = ("check-jsonschema", "--builtin-schema", "vendor.github-workflows")
DEPENDABOT = ("check-jsonschema", "--builtin-schema", "vendor.dependabot")


def lint(command: tuple[str, ...], *files: Path) -> tuple[int, str]:
    """Run a linter of the environment; jactionlint finds shellcheck there too."""
    path = f"{TOOLS}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        [TOOLS / command[0], *command[1:], *files],
        cwd=ROOT,
        env={**os.environ, "PATH": path, "NO_COLOR": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout + done.stderr


@pytest.mark.parametrize("command", [ZIZMOR, JACTIONLINT, SCHEMA], ids=lambda command: command[0])
def test_workflows_have_no_findings(command: tuple[str, ...]) -> None:
    """Not one, of whatever severity."""
    status, output = lint(command, *WORKFLOWS)
    assert status == 0, output


@pytest.mark.parametrize("command", [ZIZMOR, JACTIONLINT, DEPENDABOT], ids=lambda command: command[0])
def test_updates_of_dependencies_have_no_findings(command: tuple[str, ...]) -> None:
    """Neither does what proposes new versions."""
    status, output = lint(command, ROOT / ".github/dependabot.yml")
    assert status == 0, output


@pytest.mark.parametrize(
    ("command", "name", "findings"),
    [
        (ZIZMOR, "template_injection.yml", ["template-injection", "dangerous-triggers", "unpinned-uses"]),
        (ZIZMOR, "template_injection.yml", ["excessive-permissions", "artipacked"]),
        (JACTIONLINT, "unquoted_variable.yml", ["shellcheck", "SC2086", "undefined-job-needs"]),
        (JACTIONLINT, "template_injection.yml", ["template-injection", "missing-timeout"]),
        (SCHEMA, "unknown_key.yml", ["time-out", "is not valid"]),
    ],
    ids=lambda value: value[0] if isinstance(value, tuple) else None,
)
def test_linters_bite(command: tuple[str, ...], name: str, findings: list[str]) -> None:
    """A green linter means something: the same call names the faults of a bad workflow."""
    status, output = lint(command, BAD / name)
    assert status != 0
    assert [finding for finding in findings if finding not in output] == []
