"""Figures as files: whole by themselves, the same everywhere, with the numbers that they were drawn from."""

import csv
import io
import re
import struct
import sys
from dataclasses import fields, replace
from hashlib import sha256
from math import isfinite
from pathlib import Path
from xml.etree.ElementTree import Element, fromstring

import pytest
from hypothesis import given
from hypothesis import strategies as st

from builders import build_entry, build_reference
from leaderboard.errors import InstanceError
from leaderboard.website.building import compose_pages
from leaderboard.website.figure_exports import (
    compose_picture,
    describe_origin,
    render_figures,
    render_numbers,
)
from leaderboard.website.figure_files import MAX_PICTURE, Export
from leaderboard.website.figure_pages import PeoplePage
from leaderboard.website.figures.lettering import estimate_width, wrap
from leaderboard.website.figures.marks import Drawing
from leaderboard.website.figures.palette import ON_THEIR_OWN, Palette
from leaderboard.website.material import Material
from leaderboard.website.pages import Page
from leaderboard.website.rasterizing import FONTS, render_png
from leaderboard.website.rendering import frame_of
from site_builders import HOSTILE_NAME, build_material, html_files

SVG = "{http://www.w3.org/2000/svg}"
PNG_START = b"\x89PNG\r\n\x1a\n"
FONT_DIR = Path(sys.modules["leaderboard.website"].__file__ or "").parent / "fonts"
SQUARE = '<svg xmlns="http://www.w3.org/2000/svg" width="30" height="20"><text y="9">{}</text></svg>'


@pytest.fixture(scope="module")
def exported(files: dict[str, bytes]) -> dict[str, bytes]:
    """Pick the files of figures."""
    return {path: content for path, content in files.items() if "figures" in path.split("/")}


@pytest.fixture(scope="module")
def drawings(material: Material) -> dict[str, list[Drawing]]:
    """List the figures of each page."""
    return {page.path: list(page.figures) for _, page in compose_pages(material)}


def read_table(content: bytes) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(content.decode(), newline="")))


def read_size(png: bytes) -> tuple[int, int]:
    """Read how wide and how high a picture is from its header."""
    assert png.startswith(PNG_START)
    width, height = struct.unpack(">II", png[16:24])
    return width, height


def texts_of(root: Element) -> str:
    return " ".join(element.text or "" for element in root.iter(f"{SVG}text"))


def test_every_figure_has_its_files(files: dict[str, bytes], drawings: dict[str, list[Drawing]]) -> None:
    """Each figure of each page as SVG and CSV beside it, linked below it, and nothing that is not linked."""
    linked, drawn = set(), set()
    for path, page in html_files(files):
        folder = path.rpartition("/")[0]
        found = {link.get("href", "") for link in page.iter("a")}
        linked |= {f"{folder}/{link}".lstrip("/") for link in found if link.startswith("figures/")}
        for drawing in drawings.get(path, []):
            stem = path.rpartition("/")[2].removesuffix(".html")
            place = f"{folder}/figures/{drawing.key if stem == 'index' else f'{stem}/{drawing.key}'}".lstrip(
                "/"
            )
            drawn |= {f"{place}.{ending}" for ending in ("svg", "csv")}
    assert drawn
    assert drawn <= linked
    assert linked == {path for path in files if "figures" in path.split("/")}


def test_no_two_figures_share_a_file(material: Material) -> None:
    """Pages of one folder name their figures differently."""
    pages = [page for _, page in compose_pages(material)]
    paths = [path for path, _ in render_figures(frame_of(material.reference), pages)]
    assert len(paths) == len(set(paths))


def test_an_svg_stands_alone(exported: dict[str, bytes]) -> None:
    """Literal colours, one font by name with its like, title and description; no variable, script or link."""
    drawings = {path: content for path, content in exported.items() if path.endswith(".svg")}
    assert drawings
    for path, content in drawings.items():
        root = fromstring(content.decode())  # noqa: S314 - our own figure
        assert root.tag == f"{SVG}svg"
        assert [child.tag for child in root][:2] == [f"{SVG}title", f"{SVG}desc"], path
        assert root.get("font-family") == "Liberation Sans, Arial, Helvetica, sans-serif"
        assert not re.search(rb"var\(|currentColor|system-ui|<script|<style|href=|url\(", content), path
        colours = {e.get(name) for e in root.iter() for name in ("fill", "stroke")} - {None, "none"}
        assert colours <= {getattr(ON_THEIR_OWN, field.name) for field in fields(Palette)}, path


def test_an_svg_says_what_it_shows_and_from_where(exported: dict[str, bytes], material: Material) -> None:
    """Heading, title, caption, that the reference is synthetic, its digest, and what graded it, as words."""
    shown = texts_of(fromstring(exported["submissions/good/figures/forest-accuracy.svg"].decode()))  # noqa: S314
    assert shown.startswith("Good Accuracy Overall, by property and by scenario, with 95 % intervals.")
    assert "Synthetic reference: labels and people are simulated." in shown
    origin = describe_origin(frame_of(material.reference))
    assert origin in shown
    assert re.fullmatch(r"Tiny 1, synthetic reference 0{12}; grader [\d.]+, metrics version \d+\.", origin)


def test_hostile_names_stay_text_in_figures(exported: dict[str, bytes]) -> None:
    """An SVG shows what a stranger wrote; a table keeps a spreadsheet from running it."""
    root = fromstring(exported["submissions/hostile/figures/scatter.svg"].decode())  # noqa: S314
    assert HOSTILE_NAME in texts_of(root)
    assert not [element for element in root.iter() if element.tag == f"{SVG}img"]
    names = {row["name"] for row in read_table(exported["figures/forest-accuracy.csv"])}
    assert f"'{HOSTILE_NAME}" in names
    assert HOSTILE_NAME not in names


def test_all_panels_are_one_picture(exported: dict[str, bytes], drawings: dict[str, list[Drawing]]) -> None:
    """Three abreast and none above another; the table says which panel a number is from."""
    panels = drawings["figure.html"]
    picture = compose_picture(Export("panels", tuple(panels), (), n_abreast=3), "Heading", "Origin")
    boxes = [(p.x, p.y, p.x + p.drawing.width, p.y + p.drawing.height) for p in picture.placed]
    assert len({box[0] for box in boxes}) == 3
    assert all(0 < box[0] < box[2] < picture.around.width for box in boxes)
    assert all(0 < box[1] < box[3] < picture.around.height for box in boxes)
    assert all(
        one[2] <= other[0] or one[3] <= other[1] for i, one in enumerate(boxes) for other in boxes[i + 1 :]
    )
    rows = read_table(exported["figures/figure/panels.csv"])
    assert list(dict.fromkeys(row["figure"] for row in rows)) == [panel.title for panel in panels]


def test_a_single_panel_fills_its_picture(drawings: dict[str, list[Drawing]]) -> None:
    """Without people there is one panel, and no empty place for others beside it."""
    panel = drawings["figure.html"][0]
    several = compose_picture(Export("panels", (panel,), (), n_abreast=3), "Heading", "Origin")
    assert several == compose_picture(Export("panels", (panel,), ()), "Heading", "Origin")


def test_the_numbers_are_those_of_the_result(exported: dict[str, bytes], material: Material) -> None:
    """A forest's table has each scope with value and interval, and people beside it."""
    entry = next(p.entry for p in material.publications if p.entry.slug == "good")
    rows = read_table(exported["submissions/good/figures/forest-accuracy.csv"])
    own = {row["name"]: row for row in rows if row["series"] == "this submission"}
    for name, scope in {"Overall": "overall", "Alpha": "Alpha", "alpha two": "alpha_two"}.items():
        score = entry.score("accuracy", scope)
        assert score is not None
        assert [own[name][part] for part in ("value", "low", "high")] == [
            str(number) for number in (score.value, score.low, score.high)
        ]
    assert [own[name]["group"] for name in ("Overall", "Alpha", "alpha two")] == ["", "", "Alpha"]
    assert {row["series"] for row in rows} == {"this submission", "people"}


def test_an_absent_number_has_its_reason(exported: dict[str, bytes]) -> None:
    """Where there is no value the table is empty and says why."""
    rows = read_table(exported["submissions/flat/figures/forest-human-r.csv"])
    own = [row for row in rows if row["series"] == "this submission"]
    assert own
    assert {row["value"] for row in own} == {""}
    assert all(row["why"] for row in own)


def test_points_have_their_trials(
    exported: dict[str, bytes], files: dict[str, bytes], material: Material
) -> None:
    """Of each trial that people judged: its number in the table of trials, label, share and probability."""
    people = material.reference.people
    assert people is not None
    rows = {row["trial"]: row for row in read_table(exported["submissions/good/figures/scatter.csv"])}
    assert len(rows) == int((people.n > 0).sum())
    for trial in read_table(files["trials.csv"]):
        index = material.reference.trial_index[trial["trial_id"]]
        if people.n[index]:
            label = int(material.reference.labels[index])
            row = rows[trial["trial"]]
            assert row["label"] == trial["label"] == str(label)
            assert float(row["probability"]) == (0.8 if label else 0.3)
            share = people.n_yes[index] / people.n[index]
            assert float(row["people_yes"]) == pytest.approx(share, abs=1e-6)


def test_parts_and_bins_add_up(exported: dict[str, bytes], material: Material) -> None:
    """Pairs by how many are right, trials by bin and trials by share are all of them."""
    folder, reference = "submissions/good/figures", material.reference
    pairs = read_table(exported[f"{folder}/pairs-right.csv"])[0]
    assert sum(int(pairs[part]) for part in ("both", "one", "none")) == len(reference.pair_ids)
    bins = read_table(exported[f"{folder}/calibration-overall-label.csv"])
    assert sum(int(row["trials"]) for row in bins) == reference.n_trials
    shares = read_table(exported["figures/people/people-spread.csv"])
    assert sum(int(row["trials"]) for row in shares) == material.count("overall").n_rated


def test_numbers_have_six_decimals(drawings: dict[str, list[Drawing]]) -> None:
    """Any more would say more than results do."""
    drawing = replace(drawings["people.html"][0], numbers={"share": [1 / 3, None], "why": ["", "=none"]})
    assert render_numbers([drawing]) == "share,why\n0.333333,\n,'=none\n"


def test_pictures_have_the_size_of_their_svg(exported: dict[str, bytes]) -> None:
    """A PNG is as large as its SVG says, on pages of which there are few, and nowhere else."""
    pictures = {path for path in exported if path.endswith(".png")}
    assert {path.partition("figures/")[0] for path in pictures} == {"", "tracks/without/"}
    assert {
        "figures/figure/panels.png",
        "figures/forest-accuracy.png",
        "figures/people/people-spread.png",
    } <= pictures
    for path in pictures:
        root = fromstring(exported[f"{path[:-4]}.svg"].decode())  # noqa: S314 - our own figure
        size = [float(root.get(name, "")) for name in ("width", "height")]
        assert all(isfinite(length) for length in size)
        assert read_size(exported[path]) == pytest.approx(tuple(size), abs=1), path


def test_a_long_board_is_no_picture(drawings: dict[str, list[Drawing]]) -> None:
    """A figure of hundreds of rows is had as SVG and numbers alone; a shorter one beside it as PNG too."""
    page = PeoplePage("a.html", "A", "", (), tuple(drawings["people.html"][:1]), None)
    long = replace(page.drawings[0], key="long", height=MAX_PICTURE + 1)
    exports = replace(page, drawings=(*page.drawings, long)).exports
    assert [export.formats for export in exports] == [("svg", "png", "csv"), ("svg", "csv")]


def test_the_same_figures_are_the_same_bytes(exported: dict[str, bytes], material: Material) -> None:
    """Composed and rendered again, pictures included."""
    pages = [page for _, page in compose_pages(material)]
    kept = [page for page in pages if page.path in {"figure.html", "people.html", "index.html"}]
    again = dict(render_figures(frame_of(material.reference), kept))
    assert again == {path: exported[path] for path in again}
    assert len(again) > 20


def test_letters_come_from_the_font_that_is_here() -> None:
    """Words leave marks, bold ones others; a machine's own fonts are not asked."""
    plain, bold, none = (
        render_png(SQUARE.format(text)) for text in ("Ag", '<tspan font-weight="bold">Ag</tspan>', "")
    )
    assert len({plain, bold, none}) == 3
    assert render_png(SQUARE.format("Ag").replace("<text", '<text font-family="DejaVu Sans"')) == none


def test_the_fonts_are_those_of_their_package() -> None:
    """Unchanged: their checksums are those that the note beside them gives; their licence is there."""
    note = (FONT_DIR / "README.md").read_text(encoding="utf-8")
    for name in FONTS:
        assert f"| `{name}` | `{sha256((FONT_DIR / name).read_bytes()).hexdigest()}` |" in note
    assert "SIL OPEN FONT LICENSE Version 1.1" in (FONT_DIR / "LICENSE.txt").read_text(encoding="utf-8")


def test_a_missing_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without what draws pictures the message says so, and what to do."""
    monkeypatch.setitem(sys.modules, "resvg_py", None)
    with pytest.raises(
        InstanceError, match="figures cannot be drawn as PNG, because resvg-py cannot be"
    ) as caught:
        render_png(SQUARE.format("A"))
    assert caught.value.hint.endswith("python -m pip install resvg-py")


def test_a_page_without_figures_has_no_files() -> None:
    """Nothing is rendered for it, and a board without rows has no files of figures either."""
    reference = build_reference()
    frame = frame_of(reference)
    assert list(render_figures(frame, [Page("a.html", "A", "")])) == []
    baseline = build_entry(reference, "flat", [0.5] * reference.n_trials, family="baseline")
    pages = [page for _, page in compose_pages(build_material(reference, [baseline]))]
    assert not [page for page in pages if page.path == "index.html" and page.exports]


@given(st.text(), st.floats(30, 300))
def test_what_is_wrapped_fits_and_loses_no_word(text: str, width: float) -> None:
    """Every line is within the width; only words that are longer than any line are cut."""
    lines = wrap(text, width, 12)
    assert all(estimate_width(line, 12) <= width for line in lines)
    if all(estimate_width(word, 12) <= width for word in text.split()):
        assert " ".join(lines) == " ".join(text.split())
