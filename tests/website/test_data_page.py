"""The page of the data says what is kept, where it comes from, and what is odd about it."""

import dataclasses
from pathlib import Path
from xml.etree.ElementTree import Element

import pytest

from builders import build_reference
from leaderboard.models import Errata, Manifest, Source
from leaderboard.reference import Reference, load_reference
from leaderboard.reference.checking import draw_datasheet
from leaderboard.website import datasheets
from leaderboard.website.datasheets import SIMULATED, compose_data
from leaderboard.website.material import Material
from leaderboard.website.numbers import ABSENT
from reference_folders import ReferenceFolder, trial_name
from site_builders import HOSTILE_NAME, build_material, parse_html, render_files, text_of

TRIAL = trial_name("alpha_one", 0, 0)
HOSTILE_REASON = '<script>alert(1)</script> {{ 7 * 7 }} "quoted" & plain'
SOURCES = (
    Source(
        what="test trials",
        url="https://example.com/a.zip?b=1&c=2",
        member="lists/<b>.csv",
        sha256="a" * 64,
        last_modified="Sat, 21 Nov 2026 10:00:00 GMT",
    ),
    Source(what="people", url="javascript:alert(1)"),
)


def facts_of(reference: Reference) -> dict[str, str]:
    return {fact.title: fact.text for fact in compose_data(build_material(reference, [])).about}


def official(**changes: object) -> Reference:
    reference = build_reference()
    manifest = Manifest(kind="official", files={"Alpha.csv": "b" * 64}, digest="c" * 64, sources=SOURCES)
    benchmark = reference.benchmark.model_copy(update=changes)
    return dataclasses.replace(reference, manifest=manifest, benchmark=benchmark)


def page_of(reference: Reference) -> Element:
    return parse_html(render_files(build_material(reference, []))["data.html"])


def section_of(page: Element, key: str) -> Element:
    return next(section for section in page.iter("section") if section.get("aria-labelledby") == key)


def rows_of(section: Element) -> list[list[str]]:
    return [[text_of(cell) for cell in row] for body in section.iter("tbody") for row in body.iter("tr")]


def test_every_page_leads_to_the_data(files: dict[str, bytes]) -> None:
    """Its link stands in the navigation of every page, and on the page itself it is the current one."""
    for path, content in files.items():
        if path.endswith(".html"):
            links = {text_of(link): link for nav in parse_html(content).iter("nav") for link in nav.iter("a")}
            assert links["Data"].get("aria-current") == ("page" if path == "data.html" else None)


def test_the_datasheet_is_shown_whole(material: Material, files: dict[str, bytes]) -> None:
    """Every assumption has its row, with what was expected and found, and how it fares."""
    shown = rows_of(section_of(parse_html(files["data.html"]), "assumptions"))
    sheet = draw_datasheet(material.reference)
    expected = [row for section in sheet.sections for row in section.rows]
    assert [cells[0] for cells in shown] == [row.assumption for row in expected]
    assert [cells[2] for cells in shown] == [" ".join(row.found.split()) for row in expected]
    assert [cells[3].split()[0] for cells in shown] == [row.status.value for row in expected]


def test_what_people_gave_is_told() -> None:
    """Single responses, counts alone, or nothing: each is told for what it is."""
    single = facts_of(build_reference())
    assert "three columns are kept: participant, trial and answer" in single["People"]
    assert {"Participants", "Why"} <= single.keys()
    counted = facts_of(build_reference(responses=False))
    assert "Counts alone are kept" in counted["People"]
    assert "Participants" not in counted
    assert facts_of(build_reference(n_people=0))["People"] == "There are no human data."


def test_the_licence_is_that_of_the_definition() -> None:
    """An official reference names it; a simulated one says that nobody's data are kept."""
    assert facts_of(official(licence="MIT"))["Licence"] == "The official files are under the licence MIT."
    assert facts_of(official())["Licence"] == "The definition names no licence of the official files."
    assert facts_of(build_reference())["Licence"] == SIMULATED


def test_sources_and_files_have_their_checksums() -> None:
    """Each official file with address, part and checksum; only web addresses are links."""
    page = page_of(official())
    sources = section_of(page, "sources")
    assert rows_of(sources) == [
        [
            "test trials",
            "https://example.com/a.zip?b=1&c=2lists/<b>.csv",
            "a" * 64,
            "Sat, 21 Nov 2026 10:00:00 GMT",
        ],
        ["people", "javascript:alert(1)", ABSENT, ABSENT],
    ]
    assert [link.get("href") for link in sources.iter("a")] == ["https://example.com/a.zip?b=1&c=2"]
    assert text_of(section_of(page, "files")).endswith(f"Alpha.csv{'b' * 64} All together{'c' * 64}")


def test_a_simulated_reference_has_no_source(files: dict[str, bytes]) -> None:
    """Then that is said where the sources would be."""
    assert SIMULATED in text_of(section_of(parse_html(files["data.html"]), "sources"))


def test_errata_are_shown_with_their_reasons(tmp_path: Path) -> None:
    """Dropped trials, accepted findings and findings that are left each have their table."""
    folder = ReferenceFolder()
    folder.rows["Alpha.csv"][3][3] = "0"
    folder.rows["Beta.csv"][1][3] = "0"
    folder.raw["errata.toml"] = (
        f"[[drop]]\ntrial_id = '{TRIAL}'\nreason = '{HOSTILE_REASON}'\n"
        f"[[accept]]\ncode = 'reference-copies'\nwhere = 'beta'\nreason = '{HOSTILE_REASON}'\n"
    ).encode()
    page = page_of(load_reference(folder.write(tmp_path)))
    assert not list(page.iter("script"))
    assert rows_of(section_of(page, "dropped")) == [[TRIAL, HOSTILE_REASON]]
    ((code, message, reason),) = rows_of(section_of(page, "accepted"))
    assert (code, reason) == ("reference-copies", HOSTILE_REASON)
    assert message.endswith("reference/Beta.csv, line 3")
    found = rows_of(section_of(page, "findings"))
    assert [cells[0] for cells in found] == ["reference-copies", "reference-imbalance", "reference-imbalance"]
    assert found[0][1].endswith("reference/Alpha.csv, line 5")


def test_nothing_is_shown_of_errata_that_are_not_there(files: dict[str, bytes]) -> None:
    """No empty tables: no trial is dropped, and nothing is accepted."""
    page = parse_html(files["data.html"])
    assert "No trial is dropped." in text_of(section_of(page, "dropped"))
    assert "accepted" not in [section.get("aria-labelledby") for section in page.iter("section")]


def test_hostile_text_in_the_reference_stays_text() -> None:
    """Whatever stands in the definition, a parser finds it as it was written."""
    page = page_of(official(licence=HOSTILE_NAME))
    assert HOSTILE_NAME in text_of(section_of(page, "kept"))


def test_long_lists_of_findings_are_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    """A page stays readable, and says how many are left out."""
    reference = build_reference()
    same = dataclasses.replace(reference, copies=reference.copies * 0, errata=Errata())
    n_pairs = len(reference.pair_ids)
    monkeypatch.setattr(datasheets, "MAX_FINDINGS", 5)
    page = compose_data(build_material(same, []))
    assert (len(page.findings), page.n_unlisted) == (5, n_pairs - 5)
    assert f"There are {n_pairs - 5} more." in text_of(page_of(same))
