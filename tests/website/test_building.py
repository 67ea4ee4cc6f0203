"""From an instance on disk to a website on disk."""

import fcntl
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from leaderboard.errors import BrokenReferenceError, InstanceError
from leaderboard.instance import Instance
from leaderboard.reference import load_reference
from leaderboard.website import build_site, building
from leaderboard.website.figure_pages import PeoplePage
from leaderboard.website.material import Material, gather, load_publications
from site_builders import folder_files, html_files, render_files, write_instance


@pytest.fixture
def instance(tmp_path: Path) -> Instance:
    return write_instance(tmp_path / "instance")


def test_the_site_goes_where_it_is_told(instance: Instance, tmp_path: Path) -> None:
    """Into site/dist without a word, else into the folder given; the report counts the pages."""
    report = build_site(instance)
    assert report.path == instance.dist_dir
    pages = [path for path in folder_files(report.path) if path.endswith(".html")]
    assert report.n_pages == len(pages) == 50
    elsewhere = build_site(instance, tmp_path / "elsewhere")
    assert folder_files(elsewhere.path) == folder_files(report.path)


def test_the_site_has_the_files_that_others_rely_on(instance: Instance) -> None:
    """Names of the contract: index, api, table, feed, and what a static host looks for."""
    files = folder_files(build_site(instance).path)
    assert {
        "index.html",
        "404.html",
        ".nojekyll",
        "method.html",
        "data.html",
        "tracks/without/index.html",
        "submissions/good/index.html",
        "api/leaderboard.json",
        "api/reference.json",
        "api/submissions/good.json",
        "badge/good.json",
        "about.html",
        "leaderboard.csv",
        "feed.xml",
    } <= files.keys()


def test_downloads_are_the_very_files_that_were_graded(instance: Instance) -> None:
    """Byte for byte; the result is part of the file for programs, and nothing else leaves the folder."""
    files = folder_files(build_site(instance).path)
    for folder in instance.submission_dirs():
        own = folder_files(folder)
        result = json.loads(own.pop("result.json"))
        assert json.loads(files[f"api/submissions/{folder.name}.json"])["result"] == result
        offered = {
            path.rpartition("/")[2]: content
            for path, content in files.items()
            if path.startswith(f"submissions/{folder.name}/")
            and "/figures/" not in path
            and not path.endswith(".html")
        }
        assert offered == own


def test_the_same_inputs_give_the_same_bytes(instance: Instance, tmp_path: Path) -> None:
    """Built twice, in another process with another hash seed, and with the folders made in another order."""
    first = folder_files(build_site(instance, tmp_path / "first").path)
    shuffled = tmp_path / "shuffled"
    for path, content in sorted(folder_files(instance.root).items(), reverse=True):
        (shuffled / path).parent.mkdir(parents=True, exist_ok=True)
        (shuffled / path).write_bytes(content)
    code = (
        "import sys; from pathlib import Path; from leaderboard.instance import Instance;"
        "from leaderboard.website import build_site;"
        "build_site(Instance(Path(sys.argv[1])), Path(sys.argv[2]))"
    )
    subprocess.run(
        [sys.executable, "-c", code, shuffled, tmp_path / "second"],
        env=os.environ | {"PYTHONHASHSEED": "77", "TZ": "Pacific/Auckland", "LC_ALL": "C"},
        check=True,
    )
    assert folder_files(tmp_path / "second") == first


def test_the_footer_names_the_commit_where_it_is_told(instance: Instance, tmp_path: Path) -> None:
    """Twelve digits on every page, and another commit is another site; without one nothing is made up."""
    first = build_site(instance, tmp_path / "site", commit="0123456789abcdef" * 2)
    line = b"<dt>Commit</dt><dd><code>0123456789ab</code></dd>"
    assert all(
        line in content for path, content in folder_files(first.path).items() if path.endswith(".html")
    )
    second = build_site(instance, tmp_path / "site")
    assert not second.was_current
    assert b"<dt>Commit</dt>" not in (second.path / "index.html").read_bytes()


def test_the_order_of_submissions_does_not_matter(material: Material) -> None:
    """Whoever is read first, the pages are the same."""
    backwards = gather(material.reference, material.publications[::-1])
    assert render_files(backwards) == render_files(material)


def test_a_submission_that_is_not_graded_stops_the_build(instance: Instance) -> None:
    """Nothing is published that was not checked; the earlier site stays."""
    before = folder_files(build_site(instance).path)
    (instance.submission_dir("good") / "result.json").unlink()
    with pytest.raises(InstanceError, match=r"submissions/good/result\.json is missing"):
        build_site(instance)
    assert folder_files(instance.dist_dir) == before


def test_a_stale_result_stops_the_build(instance: Instance) -> None:
    """A result of other predictions is refused by the name of the submission and with what to do."""
    predictions = instance.submission_dir("good") / "predictions.csv"
    predictions.write_bytes(predictions.read_bytes().replace(b"0.7", b"0.6"))
    with pytest.raises(
        InstanceError, match=r"submissions/good: result\.json was made from other predictions"
    ) as caught:
        build_site(instance)
    assert "leaderboard grade submissions/good" in caught.value.hint


def test_a_folder_whose_name_is_no_slug_stops_the_build(instance: Instance) -> None:
    """Names become addresses, so only slugs are published."""
    instance.submission_dir("good").rename(instance.submission_dir("Good <b>"))
    with pytest.raises(
        InstanceError, match="submissions/Good <b> cannot be published under this name"
    ) as caught:
        load_publications(instance, load_reference(instance))
    assert caught.value.hint.startswith("a slug is 3 to 64 of a-z")


def test_a_broken_reference_stops_the_build(instance: Instance) -> None:
    """Without the sealed reference there is nothing to compare with."""
    trials = instance.reference_file("Alpha.csv")
    trials.write_bytes(trials.read_bytes().replace(b",90", b",91"))
    with pytest.raises(BrokenReferenceError, match=r"Alpha\.csv"):
        build_site(instance)


def test_a_failure_half_way_keeps_the_earlier_site(
    instance: Instance, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Pages are written as they are composed, but not into the site; nothing else stays either."""

    def fail(_: Material) -> PeoplePage:
        raise InstanceError("nothing is left")

    before = folder_files(build_site(instance).path)
    monkeypatch.setattr(building, "compose_people", fail)
    with pytest.raises(InstanceError, match="nothing is left"):
        build_site(instance, commit="0" * 40)
    assert folder_files(instance.site_dir) == {f"dist/{path}": content for path, content in before.items()}


def test_two_builds_at_once_do_not_meet(instance: Instance) -> None:
    """The second waits for the first, and finds that nothing is left to do."""
    with ThreadPoolExecutor(2) as pool:
        reports = list(pool.map(build_site, [instance, instance]))
    assert sorted(report.was_current for report in reports) == [False, True]
    assert {report.n_pages for report in reports} == {50}


def test_leftovers_are_looked_for_while_nobody_else_builds(
    instance: Instance, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A folder that was just made has no lock yet, and would be taken for a leftover."""

    def look(folder: Path) -> None:
        descriptor = os.open(folder.parent, os.O_RDONLY)
        with pytest.raises(BlockingIOError):
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        os.close(descriptor)

    monkeypatch.setattr(building, "remove_leftovers", look)
    assert build_site(instance).path == instance.dist_dir


def test_a_foreign_folder_is_refused_before_any_work(instance: Instance, tmp_path: Path) -> None:
    """What lies in the chosen folder stays."""
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("mine")
    with pytest.raises(InstanceError, match="is not empty and not an earlier site"):
        build_site(instance, tmp_path / "mine")
    assert folder_files(tmp_path / "mine") == {"notes.txt": b"mine"}


def test_an_instance_without_submissions_has_a_site(tmp_path: Path) -> None:
    """One board with people on it, a method, and empty lists; every page is sound HTML."""
    report = build_site(write_instance(tmp_path / "empty", submissions=False))
    files = folder_files(report.path)
    assert report.n_pages == len(list(html_files(files))) == 32
    assert json.loads(files["api/leaderboard.json"])["tracks"][0]["rows"] == []


def test_pages_of_a_real_folder_are_sound_html(instance: Instance) -> None:
    """Hostile metadata came through files this time, and the strict parser still accepts every page."""
    assert len(list(html_files(folder_files(build_site(instance).path)))) == 50
