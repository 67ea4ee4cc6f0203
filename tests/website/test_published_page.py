"""Published numbers stand on a page of their own, as printed, with what an audit finds in words."""

import dataclasses
from pathlib import Path
from xml.etree.ElementTree import Element

from builders import build_reference
from leaderboard.auditing import FLAGS, audit
from leaderboard.instance import Instance
from leaderboard.models.published import PublishedNumber
from leaderboard.website.material import load_published
from leaderboard.website.numbers import EN_DASH
from leaderboard.website.published_tables import compose_published
from site_builders import build_material, parse_html, render_files, text_of

TO = EN_DASH
HOSTILE = '<img src=x onerror="alert(1)"> {{ 7 * 7 }}'


def number(scope: str, printed: str, **changes: object) -> PublishedNumber:
    row = {
        "source": "A Paper",
        "url": "https://example.com/paper",
        "system": "Model",
        "training": "unified",
        "testing": "with_property",
        "training_trials": 2000,
        "scope": scope,
        "metric": "accuracy",
        "printed": printed,
        "n": 192,
        "note": "Table 2",
    }
    return PublishedNumber.model_validate(row | changes)


NUMBERS = (
    number("Mass", "52.6"),
    number("overall", "99.9", n=384),
    number("Mass", "52.5", system="Other"),
    number("Friction", "60.4", system="Other"),
    number("overall", "0.12", metric="human_r", note="text", n=None),
)


def page_of(*numbers: PublishedNumber) -> Element:
    material = dataclasses.replace(build_material(build_reference(), []), published=numbers)
    return parse_html(render_files(material)["published.html"])


def rows_of(table: Element) -> list[list[str]]:
    return [[text_of(cell) for cell in row] for row in table.iter("tr")]


def test_figures_stand_as_printed_by_system_and_scope() -> None:
    """Each protocol is a table, each system a row, each scope a column; what is not printed is a dash."""
    first, second = page_of(*NUMBERS).iter("table")
    assert rows_of(first) == [
        ["System", "Mass", "overall", "Friction"],
        ["Model", f"52.645.6{TO}59.5not-above-chance", f"99.998.5{TO}100.0impossible", TO],
        ["Other", f"52.545.0{TO}59.5impossiblenot-above-chance", TO, f"60.453.4{TO}67.1"],
    ]
    assert rows_of(second) == [["System", "overall, human_r"], ["Model", "0.12"]]


def test_captions_say_the_protocol_in_words() -> None:
    """How systems were trained and tested, and what the source adds, stand above the figures."""
    caption = next(page_of(*NUMBERS).iter("caption"))
    assert text_of(caption).startswith(
        "One model for all properties, standard video, 2,000 training trials Table 2."
    )


def test_flags_that_are_set_are_explained(repo_root: Path) -> None:
    """Every flag of the real file is counted and explained as the audit command does; no other is shown."""
    instance = Instance(repo_root)
    published = load_published(instance)
    material = dataclasses.replace(build_material(), published=published)
    counts = [flag for each in audit(published) for flag in each.flags]
    flags = {fact.title: fact.text for fact in compose_published(material).flags}
    assert flags.keys() == set(counts)
    for flag, text in flags.items():
        assert text.startswith(f"{counts.count(flag)} figure")
        assert text.endswith(f": {FLAGS[flag]}.")


def test_every_printed_figure_is_there(repo_root: Path) -> None:
    """No row of the real file is lost, and none stands twice."""
    published = load_published(Instance(repo_root))
    page = compose_published(dataclasses.replace(build_material(), published=published))
    cells = [c for s in page.sources for t in s.tables for row in t.rows for c in row.cells if c.printed]
    assert sorted(cell.printed for cell in cells) == sorted(each.printed for each in published)


def test_hostile_text_stays_text() -> None:
    """Whatever a file of published numbers holds is printed, never part of the page."""
    page = page_of(number("Mass", "52.6", source=HOSTILE, system=HOSTILE, note=HOSTILE))
    assert not list(page.iter("img"))
    assert text_of(page).count(HOSTILE) == 3


def test_without_published_numbers_the_page_says_so(tmp_path: Path) -> None:
    """An instance need not have any."""
    assert "There are none here." in text_of(page_of())
    assert load_published(Instance(tmp_path)) == ()
