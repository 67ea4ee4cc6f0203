"""Kill `leaderboard reference fetch` at random moments and look at what it leaves.

Run: python benchmarks/kills.py [KILLS]

A stand-in of the release is served on this machine in two versions; each run replaces one by the other and is
killed at a random moment. Afterwards the reference must be one of the two, bit for bit, and the next run that
is let alone must succeed.
"""

import os
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(REPOSITORY / "tests"))

from release_server import ReleaseServer  # noqa: E402  (the tests' folder comes first)
from release_stand_in import Release  # noqa: E402

KILLS = 200
SEED = 20231105


def command(root: Path, server: ReleaseServer) -> list[str]:
    """Name the command that replaces whatever is there."""
    program = Path(sys.executable).with_name("leaderboard")
    return [
        str(program), "--root", str(root), "reference", "fetch", "physionpp",
        "--mirror", server.address, "--accept-change",
    ]  # fmt: skip


def snapshot(root: Path) -> dict[str, bytes]:
    """Read the reference, whatever is there of it."""
    return {file.name: file.read_bytes() for file in sorted((root / "reference").iterdir())}


def serve(server: ReleaseServer, archives: tuple[Path, Path]) -> None:
    """Put a version of the release on the server."""
    server.files.update({f"/{archive.name}": archive for archive in archives})


def run_until(arguments: list[str], moment: float, environment: dict[str, str]) -> bool:
    """Run a command and kill it after some seconds; tell whether it was still at work."""
    process = subprocess.Popen(
        arguments, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        process.wait(moment)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        return True
    return False


def main() -> None:
    """Kill, look, and print what was found."""
    n_kills = int(sys.argv[1]) if len(sys.argv) > 1 else KILLS
    rng = random.Random(SEED)  # noqa: S311  (moments, not secrets)
    found: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as name, ReleaseServer({}) as server:
        folder, root = Path(name), Path(name) / "instance"
        environment = os.environ | {"XDG_CACHE_HOME": str(folder / "cache")}
        versions = [Release(seed=seed).write_zips(folder / str(seed)) for seed in (0, 1)]
        known, arguments, duration = [], command(root, server), 0.0
        for archives in versions:
            serve(server, archives)
            started = time.perf_counter()
            subprocess.run(arguments, env=environment, check=True, capture_output=True)
            duration = time.perf_counter() - started
            known.append(snapshot(root))
        while found["killed"] < n_kills:
            current = known.index(snapshot(root))
            serve(server, versions[1 - current])
            if not run_until(arguments, rng.uniform(0, 1.1 * duration), environment):
                found["done before it was killed"] += 1
                continue
            found["killed"] += 1
            left = snapshot(root)
            state = "the old reference" if left == known[current] else "the new reference"
            found[state if left in known else "something else"] += 1
        subprocess.run(arguments, env=environment, check=True, capture_output=True)
        found["later run succeeded"] = int(snapshot(root) in known)
        leftovers = [path.name for path in root.iterdir() if path.name.startswith(".tmp-")]
        found["leftovers after it"] = len(leftovers)
    print("| outcome | times |\n|---|---:|")
    for outcome, times in sorted(found.items()):
        print(f"| {outcome} | {times} |")
    sys.exit(1 if found["something else"] else 0)


if __name__ == "__main__":
    main()
