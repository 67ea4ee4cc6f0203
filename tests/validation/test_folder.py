"""Which files a submission consists of."""

import json
import os
from pathlib import Path
from typing import get_args

from hypothesis import given
from hypothesis import strategies as st

from leaderboard.problems import CODES, Problems
from leaderboard.report.problems import Format, render_problems
from leaderboard.submission import SIZE_LIMITS, Kind, RawFile, RawSubmission, read_submission
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


def test_a_file_too_large_gets_fitting_advice(tmp_path: Path) -> None:
    """Predictions have a row per trial, metadata are short, and a result is made again."""
    folder = make(tmp_path, "submission.toml", "predictions.csv", "result.json")
    for name, limit in SIZE_LIMITS.items():
        os.truncate(folder / name, limit + 1)
    problems = Problems()
    judge_folder(read_submission(folder, "submissions/example"), problems)
    assert {Path(problem.file).name: problem.hint for problem in problems} == {
        "predictions.csv": "a row per trial is all that is needed: is this raw output?",
        "submission.toml": "shorten it",
        "result.json": "remove it, and make it with: leaderboard grade submissions/example",
    }


def test_a_pipe_is_neither_read_nor_waited_for(tmp_path: Path) -> None:
    """Where a file is expected and where none is."""
    folder = make(tmp_path, "submission.toml")
    os.mkfifo(folder / "predictions.csv")
    os.mkfifo(folder / "pipe")
    assert [code for code, _, _ in judge(folder)] == ["unexpected-file", "not-a-plain-file"]


def test_a_file_under_another_name_is_pointed_out(tmp_path: Path) -> None:
    """The missing file's problem names it, escaped if need be."""
    folder = make(tmp_path, "submission.toml", "predictions.csv\n")
    problems = Problems()
    judge_folder(read_submission(folder, "submissions/example"), problems)
    assert [(problem.code, problem.hint) for problem in problems] == [
        ("file-missing", r"is it 'predictions.csv\n'? Rename it to predictions.csv"),
        ("unexpected-file", "did you mean predictions.csv?"),
    ]


NAMES = st.text(st.characters(exclude_categories=[]), min_size=1, max_size=12)
FILES = st.builds(
    RawFile,
    NAMES | st.sampled_from(["submission.toml", "predictions.csv", "result.json"]),
    st.sampled_from(get_args(Kind)),
    st.integers(0, 10**7),
    st.none(),
)


@given(NAMES, NAMES | st.just("sub"), st.lists(FILES, max_size=4))
def test_no_name_reaches_a_terminal_or_a_workflow_unescaped(
    location: str, slug: str, files: list[RawFile]
) -> None:
    """Names of folders and files hold any bytes; reports of them hold no control character but line ends."""
    problems = Problems()
    judge_folder(RawSubmission(f"::{location}", slug, tuple(files)), problems)
    assert {problem.code for problem in problems} <= CODES.keys()
    assert all(len(problem.message) <= 400 for problem in problems)
    reports = {format_: render_problems(problems.found, format_) for format_ in get_args(Format)}
    assert (reports["text"] + reports["github"]).replace("\n", "").isprintable()
    assert not any(line.lstrip().startswith("::") for line in reports["text"].split("\n"))
    annotations = reports["github"].split("\n")[:-1]
    assert all(line.startswith(("::error file=", "::notice::... and ")) for line in annotations)
    assert len(json.loads(reports["json"].encode())["errors"]) == len(problems)
