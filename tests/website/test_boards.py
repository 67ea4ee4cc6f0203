"""The page of a board: who stands where, with which numbers."""

import json
from dataclasses import replace
from xml.etree.ElementTree import Element

import numpy as np
import pytest

from builders import build_entry, build_reference
from leaderboard.website.boards import compose_board
from leaderboard.website.material import Material
from leaderboard.website.numbers import ABSENT, MINUS
from leaderboard.website.pages import BoardPage
from site_builders import build_entries, build_material, parse_html, render_files, text_of

COLUMNS = [
    ("accuracy", "overall", "all"),
    ("accuracy", "Alpha", "all"),
    ("accuracy", "Beta", "all"),
    ("accuracy", "overall", "easy"),
    ("accuracy", "overall", "hard"),
    ("human_r", "overall", "all"),
    ("pair_accuracy", "overall", "all"),
]


@pytest.fixture(scope="module")
def page(material: Material) -> BoardPage:
    return compose_board(material.boards[0], material)


@pytest.fixture(scope="module")
def index(files: dict[str, bytes]) -> Element:
    return parse_html(files["index.html"])


def names_by_section(page: BoardPage) -> dict[str, list[str]]:
    return {section.kind: [row.name for row in section.rows] for section in page.sections}


def row_of(index: Element, slug: str) -> Element:
    (row,) = [row for row in index.iter("tr") if row.get("id") == slug]
    return row


def numbers_of(row: Element) -> list[Element]:
    return [cell for cell in row.iter("td") if "number" in cell.get("class", "").split()]


def test_rows_stand_in_sections(page: BoardPage) -> None:
    """People come first, then ranked, then partial submissions, then baselines; each from the best."""
    sections = names_by_section(page)
    assert list(sections) == ["people", "ranked", "partial", "baseline"]
    assert sections["people"] == ["People"]
    assert sections["ranked"][:2] == ["Good", "Good too"]
    assert sections["partial"] == ["Part", "Sliver"]
    assert sections["baseline"] == ["Oracle", "Chance"]


def test_equal_scores_share_a_rank_and_others_have_none(page: BoardPage) -> None:
    """Ranks are 1, 1, 3; people, partial submissions and baselines have none."""
    ranks = {section.kind: [row.rank for row in section.rows] for section in page.sections}
    assert ranks == {"people": [""], "ranked": ["1", "1", "3"], "partial": ["", ""], "baseline": ["", ""]}


def test_badges_say_in_words_what_differs(page: BoardPage) -> None:
    """State as input, open checks, partial coverage and baselines are marked by words, not by colour."""
    badges = {row.slug: row.badges for section in page.sections for row in section.rows}
    assert badges["good"] == ("ground-truth state as input",)
    assert badges["good-too"] == ("see its checks",)
    assert badges["part"] == ("partial",)
    assert badges["oracle"] == ("baseline",)
    assert badges["hostile"] == ()


def test_partial_rows_say_what_they_cover(page: BoardPage) -> None:
    """Properties by name, or none, and how many of the trials."""
    details = {row.slug: row.details for section in page.sections for row in section.rows}
    assert details["part"] == ("Team", "covers Beta; 8 of 24 trials")
    assert details["sliver"] == ("Team", "covers no whole property; 8 of 24 trials")
    assert details["good"] == ("Team",)


def test_every_number_is_that_of_the_api(index: Element, files: dict[str, bytes]) -> None:
    """What a cell prints is its exact value rounded, and that is what the API holds."""
    for row in json.loads(files["api/leaderboard.json"])["tracks"][0]["rows"]:
        cells = numbers_of(row_of(index, row["slug"]))
        assert len(cells) == len(COLUMNS)
        for cell, (metric, scope, subset) in zip(cells, COLUMNS, strict=True):
            score = row["result"]["scores"].get(scope, {}).get(subset, {}).get(metric, {"value": None})
            assert_printed(cell, metric, score["value"])


def assert_printed(cell: Element, metric: str, value: float | None) -> None:
    if value is None:
        assert text_of(cell).startswith(ABSENT)
        assert cell.get("data-value") is None
        return
    assert float(cell.get("data-value", "nan")) == value
    factor, half_a_digit = (1, 0.0005) if metric == "human_r" else (100, 0.05)
    printed = float(text_of(cell).replace(MINUS, "-"))
    assert abs(printed - factor * value) <= half_a_digit + 1e-9


def test_people_are_pinned_with_their_own_scores(index: Element, files: dict[str, bytes]) -> None:
    """The row of people has their accuracy, and a dash for what makes no sense for them."""
    people = json.loads(files["api/leaderboard.json"])["people"]
    (body,) = [body for body in index.iter("tbody") if body.get("class") == "people"]
    cells = numbers_of(body)
    for cell, (metric, scope, subset) in zip(cells, COLUMNS, strict=True):
        assert_printed(cell, metric, people[scope][subset].get(metric, {"value": None})["value"])
    assert "not computed for people" in text_of(cells[-1])
    assert "12 people, 144 responses" in text_of(body)


def test_a_dash_tells_why_in_text_and_below_the_table(index: Element) -> None:
    """The reason can be read by eye, by pointer and by a screen reader."""
    dash = numbers_of(row_of(index, "flat"))[5]
    (mark,) = dash.iter("abbr")
    assert mark.get("title") == "undefined: all probabilities are equal"
    assert "undefined: all probabilities are equal" in text_of(dash)
    (notes,) = [notes for notes in index.iter("ol") if notes.get("class") == "footnotes"]
    number = int(next(dash.iter("sup")).text or 0)
    assert text_of(list(notes)[number - 1]) == "undefined: all probabilities are equal"


def test_headings_say_how_much_is_behind_a_column(index: Element, material: Material) -> None:
    """Trials or pairs stand under each column's name, and they are those of the reference."""
    headings = [text_of(th) for th in index.iter("th") if "number" in th.get("class", "").split()]
    easy, hard = (material.count("overall", subset).n for subset in ("easy", "hard"))
    assert headings == [
        "Overall 24 trials",
        "Alpha 16 trials",
        "Beta 8 trials",
        f"Easy {easy} trials",
        f"Hard {hard} trials",
        "Human r 24 trials",
        "Both right 12 pairs",
    ]


def test_only_tracks_with_submissions_have_boards(files: dict[str, bytes]) -> None:
    """Each board links the others; the default one is the first page."""
    other = parse_html(files["tracks/without/index.html"])
    (nav,) = [nav for nav in other.iter("nav") if nav.get("aria-label") == "Tracks"]
    links = {text_of(link): (link.get("href"), link.get("aria-current")) for link in nav.iter("a")}
    assert links == {
        "With 5 submissions": ("../../index.html", None),
        "Without 1 submission": ("../../tracks/without/index.html", "page"),
    }


def test_a_submission_without_track_is_named_on_the_first_page(page: BoardPage, material: Material) -> None:
    """Nothing that was graded is out of reach."""
    assert [(link.title, link.target) for link in page.elsewhere] == [
        ("Nowhere", "submissions/nowhere/index.html")
    ]
    assert compose_board(material.boards[1], material).elsewhere == ()


def test_an_empty_board_says_so() -> None:
    """Without submissions there is one board, people on it, and a sentence."""
    material = build_material(entries=[])
    files = render_files(material)
    index = parse_html(files["index.html"])
    assert "No submissions yet." in text_of(index)
    assert not [path for path in files if path.startswith("tracks/")]


def test_only_partial_submissions_leave_a_sentence_in_the_ranking() -> None:
    """An empty ranking above partial rows is explained."""
    reference = build_reference()
    partial = [entry for entry in build_entries(reference) if entry.slug == "part"]
    material = build_material(reference, partial)
    page = compose_board(material.boards[0], material)
    assert next(s for s in page.sections if s.kind == "ranked").note == "No complete submission yet."


def test_a_reference_without_people_and_pairs_has_fewer_columns() -> None:
    """There is no row of people and no column that could never hold a number."""
    paired = build_reference(n_people=0)
    lone = tuple(f"pair-{index}" for index in range(paired.n_trials))
    reference = replace(paired, pairs=np.arange(paired.n_trials), pair_ids=lone)
    material = build_material(reference, [build_entry(reference, "one", [0.7] * 24)])
    page = compose_board(material.boards[0], material)
    assert [column.title for group in page.groups for column in group.columns] == ["Overall", "Alpha", "Beta"]
    assert "people" not in names_by_section(page)
    assert [fact.title for fact in page.remarks] == ["How sure"]
    assert "pairs" not in page.summary
    assert "people" not in page.summary


def test_a_long_board_scrolls_under_its_headings() -> None:
    """Beyond a screen or so of rows the table gets a box of its own."""
    reference = build_reference()
    entries = [build_entry(reference, f"entry-{index:02d}", [0.6] * 24) for index in range(30)]
    long, short = (
        render_files(build_material(reference, some))["index.html"] for some in (entries, entries[:5])
    )
    assert b'class="scroll boxed"' in long
    assert b'class="scroll boxed"' not in short
