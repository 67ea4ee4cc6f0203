"""Figures on pages: whole, accessible, safe, and honest about what they are made from."""

from collections import Counter
from dataclasses import replace
from math import isfinite
from xml.etree.ElementTree import Element, fromstring

import numpy as np
import pytest

from builders import build_entry, build_reference
from leaderboard.website.board_pages import BoardPage
from leaderboard.website.building import compose_pages
from leaderboard.website.figure_pages import FigurePage
from leaderboard.website.figures.marks import Drawing
from leaderboard.website.forests import DRAWN
from leaderboard.website.material import Material
from leaderboard.website.paper_figures import MAX_SYSTEMS
from leaderboard.website.rendering import environment
from site_builders import HOSTILE_NAME, build_material, html_files, render_files, text_of

WARNING = "Synthetic reference: labels and people are simulated."
PANELS = ["I Accuracy, all", "II Accuracy, easy", "III Accuracy, hard"]
PANELS += ["IV Human r, all", "V Human r, easy", "VI Human r, hard"]


def print_svg(drawing: Drawing) -> str:
    return str(environment().get_template("drawings.html").module.svg(drawing))  # type: ignore[attr-defined]


def parse_svg(svg: str) -> Element:
    """Parse a figure alone, and fail where a place is not a finite number."""
    root = fromstring(svg)  # noqa: S314 - our own figure
    for element in root.iter():
        for name in ("x", "y", "width", "height"):
            assert isfinite(float(element.get(name, "0")))
    return root


def drawings_of(material: Material) -> dict[str, list[Drawing]]:
    found = {}
    for _, page in compose_pages(material):
        lists = (getattr(page, name, ()) for name in ("drawings", "diagrams", "panels"))
        found[page.path] = [drawing for drawings in lists for drawing in drawings]
    return found


def figure_page(material: Material) -> FigurePage:
    return next(page for _, page in compose_pages(material) if isinstance(page, FigurePage))


@pytest.fixture(scope="module")
def figures(files: dict[str, bytes]) -> dict[str, list[Element]]:
    return {path: [e for e in page.iter() if e.tag.endswith("svg")] for path, page in html_files(files)}


def test_every_kind_of_page_has_its_figures(figures: dict[str, list[Element]]) -> None:
    """Boards, people, the paper's figure for each track, and submissions, as far as they have the data."""
    counts = {path: len(found) for path, found in figures.items() if found}
    assert counts["index.html"] == counts["tracks/without/index.html"] == 2
    assert counts["figure.html"] == counts["tracks/without/figure.html"] == 6
    assert counts["people.html"] == 3
    assert counts["submissions/good/index.html"] == 7
    assert counts["submissions/sliver/index.html"] == 5


def test_every_figure_can_be_read_aloud(figures: dict[str, list[Element]]) -> None:
    """It is an image with a title and a description with numbers, whose ids are unique in their page."""
    for path, found in figures.items():
        ids: Counter[str] = Counter()
        for svg in found:
            title, description = list(svg)[:2]
            assert svg.get("role") == "img"
            assert (svg.get("aria-labelledby"), svg.get("aria-describedby")) == (
                title.get("id"),
                description.get("id"),
            )
            assert text_of(title)
            assert any(letter.isdigit() for letter in text_of(description)), (path, text_of(title))
            ids.update(element.get("id", "") for element in svg.iter() if element.get("id"))
        assert not [name for name, count in ids.items() if count > 1], path


def test_no_figure_needs_what_the_policy_forbids(figures: dict[str, list[Element]]) -> None:
    """No style of its own, no script, no link; colours are variables of the style sheet."""
    for found in figures.values():
        for element in (element for svg in found for element in svg.iter()):
            assert element.tag.rpartition("}")[2] in {"svg", "title", "desc", "g", "path", "rect", "text"}
            assert "style" not in element.attrib
            for name in ("fill", "stroke"):
                colour = element.get(name, "none")
                assert colour == "none" or colour.startswith("var(--")


def test_every_figure_of_simulated_data_says_so(material: Material) -> None:
    """In sight and in its description, since it may be shown without its page."""
    drawings = [drawing for found in drawings_of(material).values() for drawing in found]
    assert drawings
    for drawing in drawings:
        words = [text.text for layer in drawing.layers for text in layer.texts]
        assert WARNING in words, drawing.key
        assert drawing.description.endswith(WARNING)


def test_every_figure_is_whole_alone(material: Material) -> None:
    """It is well-formed XML, with other colours too, and no coordinate is anything but a number."""
    for drawings in drawings_of(material).values():
        for drawing in drawings:
            svg = print_svg(drawing)
            parse_svg(svg)
            loud = replace(drawing, palette=replace(drawing.palette, model="#123456", people="#654321"))
            assert "var(--link)" not in print_svg(loud)


def test_hostile_names_stay_words(material: Material) -> None:
    """Markup in a name is a text of the figure, whole in its title."""
    board = next(page for _, page in compose_pages(material) if isinstance(page, BoardPage))
    svg = parse_svg(print_svg(board.drawings[0]))
    titles = [text_of(element) for element in svg.iter("title")]
    assert any(title.startswith(HOSTILE_NAME) for title in titles)
    assert not list(svg.iter("img"))


def test_the_board_is_drawn_in_its_order(material: Material) -> None:
    """Ranked submissions from the first to the last; partial ones and baselines are not among them."""
    board = next(page for _, page in compose_pages(material) if isinstance(page, BoardPage))
    (ranked,) = [section for section in board.sections if section.kind == "ranked"]
    places = [board.drawings[0].description.index(f"; {row.name}: ") for row in ranked.rows]
    assert places == sorted(places)
    assert "Oracle" not in board.drawings[0].description


def test_the_papers_figure_has_six_panels(material: Material) -> None:
    """Accuracy above human r; all, easy, hard; panels of one metric share an axis and its place."""
    page = figure_page(material)
    assert [panel.title for panel in page.panels] == PANELS
    accuracy = [[text.x for layer in panel.layers for text in layer.texts] for panel in page.panels[:3]]
    assert len({max(places) for places in accuracy}) == 1
    assert "People: " in page.panels[0].description
    assert "People, split-half: " in page.panels[3].description
    assert "ceiling: " in page.panels[3].description
    assert "People, split-half: not computed for people" in page.panels[4].description


def test_many_submissions_are_cut_short() -> None:
    """The board's own figures show sixty, the paper's panels the first few; both say what they show."""
    reference = build_reference()
    probabilities = np.linspace(0, 1, reference.n_trials)
    entries = [
        build_entry(reference, f"system-{n:02d}", np.roll(probabilities, n).tolist()) for n in range(61)
    ]
    material = build_material(reference, entries)
    page = figure_page(material)
    assert f"the first {MAX_SYSTEMS} of 61 ranked submissions" in page.summary
    board = next(page for _, page in compose_pages(material) if isinstance(page, BoardPage))
    labels = [
        t.text for layer in board.drawings[0].layers for t in layer.texts if t.text.startswith("system-")
    ]
    assert len(labels) == DRAWN == 60
    said = "The first 60 of 61 ranked submissions, overall, with 95 % intervals."
    assert board.drawings[0].caption == said
    assert len(print_svg(board.drawings[0])) < 25_000


def test_figures_without_submissions_or_people() -> None:
    """Without submissions people are drawn alone; without people only accuracy is; nothing fails."""
    empty = build_material(build_reference(), [])
    assert [panel.title for panel in figure_page(empty).panels] == PANELS
    lonely = build_reference(n_people=0)
    entry = build_entry(lonely, "one", [0.7] * lonely.n_trials)
    material = build_material(lonely, [entry])
    counts = {path: len(drawings) for path, drawings in drawings_of(material).items() if drawings}
    parts = {path: count for path, count in counts.items() if path.startswith("properties/")}
    assert set(parts.values()) == {1}
    assert {path: count for path, count in counts.items() if path not in parts} == {
        "index.html": 1,
        "figure.html": 1,
        "submissions/one/index.html": 4,
    }
    assert {path for path, _ in html_files(render_files(material))} >= {"people.html", "figure.html"}


def test_an_official_figure_does_not_speak_of_simulation() -> None:
    """No warning where labels and people are real."""
    synthetic = build_reference()
    official = replace(synthetic, manifest=synthetic.manifest.model_copy(update={"kind": "official"}))
    entry = build_entry(official, "one", [0.7] * official.n_trials)
    for drawings in drawings_of(build_material(official, [entry])).values():
        assert not [drawing for drawing in drawings if "ynthetic" in print_svg(drawing)]
