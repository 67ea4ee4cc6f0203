"""Measure what building the site costs, beside a plain Jinja render of the same bytes.

Run: python -m benchmarks.building [SUBMISSIONS ...]

Boards of 20, 100 and 1,000 simulated submissions without an argument, on this repository's reference. Each is
built in a process of its own, from graded submissions to files on disk, with one thread for matrix products,
as the command has it. Times are processor time, because other work of the machine does not count in it. The
floor prints the same text files from ready-made lines, by a template that does nothing else. Exit status 1 if
a limit is exceeded.
"""

import argparse
import multiprocessing
import os
import pickle
import resource
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from jinja2 import Template

from benchmarks.site_checks import ROOT, simulate_publications
from leaderboard.instance import Instance
from leaderboard.reference import load_reference
from leaderboard.website.building import compose_pages, render_site
from leaderboard.website.material import gather
from leaderboard.website.replacing import replace_site
from leaderboard.website.stamps import is_current

T = TypeVar("T")

SIZES = (20, 100, 1_000)
SECONDS = {20: 3.0, 100: 10.0, 1_000: 90.0}  # of processor time
MEMORY_LIMIT = 1_000  # MB
SIZE_LIMIT = 500  # MB on disk; what publishes it takes 1 GB
AGAIN_LIMIT = 0.1  # of the first build, where nothing has changed

INPUTS = "simulated"
TEXTS = (".html", ".svg", ".json", ".csv", ".xml", ".js", ".css")
FLOOR = Template("{% for line in lines %}{{ line }}{% endfor %}", keep_trailing_newline=True)

STEPS = ("gather", "compose", "print", "write")
HEADINGS = (
    *("submissions", *STEPS, "all, s", "limit", "floor, s", "ratio", "again, s"),
    *("files", "MB", "peak memory, MB", "within?"),
)


class Watch:
    """Adds up processor time by what it was spent on."""

    def __init__(self) -> None:
        self.seconds: defaultdict[str, float] = defaultdict(float)

    @contextmanager
    def running(self, name: str) -> Iterator[None]:
        """Add the time of a block."""
        start = time.process_time()
        yield
        self.seconds[name] += time.process_time() - start

    def follow(self, name: str, items: Iterable[T]) -> Iterator[T]:
        """Add the time that making items takes, not that of using them."""
        start = time.process_time()
        for item in items:
            self.seconds[name] += time.process_time() - start
            yield item
            start = time.process_time()
        self.seconds[name] += time.process_time() - start


@dataclass(frozen=True)
class Cost:
    """What one build took: seconds by step, files, their bytes, and the process's peak of memory in MB."""

    n: int
    seconds: dict[str, float]
    n_files: int
    n_bytes: int
    memory: float

    @property
    def total(self) -> float:
        """Seconds of all steps."""
        return sum(self.seconds[step] for step in STEPS)

    @property
    def is_within(self) -> bool:
        """Whether it keeps every limit."""
        return (
            self.total <= SECONDS.get(self.n, self.total)
            and self.memory <= MEMORY_LIMIT
            and self.n_bytes <= 1e6 * SIZE_LIMIT
            and self.seconds["again"] <= AGAIN_LIMIT * self.total
        )


def main() -> int:
    """Print a table as Markdown; exit status 1 if a limit is exceeded."""
    parser = argparse.ArgumentParser(description="Measure what building the site costs.")
    parser.add_argument("submissions", type=int, nargs="*", default=SIZES)
    print("|", " | ".join(HEADINGS), "|")
    print("|" + "---:|" * len(HEADINGS))
    costs = []
    for n in parser.parse_args().submissions:
        costs.append(measure_size(n))
        print("|", " | ".join(show(costs[-1])), "|", flush=True)
    return 0 if all(cost.is_within for cost in costs) else 1


def show(cost: Cost) -> list[str]:
    """Print the cells of a row."""
    limit = f"{SECONDS[cost.n]:g}" if cost.n in SECONDS else ""
    floor = cost.seconds["floor"]
    return [
        *(f"{cost.n:,}", *(f"{cost.seconds[step]:.1f}" for step in STEPS), f"{cost.total:.1f}", limit),
        *(f"{floor:.2f}", f"{cost.total / floor:.0f}", f"{cost.seconds['again']:.2f}"),
        *(f"{cost.n_files:,}", f"{cost.n_bytes / 1e6:,.0f}", f"{cost.memory:,.0f}"),
        "yes" if cost.is_within else "no",
    ]


def measure_size(n: int) -> Cost:
    """Grade here, build in a fresh process, so that its memory is that of building alone."""
    reference = load_reference(Instance(ROOT))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        (folder / "graded").write_bytes(pickle.dumps(list(simulate_publications(reference, n))))
        os.environ["OPENBLAS_NUM_THREADS"] = "1"
        with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
            return pool.submit(measure_build, folder, n).result()


def measure_build(folder: Path, n: int) -> Cost:
    """Build the site of graded submissions into a folder, and look whether it is current."""
    watch, sizes = Watch(), list[int]()
    reference = load_reference(Instance(ROOT))
    publications = pickle.loads((folder / "graded").read_bytes())  # noqa: S301 - written above
    site = folder / "site"
    with watch.running("all"):
        with watch.running("gather"):
            material = gather(reference, publications)
        pages = watch.follow("compose", compose_pages(material))
        files = watch.follow("print and compose", render_site(material, pages))
        replace_site(site, compare_with_floor(files, watch, sizes), INPUTS)
    with watch.running("again"):
        if not is_current(site, INPUTS):
            raise ValueError("the site is not what was written")
    spent = watch.seconds
    spent["print"] = spent["print and compose"] - spent["compose"]
    spent["write"] = spent["all"] - spent["gather"] - spent["print and compose"] - spent["comparing"]
    return Cost(n, dict(spent), len(sizes), sum(sizes), read_peak_memory())


def compare_with_floor(
    files: Iterable[tuple[str, bytes]], watch: Watch, sizes: list[int]
) -> Iterator[tuple[str, bytes]]:
    """Pass files on, and print the same text from its lines by a template that does nothing else."""
    for path, content in files:
        with watch.running("comparing"):
            sizes.append(len(content))
            if path.endswith(TEXTS):
                lines = content.decode().splitlines(keepends=True)
                with watch.running("floor"):
                    printed = FLOOR.render(lines=lines).encode()
                if printed != content:
                    raise ValueError(f"{path} is not printed as it is")
        yield path, content


def read_peak_memory() -> float:
    """Most memory that this process has held so far, in MB; the system counts in kB, macOS in bytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1e6 if sys.platform == "darwin" else 1e3)


if __name__ == "__main__":
    sys.exit(main())
