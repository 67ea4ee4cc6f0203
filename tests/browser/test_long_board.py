"""A board of 450 rows: the script finds, sorts and pages all of them; without it they are on three pages."""

import csv
import re
from pathlib import Path
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from long_boards import N_ROWS, TRACK, build_long_board
from playwright.sync_api import Browser, Page

from leaderboard.website.board_pages import BoardPage, BoardRow
from leaderboard.website.board_parts import split_board
from leaderboard.website.rendering import frame_of, render_assets, render_page
from leaderboard.website.replacing import replace_site
from site_builders import HOSTILE_NAME, build_material
from site_visits import Visit, start_visit

pytestmark = pytest.mark.browser

N_PARTIAL = 2
ALL = N_ROWS + N_PARTIAL
SLUGS = "rows => rows.map(row => row.id)"

# A row as nested lists, without what the script adds to every row, and with links from the site's root.
READ_ROWS = r"""(rows) => {
  const read = (node) => {
    if (node.nodeType === Node.TEXT_NODE) return node.data.replace(/\s+/g, " ");
    const attributes = [...node.attributes].filter(({ name }) => name !== "abbr")
      .map(({ name, value }) => `${name}=${value.replace(/^(\.\.\/)+/, "")}`).sort();
    const children = [...node.childNodes].filter((child) => !child.matches?.(".choose")).map(read);
    return [node.localName, attributes, children.filter((child) => child !== " ")];
  };
  return rows.map(read);
}"""

Key = str | float | None


@pytest.fixture(scope="module")
def board() -> BoardPage:
    return build_long_board(build_material())


@pytest.fixture(scope="module")
def rows(board: BoardPage) -> tuple[BoardRow, ...]:
    return next(section.rows for section in board.sections if section.kind == "ranked")


@pytest.fixture(scope="module")
def board_dir(board: BoardPage, tmp_path_factory: pytest.TempPathFactory) -> Path:
    frame = frame_of(build_material().reference)
    parts = split_board(board, TRACK)
    files = render_assets() | {part.path: render_page("board.html", frame, part) for part in parts}
    files |= {part.rest.path: part.rest.content for part in parts if part.rest}
    folder = tmp_path_factory.mktemp("long") / "site"
    replace_site(folder, files.items())
    return folder


def key_of(row: BoardRow, board: BoardPage, key: str) -> Key:
    """What Python sorts a row by."""
    assert row.traits is not None
    texts: dict[str, Key] = {
        "rank": int(row.rank),
        "name": row.traits.place,
        "family": row.facts[0],
        "date": row.facts[1],
    }
    if key in texts:
        return texts[key]
    keys = [column.key for group in board.groups for column in group.columns]
    cell = row.cells[keys.index(key)]
    return float(cell.exact) if cell.exact else None


def sort_rows(rows: tuple[BoardRow, ...], board: BoardPage, key: str, order: str) -> list[str]:
    """Sort as Python does: equals keep their order in both directions, and what has no value comes last."""
    keys = {row.slug: key_of(row, board, key) for row in rows}
    with_value = [row.slug for row in rows if keys[row.slug] is not None]
    without = [row.slug for row in rows if keys[row.slug] is None]
    return sorted(with_value, key=lambda slug: keys[slug], reverse=order == "desc") + without  # type: ignore[arg-type, return-value]


def ranked(page: Page) -> list[str]:
    found: list[str] = page.locator("tbody.ranked tr[id]").evaluate_all(SLUGS)
    return found


def collect(page: Page) -> list[str]:
    """The ranked rows of all parts, from the first to the last."""
    found = []
    for part in range(page.get_by_label("Rows", exact=True).locator("option").count()):
        page.get_by_label("Rows", exact=True).select_option(str(part + 1))
        found += ranked(page)
    return found


def sort_button(page: Page, key: str) -> Any:
    return page.locator(f"th[data-key='{key}'] button")


def count(page: Page) -> str:
    return page.locator("output.count").inner_text()


@pytest.mark.parametrize(
    ("key", "orders"),
    [
        ("name", ("asc", "desc")),
        ("accuracy.overall", ("desc", "asc")),
        ("property_gain.overall", ("desc", "asc")),
        ("family", ("asc", "desc")),
        ("date", ("desc", "asc")),
    ],
)
def test_sorting_is_pythons_over_all_rows(
    page: Page, board: BoardPage, rows: tuple[BoardRow, ...], key: str, orders: tuple[str, str]
) -> None:
    """Ties keep the order of the ranks and gaps come last, wherever the rows come from."""
    for order in orders:
        sort_button(page, key).click()
        assert len(ranked(page)) == 100
        assert collect(page) == sort_rows(rows, board, key, order)


def test_find_and_filters_count_all_rows(page: Page, rows: tuple[BoardRow, ...]) -> None:
    """What is looked for is found on whichever page it would stand."""
    assert count(page) == f"All {ALL} submissions"
    page.get_by_label("Family", exact=True).select_option("vlm")
    chosen = [row.slug for row in rows if row.traits and row.traits.family == "vlm"]
    assert count(page) == f"{len(chosen)} of {ALL} submissions"
    assert collect(page) == chosen
    page.get_by_label("From", exact=True).fill("2026-06-01")
    page.get_by_label("To", exact=True).fill("2026-06-30")
    chosen = [row.slug for row in rows if row.facts[0].startswith("vlm") and row.facts[1][:7] == "2026-06"]
    assert ranked(page) == chosen
    assert page.locator("nav.parts").is_hidden()
    page.get_by_role("button", name="Show all").click()
    page.get_by_label("Find").fill("copy-40")
    assert ranked(page) == [f"copy-40{digit}" for digit in range(10)]
    page.get_by_label("Find").fill("img src")
    assert page.locator(f"tr#copy-{N_ROWS - 1} .name a").inner_text() == HOSTILE_NAME
    assert page.locator("main img, main script").count() == 0


def test_rows_are_written_as_the_server_does(visit: Visit) -> None:
    """Every element, attribute and text of rows from data equals that of the page without a script."""
    found: list[Any] = []
    for number in (3, 4, 5):
        page = visit.open(f"index.html?page={number}")
        found += page.locator("tbody.ranked tr[id]").evaluate_all(READ_ROWS)
    expected: list[Any] = []
    for number in (2, 3):
        page = visit.open(f"tracks/all/page-{number}.html")
        expected += page.locator("tbody.ranked tr[id]").evaluate_all(READ_ROWS)
    assert len(found) == N_ROWS - 200
    assert found == expected


def test_the_address_remembers_the_part(page: Page, rows: tuple[BoardRow, ...]) -> None:
    """Turning is a step that survives reload and back; a new order begins at its first part."""
    page.get_by_role("button", name="Next").click()
    page.get_by_role("button", name="Next").click()
    assert page.url.endswith("?page=3")
    page.reload()
    assert ranked(page) == [row.slug for row in rows[200:300]]
    page.go_back()
    assert ranked(page) == [row.slug for row in rows[100:200]]
    sort_button(page, "date").click()
    assert page.url.endswith("?sort=date:desc")
    assert page.get_by_label("Rows", exact=True).input_value() == "1"
    for _ in range(9):
        page.get_by_role("button", name="Next").click(force=True)
    assert page.url.endswith("?sort=date:desc&page=5")
    assert page.get_by_role("button", name="Next").get_attribute("aria-disabled") == "true"


@pytest.mark.parametrize("said", ["page=0", "page=-1", "page=6", "page=1e1", "page=2.5", "page=x"])
def test_unknown_parts_are_the_first(visit: Visit, rows: tuple[BoardRow, ...], said: str) -> None:
    """A part that does not exist counts as not said."""
    assert ranked(visit.open(f"index.html?{said}")) == [row.slug for row in rows[:100]]


def test_choices_and_columns_hold_on_every_part(page: Page) -> None:
    """A row from data can be compared, and what is hidden stays so where rows are new."""
    page.locator("tr#copy-001 .choose").check()
    page.get_by_text("Columns", exact=True).click()
    page.get_by_label("Date", exact=True).uncheck()
    page.keyboard.press("Escape")
    page.get_by_label("Rows", exact=True).select_option("4")
    page.locator("tr#copy-301 .choose").check()
    href = page.locator(".tray a").get_attribute("href")
    assert href == "compare/index.html?of=copy-001,copy-301"
    assert page.locator("tr#copy-301 .fact").count() == 1
    assert page.url.endswith("?hide=date&compare=copy-001,copy-301&page=4")
    page.reload()
    assert page.locator("tr#copy-301 .choose").is_checked()


def test_an_address_points_at_a_row_from_data(visit: Visit) -> None:
    """A row that is data only is turned to, marked and in the table."""
    page = visit.open("index.html#copy-433")
    assert page.locator("tr:target").get_attribute("id") == "copy-433"
    assert page.get_by_label("Rows", exact=True).input_value() == "5"


def test_the_view_has_all_rows(page: Page, tmp_path: Path, rows: tuple[BoardRow, ...]) -> None:
    """The file has what was found on all parts, with all digits, never shown or not."""
    with page.expect_download() as waiting:
        page.get_by_role("button", name="CSV of this view").click()
    waiting.value.save_as(tmp_path / "view.csv")
    lines = list(csv.DictReader((tmp_path / "view.csv").read_bytes().decode().splitlines(keepends=True)))
    found = [line for line in lines if line["kind"] == "ranked"]
    assert [line["slug"] for line in found] == [row.slug for row in rows]
    assert [line["accuracy.overall"] for line in found] == [row.cells[0].exact for row in rows]
    ends = [(line["accuracy.overall.low"], line["accuracy.overall.high"]) for line in found]
    assert ends == [row.cells[0].ends or ("", "") for row in rows]
    assert len(lines) == ALL + 3


def test_paper_says_which_rows_it_has(page: Page) -> None:
    """Printed, a part names its rows, and where all of them are."""
    line = page.locator(".controls")
    page.get_by_label("Rows", exact=True).select_option("5")
    page.emulate_media(media="print")
    rows = f"Here: rows 401 to {ALL} of {ALL}. All are in leaderboard.csv."
    assert line.inner_text() == f"All {ALL} submissions\n\n{rows}"
    page.emulate_media(media="screen")
    page.get_by_label("Find").fill("copy-40")
    page.emulate_media(media="print")
    assert line.inner_text() == f"10 of {ALL} submissions"
    assert page.locator(".turner").is_hidden()


def test_partial_submissions_come_last(page: Page) -> None:
    """They follow the last ranked row, in a body of their own."""
    page.get_by_label("Rows", exact=True).select_option("5")
    partial = page.locator("tbody.partial:not([hidden]) tr[id]").evaluate_all(SLUGS)
    assert sorted(partial) == ["part", "sliver"]


def test_without_javascript_all_rows_are_on_pages(
    browser: Browser, origin: str, rows: tuple[BoardRow, ...]
) -> None:
    """Following the links, a reader meets every ranked row once, and each number of each."""
    visit = start_visit(browser, origin, javascript=False)
    page = visit.open("index.html")
    found, values = [], []
    for link in ("rows 1 to 200", "rows 201 to 400", f"rows 401 to {N_ROWS}"):
        with page.expect_navigation():
            page.get_by_role("link", name=link, exact=True).click()
        found += ranked(page)
        values += page.locator("tbody.ranked td[data-exact]").evaluate_all(
            "cells => cells.map(cell => cell.firstChild.data)"
        )
        assert page.get_by_role("link", name=link, exact=True).get_attribute("aria-current") == "page"
        assert page.locator("button, input, select").count() == 0
    assert found == [row.slug for row in rows]
    assert values == [cell.text for row in rows for cell in row.cells if not cell.why]
    assert visit.complaints == []
    page.context.close()


def test_it_works_as_plain_files(browser: Browser, board_dir: Path, rows: tuple[BoardRow, ...]) -> None:
    """Opened with a double click the data is there too."""
    visit = start_visit(browser, board_dir.as_uri())
    page = visit.open("index.html?page=5")
    assert ranked(page) == [row.slug for row in rows[400:]]
    assert visit.complaints == []
    page.context.close()


@pytest.mark.parametrize("width", [1280, 360])
def test_no_accessibility_rule_is_broken(visit: Visit, width: int) -> None:
    """Axe finds nothing on a part from data, nor on a page for readers without a script."""
    visit.page.set_viewport_size({"width": width, "height": 900})
    for path in ("index.html?page=4&compare=copy-301", "tracks/all/page-2.html"):
        results = Axe().run(visit.open(path))
        assert results.response["violations"] == [], results.generate_report()
        assert visit.page.evaluate("() => document.documentElement.scrollWidth") <= width
    assert re.search("Rows", visit.open("index.html").locator("nav.parts").inner_text())
