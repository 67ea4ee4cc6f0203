"""Which files a submission consists of."""

import os
from pathlib import Path

from leaderboard.problems import Problems
from leaderboard.submission import SIZE_LIMITS, read_submission
from leaderboard.validation.folder import judge_folder


def judge(folder: Path) -> list[tuple[str, str, str]]:
    problems = Problems()
    judge_folder(read_submission(folder, f"submissions/{folder.name}"), problems)
    return [(problem.code, problem.file, problem.message) for problem in problems]


def make(tmp_path: Path, *names: str, slug: str = "example") -> Path:
    folder = tmp_path / slug
    folder.mkdir()
    for name in names:
        (folder / name).write_bytes(b"x")
    return folder


def test_two_files_and_a_result_are_all(tmp_path: Path) -> None:
    """The result may be there or not."""
    folder = make(tmp_path, "submission.toml", "predictions.csv")
    assert judge(folder) == []
    (folder / "result.json").write_bytes(b"{}")
    assert judge(folder) == []


def test_an_empty_folder_lacks_both_files(tmp_path: Path) -> None:
    """Each missing file is a problem of the folder."""
    where = "submissions/example"
    assert judge(make(tmp_path)) == [
        ("file-missing", where, "there is no submission.toml"),
        ("file-missing", where, "there is no predictions.csv"),
    ]


def test_a_file_of_exactly_the_limit_is_accepted(tmp_path: Path) -> None:
    """One byte more is not."""
    folder = make(tmp_path, "submission.toml", "predictions.csv", "result.json")
    for name, limit in SIZE_LIMITS.items():
        os.truncate(folder / name, limit)
    assert judge(folder) == []
    for name, limit in SIZE_LIMITS.items():
        os.truncate(folder / name, limit + 1)
    assert [code for code, _, _ in judge(folder)] == ["file-too-large"] * 3


def test_nothing_is_read_through_a_link(tmp_path: Path) -> None:
    """A symbolic link is named as one, whatever it leads to; a link to nowhere as well."""
    folder = make(tmp_path, "submission.toml", "predictions.csv")
    (folder / "result.json").symlink_to(folder / "nowhere")
    (folder / "secrets").symlink_to("/etc")
    assert judge(folder) == [
        (
            "not-a-plain-file",
            "submissions/example/result.json",
            "is a symbolic link, not a plain file; nothing in it was read",
        ),
        ("unexpected-file", "submissions/example/secrets", "'secrets' does not belong in a submission"),
    ]


def test_names_of_any_bytes_are_shown_escaped(tmp_path: Path) -> None:
    """A newline, a control character or a byte that is no UTF-8 reaches no terminal."""
    folder = make(tmp_path, "submission.toml", "predictions.csv")
    Path(os.fsdecode(os.fsencode(folder) + b"/a\n\x1b\xff")).write_bytes(b"")
    assert judge(folder) == [
        (
            "unexpected-file",
            r"submissions/example/a\n\x1b\udcff",
            r"'a\n\x1b\udcff' does not belong in a submission",
        )
    ]


def test_the_folder_must_be_named_by_a_slug(tmp_path: Path) -> None:
    """Its name is what the submission is called by everything else."""
    folder = make(tmp_path, "submission.toml", "predictions.csv", slug="Ünique_1")
    assert judge(folder) == [
        ("slug-malformed", r"submissions/\xdcnique_1", r"'\xdcnique_1' cannot name a submission")
    ]
