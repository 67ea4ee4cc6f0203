"""Measure sorting and finding on a board in Chromium: 200 rows in the page, and 10,000 of them as data.

Run: python -m benchmarks.browsing [ROWS ...]

The rows are simulated beside this repository's own board. A change is timed in the page from before it until
the layout is done, as wall time and as processor time of the page's thread, which is what counts on a busy
machine; medians of several runs. Exit status 1 if a limit is exceeded in processor time.
"""

import argparse
import statistics
import sys
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from playwright.sync_api import CDPSession, Page, sync_playwright

from leaderboard.grading import find_metric
from leaderboard.instance import Instance
from leaderboard.models import Score
from leaderboard.reference import load_reference
from leaderboard.website.board_pages import BoardPage, BoardRow, Traits
from leaderboard.website.board_parts import split_board
from leaderboard.website.boards import compose_board
from leaderboard.website.material import gather, load_publications
from leaderboard.website.numbers import EN_DASH, Footnotes
from leaderboard.website.pages import Cell
from leaderboard.website.quantities import OF_BOARDS, Described
from leaderboard.website.rendering import frame_of, render_assets, render_page

ROOT = Path(__file__).resolve().parent.parent
CHROMIUM = "/usr/bin/chromium"
FLAGS = ("--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run")
SIZES = (200, 10_000)
RUNS = 7
SEED = 20231105
FAMILIES = ("video", "vlm", "object-centric")

SORT_LIMITS = ((200, 150), (10_000, 300))
"""Milliseconds for a sort or a search, by the largest number of rows that they are for."""

USABLE_LIMIT = 1_000
"""Milliseconds until the board can be used."""

CHANGES = {
    "sort": ("th[data-key='accuracy.overall'] button", "th[data-key='human_r.overall'] button"),
    "find": ("system 1", ""),
}
CLICK = """(found) => {
  const start = performance.now();
  document.querySelector(found).click();
  document.querySelector("table.board").getBoundingClientRect();
  return performance.now() - start;
}"""
TYPE = """(text) => {
  const start = performance.now();
  const field = document.querySelector(".field input[type=search]");
  field.value = text;
  field.dispatchEvent(new Event("input"));
  document.querySelector("table.board").getBoundingClientRect();
  return performance.now() - start;
}"""
USABLE = "() => performance.getEntriesByType('navigation')[0].domContentLoadedEventEnd"
REST = "() => new Promise(done => requestAnimationFrame(() => setTimeout(done, 50)))"


@dataclass(frozen=True)
class Timing:
    """Medians in milliseconds: by the clock, and of the processor by the page's thread."""

    wall: float
    thread: float


def simulate_board(n: int) -> BoardPage:
    """Compose this repository's default board with simulated rows instead of its ranked ones."""
    instance = Instance(ROOT)
    reference = load_reference(instance)
    material = gather(reference, load_publications(instance, reference))
    board = next(board for board in material.boards if board.track.default)
    page = compose_board(board, material)
    rng = np.random.default_rng(SEED)
    columns = [_find_described(column.metric) for group in page.groups for column in group.columns]
    rows = tuple(_simulate_row(index, columns, rng, n) for index in range(n))
    sections = (
        replace(section, rows=rows) if section.kind == "ranked" else section for section in page.sections
    )
    return replace(page, sections=tuple(sections), drawings=())


def _find_described(name: str) -> Described:
    known = [quantity for quantity in OF_BOARDS if quantity.name == name]
    return known[0] if known else find_metric(name)


def _simulate_row(index: int, columns: list[Described], rng: np.random.Generator, n: int) -> BoardRow:
    family, date = FAMILIES[index % 3], f"2026-{index % 12 + 1:02d}-{index % 28 + 1:02d}"
    return BoardRow(
        slug=f"system-{index:05d}",
        rank=str(index + 1),
        ranks=f"{max(1, index - 20)}{EN_DASH}{min(n, index + 20)}",
        name=f"System {rng.integers(n):05d}",
        badges=("unrefereed",) if index % 2 else (),
        details=("A team of some people",),
        cells=tuple(_simulate_cell(column, rng) for column in columns),
        facts=(f"{family}, rgb", date),
        traits=Traits(int(rng.integers(n)), family, "rgb", date),
    )


def _simulate_cell(column: Described, rng: np.random.Generator) -> Cell:
    value = round(float(rng.integers(330, 600)) / 768, 6)
    low, high = (round(value + float(rng.integers(20, 60)) * sign / 1536, 6) for sign in (-1, 1))
    return Footnotes().cell(column, Score(value=value, low=low, high=high), absent="")


def write_board(page: BoardPage, folder: Path) -> None:
    """Write the page of a board with all that it loads."""
    frame = frame_of(load_reference(Instance(ROOT)))
    first = split_board(page, "all")[0]
    files = {**render_assets(), page.path: render_page("board.html", frame, first)}
    if first.rest:
        files[first.rest.path] = first.rest.content
    for path, content in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(content)


def measure_change(page: Page, session: CDPSession, name: str) -> Timing:
    """Do each of two changes in turn, several times."""
    script = CLICK if name == "sort" else TYPE
    timings = []
    for run in range(2 * RUNS):
        before = _thread_seconds(session)
        wall = page.evaluate(script, CHANGES[name][run % 2])
        timings.append((wall, 1000 * (_thread_seconds(session) - before)))
        page.evaluate(REST)
    walls, threads = zip(*timings[2:], strict=True)
    return Timing(statistics.median(walls), statistics.median(threads))


def _thread_seconds(session: CDPSession) -> float:
    metrics = session.send("Performance.getMetrics")["metrics"]
    return float(next(metric["value"] for metric in metrics if metric["name"] == "TaskDuration"))


def measure_board(folder: Path) -> dict[str, Timing]:
    """Open a board and time when it is usable, a sort and a search."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=list(FLAGS))
        page = browser.new_page(viewport={"width": 1400, "height": 900})
        session = page.context.new_cdp_session(page)
        session.send("Performance.enable", {"timeDomain": "threadTicks"})
        before = _thread_seconds(session)
        page.goto((folder / "index.html").as_uri())
        thread = 1000 * (_thread_seconds(session) - before)
        timings = {"usable": Timing(page.evaluate(USABLE), thread)}
        timings |= {name: measure_change(page, session, name) for name in CHANGES}
        browser.close()
    return timings


def main() -> int:
    """Print the table as Markdown."""
    parser = argparse.ArgumentParser(description="Measure sorting and finding on a board in Chromium.")
    parser.add_argument("rows", type=int, nargs="*", default=SIZES)
    is_within = True
    print("| rows | what | by the clock, ms | processor, ms | limit |\n|---:|---|---:|---:|---:|")
    for n in parser.parse_args().rows:
        with tempfile.TemporaryDirectory() as name:
            write_board(simulate_board(n), Path(name))
            timings = measure_board(Path(name))
        for what, timing in timings.items():
            limit = USABLE_LIMIT if what == "usable" else find_limit(n)
            is_within = is_within and timing.thread <= limit
            print(f"| {n:,} | {what} | {timing.wall:.0f} | {timing.thread:.0f} | {limit:,} |")
    return 0 if is_within else 1


def find_limit(n: int) -> int:
    """Look up how long a sort of so many rows may take."""
    return next((limit for largest, limit in SORT_LIMITS if n <= largest), SORT_LIMITS[-1][1])


if __name__ == "__main__":
    sys.exit(main())
