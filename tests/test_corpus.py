"""Broken and suspicious submissions beside the exact text that they get; tests/corpus/README.md explains."""

import datetime as dt
import os
import shutil
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from builders import build_reference
from leaderboard.problems import CODES, Severity
from leaderboard.report.problems import render_problems, render_verdict
from leaderboard.submission import read_submission
from leaderboard.validation import Validation, validate

CORPUS = Path(__file__).parent / "corpus"
VALID = CORPUS / "valid" / "submission"
EXAMPLES = sorted(path.parent for path in CORPUS.glob("*/*/*/expected.txt"))
TODAY = dt.date(2026, 6, 1)

# Found where a folder is made, not where it is judged; tests of submitting show it.
ELSEWHERE = {"slug-taken"}


@dataclass(frozen=True)
class Recipe:
    """What git cannot hold, or should not: done to the example's folder after its files are in place."""

    slug: str = "example"
    remove: tuple[str, ...] = ()
    symlinks: tuple[str, ...] = ()
    folders: tuple[str, ...] = ()
    pipes: tuple[str, ...] = ()
    sizes: dict[str, int] = field(default_factory=dict)
    pairs_per_scenario: int = 4


def read_recipe(example: Path) -> Recipe:
    file = example / "recipe.toml"
    return Recipe(**tomllib.loads(file.read_text())) if file.exists() else Recipe()


def make_folder(example: Path, name: str, folder: Path, recipe: Recipe) -> None:
    """Lay the example's files over those of the valid submission, then follow the recipe."""
    shutil.copytree(VALID, folder)
    if (example / name).is_dir():
        shutil.copytree(example / name, folder, dirs_exist_ok=True)
    for entry in (*recipe.remove, *recipe.symlinks, *recipe.folders, *recipe.pipes):
        (folder / entry).unlink(missing_ok=True)
    for entry in recipe.symlinks:
        (folder / entry).symlink_to(VALID / entry)
    for entry in recipe.folders:
        (folder / entry).mkdir()
    for entry in recipe.pipes:
        os.mkfifo(folder / entry)
    for entry, size in recipe.sizes.items():
        with (folder / entry).open("ab") as stream:
            stream.truncate(size)


def judge(example: Path, tmp_path: Path) -> tuple[Validation, str]:
    """Validate an example; return the verdict and all that a person sees of it."""
    recipe = read_recipe(example)
    reference = build_reference(recipe.pairs_per_scenario)
    others = []
    if (example / "rival").is_dir():
        make_folder(example, "rival", tmp_path / "rival", Recipe())
        raw = read_submission(tmp_path / "rival", "submissions/rival")
        rival = validate(raw, reference, today=TODAY).submission
        assert rival is not None
        others.append(rival)
    make_folder(example, "submission", tmp_path / recipe.slug, recipe)
    raw = read_submission(tmp_path / recipe.slug, f"submissions/{recipe.slug}")
    validation = validate(raw, reference, today=TODAY, others=others)
    verdict = render_verdict(raw.location, validation.submission, validation.problems)
    return validation, f"{render_problems(validation.problems, 'text')}{verdict}\n"


def name_example(example: Path) -> str:
    return example.relative_to(CORPUS).as_posix()


@pytest.mark.parametrize("example", EXAMPLES, ids=name_example)
def test_example_gets_the_expected_text(example: Path, tmp_path: Path) -> None:
    """The text is the expected one, to the letter, and the code of the example's folder is in it."""
    validation, text = judge(example, tmp_path)
    if os.environ.get("ACCEPT"):
        (example / "expected.txt").write_text(text)
    assert text == (example / "expected.txt").read_text()
    assert example.parent.name in {problem.code for problem in validation.problems}
    assert (validation.submission is None) == (example.parent.parent.name == "invalid")


def test_the_valid_submission_is_valid(tmp_path: Path) -> None:
    """What the examples are made from has no fault of its own."""
    make_folder(VALID.parent, "submission", tmp_path / "example", Recipe())
    raw = read_submission(tmp_path / "example", "submissions/example")
    validation = validate(raw, build_reference(), today=TODAY)
    assert validation.submission is not None
    assert validation.problems == ()


@pytest.mark.parametrize(
    ("folder", "severity"), [("invalid", Severity.ERROR), ("warned", Severity.WARNING)], ids=str
)
def test_every_code_has_an_example(folder: str, severity: Severity) -> None:
    """The catalogue's codes for submissions and the corpus' folders are the same."""
    codes = {
        code
        for code, kind in CODES.items()
        if kind.severity is severity and not code.startswith(("reference-", "import-"))
    }
    assert {path.name for path in (CORPUS / folder).iterdir()} == codes - ELSEWHERE
