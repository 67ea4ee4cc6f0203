"""The repository's workflows as data, and their scripts run as a runner would run them."""

import os
import subprocess
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / ".github/workflows"
WORKFLOWS = sorted(FOLDER.glob("*.yml"))


@dataclass(frozen=True)
class Step:
    """A step of a job, with the variables that the job gives it."""

    job: str
    content: Mapping[str, Any]
    job_env: Mapping[str, str]

    @property
    def name(self) -> str:
        """What the log calls it."""
        return str(self.content.get("name", ""))

    @property
    def script(self) -> str | None:
        """What it runs, if it runs a script."""
        return self.content.get("run")


def load_workflow(file: Path) -> dict[str, Any]:
    """Read a workflow; YAML 1.1 takes its key `on` for a truth value, which is put right."""
    content: dict[Any, Any] = yaml.safe_load(file.read_text(encoding="utf-8"))
    content["on"] = content.pop(True)
    return content


def list_steps(file: Path, job: str | None = None) -> Iterator[Step]:
    """Yield the steps of a workflow, of all jobs or of one."""
    for name, body in load_workflow(file)["jobs"].items():
        if job in (None, name):
            yield from (Step(name, step, body.get("env", {})) for step in body["steps"])


@dataclass(frozen=True)
class Runner:
    """A machine to run scripts on: a folder to work in, and what GitHub's variables hold."""

    folder: Path
    variables: Mapping[str, str]

    @property
    def temporary(self) -> Path:
        """What RUNNER_TEMP names."""
        return self.folder / "temp"

    @property
    def summary(self) -> Path:
        """What GITHUB_STEP_SUMMARY names."""
        return self.folder / "summary.md"

    @property
    def output(self) -> Path:
        """What GITHUB_OUTPUT names."""
        return self.folder / "output"

    def run(self, step: Step, *, work_dir: Path | None = None) -> subprocess.CompletedProcess[str]:
        """Run the script of a step with the shell that the runner takes.

        Variables of the job and the step that the test does not give stay unset: expressions of the host
        are never evaluated here.
        """
        assert step.script is not None
        literal = {
            name: value
            for name, value in {**step.job_env, **step.content.get("env", {})}.items()
            if "${{" not in value
        }
        script = self.folder / "script.sh"
        script.write_text(step.script, encoding="utf-8")
        self.temporary.mkdir(exist_ok=True)
        return subprocess.run(
            ["bash", "--noprofile", "--norc", "-eo", "pipefail", str(script)],  # noqa: S607
            cwd=work_dir or self.folder,
            env={
                "PATH": os.environ["PATH"],
                "HOME": str(self.temporary),
                "RUNNER_TEMP": str(self.temporary),
                "GITHUB_STEP_SUMMARY": str(self.summary),
                "GITHUB_OUTPUT": str(self.output),
                "OPENBLAS_NUM_THREADS": "1",
                **literal,
                **self.variables,
            },
            capture_output=True,
            text=True,
            check=False,
        )
