"""Let atheris look for bytes that a parser has no answer to.

Run: python -m benchmarks.campaigns.fuzzing [--runs MILLIONS] [--only PARSER]

It needs atheris, which follows the branches that a parser takes and changes its inputs so that they reach
new ones. Each parser runs in a process of its own until its share of the executions is done or something
escapes; what did is kept as a file, whose name is printed.
"""

import argparse
import importlib.util
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# How many of a hundred executions each parser gets: slow ones fewer.
SHARES = {
    "predictions": 10,
    "metadata": 20,
    "result": 15,
    "ledger": 20,
    "trial names": 3,
    "git listing": 8,
    "logs": 2,
    "answers": 22,
}
MILLIONS = 5.0
MAX_LENGTH = 1500  # bytes of an input
SECONDS_AN_INPUT = 10

DONE = re.compile(r"Done (\d+) runs in (\d+) second")
COUNTED = re.compile(r"^#(\d+)\t", re.MULTILINE)  # so many were done when it last said something
COVERED = re.compile(r"cov: (\d+)")
KEPT = re.compile(r"Test unit written to (\S+)")


def fuzz(name: str, arguments: list[str]) -> None:
    """Fuzz one parser in this process, which ends with it."""
    atheris = importlib.import_module("atheris")  # it ships no types
    with atheris.instrument_imports(include=["leaderboard"]):
        from benchmarks.campaigns.parsers import PARSERS

    atheris.Setup([sys.argv[0], *arguments], PARSERS[name])
    atheris.Fuzz()


def write_seeds(name: str, folder: Path) -> None:
    """Give the fuzzer valid inputs to begin with."""
    from benchmarks.campaigns.parsers import SEEDS

    folder.mkdir()
    for number, seed in enumerate(SEEDS[name]):
        (folder / str(number)).write_bytes(seed)


def run(name: str, n_runs: int, folder: Path) -> bool:
    """Fuzz one parser in a process of its own, print its line, and tell whether nothing escaped."""
    write_seeds(name, folder / name)
    kept = Path(tempfile.gettempdir()) / f"escaped-{name.replace(' ', '-')}-"
    arguments = [
        f"-runs={n_runs}", f"-max_len={MAX_LENGTH}", f"-timeout={SECONDS_AN_INPUT}", "-rss_limit_mb=4096",
        f"-artifact_prefix={kept}", "-seed=1", "-print_final_stats=0", str(folder / name),
    ]  # fmt: skip
    command = [sys.executable, "-m", "benchmarks.campaigns.fuzzing", "--in-here", name, *arguments]
    started = time.perf_counter()
    found = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
    seconds = time.perf_counter() - started
    done = DONE.search(found.stderr)
    n_done = int(done[1]) if done else max(map(int, COUNTED.findall(found.stderr)), default=0)
    edges = max(map(int, COVERED.findall(found.stderr)), default=0)
    escape = KEPT.search(found.stderr)
    outcome = escape[1] if escape else "0" if found.returncode == 0 and done else "broken off"
    print(f"| {name} | {n_done:,} | {seconds:.0f} | {edges:,} | {outcome} |", flush=True)
    if outcome != "0":
        print(found.stderr[-3000:], file=sys.stderr)
    return outcome == "0"


def main() -> None:
    """Fuzz every parser and print the table; exit status 1 if anything escaped."""
    if sys.argv[1:2] == ["--in-here"]:
        fuzz(sys.argv[2], sys.argv[3:])
        return
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--runs", type=float, default=MILLIONS, metavar="MILLIONS")
    parser.add_argument("--only", choices=sorted(SHARES))
    options = parser.parse_args()
    if importlib.util.find_spec("atheris") is None:
        sys.exit("atheris is not installed, so nothing was fuzzed: pip install -e '.[campaign]'")
    print("| parser | executions | seconds | edges covered | escapes |\n|---|---:|---:|---:|---:|")
    names = [options.only] if options.only else list(SHARES)
    with tempfile.TemporaryDirectory() as folder:
        fine = [run(name, int(options.runs * 1e4 * SHARES[name]), Path(folder)) for name in names]
    sys.exit(0 if all(fine) else 1)


if __name__ == "__main__":
    main()
