"""A whole site of hostile submissions beside the same site with harmless words: only the words differ."""

import csv
import io
import json
import re
from collections.abc import Iterator
from dataclasses import replace
from xml.etree import ElementTree as ET
from xml.etree.ElementTree import Element

import pytest

from builders import build_entry, build_reference
from hostile_texts import PRINTABLE
from hostile_twins import Twins
from leaderboard.models.metadata import Links
from site_builders import build_material, parse_html, render_files, text_of

KINDS = (
    *("element", "script", "attribute", "drawing", "comment", "entity", "style", "template"),
    *("formula", "at", "wide formula", "quotes", "separator"),
)
LINK = "https://x.example/?a=&lt;script&gt;&#34;&b=%22%3E%3Cb%3E;javascript:alert(1)#--"

Sites = tuple[dict[str, bytes], dict[str, bytes]]


@pytest.fixture(scope="module")
def twins() -> Twins:
    texts = [PRINTABLE[kind] for kind in KINDS]
    return Twins(build_reference(), texts, list(map(disarm, texts)))


@pytest.fixture(scope="module")
def sites(twins: Twins) -> Sites:
    """The hostile site and the harmless one, path to bytes."""
    hostile, harmless = (
        render_files(build_material(twins.reference, entries)) for entries in (twins.hostile, twins.harmless)
    )
    return hostile, harmless


def differing(sites: Sites, suffix: str) -> Iterator[tuple[str, bytes, bytes]]:
    """Yield what is not the same on both sites, of one kind of file."""
    hostile, harmless = sites
    assert list(hostile) == list(harmless)
    for path, content in hostile.items():
        if path.endswith(suffix) and content != harmless[path]:
            yield path, content, harmless[path]


def disarm(text: str) -> str:
    """Put a letter in place of whatever is neither letter, digit nor blank."""
    return re.sub(r"[^\w\s]|_", "q", text)


def lay_out(root: Element) -> list[tuple[str, dict[str, str], str, str]]:
    """List every element with its attributes and the disarmed text in and behind it, blanks collapsed.

    Only the order of names may be another, and what LaTeX needs in a citation, which has a test of its own.
    """
    return [
        (
            str(element.tag),
            {key: disarm(text) for key, text in element.attrib.items() if key != "data-place"},
            "BibTeX"
            if (element.text or "").startswith("@misc{")
            else disarm(" ".join((element.text or "").split())),
            disarm(" ".join((element.tail or "").split())),
        )
        for element in root.iter()
    ]


def test_pages_have_no_other_element_or_attribute(sites: Sites) -> None:
    """A parser finds the same elements, attributes and texts, the latter but for their signs."""
    headings = {}
    for path, content, twin in differing(sites, ".html"):
        page = parse_html(content)
        assert lay_out(page) == lay_out(parse_html(twin)), path
        headings[path] = text_of(next(page.iter("h1")))
    assert "index.html" in headings
    names = {f"submissions/entry-{n:02}/index.html": PRINTABLE[kind] for n, kind in enumerate(KINDS)}
    assert headings == headings | names  # the name is the heading of its page, to the letter


def test_feeds_have_none_either(sites: Sites) -> None:
    """The same for the feed."""
    ((_, content, twin),) = differing(sites, ".xml")
    found, expected = (lay_out(ET.fromstring(text)) for text in (content, twin))  # noqa: S314 - our own output
    assert found == expected


def test_drawings_have_none_either(sites: Sites) -> None:
    """In drawings long names are cut, by the width of their letters; the rest is the same."""
    for path, content, twin in differing(sites, ".svg"):
        found, expected = (
            [(tag, set(attributes)) for tag, attributes, _, _ in lay_out(ET.fromstring(text))]  # noqa: S314
            for text in (content, twin)
        )
        assert found == expected, path


def test_programs_get_every_text_as_it_is(sites: Sites, twins: Twins) -> None:
    """In JSON, the words alone differ."""
    for path, content, twin in differing(sites, ".json"):
        expected = twins.translate(twin.decode(), lambda text: json.dumps(text, ensure_ascii=False)[1:-1])
        assert json.loads(content) == json.loads(expected), path


def test_no_table_computes_anything(sites: Sites, twins: Twins) -> None:
    """In CSV every cell is the word, or the word behind an apostrophe; none begins as a formula does."""
    paths = []
    for path, content, twin in differing(sites, ".csv"):
        tables = [list(csv.reader(io.StringIO(text.decode()))) for text in (content, twin)]
        for row, plain in zip(*tables, strict=True):
            for cell, word in zip(row, plain, strict=True):
                assert cell in {twins.translate(word), f"'{twins.translate(word)}"}, path
                assert cell == word or not cell.startswith(tuple("=+-@\uff1d\uff0b\uff0d\uff20")), path
        paths.append(path)
    assert "leaderboard.csv" in paths


def test_links_are_links_and_nothing_more() -> None:
    """What is an address stays one, to the letter; search engines are told not to follow it."""
    reference = build_reference()
    entry = build_entry(reference, "entry", [0.4] * reference.n_trials)
    links = Links(paper=LINK, code=LINK, weights=LINK)
    entry = replace(entry, metadata=entry.metadata.model_copy(update={"links": links}))
    page = parse_html(render_files(build_material(reference, [entry]))["submissions/entry/index.html"])
    found = [a for a in page.iter("a") if "x.example" in a.get("href", "")]
    assert [(a.get("href"), "nofollow" in a.get("rel", "")) for a in found] == [(LINK, True)] * 3
