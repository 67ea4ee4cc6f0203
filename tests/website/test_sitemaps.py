"""Search engines find every page where the site's address is known, and others a picture to show."""

import struct
from collections.abc import Iterator
from dataclasses import replace
from xml.etree.ElementTree import fromstring

import pytest

from builders import build_entry, build_reference
from leaderboard.website.material import Material
from leaderboard.website.previews import PREVIEW_HEIGHT, PREVIEW_WIDTH, compose_preview
from leaderboard.website.rendering import frame_of
from leaderboard.website.sitemaps import MAX_ENTRIES, render_sitemap
from leaderboard.website.texts import Texts
from site_builders import HOSTILE_NAME, build_material, html_files, parse_html, render_files

SITE = "https://example.org/board/"
SITEMAPS = "{http://www.sitemaps.org/schemas/sitemap/0.9}"


@pytest.fixture(scope="module")
def addressed(material: Material) -> dict[str, bytes]:
    """Render the site of maintainers who say where it is served."""
    return render_files(replace(material, texts=Texts(url=SITE)))


def list_addresses(content: bytes) -> list[str]:
    """Read a sitemap; it holds addresses and nothing else."""
    root = fromstring(content.decode())  # noqa: S314 - our own sitemap
    assert root.tag == f"{SITEMAPS}urlset"
    assert {element.tag for url in root for element in (url, *url)} <= {f"{SITEMAPS}url", f"{SITEMAPS}loc"}
    return [url.findtext(f"{SITEMAPS}loc", "") for url in root]


def tags_of(content: bytes) -> dict[str, str]:
    """Read what a page tells those who show a link to it."""
    metas = list(parse_html(content).iter("meta"))
    return {meta.get("property", ""): meta.get("content", "") for meta in metas if meta.get("property")}


def test_the_sitemap_lists_every_page(addressed: dict[str, bytes]) -> None:
    """Sorted, each once, as pages link each other; the one for missing pages is no page to find."""
    found = list_addresses(addressed["sitemap.xml"])
    pages = {path for path, _ in html_files(addressed)} - {"404.html"}
    assert found == sorted(f"{SITE}{path}" for path in pages)


def test_addresses_are_escaped() -> None:
    """Whatever a path holds, the address is one, and the file is XML."""
    assert list_addresses(render_sitemap("https://example.org/?a=1&b=2/", ["a b/<c>.html"])) == [
        "https://example.org/?a=1&b=2/a%20b/%3Cc%3E.html"
    ]


def test_a_sitemap_has_at_most_as_many_entries_as_it_may() -> None:
    """What comes last is left out."""
    paths = [f"{number:06}.html" for number in range(MAX_ENTRIES + 5)]
    found = list_addresses(render_sitemap(SITE, paths))
    assert found == [f"{SITE}{path}" for path in paths[:MAX_ENTRIES]]


def test_without_an_address_there_is_neither(files: dict[str, bytes]) -> None:
    """No sitemap, no picture, and no page that names one: none of them may be relative."""
    assert not {"sitemap.xml", "preview.png"} & files.keys()
    assert not [path for path, content in files.items() if path.endswith(".html") and tags_of(content)]


def test_every_page_says_how_to_show_a_link_to_it(addressed: dict[str, bytes]) -> None:
    """Its title, what it is about, its address, and the picture; all but the words are whole addresses."""
    for path, content in addressed.items():
        if path.endswith(".html"):
            tags = tags_of(content)
            assert (tags["og:url"], tags["og:image"]) == (f"{SITE}{path}", f"{SITE}preview.png")
            assert tags["og:title"].endswith(" (synthetic)")
    hostile = tags_of(addressed["submissions/hostile/index.html"])
    assert hostile["og:title"] == f"{HOSTILE_NAME} (synthetic)"


def test_the_picture_has_the_size_that_pages_say(addressed: dict[str, bytes]) -> None:
    """1,200 by 630 pixels, of a board with submissions and of one without."""
    tags = tags_of(addressed["index.html"])
    said = int(tags["og:image:width"]), int(tags["og:image:height"])
    empty = render_files(replace(build_material(build_reference(1), []), texts=Texts(url=SITE)))
    for files in (addressed, empty):
        assert struct.unpack(">II", files["preview.png"][16:24]) == said == (1200, 630)


def texts_in(material: Material) -> Iterator[str]:
    """List the words in the picture."""
    picture = compose_preview(material, frame_of(material.reference, texts=material.texts))
    for drawing in (picture.around, *(place.drawing for place in picture.placed)):
        yield from (text.text for layer in drawing.layers for text in layer.texts)
    assert (picture.around.width, picture.around.height) == (PREVIEW_WIDTH, PREVIEW_HEIGHT)
    assert all(place.y + place.drawing.height <= PREVIEW_HEIGHT for place in picture.placed)


def test_the_picture_shows_what_the_site_is(material: Material) -> None:
    """Its title, how much is on it, that the reference is simulated, and who is on the first board."""
    words = " ".join(texts_in(replace(material, texts=Texts(title="Mine", url=SITE))))
    for shown in ("Mine", "7 submissions, 24", "Tiny 1", "Synthetic reference: labels", "Good too"):
        assert shown in words
    assert "other-track" not in words


def test_the_picture_of_a_long_board_shows_its_top() -> None:
    """As many rows as there is room for."""
    reference = build_reference(1)
    entries = [
        build_entry(reference, f"entry-{index:02d}", [index / 60] * reference.n_trials) for index in range(20)
    ]
    words = list(texts_in(build_material(reference, entries)))
    assert len([text for text in words if text.startswith("entry-")]) == 8
