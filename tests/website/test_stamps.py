"""A site that nothing has changed for is not built again, and whatever could change a byte counts."""

from pathlib import Path

import pytest

import leaderboard
from leaderboard.instance import Instance
from leaderboard.website import build_site, building, stamps
from leaderboard.website.replacing import replace_site
from leaderboard.website.stamps import MARKER, digest_inputs, is_current
from site_builders import folder_files, write_instance


@pytest.fixture(scope="module")
def instance(tmp_path_factory: pytest.TempPathFactory) -> Instance:
    return write_instance(tmp_path_factory.mktemp("stamps") / "instance")


def test_a_site_is_not_built_again_without_changes(
    instance: Instance, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The second build reports the same and composes nothing."""
    first = build_site(instance, tmp_path / "site")
    before = folder_files(first.path)

    def refuse(*_: object) -> None:
        raise AssertionError("nothing is to be composed")

    monkeypatch.setattr(building, "compose_pages", refuse)
    second = build_site(instance, tmp_path / "site")
    assert (first.was_current, second.was_current) == (False, True)
    assert (second.path, second.n_pages) == (first.path, first.n_pages)
    assert folder_files(second.path) == before


@pytest.mark.parametrize(
    "file", ["reference/benchmark.toml", "submissions/good/submission.toml", "site/content/about.md"]
)
def test_each_file_of_the_instance_counts(instance: Instance, tmp_path: Path, file: str) -> None:
    """A changed, added or removed byte anywhere gives another digest."""
    out = tmp_path / "site"
    path = instance.root / file
    before, content = digest_inputs(instance, out), path.read_bytes() if path.exists() else None
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes((content or b"") + b"\n")
    changed = digest_inputs(instance, out)
    path.unlink() if content is None else path.write_bytes(content)
    assert changed != before
    assert digest_inputs(instance, out) == before


def test_the_engine_and_what_prints_count(
    instance: Instance, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another template or another version of a library may give other pages."""
    before = digest_inputs(instance, tmp_path)
    monkeypatch.setattr(stamps, "version", lambda name: f"{name}-next")
    assert digest_inputs(instance, tmp_path) != before
    monkeypatch.undo()
    (tmp_path / "engine").mkdir()
    (tmp_path / "engine" / "__init__.py").touch()
    monkeypatch.setattr(leaderboard, "__file__", str(tmp_path / "engine" / "__init__.py"))
    assert digest_inputs(instance, tmp_path) != before


def test_what_was_built_is_no_input(instance: Instance) -> None:
    """Neither site/dist nor the folder that is written to."""
    before = digest_inputs(instance, instance.site_dir / "other")
    build_site(instance)
    build_site(instance, instance.site_dir / "other")
    assert digest_inputs(instance, instance.site_dir / "other") == before


def test_a_link_among_the_inputs_is_not_trusted(tmp_path: Path) -> None:
    """What it leads to could change unseen, so the site is built each time."""
    instance = write_instance(tmp_path / "instance", submissions=False)
    instance.site_dir.mkdir(exist_ok=True)
    (instance.site_dir / "link").symlink_to(tmp_path)
    assert digest_inputs(instance, instance.dist_dir) is None
    build_site(instance)
    assert not build_site(instance).was_current


CONTENTS = {"index.html": b"1", "a/b.html": b"2"}


def test_a_site_is_current_for_its_inputs_alone(tmp_path: Path) -> None:
    """Other inputs, unknown inputs and no site at all ask for a build."""
    replace_site(tmp_path / "site", CONTENTS.items(), "abc")
    assert is_current(tmp_path / "site", "abc")
    assert not is_current(tmp_path / "site", "abd")
    assert not is_current(tmp_path / "site", None)
    assert not is_current(tmp_path / "none", "abc")
    replace_site(tmp_path / "site", CONTENTS.items())
    assert not is_current(tmp_path / "site", None)


@pytest.mark.parametrize("change", ["edited", "added", "removed", "renamed", "linked", "marker"])
def test_a_site_that_somebody_changed_is_not_current(tmp_path: Path, change: str) -> None:
    """A build puts right what was edited by hand."""
    site = tmp_path / "site"
    replace_site(site, CONTENTS.items(), "abc")
    page = site / "a" / "b.html"
    if change == "edited":
        page.write_bytes(b"3")
    elif change == "added":
        (site / "new.html").touch()
    elif change == "removed":
        page.unlink()
    elif change == "renamed":
        page.rename(site / "b.html")
    elif change == "linked":
        page.rename(tmp_path / "b.html")
        page.symlink_to(tmp_path / "b.html")
    else:
        (site / MARKER).write_bytes((site / MARKER).read_bytes() + b"\n")
    assert not is_current(site, "abc")
