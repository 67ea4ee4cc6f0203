"""The news feed: valid Atom, the same for the same board."""

import datetime as dt
from xml.etree import ElementTree as ET

import numpy as np

from builders import build_entry, build_reference
from leaderboard.website.feeds import compose_feed
from leaderboard.website.material import Material
from leaderboard.website.numbers import EN_DASH
from leaderboard.website.rendering import render_feed
from site_builders import HOSTILE_NAME, HOSTILE_TEXT, build_material, render_files

ATOM = "{http://www.w3.org/2005/Atom}"


def parse_feed(content: bytes) -> ET.Element:
    return ET.fromstring(content)  # noqa: S314 - our own output


def test_the_feed_has_an_item_per_submission_and_none_for_baselines(files: dict[str, bytes]) -> None:
    """Everything that competes is news."""
    feed = parse_feed(files["feed.xml"])
    links = [link.get("href", "") for item in feed.iter(f"{ATOM}entry") for link in item.iter(f"{ATOM}link")]
    slugs = [link.split("/")[1] for link in links]
    assert slugs == ["good", "good-too", "hostile", "nowhere", "other-track", "part", "sliver"]
    assert all(link in files for link in links)


def test_the_feed_has_what_atom_requires(files: dict[str, bytes]) -> None:
    """Feed and items have an id, a title and a time; items have an author; ids differ."""
    feed = parse_feed(files["feed.xml"])
    parts = [feed, *feed.iter(f"{ATOM}entry")]
    for part in parts:
        assert all(part.findtext(f"{ATOM}{name}") for name in ("id", "title", "updated"))
    assert all(item.findtext(f"{ATOM}author/{ATOM}name") for item in parts[1:])
    ids = [part.findtext(f"{ATOM}id") or "" for part in parts]
    assert len(set(ids)) == len(ids)
    assert all(name.startswith("urn:uuid:") for name in ids)


def test_hostile_text_stays_text(files: dict[str, bytes]) -> None:
    """Names and descriptions come out of an XML parser as they went in."""
    (item,) = [
        item
        for item in parse_feed(files["feed.xml"]).iter(f"{ATOM}entry")
        if item.findtext(f"{ATOM}title") == HOSTILE_NAME
    ]
    assert HOSTILE_TEXT in (item.findtext(f"{ATOM}summary") or "")
    assert [child.tag for child in item if child.tag.endswith("script")] == []


def test_accuracy_comes_with_its_interval() -> None:
    """Also news say how sure a number is."""
    reference = build_reference()
    entry = build_entry(reference, "one", np.where(reference.labels == 1, 0.9, 0.4).tolist())
    partial = build_entry(reference, "two", [0.6] * 24, covered=(reference.properties == 1).tolist())
    feed = compose_feed(build_material(reference, [entry, partial]))
    summaries = {item.slug: item.summary for item in feed.entries}
    assert summaries["one"] == f"Accuracy 100.0 % (100.0{EN_DASH}100.0). A test."
    assert summaries["two"] == "(partial) A test."


def test_newest_first_and_no_clock() -> None:
    """Times are the submissions' own dates, at midnight UTC; the feed is as new as its newest item."""
    reference = build_reference()
    entries = [
        build_entry(reference, f"day-{day}", [0.6] * reference.n_trials, date=dt.date(2026, 5, day))
        for day in (1, 3, 2)
    ]
    feed = compose_feed(build_material(reference, entries))
    assert [item.slug for item in feed.entries] == ["day-3", "day-2", "day-1"]
    assert feed.updated == feed.entries[0].updated == "2026-05-03T00:00:00Z"


def test_titles_say_that_the_reference_is_synthetic(material: Material) -> None:
    """A feed reader shows no banner, so the feed's title carries it."""
    assert compose_feed(material).title == "Tiny leaderboard (synthetic)"


def test_an_empty_feed_is_valid() -> None:
    """There is a time even where there is no news."""
    feed = parse_feed(render_files(build_material(entries=[]))["feed.xml"])
    assert feed.findtext(f"{ATOM}updated") == "1970-01-01T00:00:00Z"
    assert render_feed(compose_feed(build_material(entries=[]))).startswith(b"<?xml")
