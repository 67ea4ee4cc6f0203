"""Badges are pictures, and have the shape that shields.io reads; both say rank and accuracy as the board."""

import json
from dataclasses import replace
from xml.etree.ElementTree import fromstring

import pytest

from builders import build_entry, build_reference
from leaderboard.website.badges import badge_data, compose_badge, list_snippets
from leaderboard.website.material import Material
from site_builders import HOSTILE_NAME, build_material, parse_html, text_of

SVG = "{http://www.w3.org/2000/svg}"


def message_of(slug: str, files: dict[str, bytes]) -> str:
    message = json.loads(files[f"badge/{slug}.json"])["message"]
    assert isinstance(message, str)
    return message


def test_every_submission_has_a_badge(material: Material, files: dict[str, bytes]) -> None:
    """In exactly the shape of an endpoint, and none of them with a stranger's text in it."""
    badges = {path for path in files if path.startswith("badge/") and path.endswith(".json")}
    assert badges == {f"badge/{p.entry.slug}.json" for p in material.publications}
    for path in badges:
        badge = json.loads(files[path])
        assert list(badge) == ["schemaVersion", "label", "message", "color"]
        assert (badge["schemaVersion"], badge["label"], badge["color"]) == (1, "Tiny (synthetic)", "yellow")
        assert HOSTILE_NAME not in files[path].decode()


def test_a_badge_says_rank_and_accuracy_as_the_board_does(
    material: Material, files: dict[str, bytes]
) -> None:
    """The rank of its track, and percent with one decimal."""
    for board in material.boards:
        for row in board.ranked:
            score = row.entry.score("accuracy")
            assert score is not None
            assert score.value is not None
            wanted = f"rank {row.rank}, {100 * score.value:.1f} %"
            assert message_of(row.entry.slug, files) == wanted


@pytest.mark.parametrize(
    ("slug", "message"),
    [
        ("flat", "baseline, 50.0 %"),
        ("oracle", "baseline, 100.0 %"),
        ("part", "partial"),
        ("sliver", "partial"),
    ],
)
def test_without_a_rank_a_badge_says_what_it_is(slug: str, message: str, files: dict[str, bytes]) -> None:
    """Baselines have an accuracy, partial submissions have none overall."""
    assert message_of(slug, files) == message


def test_a_submission_on_no_board_has_no_rank(files: dict[str, bytes]) -> None:
    """Its accuracy is told all the same."""
    assert message_of("nowhere", files).startswith("not ranked, ")


def test_colours_tell_ranked_from_others() -> None:
    """Of an official reference; a simulated one has its own colour and says so."""
    reference = build_reference()
    manifest = reference.manifest.model_copy(update={"kind": "official"})
    official = replace(reference, manifest=manifest)
    entries = [
        build_entry(official, "ranked", [0.6] * official.n_trials),
        build_entry(official, "rule", [0.5] * official.n_trials, family="baseline"),
    ]
    material = build_material(official, entries)
    badges = [badge_data(entry, material) for entry in entries]
    assert [(badge["label"], badge["color"]) for badge in badges] == [("Tiny", "blue"), ("Tiny", "lightgrey")]


def test_the_page_of_a_submission_offers_its_badge(material: Material, files: dict[str, bytes]) -> None:
    """Its words, both files as links, and what shows it elsewhere as text, which loads nothing."""
    page = parse_html(files["submissions/good/index.html"])
    assert {"../../badge/good.json", "../../badge/good.svg"} <= {link.get("href") for link in page.iter("a")}
    (shown,) = [p for p in page.iter("p") if p.get("class") == "badge-picture"]
    assert text_of(shown) == "Tiny (synthetic) rank 1, 100.0 %"
    (entry,) = [p.entry for p in material.publications if p.entry.slug == "good"]
    snippets = {fact.title: fact.text for fact in list_snippets(entry, material)}
    site = "ADDRESS-OF-THIS-SITE"
    target = f"{site}/submissions/good/index.html"
    assert snippets == {
        "Markdown": f"[![Tiny]({site}/badge/good.svg)]({target})",
        "HTML": f'<a href="{target}"><img src="{site}/badge/good.svg" alt="Tiny"></a>',
        "shields.io": f"![Tiny](https://img.shields.io/endpoint?url={site}/badge/good.json)",
    }
    assert set(snippets.values()) <= {text_of(code) for code in page.iter("code")}


def test_the_picture_says_what_the_data_say(material: Material, files: dict[str, bytes]) -> None:
    """Sound XML that loads and runs nothing, with both fields as text and as wide as both together."""
    for publication in material.publications:
        entry = publication.entry
        picture = fromstring(files[f"badge/{entry.slug}.svg"])  # noqa: S314 - our own badge
        data, badge = badge_data(entry, material), compose_badge(entry, material)
        assert [text.text for text in picture.iter(f"{SVG}text")] == [data["label"], data["message"]]
        assert picture.get("aria-label") == f"{data['label']}: {data['message']}"
        assert float(picture.get("width", "")) == badge.label_width + badge.message_width
        assert {element.tag.removeprefix(SVG) for element in picture.iter()} == {
            *("svg", "title", "rect", "path", "g", "text")
        }
