"""Versions of a file on a server, and what has changed since they were locked."""

import pytest

from leaderboard.models import Source
from leaderboard.reference.fetching import SourceChange, compare_sources
from leaderboard.reference.fetching.upstream import Upstream

URL = "https://example.com/test_data.zip"


def make_source(member: str = "Mass.csv", digit: str = "1", **other: str) -> Source:
    return Source(what="lists", url=URL, member=member, sha256=digit * 64, **other)


def test_nothing_changed() -> None:
    """Equal sources are no change, in whatever order and under whatever description."""
    locked = (make_source("a"), make_source("b"))
    found = [source.model_copy(update={"what": "files"}) for source in reversed(locked)]
    assert compare_sources(locked, found) == ()


def test_every_kind_of_change() -> None:
    """Each file that differs is listed once, by URL and member, with what it was and is."""
    locked = (
        make_source("gone"),
        make_source("other"),
        make_source("renamed", etag='"1"'),
        make_source("same"),
    )
    found = (
        make_source("same"),
        make_source("renamed", etag='"2"'),
        make_source("other", "2"),
        make_source("new"),
    )
    changes = compare_sources(locked, found)
    assert changes == (
        SourceChange("removed", locked[0], None),
        SourceChange("added", None, found[3]),
        SourceChange("content", locked[1], found[2]),
        SourceChange("validators", locked[2], found[1]),
    )
    assert [change.is_content for change in changes] == [True, True, True, False]


def test_a_date_alone() -> None:
    """Another Last-Modified with the same bytes is no change of content."""
    (change,) = compare_sources([make_source(last_modified="Monday")], [make_source(last_modified="Tuesday")])
    assert change.kind == "validators"


def test_what_was_not_locked() -> None:
    """A source without checksum locks nothing: its members are taken as they are on first use."""
    open_source = Source(what="lists", url=URL)
    assert compare_sources([open_source], [make_source("a"), make_source("b")]) == ()
    assert compare_sources([open_source], []) == ()
    elsewhere = make_source("a").model_copy(update={"url": "https://example.com/other.zip"})
    assert [change.kind for change in compare_sources([open_source], [elsewhere])] == ["added"]


@pytest.mark.parametrize(
    ("other", "is_same"),
    [
        ({}, True),
        ({"last_modified": "Tuesday"}, True),
        ({"last_modified": ""}, True),
        ({"size": None}, True),
        ({"etag": '"2"'}, False),
        ({"etag": ""}, False),
        ({"size": 2}, False),
    ],
)
def test_same_version(other: dict[str, object], is_same: bool) -> None:
    """An ETag decides, whatever the date says; sizes must not differ."""
    version = Upstream(etag='"1"', last_modified="Monday", size=1)
    changed = version.model_copy(update=other)
    assert version.is_same(changed) is changed.is_same(version) is is_same


def test_same_version_without_etag() -> None:
    """Then the date decides, unless it is left out."""
    version = Upstream(last_modified="Monday", size=1)
    assert not version.is_same(Upstream(last_modified="Tuesday", size=1))
    assert version.is_same(Upstream(size=1))


def test_conditions() -> None:
    """A strong ETag is best; by a weak one, which promises no equal bytes, no part is asked for."""
    strong = Upstream(etag='"1"', last_modified="Monday")
    assert (strong.part_condition, strong.change_conditions) == ('"1"', {"If-None-Match": '"1"'})
    weak = Upstream(etag='W/"1"', last_modified="Monday")
    assert (weak.part_condition, weak.change_conditions) == ("Monday", {"If-None-Match": 'W/"1"'})
    dated = Upstream(last_modified="Monday")
    assert (dated.part_condition, dated.change_conditions) == ("Monday", {"If-Modified-Since": "Monday"})
    assert (Upstream().part_condition, Upstream().change_conditions) == ("", {})


@pytest.mark.parametrize("etag", ['"\x1b[2J"', '"' + "1" * 300 + '"'])
def test_outlandish_headers(etag: str) -> None:
    """What is not fit to be written down is taken for absent."""
    assert Upstream.parse({"ETag": etag}, 1) == Upstream(size=1)
