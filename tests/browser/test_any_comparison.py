"""Any two to six submissions side by side, in a browser, with the numbers of ``leaderboard compare``."""

import re
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Browser, Page, expect

from builders import build_entry, build_reference
from leaderboard.comparing import Comparison, ScopeComparison, compare
from leaderboard.grading import Yardstick
from leaderboard.metrics.undefined import Undefined
from leaderboard.ranking import Entry
from leaderboard.reference import Reference
from leaderboard.submission import Submission
from leaderboard.website.describing import title_scopes
from leaderboard.website.numbers import EN_DASH, MINUS, show_ends, show_number, show_p, show_points
from leaderboard.website.replacing import replace_site
from leaderboard.website.trial_paths import trial_path
from site_builders import HOSTILE_NAME, build_entries, build_material, render_files
from site_visits import Visit, start_visit

pytestmark = pytest.mark.browser

SIX = ("good", "hostile", "oracle", "flat", "halves", "rough")
NOBODY = f"{EN_DASH} nobody judged it"
N_RESAMPLES = 1_501  # the last, odd resample of five pairs leaves half a random number over


def build_odd_reference() -> Reference:
    """Five pairs a scenario, one trial that nobody judged, and a last block of resamples that is odd."""
    reference = build_reference(5, n_people=11)
    grading = reference.benchmark.grading.model_copy(update={"resamples": N_RESAMPLES, "seed": 7})
    people = reference.people
    assert people is not None
    n, n_yes = people.n.copy(), people.n_yes.copy()
    n[3] = n_yes[3] = 0
    return replace(
        reference,
        benchmark=reference.benchmark.model_copy(update={"grading": grading}),
        people=replace(people, n=n, n_yes=n_yes, responses=None),
    )


@pytest.fixture(scope="module")
def reference() -> Reference:
    return build_odd_reference()


@pytest.fixture(scope="module")
def entries(reference: Reference) -> dict[str, Entry]:
    """One of every sort, one with ties, and one that refused an answer, by slug."""
    rng = np.random.default_rng(5)
    found = build_entries(reference)
    halves = np.round(rng.random(reference.n_trials) * 2) / 2
    found.append(build_entry(reference, "halves", halves.tolist(), name="Halves"))
    rough = build_entry(reference, "rough", rng.random(reference.n_trials).tolist(), name="Rough")
    given, credits = rough.probabilities.copy(), rough.credits.copy()
    given[5], credits[5] = np.nan, 0
    found.append(replace(rough, probabilities=given, credits=credits))
    return {entry.slug: entry for entry in found}


@pytest.fixture(scope="module")
def board_dir(
    tmp_path_factory: pytest.TempPathFactory, reference: Reference, entries: dict[str, Entry]
) -> Path:
    folder = tmp_path_factory.mktemp("compared") / "site"
    replace_site(folder, render_files(build_material(reference, list(entries.values()))).items())
    return folder


def submission_of(entry: Entry, reference: Reference) -> Submission:
    """What was submitted, as the command would read it."""
    answered = ~np.isnan(entry.probabilities)
    scopes = entry.result.scores
    names = [scenario.id for scenario in reference.benchmark.scenarios]
    covered = np.array([names[index] in scopes for index in reference.scenarios])
    probabilities = np.where(answered, entry.probabilities, 0.5)
    return Submission(entry.slug, entry.metadata, "", probabilities, answered, covered)


@pytest.fixture(scope="module")
def compared(reference: Reference, entries: dict[str, Entry]) -> dict[tuple[str, str], Comparison]:
    """Compare every two as the command does."""
    yardstick = Yardstick.of(reference)
    found = {slug: submission_of(entries[slug], reference) for slug in (*SIX, "part")}
    return {
        (a, b): compare(found[a], found[b], reference, yardstick=yardstick) for a, b in combinations(found, 2)
    }


def open_comparison(visit: Visit, *slugs: str) -> Page:
    """Open the comparison of some, and wait for its numbers."""
    page = visit.open(f"compare/index.html?of={','.join(slugs)}")
    expect(page.get_by_role("status")).to_contain_text("resamples of pairs")
    return page


def rows_of(page: Page, title: str) -> dict[str, list[str]]:
    """The cells of a table as they are printed, intervals behind their numbers, by the row's name."""
    rows = page.get_by_role("region", name=title).locator("tbody tr")
    texts = rows.evaluate_all("rows => rows.map(row => [...row.cells].map(cell => cell.textContent))")
    return {name: [" ".join(cell.split()) for cell in cells] for name, *cells in texts}


def print_scope(scope: ScopeComparison) -> list[str]:
    """Print a comparison on one scope as Python does."""
    value, *ends = (
        round(x, 6) + 0.0 for x in (scope.difference.value, scope.difference.low, scope.difference.high)
    )
    kappa, overlap = scope.kappa, scope.overlap
    counts = (
        *(overlap.n_both_right, overlap.n_only_a, overlap.n_only_b, overlap.n_neither),
        *(overlap.n_pairs_a, overlap.n_pairs_b, overlap.n_pairs_equal),
    )
    return [
        f"{show_points(value)} {show_ends(*map(show_points, ends))}",
        show_p(scope.p),
        f"{EN_DASH} undefined: {kappa.why}" if isinstance(kappa, Undefined) else show_number(round(kappa, 6)),
        *map(str, counts),
    ]


def print_differences(
    comparison: Comparison, reference: Reference, letters: tuple[str, str]
) -> dict[str, list[str]]:
    """Print what two differ in, by scope."""
    scopes = {scope.name: scope for scope in comparison.scopes}
    titles = {name: title for name, title, _ in title_scopes(scopes, reference.benchmark) if name in scopes}
    a, b = letters
    return {f"{title}, {a} {MINUS} {b}": print_scope(scopes[name]) for name, title in titles.items()}


@pytest.mark.parametrize(("a", "b"), [*combinations(SIX, 2), ("hostile", "part")])
def test_two_have_the_numbers_of_the_command(
    visit: Visit, compared: dict[tuple[str, str], Comparison], reference: Reference, a: str, b: str
) -> None:
    """Every scope, difference, interval, p, kappa and count; and the trials on which they differ most."""
    page = open_comparison(visit, a, b)
    wanted = compared[a, b]
    assert rows_of(page, "Differences") == print_differences(wanted, reference, ("A", "B"))
    trials = rows_of(page, "Trials")
    assert list(trials) == [trial.trial_id for trial in wanted.trials]
    for trial in wanted.trials:
        human = NOBODY if trial.human_mean is None else show_number(trial.human_mean)
        shown = [show_number(trial.probability_a), show_number(trial.probability_b), human]
        assert trials[trial.trial_id] == ["YES" if trial.label else "NO", *shown]


def test_several_are_compared_two_by_two(
    visit: Visit, compared: dict[tuple[str, str], Comparison], reference: Reference
) -> None:
    """Overall and on every property each of six with each other, with the same numbers."""
    page = open_comparison(visit, *SIX)
    wanted: dict[str, list[str]] = {}
    for (i, a), (j, b) in combinations(enumerate(SIX), 2):
        rows = print_differences(compared[a, b], reference, ("ABCDEF"[i], "ABCDEF"[j]))
        wanted |= {
            name: cells for name, cells in rows.items() if name.startswith(("Overall", "Alpha", "Beta"))
        }
    assert len(wanted) == 15 * 3
    assert rows_of(page, "Differences") == wanted


def test_scores_are_those_of_the_board(visit: Visit, entries: dict[str, Entry]) -> None:
    """Accuracy and human r of everybody, with their intervals, as everywhere on the site."""
    page = open_comparison(visit, "good", "hostile", "flat")
    overall = rows_of(page, "Scores")["Overall"]
    for place, slug in enumerate(("good", "hostile", "flat")):
        accuracy, r = (entries[slug].score(name) for name in ("accuracy", "human_r"))
        assert accuracy is not None
        assert accuracy.value is not None
        assert r is not None
        assert overall[2 * place].startswith(f"{100 * accuracy.value:.1f} ")
        assert overall[2 * place + 1].startswith(
            EN_DASH if r.value is None else f"{r.value:.3f} ".replace("-", MINUS)
        )


def test_headings_lead_to_what_they_mean(visit: Visit) -> None:
    """Every metric in a heading is explained on the page of the method."""
    page = open_comparison(visit, "good", "hostile")
    targets = page.locator(".compared thead a").evaluate_all("links => links.map(link => link.href)")
    assert len(set(targets)) == 5
    named = page.locator(".compared thead a").all_inner_texts()
    assert named[:5] == ["A: accuracy, %", "A: human r", "B: accuracy, %", "B: human r", "Accuracy"]
    for target in set(targets):
        page.goto(target)
        assert page.locator(":target").count() == 1, target


def test_trials_that_are_shown_lead_to_their_pages(visit: Visit) -> None:
    """A click on a trial's id opens its page."""
    page = open_comparison(visit, "good", "hostile")
    link = page.get_by_role("region", name="Trials").get_by_role("link").first
    trial_id = link.inner_text()
    link.click()
    assert page.url == f"{visit.origin}/{trial_path(trial_id)}"


def test_the_address_remembers_what_is_compared(visit: Visit) -> None:
    """Adding and removing by the keyboard alone changes the address; back, forward and reload follow it."""
    page = visit.open("compare/index.html")
    status, chosen = page.get_by_role("status"), page.locator(".chosen li > a")
    assert status.inner_text() == "Add two to six."
    for slug in ("good", "oracle", "good"):
        page.get_by_label("Submission").select_option(slug)
        page.get_by_role("button", name="Add").focus()
        page.keyboard.press("Enter")
    expect(chosen).to_have_text(["Good", "Oracle"])
    expect(page).to_have_url(re.compile(r"/compare/index\.html\?of=good,oracle$"))
    page.get_by_role("button", name="Remove Good").focus()
    page.keyboard.press("Space")
    expect(page).to_have_url(re.compile(r"\?of=oracle$"))
    assert page.evaluate("() => document.activeElement.tagName") == "SELECT"
    page.go_back()
    expect(status).to_contain_text("resamples of pairs")
    expect(chosen).to_have_text(["Good", "Oracle"])
    page.go_forward()
    expect(chosen).to_have_text(["Oracle"])
    page.go_back()
    page.reload()
    expect(chosen).to_have_text(["Good", "Oracle"])


def test_there_are_never_more_than_six(visit: Visit) -> None:
    """A seventh in the address is left out, and one that is added is refused in words."""
    page = open_comparison(visit, *SIX, "good-too")
    assert page.locator(".chosen li").count() == 6
    status, add = page.get_by_role("status"), page.get_by_role("button", name="Add")
    assert status.inner_text().startswith("Only the first six are compared. ")
    page.get_by_label("Submission").select_option("good-too")
    add.focus()
    page.keyboard.press("Enter")
    assert status.inner_text() == "Six are compared: remove one to add another."
    assert page.locator(".chosen li").count() == 6
    assert page.evaluate("() => document.activeElement.textContent") == "Add"


@pytest.mark.parametrize(
    ("said", "n_missing"),
    [
        ("of=nobody,../../etc/passwd", 2),
        ("of=javascript:alert(1),<img src=x>", 2),
        ("of=__proto__,constructor,toString", 3),
        ("of=,,", 0),
        ("x=good", 0),
    ],
)
def test_what_is_not_known_is_not_compared(visit: Visit, said: str, n_missing: int) -> None:
    """Nothing is loaded for it; that it is missing is told, in words that the address has no part in."""
    page = visit.open(f"compare/index.html?{said}")
    missing = f"Not on this site: {n_missing} of those in the address. " if n_missing else ""
    assert page.get_by_role("status").inner_text() == f"{missing}Add two to six."
    assert page.locator(".chosen li, .compared table").count() == 0
    assert page.locator("head script").count() == 2


def test_who_is_missing_changes_who_is_which(visit: Visit) -> None:
    """Letters are those of the ones that are there, and the page says that others are not."""
    page = visit.open("compare/index.html?of=good, withdrawn,oracle")
    expect(page.get_by_role("status")).to_contain_text("resamples of pairs")
    assert page.get_by_role("status").inner_text().startswith("Not on this site: 1 of those in the address. ")
    assert page.locator(".chosen li > a").all_inner_texts() == ["Good", "Oracle"]


def test_reasons_and_left_out_resamples_are_told(visit: Visit) -> None:
    """What is undefined says why beside the dash and below the table, as everywhere on the site."""
    page = open_comparison(visit, "flat", "oracle")
    cell = rows_of(page, "Scores")["Overall"][1]
    assert cell == f"{EN_DASH} undefined: all probabilities are equal"
    notes = page.locator(".compared > div > p").all_inner_texts()
    assert notes.count(f"{EN_DASH} undefined: all probabilities are equal") == 1


def test_names_of_strangers_stay_text(visit: Visit) -> None:
    """Markup in a name makes no element, neither among the chosen nor in the list to choose from."""
    page = open_comparison(visit, "hostile", "good")
    assert page.locator(".chosen li > a").first.inner_text() == HOSTILE_NAME
    assert page.locator("main img, main script").count() == 0


def test_who_has_no_scenario_in_common_is_told_so(visit: Visit) -> None:
    """Two partial submissions of different properties cannot be compared."""
    page = visit.open("compare/index.html?of=part,sliver")
    said = "They cover no scenario in common: there is nothing to compare."
    expect(page.get_by_role("status")).to_have_text(said)
    assert page.locator(".compared table").count() == 0


def test_what_cannot_be_loaded_is_told(browser: Browser, origin: str) -> None:
    """Where the answers of one are not there, the page says so, and tries again when it is added again."""
    visit = start_visit(browser, origin)
    visit.page.route("**/data/contenders/good.*.js", lambda route: route.abort())
    page = visit.open("compare/index.html?of=good,oracle")
    said = "What Good answered could not be loaded. Reload the page to try again."
    expect(page.get_by_role("status")).to_have_text(said)
    page.unroute_all()
    page.get_by_role("button", name="Remove Good, good").click()
    page.get_by_label("Submission").select_option("good")
    page.get_by_role("button", name="Add").click()
    expect(page.get_by_role("status")).to_contain_text("resamples of pairs")
    page.context.close()


def test_what_is_no_answer_is_told(browser: Browser, origin: str) -> None:
    """A page of a network in place of the file, as of a captive portal, is not waited for either."""
    visit = start_visit(browser, origin)
    visit.page.route("**/data/contenders/good.*.js", lambda route: route.fulfill(body="/* nothing */"))
    page = visit.open("compare/index.html?of=good,oracle")
    expect(page.get_by_role("status")).to_contain_text("What Good answered could not be loaded.")
    assert page.locator(".compared table").count() == 0
    page.context.close()


def test_it_works_as_a_plain_file(browser: Browser, board_dir: Path) -> None:
    """Opened with a double click the page compares too."""
    visit = start_visit(browser, board_dir.as_uri())
    page = open_comparison(visit, "good", "oracle")
    assert page.get_by_role("region", name="Differences").is_visible()
    assert visit.complaints == []
    page.context.close()


def test_without_people_there_is_no_column_for_them(browser: Browser, tmp_path: Path) -> None:
    """No human r and no share of people who said YES; the rest stays."""
    material = build_material(build_reference(n_people=0))
    replace_site(tmp_path / "site", render_files(material).items())
    visit = start_visit(browser, (tmp_path / "site").as_uri())
    page = open_comparison(visit, "good", "hostile")
    assert {len(cells) for cells in rows_of(page, "Scores").values()} == {2}
    assert {len(cells) for cells in rows_of(page, "Trials").values()} == {3}
    assert page.get_by_text("human r").count() == 0
    page.context.close()
