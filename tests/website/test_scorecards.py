"""The page of a submission: every score, what it says of itself, and how to check it."""

import re
from dataclasses import replace
from xml.etree.ElementTree import Element

import numpy as np
import pytest

from builders import build_entry, build_reference
from leaderboard.grading import METRICS, SUBSETS, find_metric
from leaderboard.website.building import compose_pages
from leaderboard.website.calibration_tables import compose_calibrations
from leaderboard.website.material import Material
from leaderboard.website.numbers import (
    ABSENT,
    EN_DASH,
    MINUS,
    name_p,
    show_interval,
    show_number,
    show_percent,
    show_points,
)
from leaderboard.website.pages import SubmissionPage
from leaderboard.website.scorecards import compose_scorecard
from site_builders import build_material, interval_of, parse_html, render_files, score_of, text_of


@pytest.fixture(scope="module")
def pages(material: Material) -> dict[str, SubmissionPage]:
    return {page.slug: page for _, page in compose_pages(material) if isinstance(page, SubmissionPage)}


def facts_of(page: Element, title: str) -> list[str]:
    return [
        text_of(next(fact.iter("dd")))
        for fact in page.iter("div")
        if list(fact) and fact[0].tag == "dt" and text_of(fact[0]) == title
    ]


def test_every_metric_is_on_the_page(pages: dict[str, SubmissionPage], material: Material) -> None:
    """Each metric has a column with the result's values in every scope and subset, or is named below it."""
    (entry,) = [p.entry for p in material.publications if p.entry.slug == "hostile"]
    assert [table.key for table in pages["hostile"].tables] == list(SUBSETS)
    for table in pages["hostile"].tables:
        columns = {column.metric: index for index, column in enumerate(table.columns) if not column.is_people}
        omitted = [title for fact in table.omitted for title in fact.title.split("; ")]
        there = entry.result.scores["overall"][table.key].metrics
        titles = {metric.name: metric.title for metric in METRICS if metric.name in there}
        assert [*columns] == [name for name, title in titles.items() if title not in omitted]
        graded = [scope for scope, subsets in entry.result.scores.items() if table.key in subsets]
        scopes = [scope for scope in graded if scope != "beta_one"]
        for row, scope in zip(table.rows, scopes, strict=True):
            for metric, index in columns.items():
                score = entry.score(metric, scope, table.key)
                cell = row.cells[index]
                assert score is not None
                assert (float(cell.exact) if cell.exact else None) == score.value
                assert [float(end) for end in cell.ends] == [
                    end for end in (score.low, score.high) if end is not None
                ]


def test_printed_numbers_are_the_exact_ones_rounded(
    pages: dict[str, SubmissionPage], files: dict[str, bytes]
) -> None:
    """In every table of every submission, what is printed lies within half a digit of what is meant."""
    seen = 0
    for page in pages.values():
        cells = [c for table in (*page.tables, *page.calibrations) for row in table.rows for c in row.cells]
        shown = [td for td in parse_html(files[page.path]).iter("td") if td.get("title")]
        for cell, td in zip([c for c in cells if c.exact], shown, strict=True):
            assert (score_of(td), interval_of(td)) == (cell.text, cell.interval)
            if not cell.text.startswith("<"):
                assert_rounded(cell.text, float(cell.exact))
                seen += 1
            ends = re.split(f" to |{EN_DASH}", cell.interval) if cell.ends else []
            for printed, exact in zip(ends, cell.ends, strict=True):
                assert_rounded(printed, float(exact))
    assert seen > 1000


def assert_rounded(printed: str, exact: float) -> None:
    digits = len(printed.partition(".")[2])
    factor = 1 if digits == 3 else 100
    number = float(printed.replace(MINUS, "-"))
    assert abs(number - factor * exact) <= 0.5 * 10**-digits + 1e-9


def test_people_stand_beside_the_submission(pages: dict[str, SubmissionPage], material: Material) -> None:
    """Where people have a score of their own it follows the submission's; beside human r, their ceiling."""
    table = pages["good"].tables[0]
    places = [index for index, column in enumerate(table.columns) if column.is_people]
    assert [table.columns[index].metric for index in places] == ["accuracy", "ceiling", "yes_rate"]
    assert [table.columns[index - 1].metric for index in places] == ["accuracy", "human_r", "yes_rate"]
    for place, metric in zip(places, ("accuracy", "ceiling", "yes_rate"), strict=True):
        human, cell = material.people_score(metric, "overall", "all"), table.rows[0].cells[place]
        assert human is not None
        assert [float(number) for number in (cell.exact, *cell.ends)] == [human.value, human.low, human.high]
    assert table.rows[2].title == "alpha one"
    assert table.rows[2].cells[places[1]].why == (
        "undefined: people's reliability is estimated for whole properties"
    )


def test_cross_fitted_subsets_have_tables(pages: dict[str, SubmissionPage], material: Material) -> None:
    """Few metrics, people beside accuracy, and counts that say they are averages."""
    tables = {table.key: table for table in pages["good"].tables}
    table = tables["hard_crossfit"]
    assert table.title == "Hard, cross-fitted"
    assert table.caption == (
        "Hard for one random half of the people, measured on the other half; means over 250 halvings, each "
        "both ways."
    )
    assert table.count_titles == ("Trials, on average", "Pairs, on average", "also easy, on average")
    assert [(column.metric, column.is_people) for column in table.columns] == [
        *(("accuracy", False), ("accuracy", True), ("human_r", False), ("human_gap", False)),
    ]
    scores = material.people["overall"]["hard_crossfit"]
    counts = (scores.n, scores.n_pairs, scores.n_pairs_in_both)
    assert table.rows[0].counts == tuple(f"{count:.0f}" for count in counts if count is not None)
    assert table.is_narrow
    assert not tables["all"].is_narrow


def test_calibration_is_tabulated_in_bins(pages: dict[str, SubmissionPage], material: Material) -> None:
    """Ten bins with both means and people's; an empty bin says so."""
    (entry,) = [p.entry for p in material.publications if p.entry.slug == "good"]
    calibration = entry.result.calibration["overall"]
    (table,) = pages["good"].calibrations
    assert [row.title for row in table.rows][:2] == [f"0.0{EN_DASH}0.1", f"0.1{EN_DASH}0.2"]
    assert len(table.rows) == 10
    assert calibration.people is not None
    for row, label, people in zip(table.rows, calibration.label, calibration.people, strict=True):
        assert row.counts == (f"{label.n}",)
        expected = (label.predicted, label.observed, people.observed)
        assert [cell.exact for cell in row.cells] == [
            "" if value is None else f"{value:.6f}" for value in expected
        ]
    assert table.rows[0].cells[0].why == "no trial has such a probability"
    assert table.footnotes == ("no trial has such a probability",)
    assert (
        table.caption
        == "The trials of all properties together. A bin holds its upper end, the first one 0 as well."
    )


def test_calibration_of_partial_submissions_goes_by_property(pages: dict[str, SubmissionPage]) -> None:
    """Each covered property has a table; without a whole one there is none."""
    assert [(table.key, table.title) for table in pages["part"].calibrations] == [("calibration-0", "Beta")]
    assert pages["part"].calibrations[0].caption.startswith("A bin holds its upper end")
    assert pages["sliver"].calibrations == ()


def test_calibration_tells_how_many_trials_people_judged() -> None:
    """Without people there is no column of theirs; where they judged fewer trials, it is said how many."""
    reference = build_reference()
    people = reference.people
    assert people is not None
    n, n_yes = people.n.copy(), people.n_yes.copy()
    n[0] = n_yes[0] = 0
    fewer = replace(reference, people=replace(people, n=n, n_yes=n_yes, responses=None))
    lonely = replace(reference, people=None)
    tables = [compose_calibrations(build_entry(some, "one", [0.3] * 24))[0] for some in (fewer, lonely)]
    titles = [[column.title for column in table.columns] for table in tables]
    assert tables[0].caption.endswith("People judged 23 of the 24 trials.")
    assert tables[1].caption.endswith("the first one 0 as well.")
    assert titles == [["Mean P(YES)", "YES was right", "People said YES"], ["Mean P(YES)", "YES was right"]]


def test_scopes_are_nested(pages: dict[str, SubmissionPage]) -> None:
    """Overall, then each property with its scenarios, if there are several; easy and hard go without."""
    rows = {table.key: [(row.title, row.level) for row in table.rows] for table in pages["good"].tables}
    properties = [("Overall", 0), ("Alpha", 1), ("Beta", 1)]
    assert rows["easy"] == rows["hard"] == properties
    assert rows["all"] == [
        ("Overall", 0),
        ("Alpha", 1),
        ("alpha one", 2),
        ("alpha two", 2),
        ("Beta", 1),
    ]


def test_a_lone_scenario_stands_under_its_property(pages: dict[str, SubmissionPage]) -> None:
    """A property that is not whole is a heading with dashes, so that no scenario seems to be another's."""
    (table,) = pages["sliver"].tables
    assert [(row.title, row.level) for row in table.rows] == [("Alpha", 1), ("alpha one", 2)]
    accuracy = table.rows[0].cells[0]
    assert (accuracy.text, accuracy.why) == (ABSENT, "not all of its scenarios are covered")
    assert table.rows[0].counts == ("", "")
    assert table.rows[1].counts == ("8", "4")


def test_metrics_without_any_value_are_named_once(pages: dict[str, SubmissionPage]) -> None:
    """A column of dashes for one reason would say less than a sentence."""
    table = pages["flat"].tables[0]
    omitted = {fact.title: fact.text for fact in table.omitted}
    assert omitted == {
        "Human r; Human r, share of the ceiling; Human r, label partialled out": (
            "undefined: all probabilities are equal"
        ),
    }
    assert "human_r" not in [column.metric for column in table.columns]


def test_the_standing_is_a_sentence(pages: dict[str, SubmissionPage]) -> None:
    """Rank, or the reason why there is none."""
    assert pages["hostile"].standing == (
        "Rank 3 of 3 by overall accuracy, 95 % rank set 3 only; distinguishable from the best; probability "
        "of being the best 0 %."
    )
    assert pages["good"].standing == (
        "Rank 1 of 3 by overall accuracy, 95 % rank set 1 to 2; one of 2 not distinguishable from the best; "
        "probability of being the best 50.0 %."
    )
    assert pages["other-track"].standing == "Rank 1 of 1 by overall accuracy."
    assert pages["part"].standing == "Not ranked, because it is partial: covers Beta; 8 of 24 trials."
    assert pages["oracle"].standing == "A baseline: shown on every board for reference, not ranked."
    assert pages["nowhere"].standing == "On no board, because no track has its protocol."


def test_who_stands_out_is_told_from_all_others() -> None:
    """The best of all is distinguishable from the others, not from itself."""
    reference = build_reference(pairs_per_scenario=8)
    right = np.where(reference.labels == 1, 0.9, 0.1)
    entries = [build_entry(reference, "a", right.tolist()), build_entry(reference, "b", (1 - right).tolist())]
    material = build_material(reference, entries)
    assert compose_scorecard(material.publications[0], material).standing == (
        "Rank 1 of 2 by overall accuracy, 95 % rank set 1 only; distinguishable from all others; probability "
        "of being the best 100 %."
    )


def test_the_gain_is_a_sentence(
    pages: dict[str, SubmissionPage], files: dict[str, bytes], material: Material
) -> None:
    """By how much, over which submission, and how sure; nothing for who was not tested both ways."""
    gain = material.standings["good"][1].gain
    assert gain is not None
    page = parse_html(files["submissions/good/index.html"])
    *_, sentence = [p for p in page.iter("p") if p.get("class") == "standing"]
    low, high = show_points(gain.low), show_points(gain.high)
    assert text_of(sentence) == (
        f"{show_points(gain.value)} points over other-track without property inference: 95 % interval {low} "
        f"to {high}, exact {name_p(gain.p)}."
    )
    (link,) = sentence.iter("a")
    assert link.get("href") == "../../submissions/other-track/index.html"
    assert pages["hostile"].gain is None
    assert pages["flat"].gain is None


def test_the_page_leads_back_to_its_own_board(pages: dict[str, SubmissionPage]) -> None:
    """A submission of another track belongs to that board."""
    assert pages["good"].board.target == "index.html"
    assert pages["other-track"].board.target == "tracks/without/index.html"


def test_headline_numbers_are_overall_or_what_is_covered(pages: dict[str, SubmissionPage]) -> None:
    """A complete submission leads with its overall scores, a partial one with what it has."""
    assert [tile.title for tile in pages["good"].tiles] == [
        "Accuracy",
        "Accuracy, easy",
        "Accuracy, hard",
        "Human r",
        "Both right",
    ]
    assert [tile.title for tile in pages["part"].tiles] == ["Beta"]
    assert [tile.title for tile in pages["sliver"].tiles] == ["alpha one"]


def test_headline_numbers_come_with_people_and_chance(
    pages: dict[str, SubmissionPage], material: Material
) -> None:
    """A number alone says little; an undefined one says why."""
    accuracy, *_, human_r, pairs = pages["flat"].tiles
    assert accuracy.cell.text == "50.0"
    assert (human_r.cell.text, human_r.unit) == (ABSENT, "")
    assert human_r.below == ("undefined: all probabilities are equal",)
    assert pairs.below == ("chance 25 %",)
    people, ceiling = (material.people_score(m, "overall", "all") for m in ("accuracy", "ceiling"))
    assert people is not None
    assert ceiling is not None
    interval = show_interval(find_metric("accuracy"), people)
    assert accuracy.below == (f"people {show_percent(people.value or 0)} ({interval})", "chance 50 %")
    *_, human_r, _ = pages["good"].tiles
    assert human_r.below[0].startswith(f"ceiling {show_number(ceiling.value or 0)} (")


def test_headline_numbers_come_with_intervals(
    pages: dict[str, SubmissionPage], files: dict[str, bytes]
) -> None:
    """Each tile shows the interval of its score."""
    page = parse_html(files["submissions/hostile/index.html"])
    shown = [text_of(part) for part in page.iter("span") if part.get("class") == "sure"]
    there = [tile.cell for tile in pages["hostile"].tiles if tile.cell.exact]
    assert shown == [f"95 %: {cell.interval}" for cell in there]
    assert all(cell.interval for cell in there)


def test_checks_are_shown_as_text(files: dict[str, bytes]) -> None:
    """What grading remarked is on the page, markup and all, as plain text."""
    page = parse_html(files["submissions/good-too/index.html"])
    assert facts_of(page, "near-duplicate") == ["nearly equal to <b>another</b>"]


def test_metadata_is_complete_and_links_are_not_endorsed() -> None:
    """All that a submission says of itself is there; links out say that we do not vouch for them."""
    reference = build_reference()
    entry = build_entry(
        reference,
        "full",
        [0.6] * reference.n_trials,
        training_trials=2000,
        auxiliary="implicit",
        answer_reader=1,
    )
    links = entry.metadata.links.model_copy(update={"paper": "https://example.com/?a=1&b=2"})
    model = entry.metadata.model.model_copy(update={"parameters": "32M", "pretraining": "none"})
    metadata = entry.metadata.model_copy(update={"links": links, "model": model})
    material = build_material(reference, [replace(entry, metadata=metadata)])
    page = parse_html(render_files(material)["submissions/full/index.html"])
    expected = {
        "Team": "Team",
        "Testing": "with property",
        "Training trials": "2,000",
        "Auxiliary": "implicit",
        "Reader of answers": "version 1",
        "Parameters": "32M",
        "Pretraining": "none",
        "Paper": "https://example.com/?a=1&b=2",
        "Contact": "@someone",
    }
    assert {title: facts_of(page, title) for title in expected} == {k: [v] for k, v in expected.items()}
    outward = [a for a in page.iter("a") if a.get("href", "").startswith("http")]
    assert [a.get("href") for a in outward] == ["https://example.com/?a=1&b=2", "https://github.com/someone"]
    assert {a.get("rel") for a in outward} == {"external noopener nofollow ugc"}


def test_provenance_says_how_to_grade_again(files: dict[str, bytes], material: Material) -> None:
    """Checksums, versions and the command are on the page."""
    page = parse_html(files["submissions/good/index.html"])
    result = next(p.entry.result for p in material.publications if p.entry.slug == "good")
    assert facts_of(page, "Predictions (SHA-256)") == [result.inputs.predictions_sha256]
    assert facts_of(page, "Reference digest") == [result.inputs.reference_digest]
    assert facts_of(page, "Grade it again") == ["leaderboard grade submissions/good"]
    assert facts_of(page, "Trials") == ["24 of 24 given, 24 answered"]


def test_unanswered_trials_are_counted() -> None:
    """How many trials got no answer is part of the provenance."""
    reference = build_reference()
    covered = np.arange(reference.n_trials) < 16
    entry = build_entry(reference, "some", [0.6] * reference.n_trials, covered=covered.tolist())
    page = parse_html(render_files(build_material(reference, [entry]))["submissions/some/index.html"])
    assert facts_of(page, "Trials") == ["16 of 24 given, 16 answered"]


def test_a_reference_without_pairs_speaks_of_trials() -> None:
    """No count of pairs, no headline of pairs, and easy is a property of trials."""
    paired = build_reference()
    lone = tuple(f"pair-{index}" for index in range(paired.n_trials))
    reference = replace(paired, pairs=np.arange(paired.n_trials), pair_ids=lone)
    material = build_material(reference, [build_entry(reference, "one", [0.7] * reference.n_trials)])
    page = compose_scorecard(material.publications[0], material)
    assert {table.count_titles for table in page.tables} == {("Trials",), ("Trials, on average",)}
    assert page.tables[1].caption == "Trials answered rightly by more than 2/3 of the people."
    assert page.tables[0].rows[0].counts == ("24",)
    assert [tile.title for tile in page.tiles][-1] == "Human r"
