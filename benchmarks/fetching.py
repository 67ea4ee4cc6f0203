"""Measure what it takes to get the lists of test trials out of an archive of four gigabytes on a server.

Run with `python benchmarks/fetching.py`. The archive is the one of the tests' stand-in of the release, with
the official number of trials; most of its bytes are holes, so that it takes hardly any disk. It is served on
this machine, so that seconds are those of programs alone; what a line of 100 Mbit/s would add is beside them.
"""

import argparse
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import requests
from remotezip import RemoteZip

from leaderboard.reference.fetching import RemoteArchive
from leaderboard.reference.fetching.fetcher import fetch_source_files
from leaderboard.reference.source_archives import is_junk

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from release_server import ReleaseServer  # noqa: E402  (the tests' folder comes first)
from release_stand_in import SPARSE_SIZE, Release  # noqa: E402

PATH = "/test_data.zip"
BYTES_LIMIT = 2_000_000
SECONDS_LIMIT = 5.0
LINE = 100e6 / 8  # bytes per second
CHUNK = 1_000_000

Contents = dict[str, bytes]


@dataclass(frozen=True)
class Contender:
    """A way to get the lists: what it is called, what it did, and a function of the URL that does it."""

    name: str
    task: str
    run: Callable[[str], Contents]


@dataclass(frozen=True)
class Cost:
    """What a way cost: requests and bytes by the server's count, and seconds."""

    n_requests: int
    n_bytes: int
    seconds: float


def is_list(name: str) -> bool:
    """Tell whether a member is a list of trials."""
    return name.endswith(".csv") and not is_junk(name)


def fetch_ours(url: str) -> Contents:
    """Fetch as `leaderboard reference fetch` does."""
    remote = RemoteArchive("lists of test trials", url, is_list, is_large=True)
    with tempfile.TemporaryDirectory() as cache:
        fetched = fetch_source_files([remote], cache=Path(cache))
    return {file.name: file.content for file in fetched.files}


def fetch_by_library(url: str) -> Contents:
    """Read the same members with the library alone."""
    with RemoteZip(url) as archive:
        return {name: archive.read(name) for name in archive.namelist() if is_list(name)}


def download_whole(url: str) -> Contents:
    """Transfer the whole archive and count its bytes, without writing them anywhere."""
    with requests.get(url, stream=True, timeout=60) as answer:
        n_bytes = sum(len(piece) for piece in answer.iter_content(CHUNK))
    if n_bytes != int(answer.headers["Content-Length"]):
        raise SystemExit(f"the download broke off after {n_bytes:,} bytes")
    return {}


CONTENDERS = (
    Contender("this project", "the lists by ranges, all of one version, checked", fetch_ours),
    Contender(f"remotezip {version('remotezip')}", "the lists by ranges", fetch_by_library),
    Contender(f"requests {version('requests')}", "the whole archive, counted and not kept", download_whole),
)


def measure_contender(contender: Contender, release: Release, server: ReleaseServer, runs: int) -> Cost:
    """Let one get the lists some times; stop if they are not the stand-in's."""
    wanted = set(release.list_files.values())
    times = []
    for _ in range(runs):
        server.requests.clear()
        server.bytes_sent.clear()
        start = time.perf_counter()
        found = contender.run(server.url(PATH))
        times.append(time.perf_counter() - start)
        if found and not wanted <= set(found.values()):
            raise SystemExit(f"{contender.name} did not find the lists")
    return Cost(server.requests[PATH], server.bytes_sent[PATH], statistics.median(times))


def print_costs(costs: Sequence[Cost]) -> None:
    """Print the table as Markdown."""
    print("| way | what it did | requests | bytes transferred | s | s more on a line of 100 Mbit/s |")
    print("|---|---|---:|---:|---:|---:|")
    for contender, cost in zip(CONTENDERS, costs, strict=True):
        numbers = f"{cost.n_requests} | {cost.n_bytes:,} | {cost.seconds:.3f} | {cost.n_bytes / LINE:,.2f}"
        print(f"| {contender.name} | {contender.task} | {numbers} |")


def main() -> None:
    """Print the costs of all ways; exit status 1 if this project's exceed a limit."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--runs", type=int, default=5, help="of each way; the whole archive comes once")
    runs = parser.parse_args().runs
    release = Release(has_all_media=True)
    with tempfile.TemporaryDirectory() as folder:
        test_zip, _ = release.write_zips(Path(folder), sparse_size=SPARSE_SIZE)
        with ReleaseServer({PATH: test_zip}) as server:
            costs = [
                measure_contender(contender, release, server, 1 if contender.run is download_whole else runs)
                for contender in CONTENDERS
            ]
    print_costs(costs)
    ours = costs[0]
    is_within = ours.n_bytes < BYTES_LIMIT and ours.seconds <= SECONDS_LIMIT
    limits = f"less than {BYTES_LIMIT:,} bytes and at most {SECONDS_LIMIT:g} s"
    print(f"\nLimits of this project: {limits}; within? {'yes' if is_within else 'no'}.")
    sys.exit(0 if is_within else 1)


if __name__ == "__main__":
    main()
