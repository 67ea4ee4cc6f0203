"""The verdict on a whole submission."""

import random
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from builders import build_reference
from leaderboard.files import sha256_hex
from leaderboard.problems import CODES
from leaderboard.report.problems import render_problems
from leaderboard.submission import RawFile, RawSubmission
from leaderboard.validation import Validation, validate
from raw_submissions import (
    SUBMISSION_TOML,
    TODAY,
    judge_predictions_file,
    predictions_csv,
    raw_folder,
    spread_probabilities,
)

REFERENCE = build_reference()
VALID = predictions_csv(REFERENCE)


def codes(validation: Validation) -> list[str]:
    return [problem.code for problem in validation.problems]


def assert_sound(validation: Validation) -> None:
    """Either a table of finite probabilities, or problems with known codes and printable text."""
    assert (validation.submission is None) == any(problem.is_error for problem in validation.problems)
    assert set(codes(validation)) <= CODES.keys()
    for problem in validation.problems:
        assert (problem.message + problem.hint).isprintable()
        assert len(problem.message) < 1500
    if validation.submission is not None:
        probabilities = validation.submission.probabilities
        assert np.all((probabilities >= 0) & (probabilities <= 1))
        assert np.all(validation.submission.covered >= validation.submission.answered)
    for line in render_problems(validation.problems, "text").splitlines():
        assert line.isprintable()
        assert not line.lstrip().startswith("::")


def test_a_valid_submission_round_trips() -> None:
    """Probabilities arrive as float64 to the last bit, with the file's checksum and the metadata."""
    probabilities = [n / 23.7 for n in range(24)]
    content = predictions_csv(REFERENCE, probabilities)
    validation = validate(raw_folder(content), REFERENCE, today=TODAY)
    assert validation.problems == ()
    submission = validation.submission
    assert submission is not None
    assert submission.probabilities.tolist() == probabilities
    assert submission.answered.all()
    assert submission.covered.all()
    assert submission.predictions_sha256 == sha256_hex(content.encode())
    assert submission.metadata is not None
    assert (submission.slug, submission.metadata.submission.team) == ("example", "Example Lab")


@given(st.randoms(use_true_random=False))
def test_the_order_of_rows_does_not_matter(rng: random.Random) -> None:
    """Shuffled rows give the same table."""
    header, *rows = VALID.splitlines(keepends=True)
    rng.shuffle(rows)
    submission = judge_predictions_file("".join([header, *rows]), REFERENCE).submission
    assert submission is not None
    assert submission.probabilities.tolist() == spread_probabilities(REFERENCE)


@pytest.mark.parametrize("mark", ["", "\ufeff"], ids=["plain", "bom"])
@pytest.mark.parametrize("line_end", ["\n", "\r\n"], ids=["lf", "crlf"])
@pytest.mark.parametrize("last", [True, False], ids=["ended", "open"])
def test_what_spreadsheets_add_is_accepted(mark: str, line_end: str, *, last: bool) -> None:
    """A byte-order mark, CRLF, and a last line without an end change nothing."""
    content = mark + (VALID if last else VALID.rstrip()).replace("\n", line_end)
    submission = judge_predictions_file(content, REFERENCE).submission
    assert submission is not None
    assert submission.probabilities.tolist() == spread_probabilities(REFERENCE)


def test_metadata_may_come_from_windows() -> None:
    """A byte-order mark and CRLF change nothing in submission.toml either."""
    raw = raw_folder(VALID, "\ufeff" + SUBMISSION_TOML.replace("\n", "\r\n"))
    assert validate(raw, REFERENCE, today=TODAY).problems == ()


def test_a_bare_file_is_judged_without_metadata() -> None:
    """Problems name the file as it was given; there is no metadata and no slug."""
    validation = judge_predictions_file(VALID.replace("0.0213", "x", 1), REFERENCE)
    assert [(p.file, p.line, p.code) for p in validation.problems] == [
        ("mine.csv", 2, "probability-not-a-number")
    ]
    submission = judge_predictions_file(VALID, REFERENCE).submission
    assert submission is not None
    assert (submission.metadata, submission.slug) == (None, None)


def test_a_bare_file_that_is_no_file_is_refused_once() -> None:
    """A link or a too large file is one problem, not two."""
    file = RawFile("predictions.csv", "symlink", 0, None)
    validation = validate(RawSubmission("mine.csv", None, (file,)), REFERENCE, today=TODAY)
    assert codes(validation) == ["not-a-plain-file"]


def test_all_files_are_judged_in_one_run() -> None:
    """A stray file, broken metadata and broken predictions are found together, in the order of lines."""
    raw = raw_folder(
        VALID.replace("0.0213", "x", 1) + "\n",
        SUBMISSION_TOML.replace("2026-05-20", "2027-01-01") + "x = 1\n",
    )
    raw = replace(raw, files=(*raw.files, RawFile("notes.txt", "file", 3, None)))
    assert codes(validate(raw, REFERENCE, today=TODAY)) == [
        "unexpected-file",
        "date-in-future",
        "unknown-key",
        "probability-not-a-number",
        "blank-line",
    ]


def test_unread_metadata_refuse_good_predictions() -> None:
    """There is no submission without metadata, even where the predictions are fine."""
    raw = raw_folder(VALID)
    without = replace(raw, files=raw.files[:1])
    validation = validate(without, REFERENCE, today=TODAY)
    assert (validation.submission, codes(validation)) == (None, ["file-missing"])


@given(st.binary(max_size=400) | st.text(max_size=200).map(str.encode))
def test_any_bytes_are_judged(content: bytes) -> None:
    """Whatever the two files hold, the verdict is a table or problems, never an exception."""
    assert_sound(validate(raw_folder(content, content), REFERENCE, today=TODAY))


PIECES = st.sampled_from(
    [
        ",",
        '"',
        "\n",
        "\r",
        "\r\n",
        "=",
        "[",
        "]",
        "0.5",
        "-",
        "e9",
        "\ufeff",
        "\x00",
        "\u202e",
        "é",
        "::x::",
        "'",
    ]
)


@given(
    place=st.floats(0, 1),
    length=st.integers(0, 12),
    piece=PIECES | st.text(max_size=4) | st.just(VALID[:300]),
    target=st.sampled_from(["predictions", "metadata"]),
)
def test_a_mutated_submission_is_judged(place: float, length: int, piece: str, target: str) -> None:
    """A valid file with a stretch replaced gives problems, or is still valid."""
    contents = {"predictions": VALID, "metadata": SUBMISSION_TOML}
    text = contents[target]
    start = int(place * len(text))
    contents[target] = text[:start] + piece + text[start + length :]
    raw = raw_folder(
        contents["predictions"].encode("utf-8", "surrogatepass"),
        contents["metadata"].encode("utf-8", "surrogatepass"),
    )
    assert_sound(validate(raw, REFERENCE, today=TODAY))


def test_long_garbage_is_cut_short() -> None:
    """Millions of lines are counted, not judged one by one."""
    for line in ("\n", "a,\n", '"\n'):
        content = "trial_id,probability\n" + line * (4_900_000 // len(line))
        validation = judge_predictions_file(content, REFERENCE)
        assert "too-many-rows" in codes(validation)
        assert len(validation.problems) < 25_000


@pytest.mark.parametrize(
    "content", [b"," * 4_900_000, b'"' * 4_900_000, b"a" * 4_900_000, b"a," + b"1" * 4_000_000]
)
def test_long_lines_end(content: bytes) -> None:
    """One line of millions of cells, quotes or digits is judged in linear time."""
    assert_sound(judge_predictions_file(content, REFERENCE))
    assert_sound(judge_predictions_file(b"trial_id,probability\n" + content, REFERENCE))


def test_judging_loads_nothing_heavy() -> None:
    """Validation needs neither a terminal nor tables nor SciPy."""
    code = (
        "import sys, leaderboard.validation;"
        "print(*sorted({'click', 'jinja2', 'pandas', 'rich', 'scipy'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.split() == []


def test_the_order_of_files_does_not_matter() -> None:
    """Files on disk come in any order; the problems are the same."""
    raw = raw_folder(VALID + "x,1\n", SUBMISSION_TOML + "x = 1\n")
    turned = replace(raw, files=raw.files[::-1])
    first, second = (validate(r, REFERENCE, today=TODAY).problems for r in (raw, turned))
    assert first == second
