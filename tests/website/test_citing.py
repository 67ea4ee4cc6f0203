"""How a submission is cited, and what the public record says of it."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from builders import build_entry, build_reference
from leaderboard.errors import InstanceError
from leaderboard.ledger import render_ledger
from leaderboard.models.ledger import Event, LedgerLine
from leaderboard.models.metadata import Links
from leaderboard.reference import load_reference
from leaderboard.website.citing import cite_submission
from leaderboard.website.material import Material, gather, load_publications
from site_builders import DAY, HOSTILE_NAME, build_material, parse_html, render_files, text_of, write_instance


def test_a_submission_is_cited_with_what_it_was_graded_against() -> None:
    """Name, team, year, board, and the beginning of the reference's digest; a paper if there is one."""
    reference = build_reference()
    manifest = reference.manifest.model_copy(update={"kind": "official"})
    official = replace(reference, manifest=manifest)
    entry = build_entry(official, "one", [0.7] * official.n_trials, name="One & only", team="Lab")
    links = Links(paper="https://example.com/a?b=%7D")
    metadata = entry.metadata.model_copy(update={"links": links})
    grader = entry.result.grader
    assert cite_submission(replace(entry, metadata=metadata), build_material(official, [entry])) == (
        "@misc{one,\n"
        "  title        = {{One \\& only}},\n"
        "  author       = {{Lab}},\n"
        "  year         = {2026},\n"
        "  howpublished = {Submission one to the Tiny leaderboard},\n"
        f"  note         = {{Reference 000000000000, grader {grader}}},\n"
        "  url          = {https://example.com/a?b=%7D},\n"
        "}"
    )


def test_nothing_that_a_stranger_wrote_ends_a_field(material: Material, files: dict[str, bytes]) -> None:
    """Braces balance whatever stands in a name, and the page shows it as text."""
    for publication in material.publications:
        slug = publication.entry.slug
        citation = cite_submission(publication.entry, material)
        plain = re.sub(r"\\[{}]", "", citation)
        assert plain.count("{") == plain.count("}")
        assert "(synthetic reference)" in citation
        page = parse_html(files[f"submissions/{slug}/index.html"])
        (shown,) = page.iter("pre")
        assert "".join(shown.itertext()) == citation


@pytest.mark.parametrize("text", ["}", "{", "\\", "a}, url = {evil", "%"])
def test_special_letters_are_escaped(text: str) -> None:
    """Each is printed, and none acts."""
    reference = build_reference()
    entry = build_entry(reference, "one", [0.7] * reference.n_trials, name=f"x{text}x")
    lines = cite_submission(entry, build_material(reference, [entry])).splitlines()
    assert len(lines) == 7
    title = re.sub(r"\\text\w+\{\}|\\[{}%&_#$]", "", lines[1])
    assert (title.count("{"), title.count("}")) == (2, 2)
    assert "%" not in title


def test_the_record_of_a_submission_is_on_its_page(tmp_path: Path) -> None:
    """Its own lines of the ledger, oldest first, and no other's."""
    instance = write_instance(tmp_path / "instance")
    record: list[tuple[str, Event, str, str]] = [
        ("good", "added", "new <b>submission</b>", "0"),
        ("part", "added", "another", "1"),
        ("good", "regraded", "new metrics", "2"),
    ]
    lines = [
        LedgerLine(date=DAY, slug=slug, event=event, reason=reason, result_sha256=sha * 64)
        for slug, event, reason, sha in record
    ]
    instance.ledger_file.write_text(render_ledger(lines))
    publications = load_publications(instance, load_reference(instance))
    assert [p.history for p in publications if p.entry.slug == "good"] == [(lines[0], lines[2])]
    files = render_files(gather(load_reference(instance), publications))
    page = parse_html(files["submissions/good/index.html"])
    words = [text_of(div) for div in page.iter("div")]
    assert f"{DAY}added: new <b>submission</b>" in words
    assert f"{DAY}regraded: new metrics" in words
    assert "history" in {element.get("id") for element in page.iter()}
    assert b'id="history"' not in files["submissions/hostile/index.html"]


def test_a_ledger_that_cannot_be_read_stops_the_build(tmp_path: Path) -> None:
    """With its line and what to do."""
    instance = write_instance(tmp_path / "instance")
    instance.ledger_file.write_text("date,slug\n")
    with pytest.raises(InstanceError, match=r"submissions/ledger\.csv") as caught:
        load_publications(instance, load_reference(instance))
    assert caught.value.hint == "see: leaderboard ledger check"


def test_a_hostile_name_is_cited_as_it_is_written(material: Material) -> None:
    """Nothing of it is lost: LaTeX prints the same letters."""
    (entry,) = [p.entry for p in material.publications if p.entry.slug == "hostile"]
    assert "=cmd()" in cite_submission(entry, material)
    assert HOSTILE_NAME.startswith("=cmd()")
