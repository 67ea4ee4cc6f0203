"""The page of the public record: what was graded, what is in doubt, and everything that ever happened."""

import datetime as dt
from pathlib import Path
from xml.etree.ElementTree import Element

import pytest

from leaderboard import __version__
from leaderboard.grading import METRICS_VERSION
from leaderboard.ledger import render_ledger
from leaderboard.models.ledger import Event, LedgerLine
from leaderboard.website import build_site
from leaderboard.website.material import Material
from leaderboard.website.status_pages import compose_status
from site_builders import build_material, parse_html, text_of, write_instance

DIGEST = "0123456789ab" + 52 * "c"
HOSTILE = "<img src=x onerror=alert(1)>"


def make_line(
    slug: str, event: Event, day: int, reason: str = "a reason", digest: str = DIGEST
) -> LedgerLine:
    date = dt.date(2026, 3, day)
    return LedgerLine(date=date, slug=slug, event=event, reason=reason, result_sha256=digest)


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Element:
    """Build the page of an instance of which one submission left the board."""
    instance = write_instance(tmp_path_factory.mktemp("status") / "instance")
    lines = [
        make_line("good", "added", 4),
        make_line("hostile", "added", 5),
        make_line("good", "regraded", 6, HOSTILE, 64 * "d"),
        make_line("hostile", "withdrawn", 7, "asked for by its team"),
    ]
    instance.ledger_file.write_text(render_ledger(lines))
    return parse_html((build_site(instance).path / "status.html").read_bytes())


def test_the_record_is_told_newest_first(page: Element) -> None:
    """Every line with its date, event, reason and result; text stays text."""
    (body,) = page.iter("tbody")
    rows = [[text_of(cell) for cell in row] for row in body.iter("tr")]
    assert rows == [
        ["hostile", "2026-03-07", "withdrawn", "asked for by its team", DIGEST[:12]],
        ["good", "2026-03-06", "regraded", HOSTILE, 12 * "d"],
        ["hostile", "2026-03-05", "added", "a reason", DIGEST[:12]],
        ["good", "2026-03-04", "added", "a reason", DIGEST[:12]],
    ]


def test_who_left_the_board_has_a_line_and_no_link(page: Element) -> None:
    """Its page is gone, what happened is not."""
    (body,) = page.iter("tbody")
    links = {link.get("href") for link in body.iter("a")}
    assert links == {"submissions/good/index.html"}


def test_it_counts_what_is_graded(material: Material) -> None:
    """Submissions, baselines and those in part; without a ledger, nothing happened yet."""
    facts = {fact.title: fact.text for fact in compose_status(material).facts}
    assert facts["Graded"] == "7 submissions and 2 baselines, 2 of them in part"
    assert facts["Last event"] == "nothing so far"
    assert facts["Against"] == "the synthetic reference 000000000000"
    assert facts["With"] == f"grader {__version__}, metrics version {METRICS_VERSION}"
    assert facts["Grade everything again"] == "leaderboard verify"


def test_what_checks_found_is_told(material: Material, files: dict[str, bytes]) -> None:
    """By the name of the submission, with a link; of a baseline nothing is, which is one on purpose."""
    (doubt,) = compose_status(material).doubts
    assert doubt.submission.target == "submissions/good-too/index.html"
    assert doubt.findings == ("nearly equal to <b>another</b>",)
    shown = parse_html(files["status.html"])
    assert [text_of(item) for item in shown.iter("li") if "nearly" in text_of(item)] == [
        "Good too: nearly equal to <b>another</b>"
    ]


def test_where_nothing_is_found_the_page_says_so() -> None:
    """Neither doubts nor a record."""
    page = compose_status(build_material(entries=[]))
    assert page.doubts == ()
    assert page.record == ()


def test_the_commit_is_named_where_it_is_known(tmp_path: Path) -> None:
    """As the last build's."""
    instance = write_instance(tmp_path / "instance", submissions=False)
    built = build_site(instance, commit="0123456789abcdef")
    assert "Built from the commit 0123456789ab." in text_of(
        parse_html((built.path / "status.html").read_bytes())
    )
