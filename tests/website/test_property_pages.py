"""Each property has a page with everybody's scores on it, equal to those of the results."""

import dataclasses
from pathlib import Path

from builders import build_reference
from leaderboard.grading import find_metric, subset_masks
from leaderboard.website.describing import count_of, property_path, scenario_path
from leaderboard.website.material import Material
from leaderboard.website.numbers import Footnotes, show_exactly, show_percent
from leaderboard.website.property_pages import PropertyPage
from leaderboard.website.property_tables import compose_properties
from site_builders import HOSTILE_NAME, build_material, parse_html, render_files, text_of


def properties_of(material: Material) -> list[PropertyPage]:
    return [page for page in compose_properties(material) if page.whole is None]


def scenarios_of(material: Material) -> dict[str, PropertyPage]:
    """The pages of scenarios by their ids."""
    return {Path(page.path).parent.name: page for page in compose_properties(material) if page.whole}


def test_every_property_has_a_page(material: Material, files: dict[str, bytes]) -> None:
    """It is where its neighbours and the navigation say, and names its scenarios."""
    names = [property_.name for property_ in material.reference.benchmark.properties]
    for name in names:
        page = parse_html(files[property_path(name)])
        links = {text_of(link): link for nav in page.iter("nav") for link in nav.iter("a")}
        assert [links[other].get("aria-current") for other in names] == [
            "page" if other == name else None for other in names
        ]
        assert links["Properties"].get("href") == f"../../{property_path(names[0])}"
        for scenario in material.reference.benchmark.scenarios_of(name):
            assert f"({scenario.id})." in text_of(page)


def test_scores_are_those_of_the_results(material: Material) -> None:
    """Every cell of a submission is its score on the property, a scenario or a subset, at full precision."""
    entries = {p.entry.metadata.submission.name: p.entry for p in material.publications}
    for page in properties_of(material):
        for table in page.tables:
            for row in table.rows[1:]:
                entry = entries[row.title.removesuffix(" (baseline)")]
                score = entry.score("accuracy", page.title, "all")
                assert row.cells[0] == Footnotes().cell(find_metric("accuracy"), score, absent="")
                assert row.target == f"submissions/{entry.slug}/index.html"


def test_rows_are_in_the_order_of_accuracy_on_the_property(material: Material) -> None:
    """People first, then submissions from the best, then baselines from the best."""
    for page in properties_of(material):
        for table in page.tables:
            people, *others = table.rows
            assert people.title == "People"
            keys = [(row.title.endswith("(baseline)"), -float(row.cells[0].exact)) for row in others]
            assert keys == sorted(keys)


def test_partial_submissions_stand_where_they_cover_the_property(material: Material) -> None:
    """A submission that leaves a property out is not in its tables."""
    entries = {p.entry.slug: p.entry for p in material.publications}
    for page in properties_of(material):
        shown = {row.target.split("/")[1] for table in page.tables for row in table.rows[1:]}
        placed = {row.entry.slug for b in material.boards for row in (*b.ranked, *b.partial, *b.baselines)}
        assert shown == {slug for slug in placed if page.title in entries[slug].result.scores}


def test_sizes_and_overlap_of_easy_and_hard_are_told(material: Material) -> None:
    """How many pairs are easy, hard, or both, as counted for people."""
    for page in properties_of(material):
        facts = {fact.title: fact.text for fact in page.facts}
        for subset, other in (("easy", "hard"), ("hard", "easy")):
            scores = material.people[page.title][subset]
            if not scores.n:
                assert facts[subset.title()].endswith("There are none.")
                continue
            assert f"{scores.n} trials in {scores.n_pairs} pairs" in facts[subset.title()]
            assert f"{scores.n_pairs_in_both} of these pairs are {other} as well" in facts[subset.title()]
        assert "95 % interval" in facts["Ceiling of human r"]


def test_without_people_and_pairs_less_is_shown() -> None:
    """A reference without human data has neither subsets nor a row of people."""
    material = build_material(build_reference(n_people=0))
    for page in properties_of(material):
        assert {fact.title for fact in page.facts} == {
            s.title for s in material.reference.benchmark.scenarios_of(page.title)
        }
        for table in page.tables:
            assert all(row.title != "People" for row in table.rows)
            assert not any("Easy" in column.title or "Human" in column.title for column in table.columns)


def test_hostile_names_stay_text(material: Material) -> None:
    """A name is printed as it is, in a link to its own page."""
    for path, content in render_files(dataclasses.replace(material)).items():
        if path.startswith("properties/") and path.endswith(".html"):
            links = [link for link in parse_html(content).iter("a") if text_of(link) == HOSTILE_NAME]
            assert all((link.get("href") or "").lstrip("./").startswith("submissions/") for link in links)


def test_every_scenario_among_several_has_a_page(material: Material, files: dict[str, bytes]) -> None:
    """Linked from its property and its neighbours; the only scenario of a property is the property."""
    assert list(scenarios_of(material)) == ["alpha_one", "alpha_two"]
    whole = parse_html(files[property_path("Alpha")])
    targets = {(text_of(link), link.get("href")) for link in whole.iter("a")}
    for scenario_id, page in scenarios_of(material).items():
        assert page.path == scenario_path("Alpha", scenario_id)
        assert (page.title, f"../../{page.path}") in targets
        assert [link.target for link in page.siblings if link.is_current] == [page.path]
        assert [link.target for link in page.siblings] == [p.path for p in scenarios_of(material).values()]
        shown = parse_html(files[page.path])
        assert "../../../properties/alpha/index.html" in {link.get("href") for link in shown.iter("a")}
        assert f"released as {scenario_id}." in page.summary


def test_scores_of_a_scenario_are_those_of_the_results(material: Material) -> None:
    """Every cell is a score of that scenario alone; whoever leaves it out is not in the table."""
    entries = {p.entry.slug: p.entry for p in material.publications}
    for scenario_id, page in scenarios_of(material).items():
        shown = set()
        for table in page.tables:
            for row in table.rows[1:]:
                entry = entries[row.target.split("/")[1]]
                shown.add(entry.slug)
                for column, cell in zip(table.columns, row.cells, strict=True):
                    score = entry.score(column.metric, scenario_id, "all")
                    assert score is not None
                    assert cell.exact == ("" if score.value is None else show_exactly(score.value))
        placed = {row.entry.slug for b in material.boards for row in (*b.ranked, *b.partial, *b.baselines)}
        assert shown == {slug for slug in placed if scenario_id in entries[slug].result.scores}
    assert "sliver" in {
        row.target.split("/")[1] for row in scenarios_of(material)["alpha_one"].tables[0].rows[1:]
    }


def test_a_scenario_tells_how_much_of_it_is_easy_and_hard(material: Material) -> None:
    """Counted within the scenario, with the overlap, and where the scores on them are."""
    masks, reference = subset_masks(material.reference), material.reference
    for scenario_id, page in scenarios_of(material).items():
        facts = {fact.title: fact.text for fact in page.facts}
        inside = reference.in_scenario(scenario_id)
        for subset in ("easy", "hard"):
            n = int((inside & masks[subset]).sum())
            in_pairs = f" in {count_of(n // 2, 'pair')}" if n else ""
            assert facts[subset.title()].endswith(f" {n} trials{in_pairs}.")
        n_both = int((inside & masks["easy"] & masks["hard"]).sum())
        assert facts["Easy and hard"].startswith(f"{n_both} trials")
        assert "whole property" in facts["Not by scenario"]


def test_figures_show_the_ranked_submissions_of_each_board(material: Material) -> None:
    """A forest for each board with ranked submissions, by accuracy on the property or scenario alone."""
    for page in compose_properties(material):
        scope = page.title if page.whole is None else Path(page.path).parent.name
        boards = [board for board in material.boards if board.ranked]
        assert [drawing.key for drawing in page.figures] == [f"forest-{b.track.id}" for b in boards]
        for drawing, board in zip(page.figures, boards, strict=True):
            for row in board.ranked:
                score = row.entry.score("accuracy", scope)
                assert score is not None
                assert score.value is not None
                words = f"{row.entry.metadata.submission.name}: {show_percent(score.value)} %"
                assert words in drawing.description


def test_without_submissions_there_is_nothing_to_draw() -> None:
    """The tables hold people alone."""
    for page in compose_properties(build_material(entries=[])):
        assert page.figures == ()
        assert [row.title for table in page.tables for row in table.rows] == ["People"]
