"""Broken and suspicious submissions beside the exact text that they get; tests/corpus/README.md explains."""

import datetime as dt
import os
import shutil
import tomllib
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from builders import build_reference
from leaderboard.problems import CODES, Severity
from leaderboard.report.problems import MAX_SHOWN, render_problems, render_verdict
from leaderboard.submission import read_submission
from leaderboard.validation import Validation, validate

CORPUS = Path(__file__).parent / "corpus"
VALID = CORPUS / "valid" / "submission"
EXAMPLES = sorted(path.parent for path in CORPUS.glob("*/*/*/expected.txt"))
TODAY = dt.date(2026, 6, 1)

MAX_MESSAGE = 400

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
    replace: dict[str, dict[str, str]] = field(default_factory=dict)
    append: dict[str, dict[str, str | int]] = field(default_factory=dict)
    pairs_per_scenario: int = 4


def read_recipe(example: Path) -> Recipe:
    file = example / "recipe.toml"
    return Recipe(**tomllib.loads(file.read_text())) if file.exists() else Recipe()


def make_folder(example: Path, name: str, folder: Path, recipe: Recipe) -> None:
    """Lay the example's files over those of the valid submission, then follow the recipe."""
    shutil.copytree(VALID, folder)
    if (example / name).is_dir():
        shutil.copytree(example / name, folder, dirs_exist_ok=True)
    put_entries(folder, recipe)
    for entry, changes in recipe.replace.items():
        replace_texts(folder / entry, changes)
    for entry, addition in recipe.append.items():
        with (folder / entry).open("ab") as stream:
            stream.write(str(addition["text"]).encode() * int(addition["times"]))
    for entry, size in recipe.sizes.items():
        with (folder / entry).open("ab") as stream:
            stream.truncate(size)


def put_entries(folder: Path, recipe: Recipe) -> None:
    """Take away files, and put links, folders and pipes in the place of others."""
    for entry in (*recipe.remove, *recipe.symlinks, *recipe.folders, *recipe.pipes):
        (folder / entry).unlink(missing_ok=True)
    for entry in recipe.symlinks:
        (folder / entry).symlink_to(VALID / entry)
    for entry in recipe.folders:
        (folder / entry).mkdir()
    for entry in recipe.pipes:
        os.mkfifo(folder / entry)


def replace_texts(file: Path, changes: dict[str, str]) -> None:
    """Put one text in the place of another; it must be there exactly once."""
    content = file.read_bytes()
    for old, new in changes.items():
        assert content.count(old.encode()) == 1, f"{old!r} is not once in {file}"
        content = content.replace(old.encode(), new.encode())
    file.write_bytes(content)


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


def test_nothing_is_accepted_in_ci(monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> None:
    """There ACCEPT=1 would turn every failure into a new expectation that nobody reads."""
    monkeypatch.setenv("ACCEPT", "1")
    monkeypatch.setenv("CI", "true")
    with pytest.raises(pytest.fail.Exception, match=r"^ACCEPT=1 writes expected files anew, and CI is set: "):
        request.getfixturevalue("is_accepting")


def name_example(example: Path) -> str:
    return example.relative_to(CORPUS).as_posix()


@pytest.mark.parametrize("example", EXAMPLES, ids=name_example)
def test_example_gets_the_expected_text(example: Path, tmp_path: Path, is_accepting: bool) -> None:
    """The text is the expected one, to the letter, and the code of the example's folder is in it."""
    validation, text = judge(example, tmp_path)
    if is_accepting:
        (example / "expected.txt").write_text(text)
    assert text == (example / "expected.txt").read_text()
    codes = [problem.code for problem in validation.problems]
    assert example.parent.name in codes
    if example.parent.parent.name == "invalid":
        assert validation.submission is None
    else:
        assert validation.submission is not None
        assert codes == [example.parent.name]


@pytest.mark.parametrize("example", EXAMPLES, ids=name_example)
def test_messages_are_short_and_say_what_to_do(example: Path, tmp_path: Path) -> None:
    """Each is at most 400 printable characters, and those that are shown come with a hint."""
    validation, text = judge(example, tmp_path)
    assert text.replace("\n", "").isprintable()
    shown: Counter[str] = Counter()
    for problem in validation.problems:
        assert 1 <= len(problem.message) <= MAX_MESSAGE
        shown[problem.code] += 1
        assert problem.hint or shown[problem.code] > MAX_SHOWN


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
        if kind.severity is severity and not code.startswith(("change-", "ledger-", "reference-", "import-"))
    }
    assert {path.name for path in (CORPUS / folder).iterdir()} == codes - ELSEWHERE
    for code in codes - ELSEWHERE:
        assert list((CORPUS / folder / code).glob("*/expected.txt"))


def test_only_what_submitting_finds_has_no_example() -> None:
    """The exceptions are codes of the catalogue, refuse, and have no folder."""
    assert {"slug-taken"} == ELSEWHERE
    assert CODES["slug-taken"].severity is Severity.ERROR
    assert not (CORPUS / "invalid" / "slug-taken").exists()


def test_every_folder_is_an_example() -> None:
    """None is left out of the tests because its expected text is missing."""
    assert sorted(CORPUS.glob("[iw]*/*/*")) == EXAMPLES
