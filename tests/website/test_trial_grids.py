"""All trials at a glance, for people and for each submission, and the lists that choose some of them."""

from dataclasses import replace
from xml.etree.ElementTree import Element

import numpy as np
import pytest

from builders import build_entry, build_reference
from leaderboard.grading import subset_masks
from leaderboard.website.describing import submission_trials_path
from leaderboard.website.material import Material
from leaderboard.website.numbers import ABSENT
from leaderboard.website.trial_choices import list_choices
from leaderboard.website.trial_grids import compose_submission_trials, compose_trials
from leaderboard.website.trial_pages import GridCell, GridPage
from leaderboard.website.trial_paths import TRIALS_PATH, choice_path, list_path, trial_anchor
from leaderboard.website.trial_rows import TrialRows
from leaderboard.website.trial_tables import compose_trial_lists
from site_builders import HOSTILE_NAME, build_material, parse_html, render_files, text_of

CHOICES = ["easy", "hard", "between", "solved", "unsolved", "people-ahead", "submissions-ahead"]


def cells_of(page: GridPage) -> list[GridCell]:
    return [cell for section in page.sections for row in section.rows for cell in row.cells]


def anchors_of(page: Element) -> list[str]:
    return [row.get("id", "") for row in page.iter("tr") if row.get("id")]


def test_every_pair_is_a_square(material: Material, files: dict[str, bytes]) -> None:
    """Each leads to its row in the list of its property, and none is there twice."""
    cells = cells_of(compose_trials(material))
    lists = (list_path("Alpha"), list_path("Beta"))
    wanted = [f"{path}#{anchor}" for path in lists for anchor in anchors_of(parse_html(files[path]))]
    assert [cell.target for cell in cells] == wanted
    assert len(set(wanted)) == 12


def test_squares_of_people_say_how_many_answers_are_right(material: Material) -> None:
    """Of both trials of the pair together, in percent, shaded in five steps."""
    reference, people = material.reference, material.reference.people
    assert people is not None
    right = np.where(reference.labels == 1, people.n_yes, people.n - people.n_yes)
    cells = {cell.target.partition("#")[2]: cell for cell in cells_of(compose_trials(material))}
    for pair in range(len(reference.pair_ids)):
        members = np.flatnonzero(reference.pairs == pair)
        share = right[members].sum() / people.n[members].sum()
        (cell,) = (cells[a] for m in members if (a := trial_anchor(reference.trial_ids[m])) in cells)
        assert cell.text == f"{100 * share:.0f}"
        assert cell.level == str(min(int(share * 5), 4))
        assert cell.title.endswith(f": {cell.text} % of people's answers right")


def test_a_submission_has_squares_of_its_own(material: Material, files: dict[str, bytes]) -> None:
    """Two, one or none of each pair right; no number where it gave no answer."""
    pages = {page.path: page for page in compose_submission_trials(material)}
    assert len(pages) == len(material.publications)
    for publication in material.publications:
        entry = publication.entry
        page = pages[submission_trials_path(entry.slug)]
        right = entry.credits.reshape(-1, 2).sum(axis=1)
        gone = [bool(pair.all()) for pair in np.isnan(entry.probabilities).reshape(-1, 2)]
        assert [cell.text for cell in cells_of(page)] == [
            ABSENT if is_gone else f"{n:g}" for n, is_gone in zip(right, gone, strict=True)
        ]
        own = parse_html(files[f"submissions/{entry.slug}/index.html"])
        assert f"../../{page.path}" in {link.get("href") for link in own.iter("a")}


def test_without_people_submissions_shade_the_squares() -> None:
    """How many of the ranked ones are right on the whole pair; without these nothing is said."""
    reference = build_reference(n_people=0)
    good = build_entry(reference, "good", reference.labels.astype(float).tolist())
    poor = build_entry(reference, "poor", (1 - reference.labels).astype(float).tolist())
    page = compose_trials(build_material(reference, [good, poor]))
    assert {cell.text for cell in cells_of(page)} == {"50"}
    assert page.note.endswith("The number in it: % of ranked submissions right throughout.")
    empty = compose_trials(build_material(reference, []))
    assert {(cell.text, cell.level) for cell in cells_of(empty)} == {(ABSENT, "")}
    assert [choice.title for choice in empty.choices] == ["By property"]


def test_trials_without_a_twin_are_squares_too() -> None:
    """Each by itself."""
    paired = build_reference()
    reference = replace(paired, pair_ids=paired.trial_ids, pairs=np.arange(paired.n_trials))
    page = compose_trials(build_material(reference))
    assert len(cells_of(page)) == reference.n_trials
    assert page.note.startswith("Each square is a trial and leads to its row in the lists.")
    for own in compose_submission_trials(build_material(reference)):
        assert {cell.text for cell in cells_of(own)} <= {"0", "0.5", "1", ABSENT}
        assert [words for _, words in own.legend] == ["wrong", "at 0.5", "right"]


def test_choices_are_what_they_say(material: Material) -> None:
    """Recounted pair by pair from responses and credits."""
    reference, people = material.reference, material.reference.people
    assert people is not None
    rows = TrialRows.of(material)
    chosen = {choice.key: choice.mask for choice in list_choices(material, rows)}
    assert list(chosen) == CHOICES
    masks = subset_masks(reference)
    right = np.where(reference.labels == 1, people.n_yes, people.n - people.n_yes)
    ranked = [row.entry for board in material.boards for row in board.ranked]
    for pair in range(len(reference.pair_ids)):
        members = np.flatnonzero(reference.pairs == pair)
        solved = [bool((entry.credits[members] == 1).all()) for entry in ranked]
        is_easy, is_hard = (bool(masks[subset][members].any()) for subset in ("easy", "hard"))
        shares = right[members] / people.n[members]
        wanted = {
            "easy": is_easy,
            "hard": is_hard,
            "between": not is_easy and not is_hard,
            "solved": all(solved),
            "unsolved": not any(solved),
            "people-ahead": (shares > 0.5).all() and 2 * sum(solved) < len(solved),
            "submissions-ahead": (shares < 0.5).any() and 2 * sum(solved) > len(solved),
        }
        assert {key: mask[members].tolist() for key, mask in chosen.items()} == {
            key: [holds] * 2 for key, holds in wanted.items()
        }


def test_lists_hold_the_rows_that_are_chosen(files: dict[str, bytes]) -> None:
    """No more and no fewer than the link to the list says, and a list of none says that there are none."""
    for path in (*(list_path(name) for name in ("Alpha", "Beta")), *map(choice_path, CHOICES)):
        page = parse_html(files[path])
        (current,) = [li for li in page.iter("li") if len(li) and li[0].get("aria-current") and len(li) == 2]
        assert text_of(current[1]) == str(len(anchors_of(page)))
        assert ("There are none." in [text_of(p) for p in page.iter("p")]) == (not anchors_of(page))
        summary = text_of(next(p for p in page.iter("p") if p.get("class") == "lead"))
        n = 2 * len(anchors_of(page))
        assert f"{n} trials" in summary


def test_each_list_links_all_others(files: dict[str, bytes]) -> None:
    """From the overview and from every list, without a script."""
    paths = {*(list_path(name) for name in ("Alpha", "Beta")), *map(choice_path, CHOICES)}
    for path in (TRIALS_PATH, *paths):
        up = "../" * path.count("/")
        targets = {(link.get("href") or "").removeprefix(up) for link in parse_html(files[path]).iter("a")}
        assert paths <= targets


@pytest.mark.parametrize("n_people", [0, 12])
def test_choices_follow_what_is_known(n_people: int) -> None:
    """Without people nothing of theirs, without ranked submissions nothing of these."""
    reference = build_reference(n_people=n_people)
    material = build_material(reference, [])
    keys = [choice.key for choice in list_choices(material, TrialRows.of(material))]
    assert keys == (CHOICES[:3] if n_people else [])
    assert len(list(compose_trial_lists(material))) == 2 + len(keys)


def test_hostile_names_stay_text_on_the_page_of_squares(files: dict[str, bytes]) -> None:
    """In the heading, the title and the way back."""
    page = parse_html(files[submission_trials_path("hostile")])
    assert text_of(next(page.iter("h1"))) == f"{HOSTILE_NAME}, trial by trial"
    assert HOSTILE_NAME in [text_of(link) for link in page.iter("a")]
    assert not [element for element in page.iter() if element.tag in {"img", "script", "style"}]


def test_the_same_material_gives_the_same_squares() -> None:
    """Rendered twice, byte for byte."""
    material = build_material(build_reference(2))
    first, second = (render_files(material) for _ in range(2))
    paths = [path for path in first if path.startswith("trials/") or path.endswith("trials.html")]
    assert all(first[path] == second[path] for path in paths)
