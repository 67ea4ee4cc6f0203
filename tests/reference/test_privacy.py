"""Of people's files nothing is kept but who answered what, and who is nobody that can be found."""

from pathlib import Path

import pytest

from leaderboard.instance import Instance
from leaderboard.reference.importing import FetchOptions, fetch_reference, import_reference
from leaderboard.reference.recipes import RECIPES
from leaderboard.reference.source_files import read_source_files
from leaderboard.report.importing import render_import
from release_server import ReleaseServer
from release_stand_in import Layout, Release, Trap, traps_for

TELLING = (Trap.SERVICE_IDS, Trap.PRIVATE_COLUMNS)


@pytest.mark.parametrize("layout", [Layout.LONG, Layout.BY_PERSON, Layout.BY_TRIAL])
def test_nothing_else_of_people_is_written(layout: Layout, tmp_path: Path) -> None:
    """No id, address, age or comment of the official files is in any file or in the report."""
    traps = [trap for trap in TELLING if trap in traps_for(layout)]
    release = Release(pairs_per_scenario=4, layout=layout, traps=traps)
    test_zip, human_zip = release.write_zips(tmp_path / "upstream")
    instance = Instance(tmp_path / "new")
    with ReleaseServer({"/test_data.zip": test_zip, "/human_data.zip": human_zip}) as server:
        how = FetchOptions(server.address, cache=tmp_path / "cache")
        report = fetch_reference(RECIPES["physionpp"], instance, how=how)
    written = b"\0".join(file.read_bytes() for file in instance.root.rglob("*") if file.is_file()).decode()
    secrets = release.truth.secrets
    assert secrets
    assert {secret for secret in secrets if secret in written + render_import(report)} == set()


def test_files_of_people_hold_three_columns_and_opaque_names(tmp_path: Path) -> None:
    """Participant, trial, response: p and a number, an id of a list, 0 or 1; and counts of these."""
    release = Release(pairs_per_scenario=4, traps=TELLING)
    members = [release.write_folder(tmp_path / "official")]
    instance = Instance(tmp_path / "new")
    recipe = RECIPES["physionpp"]
    import_reference(recipe, read_source_files(members, recipe.is_wanted), instance)
    header, *rows = instance.reference_file("human_responses.csv").read_text().splitlines()
    assert header == "participant_id,trial_id,response"
    assert rows
    for row in rows:
        participant, _, rest = row.partition(",")
        assert participant[0] == "p"
        assert participant[1:].isdigit()
        assert rest[-2:] in {",0", ",1"}
        assert rest[:-2].strip('"') in release.truth.labels
    assert instance.reference_file("human_trials.csv").read_text().startswith("trial_id,n,n_yes\n")
    names = {"benchmark.toml", "human_responses.csv", "human_trials.csv", "manifest.json"}
    lists = {"Mass.csv", "Friction.csv", "Elasticity.csv", "Deformability.csv"}
    assert {file.name for file in instance.reference_dir.iterdir()} == names | lists
