"""Measure what converting costs: 100,000 answers of a language model beside `json.loads` of the same lines.

Run with `python benchmarks/converting.py`. Answers are of several kinds, from one word to a page of thought;
each trial of the reference is asked as often as it takes. Converter and floor run in turn; what counts is
the ratio of the medians of processor time, which is that of one core. Exit status 1 if a limit is exceeded.
"""

import argparse
import json
import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from itertools import cycle, islice
from pathlib import Path

from leaderboard.converting import FORMATS, parse_answer
from leaderboard.instance import Instance
from leaderboard.reference import Reference, load_reference

ROOT = Path(__file__).resolve().parent.parent
N_ANSWERS = 100_000
LIMIT = 5.0  # seconds for the whole conversion

SENTENCE = "The red object slides on, since the surface seems to be slippery, and no wall is in the way. "
KINDS = {
    "one word": "Yes.",
    "a tag": "It moves at first, yes. But the cloth stops it. <answer>No</answer>",
    "two lines": "Is there an obstacle? No.\nFinal answer: **Yes**",
    "a page of thought": f"<think>{SENTENCE * 20}</think>\n{SENTENCE}\n\nSo the answer is: No.",
}


@dataclass(frozen=True)
class Case:
    """A task: its name, what it is, and how it is run."""

    name: str
    task: str
    run: Callable[[], object]


def write_log(file: Path, texts: list[str], reference: Reference) -> None:
    """Write answers to all trials in turn, each named by its video."""
    trial_ids = islice(cycle(reference.trial_ids), len(texts))
    with file.open("w", encoding="utf-8") as stream:
        for trial_id, text in zip(trial_ids, texts, strict=True):
            record = {"video": f"videos/{trial_id}_img.mp4", "response": text}
            stream.write(json.dumps(record) + "\n")


def list_cases(file: Path, texts: list[str], reference: Reference) -> list[Case]:
    """The floor, the reader by itself, and the whole conversion."""
    convert = FORMATS["answers"].split_runs
    return [
        Case(
            "`json.loads`",
            "of each line",
            lambda: [json.loads(line) for line in file.read_bytes().splitlines()],
        ),
        Case("`parse_answer`", "of each text", lambda: [parse_answer(text) for text in texts]),
        Case(
            "`leaderboard convert answers`",
            "lines, names, texts, repeats, account",
            lambda: convert([file], reference),
        ),
    ]


def measure_seconds(run: Callable[[], object]) -> float:
    """Run a task once and return its processor time in seconds."""
    start = time.process_time()
    run()
    return time.process_time() - start


def main() -> None:
    """Print the table as Markdown; exit status 1 if the conversion takes longer than its limit."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=5)
    runs = parser.parse_args().runs
    reference = load_reference(Instance(ROOT))
    texts = list(islice(cycle(KINDS.values()), N_ANSWERS))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "answers.jsonl"
        write_log(file, texts, reference)
        size = file.stat().st_size / 1e6
        cases = list_cases(file, texts, reference)
        rounds = [[measure_seconds(case.run) for case in cases] for _ in range(runs)]
    medians = [statistics.median(seconds) for seconds in zip(*rounds, strict=True)]
    print(f"{N_ANSWERS:,} answers, {size:.0f} MB\n\n| what | of it | s | ratio |\n|---|---|---:|---:|")
    for case, seconds in zip(cases, medians, strict=True):
        print(f"| {case.name} | {case.task} | {seconds:.2f} | {seconds / medians[0]:.1f} |")
    sys.exit(0 if medians[-1] <= LIMIT else 1)


if __name__ == "__main__":
    main()
