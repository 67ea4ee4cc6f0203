"""Kill commands that write at random moments and look at what they leave.

Run: python -m benchmarks.campaigns.kills [KILLS]

`grade`, `submit`, `ledger update` and `baselines` get the same share of the kills. Each runs in a process
that is forked with everything loaded, so that the moments fall on its work and not on imports. After each
kill every file must be as before or as after the command, to the last byte, and the same command, let alone,
must do its work and leave nothing half-written behind. (`benchmarks/kills.py` does this to the import of a
reference.)
"""

import os
import random
import signal
import statistics
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from benchmarks.campaigns.scenes import (
    Scene,
    count_leftovers,
    find_torn,
    heals,
    lay,
    make_scenes,
    read_files,
    run_quietly,
    start_quietly,
)

KILLS = 2000
SEED = 20231105
REHEARSALS = 5


def measure(root: Path, scene: Scene) -> float:
    """Return how many seconds the command takes when it is let alone."""
    seconds = []
    for _ in range(REHEARSALS):
        lay(root, scene.before)
        started = time.perf_counter()
        run_quietly(root, scene.arguments)
        seconds.append(time.perf_counter() - started)
    return statistics.median(seconds)


def is_killed(root: Path, scene: Scene, moment: float) -> bool:
    """Run the command, kill it after some seconds, and tell whether it was still at work."""
    lay(root, scene.before)
    child = start_quietly(root, scene.arguments)
    time.sleep(moment)
    os.kill(child, signal.SIGKILL)
    return os.WIFSIGNALED(os.waitpid(child, 0)[1])


def judge(root: Path, scene: Scene, found: Counter[str]) -> None:
    """Count what a killed command left, and what the next one made of it."""
    files = read_files(root)
    found["killed"] += 1
    torn = find_torn(scene, files)
    found["torn"] += len(torn)
    found["old"] += files == scene.before
    found["new"] += files == scene.after
    found["left over"] += count_leftovers(root) > 0
    found["not healed"] += not heals(root, scene)
    if torn:
        print(f"torn: {', '.join(torn)}", file=sys.stderr)


def sweep(root: Path, scene: Scene, n_kills: int, rng: random.Random) -> Counter[str]:
    """Kill a command so many times."""
    found: Counter[str] = Counter()
    duration = measure(root, scene)
    while found["killed"] < n_kills:
        if is_killed(root, scene, rng.uniform(0, 1.05 * duration)):
            judge(root, scene, found)
    return found


def main() -> None:
    """Kill, look, and print what was found; exit status 1 if anything was torn or did not heal."""
    n_kills = int(sys.argv[1]) if len(sys.argv) > 1 else KILLS
    rng = random.Random(SEED)  # noqa: S311  (moments, not secrets)
    columns = ("killed", "torn", "old", "new", "left over", "not healed")
    print("| command | kills | torn files | all old | all new | leftovers | not healed |")
    print("|---|---:|---:|---:|---:|---:|---:|")
    n_faults = 0
    with tempfile.TemporaryDirectory() as name:
        root = Path(name) / "instance"
        scenes = make_scenes(root)
        for command, scene in scenes.items():
            found = sweep(root, scene, n_kills // len(scenes), rng)
            n_faults += found["torn"] + found["not healed"]
            print(f"| {command} | {' | '.join(f'{found[column]:,}' for column in columns)} |", flush=True)
    sys.exit(1 if n_faults else 0)


if __name__ == "__main__":
    main()
