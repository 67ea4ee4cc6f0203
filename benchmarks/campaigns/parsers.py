"""What reads bytes that strangers send, each as a function of bytes that must end without an escape.

An escape is an exception that is not the one that the reader promises, or an answer that breaks a promise.
"""

import json
import sys
import tempfile
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))

from benchmarks.campaigns.promises import require, require_sound  # noqa: E402  (the tests' folder comes first)
from builders import build_reference  # noqa: E402
from leaderboard.changes.git_objects import GitRepository  # noqa: E402
from leaderboard.changes.proposals import read_proposal  # noqa: E402
from leaderboard.changes.scope import find_slug  # noqa: E402
from leaderboard.converting import FORMATS, Options, parse_answer  # noqa: E402
from leaderboard.errors import SourceError  # noqa: E402
from leaderboard.ledger import parse_ledger  # noqa: E402
from leaderboard.problems import Problems  # noqa: E402
from leaderboard.recording.regrading import explain_regrading  # noqa: E402
from leaderboard.trial_names import Ambiguous, Resolved, TrialNames  # noqa: E402
from leaderboard.validation.folder import judge_folder  # noqa: E402
from leaderboard.validation.metadata import judge_metadata  # noqa: E402
from leaderboard.validation.predictions import judge_predictions  # noqa: E402
from leaderboard.validation.suggestions import Suggestions  # noqa: E402
from leaderboard.validation.translating import translate_names  # noqa: E402
from leaderboard.verifying import list_differences  # noqa: E402
from raw_submissions import SUBMISSION_TOML, TODAY, predictions_csv  # noqa: E402

REFERENCE = build_reference(2)
NAMES = TrialNames(REFERENCE.trial_ids)
SUGGESTIONS = Suggestions(REFERENCE.trial_ids)
MAX_HINT = 1000
RESULT = {
    "inputs": {"predictions_sha256": "1", "reference_digest": "2", "reference_kind": "synthetic"},
    "metrics_version": 3,
    "grader": "1.0",
    "scores": {"all": {"accuracy": {"value": 0.5, "low": 0.25, "high": 0.75}}},
}
RESULT_BYTES = json.dumps(RESULT).encode()


def fuzz_predictions(content: bytes) -> None:
    """Read bytes as predictions: probabilities in [0, 1], or a problem that is an error."""
    problems = Problems()
    found = judge_predictions(content, "0" * 64, REFERENCE, "predictions.csv", problems)
    require_sound(problems)
    if found is not None:
        require(np.all((found.probabilities >= 0) & (found.probabilities <= 1)))
    require(found is not None or problems.has_errors)


def fuzz_metadata(content: bytes) -> None:
    """Read bytes as submission.toml."""
    problems = Problems()
    found = judge_metadata(content, REFERENCE.benchmark, "submission.toml", TODAY, problems)
    require_sound(problems)
    require(found is not None or problems.has_errors)


def fuzz_result(content: bytes) -> None:
    """Compare bytes with a result, and let them replace one and be replaced."""
    for difference in list_differences(content, RESULT_BYTES):
        require(difference.isprintable())
    for old, new in ((content, RESULT_BYTES), (RESULT_BYTES, content)):
        problems = Problems()
        reason = explain_regrading(old, new, "result.json", problems)
        require_sound(problems)
        require(reason is not None or problems.has_errors)


def fuzz_ledger(content: bytes) -> None:
    """Read bytes as a ledger."""
    problems = Problems()
    require((parse_ledger(content, "ledger.csv", problems) is None) == problems.has_errors)
    require_sound(problems)


def fuzz_trial_names(content: bytes) -> None:
    """Look up a trial's name, explain it, and translate a table that holds it."""
    text = content.decode(errors="surrogateescape")
    found = NAMES.resolve(text)
    if isinstance(found, Resolved):
        require(found.trial_id in REFERENCE.trial_index)
    elif isinstance(found, Ambiguous):
        require(len(found.trial_ids) > 1)
    require(len(SUGGESTIONS.explain(text)) < MAX_HINT)
    translate_names(content, REFERENCE)


class _Listing(GitRepository):
    """A repository whose git says whatever it is told to."""

    def __init__(self, listing: bytes, content: bytes) -> None:
        super().__init__(Path())
        object.__setattr__(self, "listing", listing)
        object.__setattr__(self, "content", content)

    def _run(self, *arguments: str, limit: int = 0) -> bytes:
        del limit
        found: bytes = getattr(self, "content" if arguments[0] == "cat-file" else "listing")
        return found


def fuzz_git_listing(content: bytes) -> None:
    """Take names and modes of a tree, NUL between them, and judge the folder and the paths."""
    modes = ("100644", "100755", "120000", "160000", "040000", "000000")
    names = [name for name in content.split(b"\0") if name]
    entries, changes = [], []
    for number, name in enumerate(names):
        mode = modes[(len(name) + number) % len(modes)].encode()
        entries.append(mode + b" blob " + b"0" * 40 + b"      12\tsubmissions/a-b/" + name + b"\0")
        changes.append(b":000000 " + mode + b" " + b"0" * 40 + b" " + b"0" * 40 + b" A\0" + name + b"\0")
    problems = Problems()
    raw = read_proposal(_Listing(b"".join(entries), content), "0" * 40, "submissions/a-b", problems)
    judge_folder(raw, problems)
    listing = _Listing(b"".join(changes), b"")
    find_slug([c.path for c in listing.list_changes("0", "1")], "submissions/", problems)
    require_sound(problems)


SUFFIXES = (".json", ".jsonl", ".csv", ".tsv")
FOLDER = tempfile.TemporaryDirectory(prefix="campaign-")


def fuzz_logs(content: bytes) -> None:
    """Read bytes as a log of each tool; the first byte chooses the format and the ending."""
    choice, body = (content[0], content[1:]) if content else (0, b"")
    format_ = list(FORMATS.values())[choice % len(FORMATS)]
    file = Path(FOLDER.name) / f"samples_x{SUFFIXES[choice // len(FORMATS) % len(SUFFIXES)]}"
    file.write_bytes(body)
    with suppress(SourceError):
        format_.split_runs([file], REFERENCE, Options())


def fuzz_answers(content: bytes) -> None:
    """Read a model's answer."""
    reading = parse_answer(content.decode(errors="replace"))
    require(reading.probability in {"", "0", "1"})


PARSERS: dict[str, Callable[[bytes], None]] = {
    "predictions": fuzz_predictions,
    "metadata": fuzz_metadata,
    "result": fuzz_result,
    "ledger": fuzz_ledger,
    "trial names": fuzz_trial_names,
    "git listing": fuzz_git_listing,
    "logs": fuzz_logs,
    "answers": fuzz_answers,
}

LEDGER = (
    "date,slug,event,reason,result_sha256\n"
    f"2026-01-02,a-b,added,new submission,{'0' * 64}\n"
    f'2026-01-03,a-b,regraded,"reference, new",{"1" * 64}\n'
).encode()
_TRIAL = REFERENCE.trial_ids[0]

SEEDS: dict[str, tuple[bytes, ...]] = {
    "predictions": (predictions_csv(REFERENCE).encode(), b"trial_id,probability,status\n"),
    "metadata": (SUBMISSION_TOML.encode(),),
    "result": (RESULT_BYTES,),
    "ledger": (LEDGER,),
    "trial names": (_TRIAL.encode(), b"https://a.org/" + _TRIAL.encode() + b"_img.mp4", b"D:\\x-copy0\\0001"),
    "git listing": (b"predictions.csv\0submission.toml\0result.json", b"submissions/a-b/predictions.csv"),
    "logs": tuple(
        bytes([10 * ending + number]) + body
        for number in range(len(FORMATS))
        for ending, body in enumerate(
            (
                json.dumps([{"trial_id": _TRIAL, "answer": "yes", "probability": 0.5}]).encode(),
                json.dumps({"trial_id": _TRIAL, "prediction": "no", "doc": {}, "resps": [["yes"]]}).encode(),
                f'trial_id,answer,probability\n"{_TRIAL}",yes,0.5\n'.encode(),
                f"index\tprediction\n{_TRIAL}\tYes.\n".encode(),
            )
        )
    ),
    "answers": (b"Answer: **Yes**", b"<think>no</think> The answer is (B) no.", b"\\boxed{yes}"),
}
