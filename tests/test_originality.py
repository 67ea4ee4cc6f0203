"""Whose submissions a new one is compared with."""

import datetime as dt
import shutil
from pathlib import Path

import pytest

from leaderboard.instance import Instance
from leaderboard.originality import load_others
from leaderboard.reference import Reference, load_reference
from leaderboard.submission import read_submission
from leaderboard.validation import validate

TODAY = dt.date(2026, 11, 21)


@pytest.fixture
def instance(tmp_path: Path, repo_root: Path) -> Instance:
    """Copy the embedded reference, a baseline and two systems of one team."""
    shutil.copytree(repo_root / "reference", tmp_path / "reference")
    for slug in ("baseline-chance", "example-slots", "example-particles"):
        shutil.copytree(repo_root / "submissions" / slug, tmp_path / "submissions" / slug)
    return Instance(tmp_path)


def _others(instance: Instance, slug: str, reference: Reference) -> list[str | None]:
    raw = read_submission(instance.submission_dir(slug), slug)
    return [other.slug for other in load_others(instance, raw, reference, today=TODAY)]


def _rename_team(instance: Instance, slug: str) -> None:
    file = instance.submission_dir(slug) / "submission.toml"
    file.write_text(file.read_text().replace("Physion++ examples", "Other Lab"))


def test_a_team_and_baselines_are_not_compared_with(instance: Instance) -> None:
    """Only another team's systems are loaded."""
    reference = load_reference(instance)
    assert _others(instance, "example-slots", reference) == []
    _rename_team(instance, "example-particles")
    assert _others(instance, "example-slots", reference) == ["example-particles"]


def test_a_teams_name_is_not_enough(instance: Instance) -> None:
    """Whoever writes another team's name under a copy is still compared with that team."""
    file = instance.submission_dir("example-particles") / "submission.toml"
    text = file.read_text()
    assert "github = " in text
    file.write_text(text.replace('github = "', 'github = "not-'))
    assert _others(instance, "example-slots", load_reference(instance)) == ["example-particles"]


def test_an_invalid_submission_is_skipped(instance: Instance) -> None:
    """What cannot be read does not stop the judgement of another."""
    _rename_team(instance, "example-particles")
    (instance.submission_dir("example-particles") / "predictions.csv").write_text("nonsense")
    assert _others(instance, "example-slots", load_reference(instance)) == []


def test_a_copy_of_another_team_is_warned_of(instance: Instance) -> None:
    """The same file under another name is found and named."""
    shutil.copytree(instance.submission_dir("example-slots"), instance.submission_dir("my-model"))
    _rename_team(instance, "my-model")
    reference = load_reference(instance)
    raw = read_submission(instance.submission_dir("my-model"), "submissions/my-model")
    others = load_others(instance, raw, reference, today=TODAY)
    problems = validate(raw, reference, today=TODAY, others=others).problems
    assert [(p.code, p.message) for p in problems] == [
        ("copy-of-another", "the probabilities equal those of example-slots on 768 trials")
    ]
