"""What must hold in every workflow, said here so that no release of a linter can forget it."""

import re
from pathlib import Path
from typing import Any

import pytest

from workflow_files import FOLDER, ROOT, WORKFLOWS, list_steps, load_workflow

PINNED = re.compile(r"[\w.-]+/[\w./-]+@[0-9a-f]{40}")
FORBIDDEN_TRIGGERS = {"pull_request_target", "workflow_run", "issue_comment", "discussion_comment", "issues"}

EACH = pytest.mark.parametrize("file", WORKFLOWS, ids=lambda file: file.stem)


def read_jobs(file: Path) -> dict[str, Any]:
    jobs: dict[str, Any] = load_workflow(file)["jobs"]
    return jobs


def test_the_workflows_are_there() -> None:
    """Three, so that the tests below look at what they mean."""
    assert [file.stem for file in WORKFLOWS] == ["check-submission", "ci", "publish"]


@EACH
def test_nothing_starts_with_rights_over_a_strangers_branch(file: Path) -> None:
    """No trigger runs with the repository's rights on what somebody else sent."""
    triggers = load_workflow(file)["on"]
    assert set(triggers) & FORBIDDEN_TRIGGERS == set()


@EACH
def test_rights_are_given_by_job(file: Path) -> None:
    """At the top there are none, and each job names its own."""
    assert load_workflow(file)["permissions"] == {}
    assert [name for name, job in read_jobs(file).items() if "permissions" not in job] == []


@EACH
def test_every_job_ends(file: Path) -> None:
    """Each has a time limit of at most an hour."""
    assert all(1 <= job["timeout-minutes"] <= 60 for job in read_jobs(file).values())


@EACH
def test_actions_are_pinned(file: Path) -> None:
    """Each is named by its commit, with the version in a comment."""
    uses = [str(step.content["uses"]) for step in list_steps(file) if "uses" in step.content]
    assert [name for name in uses if not PINNED.fullmatch(name)] == []
    lines = [line for line in file.read_text(encoding="utf-8").splitlines() if "uses:" in line]
    assert len(lines) == len(uses)
    assert [line for line in lines if not re.search(r"# v\d+\.\d+\.\d+$", line)] == []


@EACH
def test_scripts_hold_no_expressions(file: Path) -> None:
    """What the host knows reaches a script as a variable, never as part of its text."""
    assert [step.name for step in list_steps(file) if "${{" in (step.script or "")] == []


@EACH
def test_checkouts_leave_no_token(file: Path) -> None:
    """The token is not written where a later step could read it."""
    steps = [s.content for s in list_steps(file) if "actions/checkout@" in str(s.content.get("uses"))]
    assert all(step["with"]["persist-credentials"] is False for step in steps)


@EACH
def test_nothing_is_restored_from_a_cache(file: Path) -> None:
    """No cache, of an action of its own or of one that sets something up."""
    text = file.read_text(encoding="utf-8")
    assert "actions/cache" not in text
    assert not re.search(r"^\s*cache:", text, re.MULTILINE)


def test_checking_a_submission_takes_no_secret_and_may_only_read() -> None:
    """Neither a secret nor the token is named, and nothing is checked out by an action."""
    file = FOLDER / "check-submission.yml"
    text = file.read_text(encoding="utf-8")
    assert "secrets." not in text
    assert "github.token" not in text
    assert "actions/checkout" not in text
    assert [job["permissions"] for job in read_jobs(file).values()] == [{"contents": "read"}]
    assert load_workflow(file)["concurrency"]["cancel-in-progress"] is True


def test_only_deploying_may_write() -> None:
    """Pages and identity are the deploy job's, which runs no script; what runs the grader may only read."""
    file = FOLDER / "publish.yml"
    jobs = read_jobs(file)
    assert jobs["deploy"]["permissions"] == {
        "pages": "write",
        "id-token": "write",
        "attestations": "write",
    }
    assert (jobs["prove"]["permissions"], jobs["record"]["permissions"]) == ({"contents": "read"}, {})
    assert [step.name for step in list_steps(file, "deploy") if step.script] == []
    assert load_workflow(file)["concurrency"]["cancel-in-progress"] is False


def test_only_the_ledgers_key_is_a_secret() -> None:
    """One secret in all workflows, in one step, in an environment of its own."""
    named = {(f.stem, s) for f in WORKFLOWS for s in re.findall(r"secrets\.\w+", f.read_text("utf-8"))}
    assert named == {("publish", "secrets.LEDGER_KEY")}
    steps = [step for step in list_steps(FOLDER / "publish.yml") if "secrets." in str(step.content)]
    assert [(step.job, step.name) for step in steps] == [("record", "Commit the new lines")]
    assert read_jobs(FOLDER / "publish.yml")["record"]["environment"] == "ledger"


def test_owners_are_named_for_what_decides() -> None:
    """Engine, reference, workflows and ledger have owners; submissions have none."""
    lines = (ROOT / ".github/CODEOWNERS").read_text(encoding="utf-8").splitlines()
    owned = {line.split()[0] for line in lines if line and not line.startswith("#")}
    assert {"/.github/", "/leaderboard/", "/reference/", "/submissions/ledger.csv"} <= owned
    assert "/submissions/" not in owned
    assert [path for path in owned if not list(ROOT.glob(path.strip("/")))] == []
