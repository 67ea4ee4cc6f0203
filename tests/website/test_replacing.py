"""A site takes the place of an older one as a whole, and of nothing else."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from leaderboard.errors import InstanceError
from leaderboard.website import replacing
from leaderboard.website.replacing import replace_site
from leaderboard.website.stamps import MARKER
from site_builders import folder_files


def test_a_site_is_written_with_its_folders(tmp_path: Path) -> None:
    """Folders on the way are made, and the marker says whose folder it is."""
    out = tmp_path / "deep" / "site"
    replace_site(out, [("index.html", b"1"), ("a/b.html", b"2")])
    assert folder_files(out).keys() == {MARKER, "index.html", "a/b.html"}


def test_an_earlier_site_is_replaced_as_a_whole(tmp_path: Path) -> None:
    """Pages that are no more are gone, and nothing temporary stays."""
    out = tmp_path / "site"
    replace_site(out, [("old.html", b"1")])
    replace_site(out, [("new.html", b"2")])
    assert folder_files(out).keys() == {MARKER, "new.html"}
    assert list(tmp_path.iterdir()) == [out]


def test_an_empty_folder_is_filled(tmp_path: Path) -> None:
    """An empty folder holds nothing that could be lost."""
    replace_site(tmp_path / "site", [("a.html", b"1")])
    out = tmp_path / "empty"
    out.mkdir()
    replace_site(out, [("a.html", b"1")])
    assert (out / "a.html").is_file()


def test_a_folder_with_other_content_is_left_alone(tmp_path: Path) -> None:
    """Somebody's files are never deleted; the message says what to do."""
    precious = tmp_path / "thesis.tex"
    precious.write_text("all of it")
    with pytest.raises(
        InstanceError, match="is not empty and not an earlier site, so it is not replaced"
    ) as caught:
        replace_site(tmp_path, [("index.html", b"1")])
    assert caught.value.hint == "choose a new or empty folder with --out, or remove this one yourself"
    assert folder_files(tmp_path) == {"thesis.tex": b"all of it"}


def test_a_file_in_the_way_is_left_alone(tmp_path: Path) -> None:
    """A file is not a folder to be replaced."""
    out = tmp_path / "site"
    out.write_text("a file")
    with pytest.raises(InstanceError, match=r"site is not a folder$"):
        replace_site(out, [("index.html", b"1")])
    assert out.read_text() == "a file"


def test_a_failure_leaves_the_earlier_site(tmp_path: Path) -> None:
    """If a page cannot be rendered, readers keep what they had."""

    def failing() -> Iterator[tuple[str, bytes]]:
        yield "index.html", b"half"
        raise RuntimeError("no more")

    out = tmp_path / "site"
    replace_site(out, [("index.html", b"whole")])
    with pytest.raises(RuntimeError, match="no more"):
        replace_site(out, failing())
    assert folder_files(out)["index.html"] == b"whole"
    assert list(tmp_path.iterdir()) == [out]


def test_a_failed_swap_keeps_the_earlier_site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The two folders trade places in one step; if that fails, the old one has its name."""
    out = tmp_path / "site"
    replace_site(out, [("index.html", b"old")])

    def refuse(first: Path, second: Path) -> None:
        assert (first, second.name) == (out, "fresh")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(replacing, "exchange_folders", refuse)
    with pytest.raises(InstanceError, match=r"cannot write the site to .*: No space left on device"):
        replace_site(out, [("index.html", b"new")])
    assert folder_files(out)["index.html"] == b"old"
    assert list(tmp_path.iterdir()) == [out]


def test_there_is_a_site_at_every_moment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No rename takes the earlier site away before the new one is there: a kill leaves one of them."""
    out = tmp_path / "site"
    replace_site(out, [("index.html", b"old")])

    def forbid(self: Path, target: Path) -> Path:
        raise AssertionError(f"{self} is moved to {target}")

    monkeypatch.setattr(Path, "rename", forbid)
    replace_site(out, [("index.html", b"new")])
    assert folder_files(out)["index.html"] == b"new"


def test_a_link_to_a_folder_is_followed(tmp_path: Path) -> None:
    """The link stays a link; the folder behind it is replaced."""
    target, link = tmp_path / "target", tmp_path / "link"
    replace_site(target, [("old.html", b"1")])
    link.symlink_to(target)
    replace_site(link, [("new.html", b"2")])
    assert link.is_symlink()
    assert folder_files(target).keys() == {MARKER, "new.html"}


def test_a_place_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    """The message says where the site was to go."""
    (tmp_path / "file").write_text("")
    with pytest.raises(InstanceError, match=r"cannot write the site to .*file/site: "):
        replace_site(tmp_path / "file" / "site", [("index.html", b"1")])
