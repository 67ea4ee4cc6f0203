"""`reference import` and `reference fetch`: from a maintainer's command line to a sealed reference."""

from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

from leaderboard.instance import Instance
from leaderboard.reference import load_reference
from release_server import ReleaseServer
from release_stand_in import Release, Trap

Run = Callable[..., Result]
SMALL = Release(pairs_per_scenario=4)


def test_import_replaces_the_simulated_reference(root: Path, run: Run, tmp_path: Path) -> None:
    """The official files take its place, everything odd is told, and published numbers stay."""
    published = Instance(root).reference_file("published.csv").read_bytes()
    test_zip, human_zip = SMALL.write_zips(tmp_path / "official")
    output = run("reference", "import", "physionpp", "--from", test_zip, "--from", human_zip).output
    assert "Physion++: 80 trials, 80 of them judged by people\n" in output
    assert f"sealed as official in {root}, digest " in output
    reference = load_reference(Instance(root))
    assert reference.manifest.kind == "official"
    assert Instance(root).reference_file("published.csv").read_bytes() == published


def test_a_second_import_has_nothing_to_do(root: Path, run: Run, tmp_path: Path) -> None:
    """The same files again are no failure; other files are, until the change is accepted."""
    arguments = ("reference", "import", "physionpp", "--from", SMALL.write_folder(tmp_path / "official"))
    run(*arguments)
    assert f"nothing to write: {root} has this reference already\n" in run(*arguments).output
    changed = Release(pairs_per_scenario=4, traps=[Trap.SAME_LABEL_PAIRS]).write_folder(tmp_path / "later")
    refused = run("reference", "import", "physionpp", "--from", changed, exit_code=1).output
    assert "trials end otherwise: " in refused
    assert refused.endswith("nothing was written; if the change is meant, add --accept-change\n")
    run("reference", "import", "physionpp", "--from", changed, "--accept-change")


def test_columns_can_be_named(run: Run, tmp_path: Path) -> None:
    """What the importer would have found itself may be said, and what is not there is an error."""
    arguments = ("reference", "import", "physionpp", "--from", SMALL.write_folder(tmp_path / "official"))
    named = "participant=gameID,trial=stim_ID,response=response"
    assert "participant from gameID" in run(*arguments, "--columns", named).output
    missing = run(*arguments, "--columns", "participant=nobody", "--accept-change", exit_code=1).output
    assert "import-columns" in missing


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ("person=gameID", "'person' is none of participant, trial, response"),
        ("trial", "write it as participant=COLUMN,trial=COLUMN,response=COLUMN"),
        ("trial=a,trial=b", "write it as participant=COLUMN,trial=COLUMN,response=COLUMN"),
    ],
)
def test_malformed_columns_are_wrong_usage(run: Run, tmp_path: Path, columns: str, message: str) -> None:
    """A mistake in the option is told before anything is read."""
    arguments = ("reference", "import", "physionpp", "--from", tmp_path, "--columns", columns)
    assert message in run(*arguments, exit_code=2).output


def test_fetch_takes_the_recipe_of_the_instance(
    root: Path, run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where the benchmark is known, the command alone is enough; here it asks a mirror on this machine."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    test_zip, human_zip = SMALL.write_zips(tmp_path / "upstream")
    with ReleaseServer({"/test_data.zip": test_zip, "/human_data.zip": human_zip}) as server:
        output = run("reference", "fetch", "--mirror", server.address).output
    assert "sealed as official" in output
    assert load_reference(Instance(root)).manifest.sources[0].etag


def test_what_is_no_release_is_refused(root: Path, run: Run, tmp_path: Path) -> None:
    """A folder without official files leaves everything as it was."""
    before = Instance(root).manifest_file.read_bytes()
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "notes.txt").write_text("x")
    output = run("reference", "import", "physionpp", "--from", tmp_path / "other", exit_code=1).output
    assert "holds no official file; among its files are 'notes.txt'" in output
    assert Instance(root).manifest_file.read_bytes() == before
