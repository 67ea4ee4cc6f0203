"""Reading a submission, judging nothing."""

import os
from pathlib import Path

import pytest

from leaderboard.submission import SIZE_LIMITS, RawFile, read_any, read_submission


def test_entries_are_read_by_name(tmp_path: Path) -> None:
    """Only files of a submission have content; links are not followed and folders not entered."""
    (tmp_path / "submission.toml").write_bytes(b"a")
    (tmp_path / "notes.txt").write_bytes(b"abc")
    (tmp_path / "code").mkdir()
    (tmp_path / "predictions.csv").symlink_to(tmp_path / "notes.txt")
    os.mkfifo(tmp_path / "result.json")
    files = read_submission(tmp_path, "here").files
    assert [(file.name, file.kind, file.content) for file in files] == [
        ("code", "folder", None),
        ("notes.txt", "file", None),
        ("predictions.csv", "symlink", None),
        ("result.json", "special", None),
        ("submission.toml", "file", b"a"),
    ]


def test_what_is_too_large_is_not_read(tmp_path: Path) -> None:
    """Its size is known all the same."""
    size = SIZE_LIMITS["predictions.csv"] + 1
    with (tmp_path / "predictions.csv").open("wb") as stream:
        stream.truncate(size)
    assert read_submission(tmp_path, "here").find("predictions.csv") == RawFile(
        "predictions.csv", "file", size, None
    )


def test_the_slug_is_the_folders_name_from_inside_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`validate .` judges the same submission as naming its folder."""
    folder = tmp_path / "my-model"
    folder.mkdir()
    assert read_submission(folder, "here").slug == "my-model"
    monkeypatch.chdir(folder)
    assert read_any(Path(), "here").slug == "my-model"


def test_a_bare_file_may_have_any_name(tmp_path: Path) -> None:
    """It is shown as it was given, and has no slug."""
    file = tmp_path / "mine.txt"
    file.write_bytes(b"x")
    raw = read_any(file, "mine.txt")
    assert (raw.slug, raw.path_of("predictions.csv")) == (None, "mine.txt")
    assert raw.files == (RawFile("predictions.csv", "file", 1, b"x"),)
    assert raw.find("submission.toml") is None
