"""The page of a board: who stands where, with which numbers."""

import json
import re
from dataclasses import replace
from xml.etree.ElementTree import Element

import numpy as np
import pytest

from builders import build_entry, build_reference
from leaderboard.website.board_pages import BoardPage
from leaderboard.website.boards import compose_board
from leaderboard.website.material import Material
from leaderboard.website.numbers import ABSENT, EN_DASH, MINUS, name_p, show_points
from leaderboard.website.texts import Texts
from site_builders import (
    build_entries,
    build_material,
    interval_of,
    parse_html,
    render_files,
    score_of,
    text_of,
)

COLUMNS = [
    ("accuracy", "overall", "all"),
    ("accuracy", "Alpha", "all"),
    ("accuracy", "Beta", "all"),
    ("accuracy", "overall", "easy"),
    ("accuracy", "overall", "hard"),
    ("human_r", "overall", "all"),
    ("human_r_normalized", "overall", "all"),
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
    assert badges["good"] == ("among the best", "ground-truth state as input")
    assert badges["good-too"] == ("among the best", "see its checks")
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
    """What a cell prints is its exact value and interval rounded, and that is what the API holds."""
    for row in json.loads(files["api/leaderboard.json"])["tracks"][0]["rows"]:
        *cells, gain = numbers_of(row_of(index, row["slug"]))
        assert len(cells) == len(COLUMNS)
        for cell, (metric, scope, subset) in zip(cells, COLUMNS, strict=True):
            score = row["result"]["scores"].get(scope, {}).get(subset, {}).get(metric, {"value": None})
            assert_printed(cell, metric, score)
        assert_printed(gain, "property_gain", row.get("property_gain", {"value": None}))


def assert_printed(cell: Element, metric: str, score: dict[str, float | None]) -> None:
    if score["value"] is None:
        assert text_of(cell).startswith(ABSENT)
        assert cell.get("data-exact") is None
        return
    exact = cell.get("data-exact", "").split()
    assert [float(number) for number in exact] == [score[part] for part in ("value", "low", "high")]
    low, high = re.split(f" to |{EN_DASH}", interval_of(cell))
    factor, half_a_digit = (1, 0.0005) if metric.startswith("human_r") else (100, 0.05)
    for printed, number in zip((score_of(cell), low, high), exact, strict=True):
        shown = float(printed.replace(MINUS, "-"))
        assert abs(shown - factor * float(number)) <= half_a_digit + 1e-9


def test_people_are_pinned_with_their_own_scores(index: Element, files: dict[str, bytes]) -> None:
    """The row of people has their accuracy with intervals, and a dash for what makes no sense for them."""
    people = json.loads(files["api/leaderboard.json"])["people"]
    (body,) = [body for body in index.iter("tbody") if body.get("class") == "people"]
    *cells, gain = numbers_of(body)
    for cell, (metric, scope, subset) in zip(cells, COLUMNS, strict=True):
        own = "ceiling" if metric == "human_r" else metric
        assert_printed(cell, metric, people[scope][subset].get(own, {"value": None}))
    assert "not computed for people" in text_of(cells[-1])
    assert "not computed for people" in text_of(gain)
    assert "12 people, 144 responses" in text_of(body)
    assert [link.get("href") for link in body.iter("a")] == ["people.html"]


def test_people_have_their_ceiling_where_others_have_their_r(index: Element) -> None:
    """It says so below the number: no correlation can be expected above it."""
    (body,) = [body for body in index.iter("tbody") if body.get("class") == "people"]
    remarks = [remark_of(cell) for cell in numbers_of(body)]
    place = COLUMNS.index(("human_r", "overall", "all"))
    assert remarks == ["ceiling" if index == place else "" for index in range(len(remarks))]


def remark_of(cell: Element) -> str:
    return "".join(text_of(part) for part in cell.iter() if part.get("class") == "remark")


def test_every_rank_stands_with_its_rank_set(page: BoardPage, index: Element, material: Material) -> None:
    """The ranks that it could be as well, below it; nothing without a rank."""
    ranks = {row.slug: row.ranks for section in page.sections for row in section.rows}
    for row in material.boards[0].rows:
        standing = row.standing
        expected = f"{standing.low}{EN_DASH}{standing.high}" if standing else ""
        assert ranks[row.entry.slug] == expected
    assert ranks["good"] == f"1{EN_DASH}2"
    (rank,) = [cell for cell in row_of(index, "good").iter("td") if cell.get("class") == "rank"]
    assert text_of(rank) == f"1 1{EN_DASH}2"


def test_only_who_stands_out_is_called_the_best() -> None:
    """One submission ahead of all others is the best; alone on its board it is nothing of the kind."""
    reference = build_reference(pairs_per_scenario=8)
    right = np.where(reference.labels == 1, 0.9, 0.1)
    first = build_entry(reference, "first", right.tolist())
    second = build_entry(reference, "second", (1 - right).tolist())
    badges = []
    for entries in ([first, second], [first]):
        material = build_material(reference, entries)
        sections = compose_board(material.boards[0], material).sections
        badges.append([row.badges for section in sections for row in section.rows if row.slug])
    assert badges == [[("the best",), ()], [()]]


def test_a_gain_stands_with_its_p(index: Element, files: dict[str, bytes]) -> None:
    """What a system gains from inferring properties, with the exact p; else why there is nothing."""
    rows = {row["slug"]: row for row in json.loads(files["api/leaderboard.json"])["tracks"][0]["rows"]}
    gain = numbers_of(row_of(index, "good"))[-1]
    assert score_of(gain) == show_points(rows["good"]["property_gain"]["value"])
    assert remark_of(gain) == name_p(rows["good"]["property_gain"]["p"])
    assert "not tested both with and without property inference" in text_of(
        numbers_of(row_of(index, "hostile"))[-1]
    )


def test_without_any_gain_there_is_no_column_of_gains() -> None:
    """Nor a remark that explains it."""
    reference = build_reference()
    material = build_material(reference, [build_entry(reference, "one", [0.7] * 24)])
    page = compose_board(material.boards[0], material)
    assert "Property gain" not in [column.title for group in page.groups for column in group.columns]
    assert "Gain" not in [fact.title for fact in page.remarks]


def test_remarks_say_how_sure_the_numbers_are(page: BoardPage, material: Material) -> None:
    """How intervals and rank sets are made, and what so few trials can tell, in numbers."""
    remarks = {fact.title: fact.text for fact in page.remarks}
    assert list(remarks) == [
        *("How sure", "Rank set", "Best", "Detectable", "Gain", "Ceiling", "Easy", "Hard", "Caution"),
    ]
    assert remarks["How sure"] == (
        "Below each score stands its 95 % interval: percentile bootstrap over pairs of trials within "
        "scenarios and, where their answers matter, people, 200 resamples, the same for all submissions."
    )
    detectable = material.boards[0].detectable
    assert isinstance(detectable, float)
    assert remarks["Detectable"].startswith(f"A difference of {100 * detectable:.1f} points ")


def test_remarks_measure_the_selection() -> None:
    """People's accuracy on trials that they chose themselves stands beside that of others."""
    material = build_material(build_reference(pairs_per_scenario=16), [])
    subsets = ("easy", "hard", "easy_crossfit", "hard_crossfit")
    scores = [material.people_score("accuracy", "overall", subset) for subset in subsets]
    easy, hard, easy_crossfit, hard_crossfit = (f"{100 * s.value:.1f}" for s in scores if s and s.value)
    assert (
        f"than they are: {easy} % on easy and {hard} % on hard trials, but {easy_crossfit} % and "
        f"{hard_crossfit} % where one half of the people chooses and the other half is measured"
    ) in remarks_of(material)["Caution"]


def remarks_of(material: Material) -> dict[str, str]:
    return {fact.title: fact.text for fact in compose_board(material.boards[0], material).remarks}


def test_without_measurable_selection_the_caution_has_no_numbers(material: Material) -> None:
    """If people have no accuracy on hard trials, there is nothing to put beside each other."""
    assert "worse on hard trials than they are. The accuracy" in remarks_of(material)["Caution"]


def test_without_responses_nothing_is_measured_across_people() -> None:
    """The caution stays, without numbers, and nobody is said to be drawn."""
    material = build_material(build_reference(responses=False), [])
    remarks = remarks_of(material)
    assert "worse on hard trials than they are. The accuracy" in remarks["Caution"]
    assert "people" not in remarks["How sure"]
    assert "Rank set" not in remarks


def test_resamples_without_a_value_are_told_of(index: Element, material: Material) -> None:
    """An interval that leaves some out has a footnote with their number, and the exact one on the cell."""
    cell = numbers_of(row_of(index, "good"))[COLUMNS.index(("accuracy", "overall", "easy"))]
    (entry,) = [p.entry for p in material.publications if p.entry.slug == "good"]
    score = entry.score("accuracy", "overall", "easy")
    assert score is not None
    n_undefined = score.undefined_resamples
    assert n_undefined
    assert cell.get("data-undefined") == str(n_undefined)
    note = f"resamples without a value are left out of the interval, {n_undefined} at most"
    assert footnote_of(cell, index) == note
    assert "some resamples left out" in text_of(cell)


def footnote_of(cell: Element, page: Element) -> str:
    (notes,) = [notes for notes in page.iter("ol") if notes.get("class") == "footnotes"]
    return text_of(list(notes)[int(next(cell.iter("sup")).text or 0) - 1])


def test_a_dash_tells_why_in_text_and_below_the_table(index: Element) -> None:
    """The reason can be read by eye, by pointer and by a screen reader."""
    dash = numbers_of(row_of(index, "flat"))[5]
    (mark,) = dash.iter("abbr")
    assert mark.get("title") == "undefined: all probabilities are equal"
    assert "undefined: all probabilities are equal" in text_of(dash)
    assert footnote_of(dash, index) == "undefined: all probabilities are equal"


def test_headings_say_how_much_is_behind_a_column(index: Element, material: Material) -> None:
    """Trials or pairs stand under each column's name, and they are those of the reference."""
    below = " with 95 % interval"  # for who listens
    headings = [text_of(th) for th in index.iter("th") if "number" in th.get("class", "").split()]
    assert all(heading.endswith(below) for heading in headings)
    easy, hard = (material.count("overall", subset).n for subset in ("easy", "hard"))
    assert [heading.removesuffix(below) for heading in headings] == [
        "Overall 24 trials",
        "Alpha 16 trials",
        "Beta 8 trials",
        f"Easy {easy} trials",
        f"Hard {hard} trials",
        "Human r 24 trials",
        "Share of ceiling 24 trials",
        "Both right 12 pairs",
        "Property gain 24 trials",
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
    assert not [element for element in index.iter() if element.get("class") == "controls"]
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
    assert [fact.title for fact in page.remarks] == ["How sure", "Rank set", "Best"]
    assert "over trials within scenarios" in page.remarks[0].text
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


def test_all_scores_and_the_citation_are_linked(material: Material, files: dict[str, bytes]) -> None:
    """From every board; how to cite only where maintainers wrote it."""
    links = {link.get("href") for link in parse_html(files["tracks/without/index.html"]).iter("a")}
    assert {"../../leaderboard.csv", "../../api/leaderboard.json"} <= links
    assert "../../about.html#citation" not in links
    cited = replace(material, texts=Texts(citation="@misc{a,\n}"))
    page = parse_html(render_files(cited)["index.html"])
    assert "about.html#citation" in {link.get("href") for link in page.iter("a")}
