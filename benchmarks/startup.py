"""Measure how long commands take beside the bare imports that they cannot do without.

Run with `python benchmarks/startup.py`. Each command and its floor run in turn in fresh processes; the ratio
of medians is what counts, since both were measured on the same machine in the same minute.
"""

import argparse
import os
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SUBMISSION = "submissions/example-slots"

CLICK = "import click"
LIBRARIES = "import click, numpy, pydantic"


@dataclass(frozen=True)
class Case:
    """A command, the imports it is compared with, and the ratio it may not exceed."""

    arguments: tuple[str, ...]
    floor: str
    limit: float


CASES = (
    Case(("--help",), CLICK, 3),
    Case(("validate", SUBMISSION), LIBRARIES, 2),
    Case(("grade", "--check", SUBMISSION), LIBRARIES, 4),
)


def measure_seconds(command: list[str]) -> float:
    """Run a command once and return its wall time in seconds."""
    # As installed: with bytecode written at the first run, whatever the shell that measures says.
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONDONTWRITEBYTECODE"}
    start = time.perf_counter()
    subprocess.run(command, cwd=ROOT, env=environment, check=True, capture_output=True)
    return time.perf_counter() - start


def measure_case(case: Case, runs: int) -> tuple[float, float]:
    """Return the median seconds of the command and of its floor, measured in turn."""
    command = [str(Path(sys.executable).parent / "leaderboard"), *case.arguments]
    floor = [sys.executable, "-c", case.floor]
    for warm_up in (command, floor):
        measure_seconds(warm_up)
    pairs = [(measure_seconds(command), measure_seconds(floor)) for _ in range(runs)]
    return statistics.median(c for c, _ in pairs), statistics.median(f for _, f in pairs)


def main() -> None:
    """Print the table as Markdown; exit status 1 if a ratio exceeds its limit."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=15)
    runs = parser.parse_args().runs
    print("| command | ms | floor | ms | ratio | limit |\n|---|---:|---|---:|---:|---:|")
    is_within = True
    for case in CASES:
        seconds, floor = measure_case(case, runs)
        ratio = seconds / floor
        is_within = is_within and ratio <= case.limit
        name = " ".join(("leaderboard", *case.arguments))
        milliseconds = f"{1000 * seconds:.0f} | `{case.floor}` | {1000 * floor:.0f}"
        print(f"| `{name}` | {milliseconds} | {ratio:.2f} | {case.limit:g} |")
    sys.exit(0 if is_within else 1)


if __name__ == "__main__":
    main()
