"""Change valid submissions in every way that a file can be wrong, and judge and grade what comes of it.

Run: python -m benchmarks.campaigns.mutations [SUBMISSIONS]

Hypothesis chooses a set of files, what each of them is (a file, a link, a folder, a pipe, nothing) and, for
each content, where cells, lines, keys and bytes are replaced, doubled, moved or left out. Every submission is
laid on disk, read, validated and, if it is valid, graded. Anything but a table or a list of problems escapes.
"""

import os
import shutil
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))

import numpy as np  # noqa: E402  (the tests' folder comes first)
from hypothesis import HealthCheck, Phase, given, seed, settings  # noqa: E402
from hypothesis import strategies as st  # noqa: E402

from benchmarks.campaigns.promises import require, require_sound  # noqa: E402
from builders import build_reference  # noqa: E402
from leaderboard.grading import Yardstick, grade, result_bytes  # noqa: E402
from leaderboard.instance import PREDICTIONS_FILE, RESULT_FILE, SUBMISSION_FILE  # noqa: E402
from leaderboard.submission import read_submission  # noqa: E402
from leaderboard.validation import Validation, validate  # noqa: E402
from leaderboard.verifying import list_differences  # noqa: E402
from raw_submissions import SUBMISSION_TOML, TODAY, predictions_csv  # noqa: E402

SUBMISSIONS = 20_000
SEED = 20231105
MAX_MESSAGE = 1500

REFERENCE = build_reference(2)
YARDSTICK = Yardstick.of(REFERENCE)
LATIN = "é".encode("latin-1")
PIECES = (
    *(b"", b",", b'"', b'""', b"\n", b"\r", b"\r\n", b"\t", b";", b"=", b"[", b"]", b"[[", b"{", b"}", b"'"),
    *(b"'''", b"#", b"\\", b"\\u0000", b"\\ud800", b"\x00", b"\x1b[31m", LATIN, b"\xff\xfe", b"\xed\xa0\x80"),
    *(mark.encode() for mark in ("\ufeff", "\u202e", "\u200b", "é", "e\u0301", "\uff41", "\u0430", "\u2028")),
    *(b"0.5", b"1e400", b"1e-400", b"NaN", b"inf", b"-0.0", b"1_0", b"50%", b"0,5", b".5", b"5.", b"+0.5"),
    *(b"0x1p-2", b"1.0000000000000000001", b"9" * 400, "\u0660.\u0665".encode(), b"TRUE", b"None", b"null"),
    *(b"::error::x", b"::stop-commands::x", b"=HYPERLINK(1)", b"@SUM(1)", b"<script>", b"javascript:1"),
    *(b"trial_id,probability\n", b"answered", b"refused", b"error", b"[submission]\n", b"1979-05-27", b"../"),
    *(
        b"PK\x03\x04",
        b"\x1f\x8b",
        b"[" * 300,
        b"a." * 300 + b"b = 1\n",
        b"version https://git-lfs\n",
        b"true",
    ),
)
SEPARATORS = (b"\n", b",", b'"', b" = ", b"-", b".", b":")
NAMES = ("predictions.csv ", "Predictions.csv", "notes.txt", ".gitattributes", "-rf", "a\nb", "\u202e.csv")
KINDS = ("file", "file", "file", "file", "file", "file", "file", "link", "folder", "pipe", "missing", "empty")


@dataclass(frozen=True)
class Entry:
    """What stands under a name of a submission's folder."""

    name: str
    kind: str
    content: bytes


@st.composite
def mutate(draw: st.DrawFn, valid: bytes) -> bytes:
    """Change some parts of a content: its lines, cells, words or single bytes."""
    content = valid
    for _ in range(draw(st.integers(0, 4))):
        separator = draw(st.sampled_from((*SEPARATORS, b"")))
        parts = content.split(separator) if separator else [bytes([byte]) for byte in content]
        place = draw(st.integers(0, max(len(parts) - 1, 0)))
        change = draw(st.sampled_from(("replace", "insert", "remove", "double", "swap", "cut", "edge")))
        content = separator.join(_change(parts, place, change, draw(_pieces())))
    return content


def _pieces() -> st.SearchStrategy[bytes]:
    return st.sampled_from(PIECES) | st.binary(max_size=6) | st.text(max_size=6).map(_encode)


def _encode(text: str) -> bytes:
    return text.encode("utf-8", "surrogatepass")


def _change(parts: list[bytes], place: int, change: str, piece: bytes) -> list[bytes]:
    before, here, after = parts[:place], parts[place : place + 1], parts[place + 1 :]
    changed = {
        "replace": [*before, piece, *after],
        "insert": [*before, piece, *here, *after],
        "remove": [*before, *after],
        "double": [*before, *here, *here, *after],
        "swap": [*after, *here, *before],
        "cut": [*before, *here],
        "edge": [*before, *(piece + part + piece for part in here), *after],
    }
    return changed[change]


def entries() -> st.SearchStrategy[list[Entry]]:
    """Draw what is in a submission's folder."""
    valid = {
        PREDICTIONS_FILE: predictions_csv(REFERENCE).encode(),
        SUBMISSION_FILE: SUBMISSION_TOML.encode(),
        RESULT_FILE: VALID_RESULT,
    }
    files = [
        st.builds(Entry, st.just(name), st.sampled_from(KINDS), mutate(content) | st.just(content))
        for name, content in valid.items()
    ]
    other = st.builds(Entry, st.sampled_from(NAMES), st.sampled_from(KINDS), st.just(b"x"))
    others: st.SearchStrategy[list[Entry]] = st.lists(other, max_size=1)
    others = st.just([]) | st.just([]) | st.just([]) | others
    return st.builds(lambda first, rest: [*first, *rest], st.tuples(*files), others)


def lay(folder: Path, drawn: list[Entry]) -> None:
    """Put the entries into an empty folder."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for entry in drawn:
        path = folder / entry.name
        if entry.kind == "link":
            path.symlink_to("../example")  # a folder, if it were followed
        elif entry.kind == "folder":
            path.mkdir()
        elif entry.kind == "pipe":
            os.mkfifo(path)
        elif entry.kind != "missing":
            path.write_bytes(b"" if entry.kind == "empty" else entry.content)


def judge(folder: Path) -> str:
    """Read, validate and grade a folder, and name the outcome.

    Raises
    ------
    AssertionError
        If what comes of it is neither a table nor a list of problems.
    """
    raw = read_submission(folder, "submissions/example")
    validation = validate(raw, REFERENCE, today=TODAY)
    require_verdict(validation)
    if validation.submission is None:
        return "problems"
    content = result_bytes(grade(validation.submission, REFERENCE, yardstick=YARDSTICK))
    committed = raw.find(RESULT_FILE)
    differences = list_differences(committed.content if committed else None, content)
    require(all(difference.isprintable() for difference in differences))
    return "graded, with warnings" if validation.problems else "graded"


def require_verdict(validation: Validation) -> None:
    """See that a verdict is one: probabilities from 0 to 1, or problems whose text stays in its line."""
    problems, submission = validation.problems, validation.submission
    require((submission is None) == any(problem.is_error for problem in problems))
    require(all(len(problem.message) < MAX_MESSAGE for problem in problems))
    require_sound(problems)
    if submission is not None:
        require(np.all((submission.probabilities >= 0) & (submission.probabilities <= 1)))
        require(np.all(submission.covered >= submission.answered))


def grade_valid() -> bytes:
    """Make the result of the submission that nothing was done to."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "example"
        predictions = predictions_csv(REFERENCE).encode()
        toml = SUBMISSION_TOML.encode()
        lay(folder, [Entry(PREDICTIONS_FILE, "file", predictions), Entry(SUBMISSION_FILE, "file", toml)])
        submission = validate(read_submission(folder, "x"), REFERENCE, today=TODAY).submission
    require(submission is not None)
    return b"" if submission is None else result_bytes(grade(submission, REFERENCE, yardstick=YARDSTICK))


VALID_RESULT = grade_valid()


def run(n_submissions: int) -> Counter[str]:
    """Judge so many submissions and count the outcomes; what escapes is raised by Hypothesis, made small."""
    found: Counter[str] = Counter()

    @seed(SEED)
    @settings(
        max_examples=n_submissions,
        database=None,
        deadline=None,
        phases=[Phase.generate, Phase.shrink],
        suppress_health_check=list(HealthCheck),
    )
    @given(entries())
    def judge_drawn(drawn: list[Entry]) -> None:
        lay(folder, drawn)
        found[judge(folder)] += 1

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "example"
        judge_drawn()
    return found


def main() -> None:
    """Judge them all and print what came of them."""
    found = run(int(sys.argv[1]) if len(sys.argv) > 1 else SUBMISSIONS)
    print("| outcome | submissions |\n|---|---:|")
    for outcome, times in sorted(found.items()):
        print(f"| {outcome} | {times:,} |")
    print(f"| all | {found.total():,} |\n| escapes | 0 |")


if __name__ == "__main__":
    main()
