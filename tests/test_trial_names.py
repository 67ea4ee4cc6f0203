"""Names in other people's files, and the trials that they mean."""

import csv
from pathlib import Path
from urllib.parse import quote

import pytest
from hypothesis import assume, given
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
        f"{TRIAL}_img-redyellow.mp4",
        f"{TRIAL}_img.mp4.npy",
        f"{TRIAL}_id.png",
        f"{TRIAL}_img_img.avi",
        f"{TRIAL}_img/",
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
        f"{TRIAL}_imag",
        f"{TRIAL}.doc",
        f"{TRIAL}mp4",
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
    names = TrialNames(["wall/target=bowl-tscale=0.3,0.5/0007"])
    assert names.resolve("/data/test/wall/target=bowl-tscale=0.3,0.5/0007_img.mp4") == Resolved(
        "wall/target=bowl-tscale=0.3,0.5/0007"
    )
    assert isinstance(names.resolve("target=bowl-tscale=0.3,0.5/0007_img.mp4"), Unknown)


CONFIG = "mass_wall-target=bowl-tscale=0.3,0.5-zdloc=1"
FIRST, SECOND = (f"wall_pp-copy{copy}/{CONFIG}/0007" for copy in (0, 1))
LONE = f"wall_pp-copy1/{CONFIG}/0012"
OTHER = f"ramp_pp-copy0/{CONFIG}/0099"
PAIRED = TrialNames([FIRST, SECOND, LONE, OTHER])


@pytest.mark.parametrize(
    "name",
    [
        f"{SECOND}_img.mp4",
        f"{SECOND}_aimg.mp4",
        f"{SECOND}_cue-redyellow.webm",
        f"/mnt/my data/testdata_v1/{SECOND}_img.mp4",
        rf"D:\my data\testdata_v1\wall_pp-copy1\{CONFIG}\0007_img.mp4",
        rf"\\server\share\wall_pp-copy1_mp4/{CONFIG}\0007.hdf5",
        rf"C:\\data\\wall_pp-copy1\\{CONFIG}\\0007_id.png",
        f"wall_pp-copy1_mp4/{CONFIG}/0007_img.mp4",
        f"wall_pp-copy1/{CONFIG}-redyellow/0007.pkl",
        f"//{SECOND}/",
        f"file:///C:/data/{SECOND}_img.mp4",
        f"https://example.com/a%20b/{quote(SECOND)}_img.mp4?versionId=a/b#t=10",
        f"s3://bucket/{SECOND}_map.png",
    ],
)
def test_names_of_released_files_mean_their_trial(name: str) -> None:
    """Full paths of any system, folders marked by the kind of file, and links mean the trial at their end."""
    assert PAIRED.resolve(name) == Resolved(SECOND)


@pytest.mark.parametrize(
    "name",
    [
        f"{CONFIG}/0007_img.mp4",
        f"wall_pp/{CONFIG}/0007_img.mp4",
        f"wall_pp_mp4/{CONFIG}/0007",
        f"/data/videos/wall_pp/{CONFIG}/0007.hdf5",
        f"/data/videos/{CONFIG}/0007.hdf5",
        rf"C:\videos\{CONFIG}\0007_img.mp4",
        f"https://example.com/{CONFIG}/0007_img.mp4",
    ],
)
def test_names_without_their_copy_fit_both_members(name: str) -> None:
    """A name that lacks the mark of its copy, or the folder, is ambiguous: it says nothing of which it is."""
    assert PAIRED.resolve(name) == Ambiguous(name, (FIRST, SECOND))


@pytest.mark.parametrize(
    "name", [f"{CONFIG}/0012_img.mp4", f"wall_pp/{CONFIG}/0012", f"x/wall_pp/{CONFIG}/0012"]
)
def test_names_without_their_copy_need_both_members_to_be_here(name: str) -> None:
    """Where only one member is here, the other may be meant; where all is one copy, nothing else can be."""
    assert isinstance(PAIRED.resolve(name), Unknown)
    assert TrialNames([LONE]).resolve(name) == Resolved(LONE)


@pytest.mark.parametrize(
    "name",
    [
        f"wall_pp-copy0/{CONFIG}/0012_img.mp4",
        f"wall_pp-copy2/{CONFIG}/0007_img.mp4",
        f"wall_pp_copy0/{CONFIG}/0012",
        f"copy0/wall_pp/{CONFIG}/0012",
        f"COPY 0/{CONFIG}/0012",
        f"https://example.com/wall_pp/{CONFIG}/0012_img.mp4?copy=0",
        f"wall_pp/{CONFIG}/0012-copy0",
        f"ramp_pp-copy1/{CONFIG}/0099_img.mp4",
        f"other_pp-copy1/{CONFIG}/0012",
        f"other_pp/{CONFIG}/0012",
    ],
)
def test_no_name_means_the_other_copy_or_another_scenario(name: str) -> None:
    """A name that says which copy it is, or may be of another scenario, never falls back on what is left."""
    assert isinstance(PAIRED.resolve(name), Unknown)


def test_trials_without_copies_are_not_taken_for_others() -> None:
    """Beside pairs, a trial of its own is still found by its path, whatever its folder shares with theirs."""
    names = TrialNames([FIRST, SECOND, f"solo_pp/{CONFIG}/0007"])
    assert names.resolve(f"/data/solo_pp/{CONFIG}/0007_img.mp4") == Resolved(f"solo_pp/{CONFIG}/0007")


def test_endless_names_are_nothing() -> None:
    """What is longer than any path fits no trial, without being taken apart."""
    assert isinstance(PAIRED.resolve("x/" * 2_000_000 + SECOND), Unknown)
    assert PAIRED.resolve("x/" * 2_000 + SECOND) == Resolved(SECOND)


PARTS = st.sampled_from(
    ["a", "b_0001", "0001", "c_img", "d.mp4", "e-redyellow", "e-redyellow_0001", "_img"]
) | st.sampled_from(
    ["-copy0", "x-copy0", "x-copy1", "x", "x_map-copy0", "t=0.3,0.5", "http:", "%41", "q?v=1"]
)
PAIR_IDS = st.builds(
    lambda scenario, copy, config, number: f"{scenario}-copy{copy}/{config}/{number:04d}",
    st.sampled_from(["s_pp", "t", "s_pp_map"]),
    st.integers(0, 2),
    st.sampled_from(["t=0.3,0.5-z=1", "zone=far", "zone=far_id"]),
    st.integers(0, 2),
)
IDS = st.sets(st.lists(PARTS, min_size=1, max_size=3).map("/".join) | PAIR_IDS, min_size=1, max_size=12)
SUFFIXES = ["_img", "_aimg", "_ifimg", "_image", "_id", "_seg", "_cue", "_map", "_mp4", "-redyellow"]
ENDINGS = [".mp4", ".hdf5", ".h5", ".png", ".json", ".npz", ".npy", ".pkl", ".txt", ".gif", ".avi", ".webm"]
DECORATIONS = st.lists(st.sampled_from([*SUFFIXES, *ENDINGS]), max_size=4).map("".join)
FOLDERS = st.lists(
    st.sampled_from(["C:", "my data", "test.mp4", "wall_pp", "copy1", "a", "..", "x-copy0"]), max_size=3
)


def decorate(trial_id: str, ends: list[str], folders: list[str], spelling: str) -> str:
    """Write an id as tools do: something behind each part, folders before it, slashes of any kind."""
    parts = [part + end for part, end in zip(trial_id.split("/"), ends, strict=False)]
    if spelling == "link":
        return "/".join(["https://example.com", *map(quote, [*folders, *parts])]) + "?v=1"
    return {"posix": "/", "windows": "\\", "escaped": "\\\\"}[spelling].join([*folders, *parts])


@given(
    IDS,
    st.data(),
    st.lists(DECORATIONS, min_size=3, max_size=3),
    FOLDERS,
    st.sampled_from(["posix", "windows", "escaped", "link"]),
)
def test_no_decoration_leads_to_another_trial(
    trial_ids: set[str], data: st.DataObject, ends: list[str], folders: list[str], spelling: str
) -> None:
    """An id with anything that tools add means its trial, or several with it among them.

    What is an id itself, by chance, means that trial.
    """
    trial_id = data.draw(st.sampled_from(sorted(trial_ids)))
    name = decorate(trial_id, ends, folders, spelling)
    assume(name not in trial_ids or name == trial_id)
    found = TrialNames(sorted(trial_ids)).resolve(name)
    meant = found.trial_ids if isinstance(found, Ambiguous) else (getattr(found, "trial_id", None),)
    assert trial_id in meant


@given(
    st.sets(PAIR_IDS, min_size=1, max_size=12),
    st.data(),
    st.lists(DECORATIONS, min_size=3, max_size=3),
    st.sampled_from(["mark", "folder"]),
    st.sampled_from(["posix", "windows", "escaped"]),
)
def test_no_lost_copy_leads_to_another_trial(
    trial_ids: set[str], data: st.DataObject, ends: list[str], lost: str, spelling: str
) -> None:
    """An id without its copy, or the folder that names it, means its trial, several with it, or none."""
    trial_id = data.draw(st.sampled_from(sorted(trial_ids)))
    folder, _, rest = trial_id.partition("/")
    short = f"{folder.rpartition('-copy')[0]}/{rest}" if lost == "mark" else rest
    found = TrialNames(sorted(trial_ids)).resolve(decorate(short, ends, [], spelling))
    meant = found.trial_ids if isinstance(found, Ambiguous) else (getattr(found, "trial_id", trial_id),)
    assert trial_id in meant


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
