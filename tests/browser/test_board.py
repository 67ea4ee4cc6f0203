"""The board with JavaScript: sort, find, choose columns, compare, download; and its address remembers."""

import csv
import datetime as dt
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, Route

from builders import build_entry, build_reference
from leaderboard.website.replacing import replace_site
from site_builders import HOSTILE_NAME, build_entries, build_material, render_files
from site_visits import Visit, start_visit

pytestmark = pytest.mark.browser

ARIA = {"asc": "ascending", "desc": "descending"}
OTHER = {"asc": "desc", "desc": "asc"}
FIRST_ORDERS = {"rank": "asc", "name": "asc", "family": "asc"}
NAMES = ("Zebra", "alpha two", "Émile", "ALPHA ONE", "\U0001d538stral", "\uff20 full", "10", "9", "alpha one")
FAMILIES = ("video", "vlm", "object-centric")
INPUTS = ("rgb", "rgb+masks")
DATES = ("2026-01-02", "2025-11-30", "2026-02-28", "2026-01-02")
N_SUBMISSIONS = 5 + len(NAMES)
SMALLEST_TARGET = 24
NOTE_SHIFTS = """
window.shifts = [];
new PerformanceObserver((list) => {
  for (const entry of list.getEntries()) window.shifts.push(entry.value);
}).observe({ type: "layout-shift", buffered: true });
"""
IN_SIGHT = """(id) => {
  const { top } = document.getElementById(id).getBoundingClientRect();
  return top >= 0 && top < innerHeight;
}"""

Key = str | float | None


@pytest.fixture(scope="module")
def board_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build a site whose submissions differ in all that can be sorted and found, with ties and gaps."""
    reference = build_reference()
    rng = np.random.default_rng(12)
    entries = build_entries(reference)
    for index, name in enumerate(NAMES):
        probabilities = np.round(rng.random(reference.n_trials) * 4) / 4
        about: dict[str, Any] = {
            "family": FAMILIES[index % 3],
            "inputs": INPUTS[index % 2],
            "date": dt.date.fromisoformat(DATES[index % 4]),
        }
        entries.append(build_entry(reference, f"system-{index}", probabilities.tolist(), name=name, **about))
    folder = tmp_path_factory.mktemp("board") / "site"
    replace_site(folder, render_files(build_material(reference, entries)).items())
    return folder


@pytest.fixture(scope="module")
def rows(board_dir: Path) -> list[dict[str, Any]]:
    """What the file for programs says of the default board, in its order."""
    board = json.loads((board_dir / "api" / "leaderboard.json").read_text(encoding="utf-8"))
    found: list[dict[str, Any]] = board["tracks"][0]["rows"]
    return found


def list_keys(page: Page) -> list[str]:
    headings = page.locator("thead th[data-key]")
    keys: list[str] = headings.evaluate_all("headings => headings.map(heading => heading.dataset.key)")
    return keys


def key_of(row: dict[str, Any], column: str) -> Key:
    """What Python sorts a row by."""
    about, model = row["metadata"]["submission"], row["metadata"]["model"]
    texts = {"name": about["name"].casefold(), "date": about["date"], "rank": row["rank"]}
    texts["family"] = f"{model['family']}, {model['inputs']}"
    if column in texts:
        found: Key = texts[column]
        return found
    metric, scope, *subset = column.split(".")
    if metric == "property_gain":
        return row["property_gain"]["value"] if "property_gain" in row else None
    scores = row["result"]["scores"].get(scope, {}).get(subset[0] if subset else "all", {})
    value: Key = scores.get(metric, {}).get("value")
    return value


def sort_rows(rows: list[dict[str, Any]], column: str, order: str) -> list[str]:
    """Sort as Python does: equals keep their order in both directions, and what has no value comes last."""
    with_value = [row for row in rows if key_of(row, column) is not None]
    without = [row["slug"] for row in rows if key_of(row, column) is None]
    ordered = sorted(with_value, key=lambda row: key_of(row, column), reverse=order == "desc")  # type: ignore[arg-type, return-value]
    return [row["slug"] for row in ordered] + without


def shown(page: Page, *kinds: str) -> list[str]:
    """The submissions that stand in some bodies of the table, or in all that can be sorted."""
    bodies = ", ".join(f"tbody.{kind}:not([hidden]) tr[id]" for kind in kinds or ("ranked", "partial"))
    slugs: list[str] = page.locator(bodies).evaluate_all("rows => rows.map(row => row.id)")
    return slugs


def of_kind(rows: list[dict[str, Any]], kind: str) -> list[dict[str, Any]]:
    return [row for row in rows if row["kind"] == kind]


def count(page: Page) -> str:
    return page.locator("output.count").inner_text()


def sort_button(page: Page, key: str) -> Any:
    return page.locator(f"th[data-key='{key}'] button")


def query(page: Page) -> str:
    return page.url.partition("?")[2]


def assert_sorted(page: Page, rows: list[dict[str, Any]], key: str, order: str) -> None:
    for kind in ("ranked", "partial"):
        assert shown(page, kind) == sort_rows(of_kind(rows, kind), key, order), (key, order, kind)
    sorted_by = page.locator("[aria-sort]")
    assert sorted_by.count() == 1
    assert sorted_by.get_attribute("data-key") == key
    assert sorted_by.get_attribute("aria-sort") == ARIA[order]


def test_sorting_is_pythons(page: Page, rows: list[dict[str, Any]]) -> None:
    """By every column, the best first and then the other way, each kind of submission by itself."""
    assert_sorted(page, rows, "rank", "asc")
    for key in list_keys(page)[1:]:
        first = FIRST_ORDERS.get(key, "desc")
        sort_button(page, key).click()
        assert_sorted(page, rows, key, first)
        sort_button(page, key).click()
        assert_sorted(page, rows, key, OTHER[first])
    sort_button(page, "rank").click()
    assert_sorted(page, rows, "rank", "asc")


def test_there_is_something_to_sort(page: Page, rows: list[dict[str, Any]]) -> None:
    """The submissions of these tests have ties, gaps and different values, so that sorting is tested."""
    for key in ("accuracy.overall", "date", "family", "name"):
        values = [key_of(row, key) for row in of_kind(rows, "ranked")]
        assert 1 < len(set(values)) < len(values), key
    assert any(key_of(row, "property_gain.overall") is None for row in of_kind(rows, "ranked"))
    assert len(list_keys(page)) == 13
    assert len(shown(page)) == N_SUBMISSIONS


def test_lower_is_better_comes_first_where_it_is(visit: Visit, rows: list[dict[str, Any]]) -> None:
    """A column whose best values are low starts ascending."""

    def turn(route: Route) -> None:
        response = route.fetch()
        marked = 'data-key="accuracy.overall" data-first='
        assert f'{marked}"desc"' in response.text()
        route.fulfill(body=response.text().replace(f'{marked}"desc"', f'{marked}"asc"'), response=response)

    visit.page.route("**/index.html", turn)
    page = visit.open("index.html")
    sort_button(page, "accuracy.overall").click()
    assert_sorted(page, rows, "accuracy.overall", "asc")


def test_people_and_baselines_stay_in_place(page: Page) -> None:
    """People stay on top and baselines at the bottom, whatever is sorted or found."""
    sort_button(page, "name").click()
    page.get_by_label("Find").fill("zebra")
    kinds = page.locator("table.board tbody:not([hidden])").evaluate_all(
        "bodies => bodies.map(body => body.className)"
    )
    assert kinds == ["people", "ranked", "baseline"]
    assert shown(page) == ["system-0"]
    assert shown(page, "baseline") == ["oracle", "flat"]
    assert page.locator("tbody.people tr").is_visible()


def test_find_and_filters_count_what_is_left(page: Page, rows: list[dict[str, Any]]) -> None:
    """The count is that of the rows that are shown, and of those that Python would choose."""
    competing = [row for row in rows if row["kind"] != "baseline"]
    assert count(page) == f"All {N_SUBMISSIONS} submissions"
    for field, name in (("Family", "family"), ("Inputs", "inputs")):
        values = (
            page.get_by_label(field, exact=True)
            .locator("option")
            .evaluate_all("all => all.map(one => one.value)")
        )
        assert values[1:] == sorted({row["metadata"]["model"][name] for row in competing})
        for value in values[1:]:
            page.get_by_label(field, exact=True).select_option(value)
            chosen = [row["slug"] for row in competing if row["metadata"]["model"][name] == value]
            assert shown(page) == chosen
            assert count(page) == f"{len(chosen)} of {N_SUBMISSIONS} submissions"
        page.get_by_label(field, exact=True).select_option("")
    page.get_by_label("From", exact=True).fill("2026-01-01")
    page.get_by_label("To", exact=True).fill("2026-01-31")
    in_january = [row for row in competing if row["metadata"]["submission"]["date"].startswith("2026-01")]
    assert shown(page) == [row["slug"] for row in in_january]
    page.get_by_label("Find").fill("ALPHA o")
    assert shown(page) == ["system-3", "system-8"]
    page.get_by_label("Find").fill("emile")
    assert shown(page) == []
    page.get_by_role("button", name="Show all").click()
    page.get_by_label("Find").fill("emile 02-28")
    assert shown(page) == ["system-2"]
    page.get_by_role("button", name="Show all").click()
    assert count(page) == f"All {N_SUBMISSIONS} submissions"
    assert page.get_by_role("button", name="Show all").is_hidden()


def test_nothing_found_is_said(page: Page) -> None:
    """An empty result says so in the table and in the count, and is announced without haste."""
    page.get_by_label("Find").fill("no such system")
    assert shown(page) == []
    assert page.get_by_role("cell", name="No submission fits.").is_visible()
    assert count(page) == f"0 of {N_SUBMISSIONS} submissions"
    assert page.locator("output.count").get_attribute("aria-live") == "polite"
    page.get_by_label("Find").fill("sliver")
    assert page.get_by_role("cell", name="No complete submission fits.").is_visible()
    assert shown(page) == ["sliver"]


def test_columns_can_be_hidden(page: Page) -> None:
    """A hidden column is gone from every row, the groups above shrink, and sorting returns to the ranks."""
    sort_button(page, "accuracy.overall.easy").click()
    page.get_by_text("Columns", exact=True).click()
    for name in ("Accuracy, %: Easy", "Accuracy, %: Hard", "Agreement with people: Human r"):
        page.get_by_label(name).uncheck()
    page.get_by_label("Agreement with people: Share of ceiling").uncheck()
    widths = page.locator("table.board tbody tr").evaluate_all(
        "rows => rows.map(row => [...row.cells].filter(cell => cell.checkVisibility())"
        ".reduce((sum, cell) => sum + cell.colSpan, 0))"
    )
    assert set(widths) == {9}
    assert page.locator("th[data-key]").count() == 9
    assert page.get_by_role("columnheader", name="Agreement with people").count() == 0
    assert page.get_by_role("columnheader", name="Accuracy, %", exact=True).get_attribute("colspan") == "3"
    assert page.locator("[aria-sort]").get_attribute("data-key") == "rank"
    page.get_by_label("Agreement with people: Human r").check()
    assert page.locator("th[data-key]").count() == 10
    assert page.locator("tr#good td[data-exact]:visible").count() == 6


def test_the_address_survives_reload_and_history(page: Page) -> None:
    """Sorting, finding, columns and choice are in the address; back undoes them step by step."""
    sort_button(page, "human_r.overall").click()
    page.get_by_label("Family", exact=True).select_option("vlm")
    page.get_by_label("Find").press_sequentially("alpha")
    page.get_by_text("Columns", exact=True).click()
    page.get_by_label("Date", exact=True).uncheck()
    page.keyboard.press("Escape")
    page.get_by_label("Compare alpha two").check()
    written = "find=alpha&family=vlm&sort=human_r.overall:desc&hide=date&compare=system-1"
    assert query(page) == written
    before = page.locator("table.board").inner_text()
    page.reload()
    assert query(page) == written
    assert page.locator("table.board").inner_text() == before
    assert page.get_by_label("Find").input_value() == "alpha"
    assert page.get_by_label("Compare alpha two").is_checked()
    steps = [query(page)]
    for _ in range(5):
        page.go_back()
        steps.append(query(page))
    assert steps == [
        written,
        "find=alpha&family=vlm&sort=human_r.overall:desc&hide=date",
        "find=alpha&family=vlm&sort=human_r.overall:desc",
        "family=vlm&sort=human_r.overall:desc",
        "sort=human_r.overall:desc",
        "",
    ]
    assert count(page) == f"All {N_SUBMISSIONS} submissions"
    assert page.locator("[aria-sort]").get_attribute("data-key") == "rank"
    page.go_forward()
    page.go_forward()
    assert page.get_by_label("Family", exact=True).input_value() == "vlm"
    assert shown(page) == [slug for slug in shown(page) if slug in {"system-1", "system-4", "system-7"}]


@pytest.mark.parametrize(
    "said",
    [
        "sort=__proto__:asc&sort=constructor:desc",
        "sort=rank:sideways",
        "sort=rank:desc:desc",
        "sort=nothing:asc&hide=rank,name,__proto__,toString",
        "family=<img src=x onerror=alert(1)>&inputs=' or 1=1",
        "from=yesterday&to=2026-99-99",
        "compare=nobody,../../etc/passwd,javascript:alert(1)",
        "unknown=1&hide=&find=&%E0%A4%A=%E0%A4%A",
        "compare=people&__proto__[sort]=x",
    ],
)
def test_hostile_parameters_do_nothing(visit: Visit, said: str) -> None:
    """Whatever the board does not know counts as not said."""
    plain = visit.open("index.html").locator("main").inner_html()
    page = visit.open(f"index.html?{said}")
    assert page.locator("main").inner_html() == plain


def test_a_hostile_search_is_text(visit: Visit) -> None:
    """What an address asks to find is looked for, as it is, and shortened to a sensible length."""
    page = visit.open("index.html?find=<script>alert(1)</script>")
    assert page.get_by_label("Find").input_value() == "<script>alert(1)</script>"
    assert shown(page) == []
    page = visit.open(f"index.html?find={'a' * 5000}")
    assert page.get_by_label("Find").input_value() == "a" * 100


def test_hostile_names_stay_text(page: Page) -> None:
    """A name with markup is text in the controls too, after sorting, finding and choosing."""
    sort_button(page, "name").click()
    page.get_by_label("Find").fill("img src")
    assert shown(page) == ["hostile"]
    page.get_by_role("checkbox", name=f"Compare {HOSTILE_NAME}", exact=True).check()
    assert page.locator(".tray").inner_text().startswith(HOSTILE_NAME)
    assert page.locator("main img, main script").count() == 0


def test_two_chosen_lead_to_their_page(page: Page) -> None:
    """A ready-made comparison is linked, whichever of the two was chosen first."""
    assert page.locator(".tray").inner_text() == "Tick two to six to compare them."
    page.get_by_label("Compare Good too").check()
    assert page.locator(".tray").inner_text() == "Good too: tick others to compare it with."
    page.get_by_role("checkbox", name="Compare Good", exact=True).check()
    page.get_by_role("link", name="Compare Good too with Good").click()
    assert page.url.endswith("/compare/good--vs--good-too/index.html")
    assert page.get_by_role("heading", level=1).inner_text() == "Good and Good too"


def test_any_two_to_six_lead_to_a_comparison(page: Page, rows: list[dict[str, Any]]) -> None:
    """Without a ready-made page the board links the page that compares any; a seventh replaces the first."""
    last = of_kind(rows, "ranked")[-1]
    link = page.locator(".tray a")
    page.locator(f"tr#{last['slug']} .choose").check()
    page.locator("tr#part .choose").check()
    assert link.inner_text() == f"Compare {last['metadata']['submission']['name']} with Part"
    assert link.get_attribute("href") == f"compare/index.html?of={last['slug']},part"
    more = ["good", "good-too", "flat", "oracle", "hostile"]
    for slug in more:
        page.locator(f"tr#{slug} .choose").check()
    assert page.locator(".choose:checked").count() == 6
    assert link.inner_text() == f"Compare Part, Good, Good too, Chance, Oracle, {HOSTILE_NAME}"
    link.click()
    assert page.url.endswith(f"/compare/index.html?of={','.join(['part', *more])}")


def test_the_view_can_be_downloaded(page: Page, rows: list[dict[str, Any]], tmp_path: Path) -> None:
    """The file holds the rows and columns that are shown, with all digits, and no formula."""
    sort_button(page, "accuracy.overall").click()
    sort_button(page, "accuracy.overall").click()
    page.get_by_text("Columns", exact=True).click()
    page.get_by_label("Accuracy, %: Hard").uncheck()
    page.get_by_label("Inputs", exact=True).select_option("rgb")
    with page.expect_download() as waiting:
        page.get_by_role("button", name="CSV of this view").click()
    assert waiting.value.suggested_filename == "leaderboard-view.csv"
    waiting.value.save_as(tmp_path / "view.csv")
    text = (tmp_path / "view.csv").read_bytes().decode("utf-8")
    lines = list(csv.DictReader(text.splitlines(keepends=True)))
    assert [line["slug"] for line in lines] == ["", *shown(page), "oracle", "flat"]
    assert [line["kind"] for line in lines][:2] == ["people", "ranked"]
    by_slug = {row["slug"]: row for row in rows}
    for line in lines[1:]:
        row = by_slug[line["slug"]]
        value = key_of(row, "accuracy.overall")
        assert line["accuracy.overall"] == ("" if value is None else f"{value:.6f}")
        assert line["rank"] == str(row["rank"] or "")
        assert line["date"] == row["metadata"]["submission"]["date"]
    assert next(line for line in lines if line["slug"] == "hostile")["name"] == f"'{HOSTILE_NAME}"
    assert not [name for name in lines[0] if name.startswith("accuracy.overall.hard")]
    assert "accuracy.overall.easy.low" in lines[0]


def press_until(page: Page, key: str, found: str) -> None:
    """Press a key until an element has the focus."""
    for _ in range(200):
        page.keyboard.press(key)
        if page.evaluate("found => document.activeElement.matches(found)", found):
            return
    pytest.fail(f"{key} never leads to {found}")


def test_the_keyboard_does_everything(page: Page, rows: list[dict[str, Any]]) -> None:
    """Tab reaches find, filters, columns, headings and boxes; Enter and Space work; the focus stays."""
    press_until(page, "Tab", "input[type=search]")
    page.keyboard.type("a")
    press_until(page, "Tab", "select")
    page.keyboard.press("o")
    assert query(page) == "find=a&family=object-centric"
    press_until(page, "Tab", ".menu summary")
    page.keyboard.press("Enter")
    press_until(page, "Tab", "input[value=date]")
    page.keyboard.press("Space")
    assert page.locator("th[data-key=date]").count() == 0
    page.keyboard.press("Escape")
    assert page.locator(".menu .list").is_hidden()
    assert page.evaluate("() => document.activeElement.matches('.menu summary')")
    press_until(page, "Tab", ".said button")
    page.keyboard.press("Enter")
    assert query(page) == "hide=date"
    press_until(page, "Tab", "th[data-key='accuracy.Alpha'] button")
    for key, order in (("Enter", "desc"), ("Space", "asc"), ("Enter", "desc")):
        page.keyboard.press(key)
        assert_sorted(page, rows, "accuracy.Alpha", order)
        assert page.evaluate("() => document.activeElement.closest('th').dataset.key") == "accuracy.Alpha"
    press_until(page, "Tab", "tr#good-too .choose")
    page.keyboard.press("Space")
    press_until(page, "Shift+Tab", "tr#good .choose")
    page.keyboard.press("Space")
    press_until(page, "Shift+Tab", ".tray a")
    page.keyboard.press("Enter")
    page.wait_for_url("**/compare/good--vs--good-too/index.html")


def test_controls_have_names(page: Page) -> None:
    """Each button says what it sorts by and how it is sorted now; a cell's heading does not repeat it."""
    assert sort_button(page, "rank").get_attribute("aria-label") == "Sort by Rank, ascending now"
    button = page.get_by_role("button", name="Sort by Accuracy, % Overall", exact=True)
    button.click()
    assert button.count() == 0
    assert page.get_by_role("button", name="Sort by Accuracy, % Overall, descending now").is_visible()
    assert page.locator("th[data-key='accuracy.overall']").get_attribute("abbr") == "Overall"


def test_a_screen_reader_hears_what_is_below_a_number(page: Page) -> None:
    """Each heading says that rank sets or intervals follow, and a cell gives one thing after the other."""
    nodes = page.context.new_cdp_session(page).send("Accessibility.getFullAXTree")["nodes"]
    headings = [node["name"]["value"] for node in nodes if node["role"]["value"] == "columnheader"]
    assert "95 % set" in headings[0]
    assert len([heading for heading in headings if "with 95 % interval" in heading]) == 9
    cells = page.locator("tr#good :is(.rank, .number:has(.interval))")
    for cell in cells.evaluate_all("all => all.map(one => one.innerText)"):
        assert re.match(r"\S+\n\S+", cell), cell


def test_pointing_at_a_number_tells_it_exactly(page: Page, rows: list[dict[str, Any]]) -> None:
    """Value and interval with all digits, and how many resamples have no value."""
    cell = page.locator("tr#good td.number").nth(3)
    assert cell.get_attribute("title") is None
    cell.hover()
    (good,) = [row for row in rows if row["slug"] == "good"]
    score = good["result"]["scores"]["overall"]["easy"]["accuracy"]
    exact = [f"{score[part]:.6f}" for part in ("value", "low", "high")]
    assert cell.get_attribute("title") == (
        f"{exact[0]}, 95 % interval {exact[1]} to {exact[2]}, "
        f"{score['undefined_resamples']} resamples without a value"
    )
    absent = page.locator("tr#part td.number").first
    absent.hover()
    assert absent.get_attribute("title") is None


@pytest.mark.parametrize("width", [1280, 360])
@pytest.mark.parametrize("look", ["light", "dark", "forced"])
def test_no_accessibility_rule_is_broken(visit: Visit, look: str, width: int) -> None:
    """Axe finds nothing with the controls in use, in either theme, in forced colours and on a telephone."""
    visit.page.set_viewport_size({"width": width, "height": 900})
    visit.page.emulate_media(
        color_scheme="light" if look == "light" else "dark",
        forced_colors="active" if look == "forced" else "none",
    )
    page = visit.open("index.html?find=o&sort=name:desc&hide=date&compare=good,good-too")
    page.evaluate("() => document.querySelectorAll('details').forEach(part => { part.open = true; })")
    results = Axe().run(page)
    assert results.response["violations"] == [], results.generate_report()


@pytest.mark.parametrize("width", [1280, 360])
def test_targets_are_large_enough(visit: Visit, width: int) -> None:
    """Every control is at least 24 pixels high and wide."""
    visit.page.set_viewport_size({"width": width, "height": 900})
    page = visit.open("index.html?find=o&compare=good,good-too")
    page.evaluate("() => document.querySelectorAll('details').forEach(part => { part.open = true; })")
    found = page.locator(".controls :is(a, button, input, select, summary), .sort, .choose")
    sizes = found.evaluate_all(
        "all => all.filter(one => one.checkVisibility()).map(one => [one.outerHTML.slice(0, 80),"
        "Math.min(one.getBoundingClientRect().width, one.getBoundingClientRect().height)])"
    )
    assert len(sizes) > 30
    assert [name for name, size in sizes if size < SMALLEST_TARGET] == []


@pytest.mark.parametrize("width", [320, 800, 1120, 1280, 1600])
def test_nothing_moves_while_loading(visit: Visit, width: int) -> None:
    """The space of the controls is free beforehand, so that neither the table nor its rows shift."""
    visit.page.set_viewport_size({"width": width, "height": 900})
    visit.page.add_init_script(NOTE_SHIFTS)
    script = re.compile(r"/assets/site\.\w+\.js$")

    def wait_for_paint(route: Route) -> None:
        visit.page.wait_for_function("() => performance.getEntriesByName('first-contentful-paint').length")
        measured.append(visit.page.locator("table.board").bounding_box())
        route.continue_()

    measured: list[Any] = []
    visit.page.route(script, wait_for_paint)
    page = visit.open("index.html")
    assert page.locator("output.count").is_visible()
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    assert page.locator("table.board").bounding_box() == measured[0]
    assert page.evaluate("() => window.shifts") == []
    assert page.evaluate("() => document.documentElement.scrollWidth") <= width


def test_without_javascript_there_are_no_controls(browser: Browser, origin: str) -> None:
    """All rows are there in the order of the page, no control shows, and no space is kept for any."""
    visit = start_visit(browser, origin, javascript=False)
    page = visit.open("index.html?find=zebra&sort=name:desc")
    assert page.locator("table.board tr[id]").count() == N_SUBMISSIONS + 2
    assert page.locator("button, input, select, details").count() == 0
    box = page.locator(".controls").bounding_box()
    assert box is None or box["height"] == 0
    assert visit.complaints == []
    page.context.close()


def test_it_works_as_plain_files(browser: Browser, board_dir: Path, rows: list[dict[str, Any]]) -> None:
    """Opened with a double click the board sorts, finds, compares and remembers what its address says."""
    visit = start_visit(browser, board_dir.as_uri())
    page = visit.open("index.html?sort=accuracy.Beta:asc")
    assert_sorted(page, rows, "accuracy.Beta", "asc")
    sort_button(page, "date").click()
    assert_sorted(page, rows, "date", "desc")
    page.get_by_label("Find").fill("good")
    assert shown(page) == ["good", "good-too"]
    for box in page.locator("tbody.ranked .choose").all():
        box.check()
    page.get_by_role("link", name="Compare Good with Good too").click()
    assert page.url == f"{board_dir.as_uri()}/compare/good--vs--good-too/index.html"
    assert visit.complaints == []
    page.context.close()


def test_other_tracks_have_controls_too(visit: Visit) -> None:
    """A board in a folder of its own sorts and compares as the first one does."""
    page = visit.open("tracks/without/index.html?compare=other-track,flat")
    assert count(page) == "All 1 submission"
    assert page.locator(".tray a").get_attribute("href") == "../../compare/index.html?of=other-track,flat"


def test_paper_has_no_controls(page: Page) -> None:
    """Printed, the view is as chosen and says how much of all it is, without anything to press."""
    page.get_by_label("Find").fill("zebra")
    page.emulate_media(media="print")
    assert page.locator("button:visible, input:visible, select:visible, summary:visible").count() == 0
    assert page.locator(".controls").inner_text() == f"1 of {N_SUBMISSIONS} submissions"
    assert shown(page) == ["system-0"]


def test_an_address_still_points_at_a_row(visit: Visit) -> None:
    """The row that an address names is marked and in sight, although the script moved it."""
    page = visit.open("index.html#system-3")
    assert page.locator("tr:target").get_attribute("id") == "system-3"
    page.wait_for_function(IN_SIGHT, arg="system-3")  # the page scrolls smoothly, which takes a moment
