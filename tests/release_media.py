"""What else the archives hold: videos, states, pickles, and what computers leave behind."""

from collections.abc import Collection, Iterable, Sequence

from release_lists import ListDialect, folder_of, readout_trials, render_list
from release_traps import Trap
from release_trials import Trial

N_WITH_MEDIA = 6  # trials whose files are there unless all are asked for
README = b"# Physion++ (a stand-in for tests)\n\nLists of trials are the csv files; license: MIT.\n"

# Whoever loads it ends with this message.
ARMED_PICKLE = b"cbuiltins\nexec\n(S'raise SystemExit(\"a pickle of the release was loaded\")'\ntR."

_MEDIA = {
    "_img.mp4": b"\x00\x00\x00\x18ftypmp42",
    "_aimg.mp4": b"\x00\x00\x00\x18ftypmp42",
    "_map.png": b"\x89PNG\r\n\x1a\n",
    ".hdf5": b"\x89HDF\r\n\x1a\n",
    ".pkl": ARMED_PICKLE,
}


def media_members(folder: str, trials: Sequence[Trial], traps: Collection[Trap]) -> dict[str, bytes]:
    """Make the files of some trials."""
    return {
        f"{folder}/{folder_of(trial, traps)}/{trial.config}/{trial.number}{ending}": content
        for trial in trials
        for ending, content in _MEDIA.items()
    }


def readout_members(
    folder: str, trials: Sequence[Trial], dialect: ListDialect, seed: int
) -> dict[str, bytes]:
    """Make the lists of training trials that ``READOUT_LIST`` puts beside those of the test."""
    if Trap.READOUT_LIST not in dialect.traps:
        return {}
    members = {}
    elsewhere = ListDialect(
        dialect.names,
        dialect.columns,
        dialect.has_index,
        dialect.root.replace("testdata", "readoutdata"),
        dialect.traps,
    )
    properties = dict.fromkeys(trial.property_name for trial in trials)
    for property_, name in zip(properties, dialect.file_names(), strict=True):
        own = readout_trials([trial for trial in trials if trial.property_name == property_], seed)
        members[f"{folder}/readout/{name}"] = render_list(own, elsewhere)
    return members


def junk_members(folder: str, names: Iterable[str]) -> dict[str, bytes]:
    """Make what a Mac packs along, and a readme."""
    forks = {
        f"__MACOSX/{folder}/._{name}": b"\x00\x05\x16\x07\x00\x02\x00\x00Mac OS X        " for name in names
    }
    return {**forks, f"{folder}/.DS_Store": b"\x00\x00\x00\x01Bud1", f"{folder}/README.md": README}
