"""Installs references in processes that are killed, one moment after the other; a program of its own.

Use it so::

    python tests/killed_installs.py FOLDER replaced

Each process is killed right before one of the things that it asks of the file system: the first process
before the first, the next before the second, until one lives to its end. For each of them a line of JSON says
what was found then, and what after a later install.
"""

import errno
import json
import os
import shutil
import signal
import sys
from pathlib import Path

from leaderboard import files
from leaderboard.errors import InstanceError
from leaderboard.files import csv_text
from leaderboard.instance import BENCHMARK_FILE, Instance
from leaderboard.reference.installing import install_reference
from reference_folders import DEFINITION, HEADERS, sound_rows

FLUSH = "flush"  # ours; the others are what Python tells auditors before it is done
WATCHED = frozenset(
    {"open", "os.mkdir", "os.rename", "os.remove", "os.rmdir", "os.scandir", "os.listdir", "fcntl.flock"}
    | {"ctypes.dlopen", "ctypes.dlsym", FLUSH}
)


def contents(title: str) -> dict[str, bytes]:
    """Make the files of a reference that is told from others by its title."""
    tables = {name: csv_text(HEADERS[name], rows).encode() for name, rows in sound_rows().items()}
    return {BENCHMARK_FILE: DEFINITION.replace("Tiny", title).encode()} | tables


def install(instance: Instance, title: str) -> None:
    install_reference(instance, contents(title), "official", sources=[])


def snapshot(folder: Path) -> dict[str, bytes]:
    """Read everything below a folder; folders count as empty."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() if path.is_file() else b""
        for path in folder.rglob("*")
    }


def die_at(moment: int) -> None:
    """Let this process be killed before it does what it will do then."""
    n_seen = 0

    def notice(event: str, _arguments: object = None) -> None:
        nonlocal n_seen
        if event in WATCHED:
            if n_seen == moment:
                os.kill(os.getpid(), signal.SIGKILL)
            n_seen += 1

    sys.addaudithook(notice)


def is_killed(instance: Instance, moment: int) -> bool:
    """Install in a process of its own, and tell whether it was killed."""
    child = os.fork()
    if child == 0:
        die_at(moment)
        install(instance, "New")
        os._exit(0)
    _, status = os.waitpid(child, 0)
    if os.WIFEXITED(status) and os.WEXITSTATUS(status) != 0:
        raise RuntimeError(f"the install failed at moment {moment}")
    return os.WIFSIGNALED(status)


def tell_flush(fd: object) -> None:
    """Flush nothing: what a killed process has written is not lost."""
    del fd
    sys.audit(FLUSH)


def refuse_exchange(first: Path, second: Path) -> None:
    del second
    raise OSError(errno.EINVAL, os.strerror(errno.EINVAL), str(first))


class Bench:
    """A place for an instance, and what whole references look like."""

    def __init__(self, root: Path, before: str) -> None:
        self.instance = Instance(root)
        self._before = before
        self._whole: dict[str, dict[str, bytes]] = {}
        for title in ("Old", "New"):
            install(self.instance, title)
            self._whole[title] = snapshot(self.instance.reference_dir)

    def reset(self) -> None:
        """Make what is there before each install."""
        if self._before in {"new", "bare"}:
            shutil.rmtree(self.instance.root)
        if self._before == "bare":
            self.instance.root.mkdir()

    def found(self) -> str:
        """Say which reference is there, to the last byte."""
        if not self.instance.reference_dir.exists():
            return "none"
        there = snapshot(self.instance.reference_dir)
        return next((title for title, whole in self._whole.items() if there == whole), "a mixture")

    def names(self) -> list[str]:
        """List what is in the instance and beside it, leftovers by the beginning of their names."""
        listed = [*self.instance.root.parent.iterdir()]
        listed += self.instance.root.iterdir() if self.instance.root.exists() else []
        return sorted({path.name[: len(".tmp-reference-")] for path in listed})

    def later(self) -> str:
        """Install once more, and tell what it said if it stopped."""
        try:
            install(self.instance, "Old")
        except InstanceError as error:
            return error.message.removeprefix(f"{self.instance.reference_dir}: ")
        return ""


def sweep(root: Path, before: str) -> None:
    """Kill an install at every moment."""
    os.fsync = tell_flush
    if before == "renamed":
        files._exchange = refuse_exchange
    bench = Bench(root, before)
    bench.later()
    moment, was_killed = 0, True
    while was_killed:
        bench.reset()
        was_killed = is_killed(bench.instance, moment)
        record = {"found": bench.found(), "names": bench.names(), "said": bench.later()}
        if record["said"]:
            record["put back"] = bench.found()
            bench.later()
        record |= {"later": bench.found(), "later names": bench.names()}
        sys.stdout.write(json.dumps(record) + "\n")
        sys.stdout.flush()  # or the next process would have it too
        moment += 1


if __name__ == "__main__":
    sweep(Path(sys.argv[1]), sys.argv[2])
