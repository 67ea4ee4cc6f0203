"""Ready-made comparisons show the numbers of the command, for neighbours at the top of each board."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from builders import build_entry, build_reference
from leaderboard.cli import group
from leaderboard.comparing import compare
from leaderboard.grading import Yardstick
from leaderboard.reference import Reference, load_reference
from leaderboard.submission import Submission
from leaderboard.submitting import replace_submission
from leaderboard.website.comparison_pages import ComparisonPage
from leaderboard.website.comparison_tables import (
    compose_comparison_pages,
    compose_comparisons,
    link_comparisons,
)
from leaderboard.website.material import Material, gather, load_publications
from leaderboard.website.numbers import EN_DASH, MINUS
from leaderboard.website.pages import Cell
from site_builders import (
    DAY,
    HOSTILE_NAME,
    HOSTILE_TEAM,
    build_material,
    parse_html,
    render_files,
    text_of,
    write_instance,
)

GOOD_AND_HOSTILE = "compare/good--vs--hostile/index.html"


def page_at(path: str, material: Material) -> ComparisonPage:
    return next(page for page in compose_comparison_pages(material) if page.path == path)


def cells_of(page: ComparisonPage) -> dict[str, dict[str, Cell]]:
    """Each score by its scope and its column."""
    scores = page.tables[0]
    columns = [column.metric for column in scores.columns]
    columns[:2] = ["accuracy_a", "accuracy_b"]
    return {row.title: dict(zip(columns, row.cells, strict=True)) for row in scores.rows}


def counts_of(page: ComparisonPage) -> dict[str, tuple[str, ...]]:
    return {row.title: row.counts for row in page.tables[1].rows}


def build_board(n: int, reference: Reference) -> Material:
    """Fill a board with submissions that get one trial more wrong each."""
    wrong = [np.arange(reference.n_trials) < place for place in range(n)]
    answers = [np.where(mask, 1 - reference.labels, reference.labels).astype(float) for mask in wrong]
    return build_material(
        reference,
        [build_entry(reference, f"system-{place:02d}", p.tolist()) for place, p in enumerate(answers)],
    )


def submission_of(slug: str, material: Material) -> Submission:
    entry = next(p.entry for p in material.publications if p.entry.slug == slug)
    everything = np.ones(material.reference.n_trials, bool)
    return Submission(slug, entry.metadata, "", entry.probabilities, everything, everything)


def value_of(cell: Cell) -> float | None:
    return float(cell.exact) if cell.exact else None


def test_the_numbers_are_those_of_the_command(tmp_path: Path) -> None:
    """Every scope, difference, interval, p, kappa, count and trial equals what the command prints as JSON."""
    instance = write_instance(tmp_path / "instance")
    reference, folder = load_reference(instance), instance.submission_dir("hostile")
    other = (folder / "predictions.csv").read_bytes().replace(b",0.7", b",0.2").replace(b",0.0", b",0.9")
    about = (folder / "submission.toml").read_bytes()
    replace_submission(instance, reference, "hostile", about, other, today=DAY)
    material = gather(reference, load_publications(instance, reference))
    (page,) = compose_comparison_pages(material)
    a, b = page.path.split("/")[1].split("--vs--")
    printed = CliRunner().invoke(group, ["--root", str(instance.root), "compare", a, b, "--json"])
    wanted = json.loads(printed.output)
    titles = {s.id: s.title for s in reference.benchmark.scenarios} | {"overall": "Overall"}
    by_title = {titles.get(scope["name"], scope["name"]): scope for scope in wanted["scopes"]}
    assert any(scope["difference"]["value"] for scope in wanted["scopes"])
    for title, cells in cells_of(page).items():
        scope = by_title[title]
        for key in ("accuracy_a", "accuracy_b"):
            assert float(cells[key].exact) == scope[key]
        for key, name in (("accuracy_difference", "difference"), ("human_r_difference",) * 2):
            interval = scope[name]
            assert value_of(cells[key]) == interval["value"]
            if interval["value"] is not None:
                assert [float(end) for end in cells[key].ends] == [interval["low"], interval["high"]]
        assert float(cells["paired_p"].exact) == scope["p"]
        assert value_of(cells["rival_kappa"]) == scope["kappa"]["value"]
        overlap = scope["overlap"]
        keys = ("n_both_right", "n_only_a", "n_only_b", "n_neither")
        trials = [overlap[key] for key in keys]
        pairs = [overlap[key] for key in ("n_pairs_a", "n_pairs_b", "n_pairs_equal")]
        assert [int(n) for n in counts_of(page)[title]] == [scope["n"], *trials, scope["n_pairs"], *pairs]
    assert [(line.trial.title, line.label) for line in page.trials] == [
        (trial["trial_id"], "YES" if trial["label"] else "NO") for trial in wanted["trials"]
    ]
    for line, trial in zip(page.trials, wanted["trials"], strict=True):
        values = [trial["probability_a"], trial["probability_b"], trial["human_mean"]]
        assert [float(exact) if exact else None for _, exact in line.probabilities] == values


def test_exchanging_the_two_turns_every_sign(material: Material) -> None:
    """Differences and ends of intervals change sides and signs; p and kappa stay, counts change places."""
    two = [submission_of(slug, material) for slug in ("good", "hostile")]
    yardstick = Yardstick.of(material.reference)
    backward = replace(
        material, comparisons=(compare(two[1], two[0], material.reference, yardstick=yardstick),)
    )
    a_first = page_at(GOOD_AND_HOSTILE, material)
    b_first = page_at("compare/hostile--vs--good/index.html", backward)
    for scope, cells in cells_of(a_first).items():
        turned = cells_of(b_first)[scope]
        assert cells["accuracy_a"] == turned["accuracy_b"]
        assert cells["paired_p"] == turned["paired_p"]
        assert cells["rival_kappa"] == turned["rival_kappa"]
        for key in ("accuracy_difference", "human_r_difference"):
            assert float(cells[key].exact) == -float(turned[key].exact)
            ends = [-float(end) for end in reversed(turned[key].ends)]
            assert [float(end) for end in cells[key].ends] == pytest.approx(ends, abs=1e-6)
        n, both, only_a, only_b, neither, pairs, a_better, b_better, equal = counts_of(a_first)[scope]
        exchanged = (n, both, only_b, only_a, neither, pairs, b_better, a_better, equal)
        assert counts_of(b_first)[scope] == exchanged


def test_neighbours_and_the_best_are_compared() -> None:
    """Of thirteen, the first ten each with the next one, the tenth with the eleventh, and with the best."""
    material = build_board(13, build_reference(6))
    pairs = [(int(c.a[-2:]), int(c.b[-2:])) for c in material.comparisons]
    neighbours = {(place, place + 1) for place in range(10)}
    assert pairs == sorted(neighbours | {(0, place) for place in range(2, 10)})


def test_comparisons_are_linked_from_both_submissions_and_the_board(files: dict[str, bytes]) -> None:
    """And from the list of all, which every comparison, board and submission leads to."""
    for path in ("submissions/good/index.html", "submissions/hostile/index.html"):
        assert f"../../{GOOD_AND_HOSTILE}".encode() in files[path]
    assert b'href="compare/index.html"' in files["index.html"]
    assert b'href="../compare/good--vs--hostile/index.html"' in files["compare/index.html"]
    assert b'href="../../compare/index.html"' in files[GOOD_AND_HOSTILE]
    assert b'href="../../compare/index.html"' in files["tracks/without/index.html"]
    assert b'href="../../compare/index.html?of=part"' in files["submissions/part/index.html"]


def test_the_list_shows_what_the_pages_show(material: Material) -> None:
    """Overall difference, p and agreement of each, under the two names."""
    pages = {page.path: page for page in compose_comparison_pages(material)}
    (table,) = compose_comparisons(material).tables
    assert [row.target for row in table.rows] == list(pages)
    for row in table.rows:
        assert row.title == pages[row.target].title
        assert row.cells == pages[row.target].tables[0].rows[0].cells[2:]


def test_differences_are_drawn_around_zero(material: Material) -> None:
    """Every scope with its interval, on an axis that reaches as far to either side; human r where known."""
    page = page_at(GOOD_AND_HOSTILE, material)
    accuracy, human_r = page.figures
    assert (accuracy.key, human_r.key) == ("forest-accuracy-difference", "forest-human-r-difference")
    for scope, cells in cells_of(page).items():
        cell = cells["accuracy_difference"]
        low, high = (f"{100 * float(end):+z.1f}".replace("-", MINUS) for end in cell.ends)
        assert f"{scope}: {cell.text} points, 95 % interval {low} to {high}" in accuracy.description
    numbers = [text.text for layer in accuracy.layers for text in layer.texts]
    for tick in (text for text in numbers if text.startswith(MINUS) and "." not in text):
        assert tick.removeprefix(MINUS) in numbers
    alone = build_material(build_reference(n_people=0))
    assert [drawing.key for drawing in page_at(GOOD_AND_HOSTILE, alone).figures] == [accuracy.key]


def test_the_verdict_is_a_sentence(material: Material) -> None:
    """What the difference is, how sure, and whether one test alone tells the two apart."""
    good_too = page_at("compare/good--vs--good-too/index.html", material)
    assert good_too.verdict == (
        "Overall, the accuracy of A minus that of B is +0.0 points: 95 % interval +0.0 to +0.0, exact "
        "p = 1.000. On its own, such a test does not tell the two apart at 5 %."
    )
    hostile = page_at(GOOD_AND_HOSTILE, material)
    overall = cells_of(hostile)["Overall"]
    assert float(overall["paired_p"].exact) < 0.05
    assert f" is {overall['accuracy_difference'].text} points: " in hostile.verdict
    assert hostile.verdict.endswith("On its own, such a test tells the two apart at 5 %.")


def test_without_people_their_columns_are_left_out() -> None:
    """No human r, and no share of people who said YES."""
    material = build_material(build_reference(n_people=0))
    for page in compose_comparison_pages(material):
        assert "human_r_difference" not in cells_of(page)["Overall"]
        assert not page.has_people
        assert {len(line.probabilities) for line in page.trials} == {2}
    assert b"of-people" not in render_files(material)[GOOD_AND_HOSTILE]


def test_what_is_undefined_says_why() -> None:
    """Two that give one answer to all trials have neither a kappa nor a human r."""
    reference = build_reference()
    entries = [build_entry(reference, slug, [0.9] * reference.n_trials) for slug in ("one", "two")]
    (page,) = compose_comparison_pages(build_material(reference, entries))
    for name in ("rival_kappa", "human_r_difference"):
        cell = cells_of(page)["Overall"][name]
        assert cell.text == EN_DASH
        assert cell.why.startswith("undefined: ")
        assert page.tables[0].footnotes[cell.note - 1] == cell.why


def test_what_else_a_reader_should_know_is_noted(material: Material) -> None:
    """A property gain is called so, a trial may have no share of people, and the command is named."""
    known = material.comparisons[0]
    trials = (replace(known.trials[0], human_mean=None), *known.trials[1:])
    changed = replace(material, comparisons=(replace(known, property_gain="A-B", trials=trials),))
    (page,) = compose_comparison_pages(changed)
    notes = {note.title: note.text for note in page.notes}
    assert notes["Property gain"] == (
        f"A {MINUS} B is that of one system, with and without property inference."
    )
    assert notes["Compare again"] == f"leaderboard compare {known.a} {known.b}"
    cells = [text_of(td) for td in parse_html(render_files(changed)[page.path]).iter("td")]
    assert f"{EN_DASH} nobody judged it" in cells


def test_one_submission_alone_is_compared_with_none() -> None:
    """There is no page, no list and no link."""
    reference = build_reference()
    material = build_material(reference, [build_entry(reference, "alone", [0.6] * reference.n_trials)])
    assert material.comparisons == ()
    assert link_comparisons("alone", material) == ()
    files = render_files(material)
    assert not [path for path in files if path.startswith("compare/")]
    assert not [path for path, content in files.items() if path.endswith(".html") and b"compare/" in content]


def test_hostile_names_stay_text(files: dict[str, bytes]) -> None:
    """The heading, the title and the link are what was written, and the team's name makes no element."""
    page = parse_html(files[GOOD_AND_HOSTILE])
    assert text_of(next(page.iter("h1"))) == f"Good and {HOSTILE_NAME}"
    (link,) = [link for link in page.iter("a") if text_of(link) == HOSTILE_NAME]
    assert link.get("href") == "../../submissions/hostile/index.html"
    assert any(HOSTILE_TEAM in text_of(small) for small in page.iter("small"))
    assert not list(page.iter("script"))
