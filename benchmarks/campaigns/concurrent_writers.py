"""Let many processes write into one instance at the same time and look for what was lost.

Run: python -m benchmarks.campaigns.concurrent_writers [WRITERS] [ROUNDS]

In each round a writer makes a submission of its own, and one that all of them want; it grades its own, and
one that all of them grade; it brings the ledger up to date, and in some rounds the baselines. Afterwards
every submission that a command said it had made must be there, with a line in the ledger and a result that
equals a fresh grade; of those that all wanted, exactly one writer may have been told that it made it.
"""

import argparse
import datetime as dt
import json
import os
import sys
import tempfile
from collections import Counter
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path

from benchmarks.campaigns.scenes import (
    DATE,
    count_leftovers,
    make_instance,
    prepare,
    run_command,
    submit_arguments,
)
from leaderboard.instance import Instance
from leaderboard.recording import check_ledger
from leaderboard.verifying import verify_instance

WRITERS, ROUNDS = 8, 50
BASELINES_EVERY = 10
TODAY = dt.date(2026, 5, 21)
SHARED = "shared"
NOT_FIRST = ("exists", "there is a submission")


def write(root: Path, writer: int, n_rounds: int, record: Path) -> None:
    """Be one writer: run the commands of each round and record the exit status and the words of each."""
    said = []
    for number in range(n_rounds):
        own = f"writer-{writer}-{number}"
        commands = [
            ("submit", own, submit_arguments(root, own)),
            ("contested", f"contested-{number}", submit_arguments(root, f"contested-{number}")),
            ("grade", own, ("grade", str(root / "submissions" / own))),
            ("grade", SHARED, ("grade", str(root / "submissions" / SHARED))),
            ("ledger", own, ("ledger", "update", *DATE)),
        ]
        if number % BASELINES_EVERY == 0:
            commands.append(("baselines", "", ("baselines", *DATE)))
        for kind, slug, arguments in commands:
            output = StringIO()
            with redirect_stdout(output), redirect_stderr(output):
                status = run_command(root, arguments)
            said.append((kind, slug, status, "" if status == 0 else output.getvalue()))
    record.write_text(json.dumps(said))


def run_writers(folder: Path, root: Path, n_writers: int, n_rounds: int) -> list[tuple[str, str, int, str]]:
    """Let all writers run at once; return what their commands said."""
    records = [folder / f"writer-{writer}.json" for writer in range(n_writers)]
    children = []
    for writer, record in enumerate(records):
        child = os.fork()
        if child == 0:
            write(root, writer, n_rounds, record)
            os._exit(0)
        children.append(child)
    for child in children:
        os.waitpid(child, 0)
    return [tuple(said) for record in records if record.exists() for said in json.loads(record.read_text())]


def find_faults(root: Path, said: list[tuple[str, str, int, str]]) -> list[str]:
    """Compare what commands said with what is there."""
    instance = Instance(root)
    faults = [
        f"{kind} {slug}: {output.strip()[-300:]}"
        for kind, slug, status, output in said
        if status and not (kind == "contested" and any(words in output for words in NOT_FIRST))
    ]
    made = Counter(slug for kind, slug, status, _ in said if kind in {"submit", "contested"} and status == 0)
    wanted = {slug for kind, slug, _, _ in said if kind in {"submit", "contested"}}
    faults += [
        f"{slug}: {made[slug]} writers were told that they made it" for slug in wanted if made[slug] != 1
    ]
    there = {folder.name for folder in instance.submission_dirs()}
    faults += [f"{slug} is lost" for slug in sorted(wanted - there)]
    check = check_ledger(instance, None)
    faults += [f"{problem.file}: {problem.message}" for problem in check.problems]
    recorded = set(check.ledger.latest) if check.ledger else set()
    faults += [f"{slug} has no line in the ledger" for slug in sorted(there - recorded)]
    verification = verify_instance(instance, today=TODAY)
    faults += [f"{v.slug}: {v.differences[0]}" for v in verification.verdicts if v.differences]
    return faults + [f"{stray} is a stray" for stray in verification.strays]


def main() -> None:
    """Let them write and print what was found; exit status 1 if anything was lost."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("writers", type=int, nargs="?", default=WRITERS)
    parser.add_argument("rounds", type=int, nargs="?", default=ROUNDS)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder, root = Path(name), Path(name) / "instance"
        make_instance(root)
        prepare(root, submit_arguments(root, SHARED))
        said = run_writers(folder, root, options.writers, options.rounds)
        prepare(root, ("ledger", "update", *DATE))
        faults = find_faults(root, said)
        n_leftovers = count_leftovers(root)
    counts = Counter((kind, "done" if status == 0 else "refused") for kind, _, status, _ in said)
    print("| command | done | refused |\n|---|---:|---:|")
    for kind in sorted({kind for kind, _ in counts}):
        print(f"| {kind} | {counts[kind, 'done']:,} | {counts[kind, 'refused']:,} |")
    print(f"| lost, torn or unclear | {len(faults)} | |\n| leftovers | {n_leftovers} | |")
    for fault in faults:
        print(fault, file=sys.stderr)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
