"""Names in other people's files, and the trials that they mean."""

import csv
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.trial_names import Ambiguous, Resolved, TrialNames, Unknown

TRIAL = "pilot_it2_drop_all_bowls_box_0001"


@pytest.mark.parametrize(
    "name",
    [
        TRIAL,
        f"{TRIAL}_img",
        f"{TRIAL}_map",
        f"{TRIAL}.hdf5",
        f"{TRIAL}_img.mp4",
        f"{TRIAL}_map.png",
        "pilot_it2_drop_all_bowls_box-redyellow_0001",
        "pilot_it2_drop_all_bowls_box-redyellow_0001_img.mp4",
        f"{TRIAL}-redyellow",
        f"{TRIAL}-redyellow_img",
        f"some/folder/{TRIAL}.hdf5",
        f"https://example.com/{TRIAL}_img.mp4",
    ],
)
def test_known_decorations_are_seen_through(name: str) -> None:
    """A name with any decoration of the official files means the trial without it."""
    names = TrialNames([TRIAL, "pilot_it2_drop_all_bowls_box_0002"])
    assert names.resolve(name) == Resolved(TRIAL)


@pytest.mark.parametrize(
    "name",
    [
        TRIAL.upper(),
        f"{TRIAL}_IMG",
        f"{TRIAL}.MP4",
        f"{TRIAL} ",
        f"{TRIAL}_0001",
        f"{TRIAL}_img_img",
        f"{TRIAL}.avi",
        TRIAL.replace("_0001", "_1"),
        "pilot-redyellow_it2_drop_all_bowls_box_0001",
        TRIAL.removeprefix("pilot_"),
        f"{TRIAL}/other",
        "",
        "/",
    ],
)
def test_nothing_else_is_forgiven(name: str) -> None:
    """Other letters' case, blanks, numbers written differently and unknown decorations fit no trial."""
    names = TrialNames([TRIAL])
    assert names.resolve(name) == Unknown(name, [])


def test_name_of_two_trials_names_both() -> None:
    """A name whose normal form two ids share is ambiguous, and each id still means itself."""
    plain, recoloured = "ramp_0001", "ramp-redyellow_0001"
    names = TrialNames([plain, recoloured])
    assert names.resolve("ramp_0001_img.mp4") == Ambiguous("ramp_0001_img.mp4", (recoloured, plain))
    assert names.resolve(plain) == Resolved(plain)
    assert names.resolve(recoloured) == Resolved(recoloured)


def test_paths_are_compared_from_their_end() -> None:
    """Ids with folders in them match a full path by as many last parts as they have, and never fewer."""
    trial = "wall_pp-copy0/target=bowl-tscale=0.3,0.5/0007"
    names = TrialNames([trial, trial.replace("copy0", "copy1")])
    assert names.resolve(f"/data/test/{trial}_img.mp4") == Resolved(trial)
    assert isinstance(names.resolve("target=bowl-tscale=0.3,0.5/0007_img.mp4"), Unknown)


def test_ids_of_different_depth_can_clash() -> None:
    """A path that fits a short id and a long one at once is ambiguous."""
    names = TrialNames(["0001", "ramp/0001"])
    assert names.resolve("videos/ramp/0001.mp4") == Ambiguous("videos/ramp/0001.mp4", ("0001", "ramp/0001"))


def test_unknown_name_offers_the_nearest_trial() -> None:
    """A mistyped name knows the id that it resembles most; one that resembles none offers none."""
    names = TrialNames([TRIAL, "pilot-containment-bowl_0001"])
    mistyped = names.resolve("pilot-contanment-bowl-redyellow_0001_img.mp4")
    assert isinstance(mistyped, Unknown)
    assert mistyped.nearest == "pilot-containment-bowl_0001"
    strange = names.resolve("???")
    assert isinstance(strange, Unknown)
    assert strange.nearest is None


def test_unknown_shows_itself_briefly() -> None:
    """The thousand known ids do not appear when an unknown name is printed."""
    assert repr(TrialNames([TRIAL]).resolve("x")) == "Unknown(name='x')"


@given(st.sets(st.text(alphabet="ab_01-./", min_size=1, max_size=6), min_size=1), st.text())
def test_every_id_means_itself_and_every_name_gets_an_answer(trial_ids: set[str], name: str) -> None:
    """Whatever the ids look like, each resolves to itself, and no name raises."""
    names = TrialNames(sorted(trial_ids))
    assert {names.resolve(trial_id) for trial_id in trial_ids} == {Resolved(t) for t in trial_ids}
    match names.resolve(name):
        case Resolved(trial_id):
            assert trial_id in trial_ids
        case Ambiguous(_, several):
            assert len(several) > 1
            assert set(several) <= trial_ids
        case Unknown(unknown):
            assert unknown == name


@pytest.mark.shared
def test_official_links_name_their_own_trials(shared_dir: Path) -> None:
    """In the predecessor's table every link to a video, map or recording means the trial of its row."""
    table = shared_dir / "data" / "physion-v1" / "stimulus_names_and_labels.csv"
    with table.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    names = TrialNames(row["stim_ID"] for row in rows)
    for row in rows:
        for link in ("stim_url", "map_url", "hdf5_url"):
            assert names.resolve(row[link]) == Resolved(row["stim_ID"])
