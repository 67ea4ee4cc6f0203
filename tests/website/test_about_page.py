"""What maintainers say of their benchmark, as plain text, beside what the engine knows."""

from dataclasses import replace
from pathlib import Path

import pytest

from builders import build_reference
from leaderboard.errors import InstanceError
from leaderboard.instance import Instance
from leaderboard.website import build_site
from leaderboard.website.about_pages import compose_about
from leaderboard.website.material import Material
from leaderboard.website.texts import MAX_BYTES, NO_TEXTS, Texts, load_texts
from site_builders import build_material, parse_html, render_files, text_of, write_instance


def write_text(root: Path, name: str, content: bytes) -> Instance:
    file = Instance(root).content_file(name)
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(content)
    return Instance(root)


def test_paragraphs_are_parted_by_empty_lines(tmp_path: Path) -> None:
    """Lines of one paragraph are joined, whatever ends them; BibTeX keeps its lines."""
    write_text(tmp_path, "about.md", b"First\r\nline.\r\n\r\n\r\n\r\nSecond *one*.\n")
    instance = write_text(tmp_path, "citation.bib", b"@misc{a,\n  title = {B},\n}\n")
    texts = Texts(("First line.", "Second *one*."), "@misc{a,\n  title = {B},\n}")
    assert load_texts(instance) == texts


def test_without_texts_there_are_none(tmp_path: Path, material: Material) -> None:
    """The page is there all the same, without a heading of a citation."""
    assert load_texts(Instance(tmp_path)) == NO_TEXTS
    assert [text_of(h2) for h2 in parse_html(render_files(material)["about.html"]).iter("h2")] == []


def test_texts_stay_text(tmp_path: Path) -> None:
    """What looks like markup is shown as it was written, line by line in the citation."""
    instance = write_instance(tmp_path / "instance", submissions=False)
    write_text(instance.root, "about.md", b"<script>alert(1)</script> & {{ 1 }}\n\n# not a heading")
    write_text(instance.root, "citation.bib", b"@misc{a,\n  note = {</code><img src=x>},\n}")
    page = parse_html((build_site(instance).path / "about.html").read_bytes())
    paragraphs = [text_of(paragraph) for paragraph in page.iter("p")]
    assert {"<script>alert(1)</script> & {{ 1 }}", "# not a heading"} <= {*paragraphs}
    (citation,) = page.iter("pre")
    assert "".join(citation.itertext()) == "@misc{a,\n  note = {</code><img src=x>},\n}"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"\xff", r"site/content/about\.md cannot be read"),
        (b"a" * (MAX_BYTES + 1), r"site/content/about\.md is too large"),
    ],
)
def test_a_text_that_cannot_be_shown_stops_the_build(tmp_path: Path, content: bytes, message: str) -> None:
    """With its name and what would be right."""
    with pytest.raises(InstanceError, match=message):
        load_texts(write_text(tmp_path, "about.md", content))


def test_it_says_what_is_simulated_and_the_licence(material: Material) -> None:
    """Of a simulated reference what is simulated; the licence where the benchmark names one."""
    titles = [fact.title for fact in compose_about(material).facts]
    assert titles == ["Simulated", "Contact"]
    reference = build_reference()
    licensed = replace(
        reference,
        benchmark=reference.benchmark.model_copy(update={"licence": "MIT"}),
        manifest=reference.manifest.model_copy(update={"kind": "official"}),
    )
    facts = compose_about(build_material(licensed, [])).facts
    assert facts[0].text == "The official files of the benchmark are under the licence MIT."
    assert [fact.title for fact in facts] == ["Licence", "Contact"]
