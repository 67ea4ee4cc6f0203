"""``leaderboard submit`` with files that name trials as other tools do."""

import csv
import io
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

Run = Callable[..., Result]

FLAGS = [
    text
    for option in (
        "--name=My Model",
        "--team=My Lab",
        "--date=2026-11-20",
        "--description=A test.",
        "--training=separate",
        "--testing=with_property",
        "--family=video",
        "--inputs=rgb",
        "--github=someone",
    )
    for text in option.split("=", 1)
]


def spell_path(trial_id: str) -> str:
    return f"/mnt/my data/testdata_v1/{trial_id}_img.mp4"


def spell_windows(trial_id: str) -> str:
    return "D:\\testdata_v1\\" + trial_id.replace("/", "\\").replace("copy0\\", "copy0_mp4\\") + ".hdf5"


def rename(content: str, spell: Callable[[str], str], lines: slice) -> str:
    """Spell the ids of some lines in another way."""
    rows = list(csv.reader(io.StringIO(content)))
    for row in rows[1:][lines]:
        row[0] = spell(row[0])
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerows(rows)
    return buffer.getvalue()


@pytest.fixture
def content(example: Path) -> str:
    return (example / "predictions.csv").read_text()


@pytest.mark.parametrize("spell", [spell_path, spell_windows])
def test_names_are_written_as_ids(
    run: Run, content: str, root: Path, tmp_path: Path, spell: Callable[[str], str]
) -> None:
    """The submission is that of a file with ids, byte for byte, and how many were translated is said."""
    mine = tmp_path / "mine.csv"
    mine.write_text(rename(content, spell, slice(192)))
    result = run("submit", mine, *FLAGS)
    assert (root / "submissions/my-model/predictions.csv").read_text() == content
    first = next(iter(csv.DictReader(io.StringIO(content))))["trial_id"]
    said = result.stderr.splitlines()[0]
    assert said.startswith("192 names were translated to trial ids, for instance '")
    assert said.endswith(f" -> {first}")
    assert "translated" not in result.stdout
    assert mine.read_text() != content


def test_ids_are_not_spoken_of(run: Run, example: Path, root: Path) -> None:
    """A file of ids is taken byte for byte, without a word."""
    result = run("submit", example / "predictions.csv", *FLAGS)
    assert result.stderr == ""
    written = root / "submissions/my-model/predictions.csv"
    assert written.read_bytes() == (example / "predictions.csv").read_bytes()


def test_parts_are_translated_each(run: Run, content: str, root: Path, tmp_path: Path) -> None:
    """Several files may have names of several kinds."""
    header, *lines = content.splitlines(keepends=True)
    first, second = tmp_path / "a.csv", tmp_path / "b.csv"
    first.write_text(rename("".join([header, *lines[:192]]), spell_windows, slice(192)))
    second.write_text(rename("".join([header, *lines[192:]]), spell_path, slice(1)))
    result = run("submit", first, second, *FLAGS)
    assert result.stderr.startswith("193 names were translated")
    assert (root / "submissions/my-model/predictions.csv").read_text() == content


def test_names_without_their_copy_are_explained_on_their_lines(
    run: Run, content: str, root: Path, tmp_path: Path
) -> None:
    """They fit two trials: nothing is guessed, nothing is written, the other names are seen through."""
    mine = tmp_path / "mine.csv"
    renamed = rename(content, spell_path, slice(1, 3))
    mine.write_text(rename(renamed, lambda trial_id: f"{trial_id.replace('-copy0', '')}_img.mp4", slice(1)))
    result = run("submit", mine, *FLAGS, exit_code=1)
    first = next(iter(csv.DictReader(io.StringIO(content))))["trial_id"]
    second = first.replace("-copy0", "-copy1")
    lines = result.stdout.splitlines()
    assert lines[0].startswith(f"{mine}:2: unknown-trial: ")
    assert lines[1] == f"    it could be {first} or {second}; write one of these"
    assert lines[2].startswith(f"{mine}: missing-trials: 1 of the 64 trials of mass_dominoes_pp are missing")
    assert result.stderr.splitlines()[0].startswith("2 names were translated")
    assert result.stderr.splitlines()[-1] == "nothing was written"
    assert not (root / "submissions/my-model").exists()


def test_two_names_of_one_trial_are_refused_with_both_lines(run: Run, content: str, tmp_path: Path) -> None:
    """An id and the path of its video, in one file."""
    header, first, *rest = content.splitlines(keepends=True)
    again = rename(header + first, spell_path, slice(1)).splitlines(keepends=True)[1]
    mine = tmp_path / "mine.csv"
    mine.write_text("".join([header, first, *rest, again]))
    output = run("submit", mine, *FLAGS, exit_code=1).output
    assert f"{mine}:770: duplicate-trial: trial 'mass_dominoes_pp-copy0/" in output
    assert "is on line 2 already" in output


def test_two_names_of_one_trial_in_two_parts_are_refused(run: Run, content: str, tmp_path: Path) -> None:
    """The message names both files and lines."""
    header, *lines = content.splitlines(keepends=True)
    first, second = tmp_path / "a.csv", tmp_path / "b.csv"
    first.write_text(rename(content, spell_path, slice(768)))
    second.write_text(rename(header + lines[4], spell_windows, slice(1)))
    output = run("submit", first, second, *FLAGS, exit_code=1).output
    assert f"{second}:2: duplicate-trial:" in output
    assert f"is also in {first}, line 6" in output


def test_a_malformed_file_is_explained_untranslated(run: Run, content: str, tmp_path: Path) -> None:
    """Lines and names are the participant's own, and the hint says what each name would be."""
    mine = tmp_path / "mine.csv"
    mine.write_text(rename(content, spell_path, slice(1)) + "\n")
    result = run("submit", mine, *FLAGS, exit_code=1)
    assert result.stdout.startswith(f"{mine}:2: unknown-trial: '/mnt/my data/testdata_v1/mass_dominoes_pp-")
    assert "write its id, mass_dominoes_pp-copy0/" in result.stdout
    assert f"{mine}:770: blank-line:" in result.stdout
    assert "translated" not in result.stderr


def test_validate_accepts_ids_only(run: Run, content: str, tmp_path: Path) -> None:
    """The same names are refused there, with what each should be."""
    mine = tmp_path / "mine.csv"
    mine.write_text(rename(content, spell_windows, slice(1)))
    lines = run("validate", mine, exit_code=1).output.splitlines()
    first = next(iter(csv.DictReader(io.StringIO(content))))["trial_id"]
    assert lines[1] == f"    write its id, {first}"
