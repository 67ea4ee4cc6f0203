"""Let every system call that writes fail once, as on a full or a broken disk, and look at what is left.

Run: python -m benchmarks.campaigns.failing_calls [--only COMMAND] [--every N]

It needs strace, which answers a chosen call with an error instead of handing it to the system. A first run
of a command tells which calls it makes; then it runs once for each of them and each error. Afterwards every
file must be as before or as after the command, a failure must be told in plain words, and the same command,
let alone, must do its work. All of it happens below a temporary folder.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from benchmarks.campaigns.scenes import Scene, find_torn, heals, lay, make_scenes, read_files

OPENING = ("open", "openat", "creat")
WRITING = (
    *("write", "pwrite64", "writev", "pwritev", "fsync", "fdatasync", "sync_file_range", "ftruncate"),
    *("rename", "renameat", "renameat2", "link", "linkat", "symlink", "symlinkat", "mkdir", "mkdirat"),
    *("fchmod", "fchmodat", "chmod", "unlink", "unlinkat", "rmdir", "copy_file_range", "sendfile", "mknod"),
)
ERRORS = ("ENOSPC", "EIO")
PLAIN_END = re.compile(r"^error: .+$", re.MULTILINE)

CALL = re.compile(r"^(?P<process>\d+) +(?P<call>\w+)\((?P<rest>.*)$")
FOR_WRITING = re.compile(r"O_(?:WRONLY|RDWR|CREAT)")
INJECTED = "(INJECTED)"


@dataclass(frozen=True)
class Target:
    """The n-th time that a command makes a system call."""

    call: str
    number: int


@dataclass(frozen=True)
class Stage:
    """Where commands run: the instance, and a file for what strace notes."""

    root: Path
    log: Path

    def trace(self, scene: Scene, *options: str) -> subprocess.CompletedProcess[str]:
        """Run a scene's command from its beginning under strace."""
        lay(self.root, scene.before)
        program = Path(sys.executable).with_name("leaderboard")
        calls = ",".join(f"?{name}" for name in (*OPENING, *WRITING))
        command = ["strace", "-f", "-y", "-o", str(self.log), "-e", f"trace={calls}", *options]
        environment = {**os.environ, "PYTHONHASHSEED": "0", "OPENBLAS_NUM_THREADS": "1"}
        return subprocess.run(
            [*command, str(program), "--root", str(self.root), *scene.arguments],
            env=environment, capture_output=True, text=True, errors="replace", check=False,
        )  # fmt: skip

    def list_targets(self) -> Iterator[Target]:
        """List what the last run wrote: below the instance, and to its standard output.

        strace counts the calls of each process by themselves; git, which tells the history, only reads.
        """
        numbers: Counter[str] = Counter()
        first = ""
        for line in self.log.read_text(errors="replace").splitlines():
            found = CALL.match(line)
            first = first or (found["process"] if found else "")
            if found is None or found["process"] != first:
                continue
            numbers[found["call"]] += 1
            is_open = found["call"] in OPENING
            if is_open and not FOR_WRITING.search(found["rest"]):
                continue
            if str(self.root) in found["rest"] or (not is_open and found["rest"].startswith("1<")):
                yield Target(found["call"], numbers[found["call"]])

    def missed(self) -> bool:
        """Tell whether the last run never came to the call that was to fail."""
        return INJECTED not in self.log.read_text(errors="replace")


def judge(stage: Stage, scene: Scene, target: Target, error: str) -> list[str]:
    """Let one call fail, and say what is wrong with what it leaves."""
    inject = f"inject={target.call}:error={error}:when={target.number}"
    done = stage.trace(scene, "-e", inject)
    found, faults = read_files(stage.root), []
    if stage.missed():
        faults.append("never came to that call")
    if "Traceback" in done.stderr + done.stdout:
        faults.append("a traceback")
    if done.returncode == 0 and found != scene.after:
        faults.append("success was told, and something is missing")
    if done.returncode and not PLAIN_END.search(done.stderr):
        faults.append(f"exit status {done.returncode} without a word")
    faults += [f"torn: {name}" for name in find_torn(scene, found)]
    if not heals(stage.root, scene):
        faults.append("the next run did not mend it")
    return faults


def sweep(stage: Stage, name: str, scene: Scene, every: int) -> int:
    """Let each of a command's calls fail with each error, print its line, and count the faults."""
    stage.trace(scene)  # what Python compiles when it first runs
    stage.trace(scene)
    targets = list(stage.list_targets())[::every]
    n_faults = 0
    for target in targets:
        for error in ERRORS:
            faults = judge(stage, scene, target, error)
            n_faults += len(faults)
            for fault in faults:
                print(f"{name}: {target.call} number {target.number}, {error}: {fault}", file=sys.stderr)
    kinds = ", ".join(f"{call} {n}" for call, n in sorted(Counter(t.call for t in targets).items()))
    n_runs = len(targets) * len(ERRORS)
    print(f"| {name} | {len(targets)} | {kinds} | {n_runs} | {n_faults} |", flush=True)
    return n_faults


def main() -> None:
    """Let all fail and print the table; exit status 1 if anything was lost, torn or untold."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--only", help="one command instead of all")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="only each N-th call")
    options = parser.parse_args()
    if shutil.which("strace") is None:
        sys.exit("strace is not installed, so no call was made to fail: apt-get install strace")
    print("| command | calls that write | which | runs | faults |\n|---|---:|---|---:|---:|")
    n_faults = 0
    with tempfile.TemporaryDirectory() as name:
        stage = Stage(Path(name) / "instance", Path(name) / "strace.log")
        for command, scene in make_scenes(stage.root).items():
            if options.only in (None, command):
                n_faults += sweep(stage, command, scene, options.every)
    sys.exit(1 if n_faults else 0)


if __name__ == "__main__":
    main()
