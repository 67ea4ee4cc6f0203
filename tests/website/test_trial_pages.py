"""Trials one by one: the list of all pairs, and a page for each with everybody's answers."""

from dataclasses import replace
from xml.etree.ElementTree import Element

import numpy as np
import pytest

from builders import build_entry, build_reference
from leaderboard.grading import subset_masks
from leaderboard.metrics.pairs import find_pairs
from leaderboard.metrics.published import wilson_interval
from leaderboard.reference import Reference
from leaderboard.website.disagreements import N_LISTED
from leaderboard.website.material import Material
from leaderboard.website.numbers import EN_DASH, show_number, show_percent
from leaderboard.website.trial_paths import list_path, trial_anchor, trial_path
from site_builders import HOSTILE_NAME, build_material, parse_html, render_files, text_of

SIGNS = {1.0: "✓ right", 0.0: "✗ wrong", 0.5: "= at 0.5"}
UP = "../../"
LISTS = (list_path("Alpha"), list_path("Beta"))


def page_of(files: dict[str, bytes], trial_id: str) -> Element:
    return parse_html(files[trial_path(trial_id)])


def body_of(page: Element, *, of_people: bool = False) -> list[Element]:
    """Rows of a trial's table of answers: submissions, or the one of people."""
    return [
        row
        for body in page.iter("tbody")
        if (body.get("class") == "people") == of_people
        for row in body.iter("tr")
    ]


def fact_of(page: Element, title: str) -> str:
    facts = {text_of(div[0]): text_of(div[1]) for div in page.iter("div") if len(div) and div[0].tag == "dt"}
    return facts.get(title, "")


def target_of(element: Element) -> str:
    return next(element.iter("a")).get("href", "")


def without_pairs(reference: Reference) -> Reference:
    """The same trials, each a pair of its own, as in benchmarks that have no twins."""
    return replace(reference, pair_ids=reference.trial_ids, pairs=np.arange(reference.n_trials))


def test_every_probability_is_that_of_the_predictions(material: Material, files: dict[str, bytes]) -> None:
    """Each page lists every submission once, to the last digit, with its verdict and a link to its page."""
    for index, trial_id in enumerate(material.reference.trial_ids):
        rows = {target_of(row): row for row in body_of(page_of(files, trial_id))}
        assert len(rows) == len(material.publications)
        for publication in material.publications:
            entry = publication.entry
            _, number, verdict, *_ = rows[f"{UP}submissions/{entry.slug}/index.html"]
            probability = entry.probabilities[index]
            if np.isnan(probability):
                assert (text_of(number), number.get("data-value")) == (EN_DASH, None)
                assert text_of(verdict) == "no answer"
            else:
                assert float(number.get("data-value", "")) == probability
                assert text_of(number) == show_number(probability)
                assert text_of(verdict) == SIGNS[entry.credits[index]]


def test_what_is_said_of_the_twin_stands_beside(material: Material, files: dict[str, bytes]) -> None:
    """The last two cells of every row are the first two of the same row on the twin's page."""
    reference = material.reference
    for members in find_pairs(reference.pairs):
        one, other = (
            {
                target_of(row): [text_of(cell) for cell in row[1:]]
                for of_people in (False, True)
                for row in body_of(page_of(files, reference.trial_ids[trial]), of_people=of_people)
            }
            for trial in members
        )
        assert one.keys() == other.keys()
        assert all(one[who][2:] == other[who][:2] and one[who][:2] == other[who][2:] for who in one)


def test_answers_fall_from_the_highest(material: Material, files: dict[str, bytes]) -> None:
    """Probabilities fall down the page, and those who did not answer come last."""
    for trial_id in material.reference.trial_ids:
        cells = [row[1].get("data-value") for row in body_of(page_of(files, trial_id))]
        given = [float(cell) for cell in cells if cell]
        assert given == sorted(given, reverse=True)
        assert all(cells[: len(given)])


def test_people_are_counted_with_their_wilson_interval(material: Material, files: dict[str, bytes]) -> None:
    """Each page says how many of how many said YES, how sure that share is, and whether most were right."""
    reference, people = material.reference, material.reference.people
    assert people is not None
    for index, trial_id in enumerate(reference.trial_ids):
        n, n_yes = int(people.n[index]), int(people.n_yes[index])
        low, high = wilson_interval(n_yes / n, n)
        page = page_of(files, trial_id)
        assert fact_of(page, "People") == (
            f"{n_yes} of {n} said YES: {show_percent(n_yes / n)} %, "
            f"95 % Wilson interval {show_percent(low)}{EN_DASH}{show_percent(high)} %"
        )
        (row,) = body_of(page, of_people=True)
        side = np.sign(n_yes / n - 0.5) * (2 * reference.labels[index] - 1)
        assert text_of(row).startswith(f"People{show_number(n_yes / n)}{SIGNS[(1 + side) / 2]}")


def test_a_page_tells_answer_difficulty_and_twin(material: Material, files: dict[str, bytes]) -> None:
    """The label in words, easy and hard as they are graded, and the other trial of the pair."""
    reference, masks = material.reference, subset_masks(material.reference)
    for index, trial_id in enumerate(reference.trial_ids):
        page = page_of(files, trial_id)
        assert text_of(next(page.iter("h1"))) == trial_id
        answer = "YES" if reference.labels[index] else "NO"
        assert f"“Will it?” The answer is {answer}." in [text_of(p) for p in page.iter("p")]
        words = fact_of(page, "Easy or hard")
        assert ("Easy:" in words, "Hard:" in words) == (masks["easy"][index], masks["hard"][index])
        (twin,) = [t for t in np.flatnonzero(reference.pairs == reference.pairs[index]) if t != index]
        (section,) = [s for s in page.iter("section") if s.get("aria-labelledby") == "twin"]
        assert target_of(section) == f"{UP}{trial_path(reference.trial_ids[twin])}"
        assert f"Its answer is {'YES' if reference.labels[twin] else 'NO'};" in text_of(section)


def test_the_list_counts_pairs_as_they_are(material: Material, files: dict[str, bytes]) -> None:
    """Both labels, both shares of YES, and how many ranked submissions have both, one or none right."""
    reference, people = material.reference, material.reference.people
    assert people is not None
    credits = np.array([row.entry.credits for board in material.boards for row in board.ranked])
    listed = [row for path in LISTS for row in parse_html(files[path]).iter("tr") if row.get("id")]
    rows = {row.get("id"): row for row in listed}
    pairs = find_pairs(reference.pairs)
    assert len(rows) == len(pairs) == 12
    for members in pairs:
        name, *cells = rows[trial_anchor(reference.trial_ids[members[0]])]
        assert reference.pair_ids[reference.pairs[members[0]]].endswith(f"/{text_of(name)}")
        for trial, label, share in zip(members, cells[0:3:2], cells[1:4:2], strict=False):
            assert target_of(label) == f"{UP}{trial_path(reference.trial_ids[trial])}"
            assert text_of(label) == ("YES" if reference.labels[trial] else "NO")
            n = people.n[trial]
            assert text_of(share) == f"{show_percent(people.n_yes[trial] / n)} of {n}"
        n_right = credits[:, members].sum(axis=1)
        assert [text_of(cell) for cell in cells[4:]] == [str((n_right == k).sum()) for k in (2, 1, 0)]


def test_undecided_submissions_have_a_column_of_their_own() -> None:
    """A ranked submission that says 0.5 is neither right nor wrong; the columns add up to the ranked ones."""
    reference = build_reference()
    half = build_entry(reference, "half", [0.5, *[0.9] * (reference.n_trials - 1)])
    page = parse_html(render_files(build_material(reference, [half]))[LISTS[0]])
    table = next(page.iter("table"))
    headings = [text_of(th) for th in next(table.iter("tr"))]
    assert headings[-4:] == ["Both right", "One", "None", "At 0.5"]
    counts = [[int(text_of(cell)) for cell in row[-4:]] for row in table.iter("tr") if row.get("id")]
    assert counts[0] == [0, 0, 0, 1]
    assert {sum(row) for row in counts} == {1}


def test_copies_stand_in_their_columns(material: Material) -> None:
    """Whatever the order of the file, copy 0 comes first, and its trial names the row."""
    swapped = replace(material.reference, copies=1 - material.reference.copies)
    page = parse_html(render_files(replace(material, reference=swapped))[LISTS[0]])
    (row, *_) = [row for row in page.iter("tr") if row.get("id")]
    links = [link.get("href") for link in row.iter("a")]
    assert links == [f"{UP}{trial_path(trial_id)}" for trial_id in swapped.trial_ids[1::-1]]
    assert row.get("id") == trial_anchor(swapped.trial_ids[1])


def test_without_people_nothing_is_said_of_them() -> None:
    """No share, no difficulty, no row of people, and no disagreement with them."""
    reference = build_reference(n_people=0)
    files = render_files(build_material(reference))
    page = page_of(files, reference.trial_ids[0])
    assert body_of(page, of_people=True) == []
    assert fact_of(page, "People") == fact_of(page, "Easy or hard") == ""
    assert "People" not in [text_of(th) for th in parse_html(files[LISTS[0]]).iter("th")]
    assert b"disagreements" not in files["submissions/good/index.html"]


def test_a_trial_that_nobody_judged_says_so() -> None:
    """There is no share of no people, neither on its page nor in the list."""
    reference = build_reference(responses=False)
    people = reference.people
    assert people is not None
    there = np.arange(reference.n_trials) != 0
    unjudged = replace(reference, people=replace(people, n=people.n * there, n_yes=people.n_yes * there))
    files = render_files(build_material(unjudged, []))
    page = page_of(files, reference.trial_ids[0])
    assert fact_of(page, "People") == "Nobody judged it."
    assert body_of(page, of_people=True) == []
    assert [text_of(td) for td in parse_html(files[LISTS[0]]).iter("td")][1] == f"{EN_DASH} nobody judged it"


def test_without_pairs_trials_are_listed_one_by_one() -> None:
    """As in benchmarks that have no twins: right or wrong instead of both, one or none, and no twin."""
    reference = without_pairs(build_reference())
    files = render_files(build_material(reference))
    listed = parse_html(files[LISTS[0]])
    headings = [text_of(th) for th in next(listed.iter("tr"))]
    assert headings == ["Trial", "Answer", "People", "Right", "Wrong"]
    assert len([row for row in listed.iter("tr") if row.get("id")]) == reference.in_property("Alpha").sum()
    assert "twin" not in {element.get("id") for element in page_of(files, reference.trial_ids[0]).iter()}


def test_a_trial_that_lost_its_twin_is_listed_after_the_pairs() -> None:
    """Where one of a pair was dropped, the other stands alone."""
    reference = build_reference()
    alone = replace(
        reference,
        pairs=np.where(np.arange(reference.n_trials) == 1, len(reference.pair_ids), reference.pairs),
        pair_ids=(*reference.pair_ids, "other"),
    )
    listed = parse_html(render_files(build_material(alone, []))[LISTS[0]])
    captions = [text_of(caption) for caption in listed.iter("caption")]
    assert captions[:2] == ["alpha one: Pairs 3 pairs", "alpha one: Trials without a twin 2 trials"]


def test_without_submissions_trials_have_pages_all_the_same() -> None:
    """Labels and people are there, and the table of answers says that there are none."""
    reference = build_reference()
    files = render_files(build_material(reference, []))
    assert "There are none." in [text_of(p) for p in page_of(files, reference.trial_ids[0]).iter("p")]
    headings = [text_of(th) for th in next(parse_html(files[LISTS[0]]).iter("tr"))]
    assert headings == ["Pair", "Copy 0", "People", "Copy 1", "People"]


def test_of_many_submissions_both_ends_are_listed() -> None:
    """Beyond 50, the 25 highest and the 25 lowest, and the page says so; exactly 50 are all listed."""
    reference = build_reference(pairs_per_scenario=1)
    entries = [
        build_entry(reference, f"entry-{index:02d}", [index / 60] * reference.n_trials) for index in range(60)
    ]
    page = page_of(render_files(build_material(reference, entries)), reference.trial_ids[0])
    listed = [float(row[1].get("data-value", "")) for row in body_of(page)]
    assert listed == [index / 60 for index in (*range(59, 34, -1), *range(24, -1, -1))]
    assert text_of(next(page.iter("caption"))).endswith(
        "60 submissions, 60 probabilities, of which the 25 highest and the 25 lowest are listed; "
        "all are in the submissions' files."
    )
    page = page_of(render_files(build_material(reference, entries[:50])), reference.trial_ids[0])
    assert len(body_of(page)) == 50
    assert text_of(next(page.iter("caption"))) == "Probability of YES Highest first."


def test_of_many_submissions_those_without_an_answer_are_counted() -> None:
    """A page of more than 50 leaves out those who did not answer, and says how many did."""
    reference = build_reference(pairs_per_scenario=1)
    beta = (reference.properties == 1).tolist()
    given = [0.7] * reference.n_trials
    entries = [build_entry(reference, f"part-{index:02d}", given, covered=beta) for index in range(51)]
    files = render_files(build_material(reference, [*entries, build_entry(reference, "whole", given)]))
    page = page_of(files, reference.trial_ids[0])
    assert [text_of(row) for row in body_of(page)] == [
        f"whole0.700{SIGNS[float(reference.labels[0])]}0.700{SIGNS[float(reference.labels[1])]}"
    ]
    assert "52 submissions, 1 probability; all are in" in text_of(next(page.iter("caption")))


def test_names_that_are_given_twice_are_told_apart_by_their_board() -> None:
    """A name of its own stands alone; one that two boards have stands with the board."""
    reference = build_reference()
    given = [0.7] * reference.n_trials
    entries = [
        build_entry(reference, "one", given, name="Twice"),
        build_entry(reference, "two", given, name="Twice", testing="without_property"),
        build_entry(reference, "three", given, name="Once"),
    ]
    page = page_of(render_files(build_material(reference, entries)), reference.trial_ids[0])
    assert [text_of(row[0]) for row in body_of(page)] == ["Twice With", "Once", "Twice Without"]


def test_a_page_names_what_strangers_wrote_as_text(material: Material, files: dict[str, bytes]) -> None:
    """Markup in a submission's name stays a name."""
    page = page_of(files, material.reference.trial_ids[0])
    assert HOSTILE_NAME in [text_of(link) for link in page.iter("a")]
    assert not list(page.iter("img"))


def test_a_submission_lists_where_it_parts_from_people_most(
    material: Material, files: dict[str, bytes]
) -> None:
    """The trials with the largest distance between its probability and the share of YES, largest first."""
    reference, people = material.reference, material.reference.people
    assert people is not None
    for publication in material.publications:
        entry = publication.entry
        page = parse_html(files[f"submissions/{entry.slug}/index.html"])
        (section,) = [s for s in page.iter("section") if s.get("aria-labelledby") == "trial-by-trial"]
        rows = [row for body in section.iter("tbody") for row in body]
        distances = dict(
            zip(reference.trial_ids, np.abs(entry.probabilities - people.n_yes / people.n), strict=True)
        )
        known = sorted((d for d in distances.values() if not np.isnan(d)), reverse=True)
        assert [distances[text_of(row[0])] for row in rows] == known[:N_LISTED]
        for row in rows:
            index = reference.trial_index[text_of(row[0])]
            assert target_of(row) == f"{UP}{trial_path(reference.trial_ids[index])}"
            assert float(row[1].get("data-value", "")) == entry.probabilities[index]
            share = people.n_yes[index] / people.n[index]
            assert text_of(row[2]) == f"{show_number(share)} of {people.n[index]}"
            assert text_of(row[3]) == ("YES" if reference.labels[index] else "NO")
            assert text_of(row[4]) == SIGNS[entry.credits[index]]


@pytest.mark.parametrize("seed", [1, 2])
def test_there_is_a_page_for_every_trial(seed: int) -> None:
    """As many as the reference has trials, beside the lists of them, and the same bytes every time."""
    reference = build_reference(pairs_per_scenario=2, seed=seed)
    first, second = (render_files(build_material(reference)) for _ in range(2))
    pages = {path: content for path, content in first.items() if path.startswith("trials/")}
    lists = {path for path in pages if path.startswith(("trials/of/", "trials/where/"))}
    assert len(lists) == 2 + 7
    assert len(pages) == reference.n_trials + len(lists) + 1
    assert pages == {path: content for path, content in second.items() if path.startswith("trials/")}
