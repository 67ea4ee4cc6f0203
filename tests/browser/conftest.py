"""A real browser for the built site: the system's Chromium, driven by Playwright, without network."""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import NoReturn

import pytest
from playwright.sync_api import Browser, Page, sync_playwright

from builders import build_entry, build_reference
from leaderboard.website.replacing import replace_site
from site_builders import build_entries, build_material, render_files
from site_visits import Visit, serve_folder, start_visit

CHROMIUM = Path("/usr/bin/chromium")
FLAGS = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)
SUB_PATH = "some/where"


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Start Chromium; without it the tests skip with a reason, and in CI they fail."""
    if not CHROMIUM.exists():
        _give_up(f"{CHROMIUM} is not there: `make browser` installs it")
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=str(CHROMIUM), args=list(FLAGS))
        yield chromium
        chromium.close()


def _give_up(reason: str) -> NoReturn:
    if os.environ.get("CI"):
        pytest.fail(f"{reason} (with CI set, browser tests must run)")
    pytest.skip(f"NO BROWSER TEST RUNS: {reason}")


@pytest.fixture(scope="session")
def site_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build a site with a submission of every sort and a long board, below a sub-path."""
    reference = build_reference()
    entries = build_entries(reference)
    for index in range(30):
        probabilities = [0.6 - 0.01 * (trial % index if index else 0) for trial in range(reference.n_trials)]
        entries.append(build_entry(reference, f"filler-{index:02d}", probabilities))
    folder = tmp_path_factory.mktemp("served") / SUB_PATH
    replace_site(folder, render_files(build_material(reference, entries)).items())
    return folder


@pytest.fixture(scope="session")
def served(site_dir: Path) -> Iterator[str]:
    """Serve the site below a sub-path, as a project's pages are, and give its address."""
    with serve_folder(site_dir.parents[SUB_PATH.count("/")]) as origin:
        yield f"{origin}/{SUB_PATH}"


@pytest.fixture(scope="module")
def origin(board_dir: Path) -> Iterator[str]:
    """Serve the board that a module has built, and give its address."""
    with serve_folder(board_dir.parent) as origin:
        yield f"{origin}/site"


@pytest.fixture
def visit(browser: Browser, origin: str) -> Iterator[Visit]:
    """Open a tab, which must have nothing to complain about when the test is over."""
    visit = start_visit(browser, origin)
    yield visit
    visit.page.context.close()
    assert visit.complaints == []


@pytest.fixture
def page(visit: Visit) -> Page:
    """Open the board."""
    return visit.open("index.html")
