"""The built site in a real browser."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page

from leaderboard.website.trial_paths import trial_path
from site_visits import Visit, start_visit

pytestmark = pytest.mark.browser

KINDS = {
    "default board": "index.html",
    "other board": "tracks/without/index.html",
    "complete submission": "submissions/good/index.html",
    "submission with checks": "submissions/good-too/index.html",
    "hostile submission": "submissions/hostile/index.html",
    "partial submission": "submissions/sliver/index.html",
    "baseline": "submissions/flat/index.html",
    "figure": "figure.html",
    "people": "people.html",
    "method": "method.html",
    "property": "properties/alpha/index.html",
    "scenario": "properties/alpha/alpha_one/index.html",
    "trials": "trials/index.html",
    "trials of a property": "trials/of/alpha.html",
    "chosen trials": "trials/where/hard.html",
    "trials of a submission": "submissions/hostile/trials.html",
    "trial": trial_path("alpha_one-copy0/set=a,b/0000"),
    "comparison": "compare/good--vs--good-too/index.html",
    "comparisons": "compare/index.html",
    "comparison of several": "compare/index.html?of=good,hostile,flat",
    "published": "published.html",
    "data": "data.html",
    "about": "about.html",
    "submit": "submit.html",
    "status": "status.html",
    "missing page": "404.html",
}
MEASURE_CELL = """(cell) => [cell, cell.querySelector(".interval")].map(({ firstChild: text }) => {
  const letters = document.createRange();
  letters.setStart(text, text.data.search(/\\S/));
  letters.setEnd(text, text.length);
  return letters.getBoundingClientRect().toJSON();
})"""
every_kind = pytest.mark.parametrize("path", KINDS.values(), ids=KINDS.keys())


@pytest.fixture
def visit(browser: Browser, served: str) -> Iterator[Visit]:
    visit = start_visit(browser, served)
    yield visit
    visit.page.context.close()


def style_applies(page: Page) -> bool:
    collapse = page.locator("table").first.evaluate("table => getComputedStyle(table).borderCollapse")
    return bool(collapse == "separate")


@every_kind
def test_a_page_stays_on_its_site_and_makes_no_noise(visit: Visit, path: str) -> None:
    """No request leaves the origin or fails, nothing reaches the console, the policy is not violated."""
    visit.open(path)
    assert visit.complaints == []


def test_the_policy_is_in_force(visit: Visit) -> None:
    """A script that somebody smuggled in would not run: the browser complains instead."""
    page = visit.open("index.html")
    image = '<img src=x onerror="window.ran = 1">'
    page.evaluate("html => document.body.insertAdjacentHTML('beforeend', html)", image)
    script = "() => Object.assign(document.createElement('script'), { text: 'window.ran = 1' })"
    page.evaluate(f"() => document.body.append(({script})())")
    assert page.evaluate("() => window.ran") is None
    assert any("Content Security Policy" in complaint for complaint in visit.complaints)


def test_it_works_below_a_sub_path(visit: Visit) -> None:
    """Style applies and links lead on where the site is not at the root of its host."""
    page = visit.open("tracks/without/index.html")
    assert style_applies(page)
    page.get_by_role("row").get_by_role("link", name="other-track").click()
    assert page.url == f"{visit.origin}/submissions/other-track/index.html"
    page.get_by_role("link", name="Method", exact=True).click()
    assert page.url == f"{visit.origin}/method.html"
    page.get_by_role("link", name="Board", exact=True).click()
    assert page.url == f"{visit.origin}/index.html"
    assert visit.complaints == []


def test_it_works_as_plain_files(browser: Browser, site_dir: Path) -> None:
    """Opened with a double click, style applies and links lead on."""
    visit = start_visit(browser, site_dir.as_uri())
    page = visit.open("index.html")
    assert style_applies(page)
    page.get_by_role("link", name="Good", exact=True).click()
    assert page.url == f"{site_dir.as_uri()}/submissions/good/index.html"
    assert style_applies(page)
    page.get_by_role("link", name="With", exact=True).click()
    assert page.url == f"{site_dir.as_uri()}/index.html"
    assert visit.complaints == []
    page.context.close()


def test_everything_is_there_without_javascript(browser: Browser, served: str) -> None:
    """All rows and numbers are in the page itself, and no control is dead because there is none."""
    visit = start_visit(browser, served, javascript=False)
    page = visit.open("index.html")
    assert page.locator("tbody tr[id]").count() == 37
    assert page.locator("tbody tr[id=good] td.number").count() == 9
    assert page.locator("button, input, select").count() == 0
    assert page.locator(".controls").is_hidden()
    assert page.get_by_text("Synthetic reference.").is_visible()
    page.context.close()


def test_hostile_metadata_runs_nothing(visit: Visit) -> None:
    """A browser shows the markup that a stranger wrote as text and makes no element of it."""
    for kind in ("default board", "hostile submission", "scenario", "trials of a submission", "trial"):
        page = visit.open(KINDS[kind])
        assert page.locator("main img, main script, main style").count() == 0
        assert page.get_by_text("<img src=x onerror=alert(1)>").first.is_visible()
    for kind in ("default board", "hostile submission"):
        page = visit.open(KINDS[kind])
        assert page.get_by_text("<script>alert(2)</script>").first.is_visible()
    assert visit.complaints == []


@every_kind
def test_the_page_never_scrolls_sideways(visit: Visit, path: str) -> None:
    """Wide tables scroll in their own box; the page fits a small telephone and 400 % zoom."""
    page = visit.open(path)
    for width in (320, 768, 1280):
        page.set_viewport_size({"width": width, "height": 900})
        assert page.evaluate("() => document.documentElement.scrollWidth") <= width


def test_headings_and_names_stay_in_sight(browser: Browser, served: str) -> None:
    """In the box of a long board the headings stay on top and the names at the left, to a pixel."""
    visit = start_visit(browser, served, width=600)
    page = visit.open("index.html")
    box, heading = page.locator(".scroll"), page.locator("thead th.name")
    name = page.locator("tr#filler-20 th.name")
    box.evaluate("box => box.scrollTo(200, 700)")
    edges = box.evaluate("box => [box.getBoundingClientRect().top, box.getBoundingClientRect().left]")
    heading_box, name_box = heading.bounding_box(), name.bounding_box()
    assert heading_box is not None
    assert name_box is not None
    assert heading_box["y"] == pytest.approx(edges[0] + 1, abs=1.5)
    assert name_box["x"] == pytest.approx(edges[1] + 1, abs=1.5)
    page.context.close()


def test_both_rows_of_headings_stay_in_sight(browser: Browser, served: str) -> None:
    """The second row of headings stays right below the first."""
    visit = start_visit(browser, served, width=900)
    page = visit.open("index.html")
    page.locator(".scroll").evaluate("box => box.scrollTo(0, 700)")
    group = page.locator("thead .group").first.bounding_box()
    column = page.locator("thead tr + tr th").first.bounding_box()
    assert group is not None
    assert column is not None
    assert column["y"] == pytest.approx(group["y"] + group["height"], abs=1.5)
    page.context.close()


def test_an_interval_stands_below_its_score(visit: Visit) -> None:
    """On its own line, in smaller type, flush with the number."""
    page = visit.open("index.html")
    cell = page.locator("tr#good td.number").first
    score, interval = cell.evaluate(MEASURE_CELL)
    assert interval["y"] >= score["y"] + score["height"] - 4
    assert interval["height"] < score["height"]
    assert interval["x"] + interval["width"] == pytest.approx(score["x"] + score["width"], abs=1)


def test_a_table_can_be_reached_and_scrolled_by_keyboard(visit: Visit) -> None:
    """The box takes the focus, tells its name, and moves with the arrow keys."""
    page = visit.open("index.html")
    box = page.get_by_role("region", name="Complete submissions in order")
    box.focus()
    page.keyboard.press("End")
    page.wait_for_function("() => document.querySelector('.scroll').scrollTop > 0")


@pytest.mark.parametrize("scheme", ["light", "dark"])
@every_kind
def test_no_accessibility_rule_is_broken(visit: Visit, path: str, scheme: str) -> None:
    """Axe finds nothing, contrast included, in either theme."""
    visit.page.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
    results = Axe().run(visit.open(path))
    assert results.response["violations"] == [], results.generate_report()


@pytest.mark.parametrize("path", ["index.html", "figure.html", "submissions/good/index.html"])
def test_figures_follow_the_theme(visit: Visit, path: str) -> None:
    """Words, marks and lines have another colour in the dark, and each differs from what is behind it."""
    seen = []
    for scheme in ("light", "dark"):
        visit.page.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
        page = visit.open(path)
        behind = page.locator("body").evaluate("body => getComputedStyle(body).backgroundColor")
        paint = "group => [getComputedStyle(group).fill, getComputedStyle(group).stroke]"
        groups = [group.evaluate(paint) for group in page.locator("svg > g").all()]
        assert groups
        assert not [fill for fill, stroke in groups if {fill, stroke} <= {"none", behind}]
        seen.append(groups)
    assert not [light for light, dark in zip(*seen, strict=True) if light == dark]


def test_figures_stay_readable_on_a_telephone(visit: Visit) -> None:
    """At 320 px the smallest letters are at least 9 px high, and a figure is as wide as the page."""
    page = visit.open("submissions/good/index.html")
    page.set_viewport_size({"width": 320, "height": 900})
    for figure in page.locator("figure svg").all():
        scale = figure.evaluate("svg => svg.getBoundingClientRect().width / svg.viewBox.baseVal.width")
        assert scale * 10.5 >= 9


def test_the_page_prints_without_navigation(visit: Visit) -> None:
    """On paper the whole table is there, the banner too, and no navigation."""
    page = visit.open("index.html")
    page.emulate_media(media="print")
    assert page.locator(".masthead nav").is_hidden()
    assert page.get_by_text("Synthetic reference.").is_visible()
    sizes = page.locator(".scroll").evaluate("box => [box.clientHeight, box.scrollHeight]")
    assert sizes[0] == sizes[1]


def test_the_feed_and_the_data_are_served(visit: Visit) -> None:
    """What pages point programs at can be fetched from where they point."""
    page = visit.open("submissions/good/index.html")
    endings = ("csv", "json", "xml", "toml", "svg", "png")
    targets = page.locator(", ".join(f"a[href$='.{ending}']" for ending in endings))
    addresses = targets.evaluate_all("links => links.map(link => link.href)")
    n_figures = page.locator("figure").count()
    assert len(addresses) == 8 + 2 * n_figures
    assert {page.request.get(address).status for address in addresses} == {200}
