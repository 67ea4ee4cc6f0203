"""Pages as bytes: safe, whole, and linked relatively."""

import gzip
import re
from dataclasses import replace
from importlib.resources import files as package_files
from itertools import pairwise
from posixpath import normpath
from urllib.parse import unquote, urlsplit
from xml.etree.ElementTree import Element

import numpy as np
import pytest
from jinja2 import UndefinedError

from builders import build_entry, build_reference
from leaderboard.grading import METRICS_VERSION
from leaderboard.website.boards import compose_board
from leaderboard.website.rendering import environment, frame_of, render_page
from leaderboard.website.trial_paths import trial_path
from site_builders import (
    HOSTILE_NAME,
    HOSTILE_TEAM,
    HOSTILE_TEXT,
    build_material,
    html_files,
    parse_html,
    render_files,
    text_of,
)

POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; font-src 'self'; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'"
)
BANNER = "Synthetic reference."
TEMPLATES = package_files("leaderboard.website") / "templates"


@pytest.fixture(scope="module")
def pages(files: dict[str, bytes]) -> dict[str, Element]:
    return dict(html_files(files))


def test_the_environment_escapes_and_refuses_unknown_names() -> None:
    """In every template whatever its name, and a name that is not there is an error, not an empty text."""
    assert environment().autoescape is True
    assert environment().from_string("{{ text }}").render(text="<b>&'\"") == "&lt;b&gt;&amp;&#39;&#34;"
    with pytest.raises(UndefinedError, match="'nothing' is undefined"):
        environment().from_string("{{ nothing }}").render()


def test_no_template_switches_escaping_off() -> None:
    """No template says safe, autoescape or Markup, and none holds style or script but in files of its own."""
    found = [
        (template.name, hit)
        for template in TEMPLATES.iterdir()
        for hit in re.findall(
            r"\|\s*safe|autoescape|Markup|<style|<script(?! defer src=)| style=| on\w+=", template.read_text()
        )
    ]
    assert found == []


def test_the_policy_comes_first(files: dict[str, bytes]) -> None:
    """On every page the content policy stands before anything that it could forbid."""
    for path, content in files.items():
        if path.endswith(".html"):
            head = content.decode().partition("<head>")[2].lstrip()
            assert head.startswith(f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'), path


def test_nothing_comes_from_elsewhere(pages: dict[str, Element]) -> None:
    """No frame or form; scripts, style and icon lie beside the pages; only links lead out."""
    for path, page in pages.items():
        tags = {element.tag for element in page.iter()}
        assert tags.isdisjoint({"style", "iframe", "object", "embed", "form", "base", "img"}), path
        loaded = [link.get("href", "") for link in page.iter("link")]
        loaded += [script.get("src", "") for script in page.iter("script")]
        assert all(not urlsplit(link).scheme and not urlsplit(link).netloc for link in loaded), path
        assert not [element for element in page.iter() if any(key.startswith("on") for key in element.attrib)]


def test_the_style_loads_nothing(files: dict[str, bytes]) -> None:
    """It imports nothing and names no address."""
    (style,) = [content.decode() for path, content in files.items() if path.endswith(".css")]
    assert not re.search(r"@import|url\(|https?:|@font-face", style)


def test_hostile_metadata_stays_text(pages: dict[str, Element]) -> None:
    """A parser finds the text as it was written, and no element that it tried to make."""
    page = pages["submissions/hostile/index.html"]
    assert text_of(next(page.iter("h1"))) == HOSTILE_NAME
    paragraphs = [text_of(paragraph) for paragraph in page.iter("p")]
    assert HOSTILE_TEXT in paragraphs
    assert HOSTILE_TEAM in paragraphs
    (row,) = [row for row in pages["index.html"].iter("tr") if row.get("id") == "hostile"]
    assert HOSTILE_NAME in text_of(row)
    assert HOSTILE_TEAM in text_of(row)
    assert len(list(row)) == len(next(r for r in pages["index.html"].iter("tr") if r.get("id") == "good"))


@pytest.mark.parametrize(
    "path",
    [
        "compare/good--vs--hostile/index.html",
        "compare/index.html",
        "figure.html",
        "index.html",
        "properties/alpha/alpha_one/index.html",
        "properties/alpha/index.html",
        "submissions/hostile/trials.html",
        trial_path("alpha_one-copy0/set=a,b/0000"),
    ],
)
def test_a_hostile_name_is_text_wherever_submissions_are_named(path: str, pages: dict[str, Element]) -> None:
    """The name is there letter by letter, and nothing on the page could run or hide anything."""
    page = pages[path]
    assert HOSTILE_NAME in text_of(page)
    tags = {element.tag for part in page.iter("main") for element in part.iter()}
    assert tags.isdisjoint({"img", "script", "style", "iframe", "object", "form"})
    addresses = [element.get("href", "") for element in page.iter()]
    assert not [address for address in addresses if "javascript:" in address or "alert" in address]


def test_the_banner_is_on_every_page(pages: dict[str, Element]) -> None:
    """A synthetic reference is named before anything else, in the title and in the footer."""
    for path, page in pages.items():
        banner = next(paragraph for paragraph in page.iter("p"))
        assert text_of(banner).startswith(BANNER), path
        assert "(synthetic)" in text_of(next(page.iter("title"))), path
        assert "synthetic" in text_of(next(page.iter("footer"))), path


def test_an_official_reference_has_no_banner() -> None:
    """The word synthetic is nowhere on a page of real figures."""
    synthetic = build_reference()
    official = synthetic.manifest.model_copy(update={"kind": "official"})
    files = render_files(build_material(replace(synthetic, manifest=official)))
    assert not [path for path, content in files.items() if path.endswith(".html") and b"ynthetic" in content]


def test_the_footer_says_what_the_numbers_are_made_with(pages: dict[str, Element]) -> None:
    """Reference, digest, grader and version of the metrics stand on every page."""
    for page in pages.values():
        footer = text_of(next(page.iter("footer")))
        assert "Tiny 1" in footer
        assert "0" * 64 in footer
        assert f"metrics version {METRICS_VERSION}" in footer


def resolve(path: str, target: str) -> str:
    """Follow a relative link from a page; a link that leaves the site keeps its dots."""
    file = unquote(target.partition("#")[0].partition("?")[0])
    return normpath(f"{path}/../{file}") if file else path


def test_every_link_leads_somewhere(files: dict[str, bytes], pages: dict[str, Element]) -> None:
    """Links are relative, to files that are there and to places in them that exist."""
    for path, page in pages.items():
        for target in filter(None, (element.get("href") for element in page.iter())):
            if not target.startswith("http"):
                found, place = resolve(path, target), target.partition("#")[2]
                assert found in files, (path, target)
                assert not place or place in {element.get("id") for element in pages[found].iter()}


def test_every_page_can_be_reached(pages: dict[str, Element]) -> None:
    """From the first page, following links, to every page but the one for missing pages."""
    reached, todo = {"index.html"}, ["index.html"]
    while todo:
        path = todo.pop()
        found = {resolve(path, link.get("href", "")) for link in pages[path].iter("a")} & pages.keys()
        todo += found - reached
        reached |= found
    assert reached == pages.keys() - {"404.html"}


def test_ids_are_unique_and_headings_in_order(pages: dict[str, Element]) -> None:
    """Each page has one main heading, no heading skips a level, and no id is given twice."""
    for path, page in pages.items():
        ids = [element.get("id") for element in page.iter() if element.get("id")]
        assert len(ids) == len(set(ids)), path
        levels = [int(str(e.tag)[1]) for e in page.iter() if re.fullmatch(r"h[1-6]", str(e.tag))]
        assert levels.count(1) == 1
        assert levels[0] == 1
        assert all(after <= before + 1 for before, after in pairwise(levels)), path


def test_tables_fit_together(pages: dict[str, Element]) -> None:
    """Every row spans as many columns as its table has, every header cell says what it heads."""
    for path, page in pages.items():
        for table in page.iter("table"):
            widths = {
                sum(int(cell.get("colspan", "1")) for cell in row)
                for body in table.iter("tbody")
                for row in body.iter("tr")
            }
            assert len(widths) == 1, path
            assert all(cell.get("scope") for cell in table.iter("th")), path


def test_boards_and_comparisons_have_scripts(files: dict[str, bytes], pages: dict[str, Element]) -> None:
    """The library first, then our own; classic, so that they run from plain files, and empty inside."""
    for path, page in pages.items():
        scripts = list(page.iter("script"))
        sources = [resolve(path, script.get("src", "")) for script in scripts]
        is_board = any(table.get("class") == "board" for table in page.iter("table"))
        names = [source.split(".")[0] for source in sources]
        is_comparer = any(section.get("class") == "compared" for section in page.iter("section"))
        of_comparer = ["data/comparing", "assets/compare"] if is_comparer else []
        assert names == (["assets/datatables", "assets/site"] if is_board else of_comparer), path
        assert all(source in files for source in sources), path
        assert all(set(script.attrib) == {"defer", "src"} and not script.text for script in scripts), path


@pytest.mark.parametrize("name", ["site", "compare"])
def test_our_scripts_are_small(files: dict[str, bytes], name: str) -> None:
    """Compressed, the one that a page loads stays within 12 kB; strict, and no element is made from text."""
    (path,) = [path for path in files if re.fullmatch(rf"assets/{name}\.[0-9a-f]{{10}}\.js", path)]
    assert len(gzip.compress(files[path])) < 12_000
    script = files[path].decode()
    assert '"use strict";' in script
    assert not re.search(
        r"innerHTML|outerHTML|insertAdjacentHTML|eval\(|Function\(|document\.write|\.style\b", script
    )


def test_the_index_stays_small_with_200_submissions() -> None:
    """With 200 submissions the first page stays within 60 kB compressed."""
    reference = build_reference()
    rng = np.random.default_rng(8)
    entries = [
        build_entry(reference, f"system-{index:03d}", rng.random(reference.n_trials).tolist())
        for index in range(200)
    ]
    material = build_material(reference, entries)
    board = compose_board(material.boards[0], material)
    page = render_page("board.html", frame_of(reference), board)
    assert len(gzip.compress(page)) < 60_000


def test_style_is_small_and_named_by_its_content(files: dict[str, bytes]) -> None:
    """The whole style stays within 8 kB compressed, and a changed style gets a new name."""
    (path,) = [path for path in files if path.endswith(".css")]
    assert re.fullmatch(r"assets/site\.[0-9a-f]{10}\.css", path)
    assert len(gzip.compress(files[path])) < 8_000


def test_pages_parse_without_a_complaint(files: dict[str, bytes]) -> None:
    """The strict parser of the HTML standard accepts every page."""
    assert len([parse_html(content) for path, content in files.items() if path.endswith(".html")]) == 72
