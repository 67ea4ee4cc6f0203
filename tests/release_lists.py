"""The lists of test trials, in every dialect in which they were seen."""

import csv
import io
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from release_traps import Trap
from release_trials import Trial, stream

POSIX_ROOT = "/mnt/fs4/some one/physion pp/testdata"
WINDOWS_ROOT = "D:\\data\\physion pp\\testdata"
UNKNOWN_SCENARIO = "mass_ramp_pp"


class ListNames(Enum):
    """The names of the lists, in the order of the properties."""

    MERGED = (
        "physionpp-mass_merge_221111.csv",
        "physionpp-friction_merge_230108.csv",
        "physionpp-bouncy_merge_230108.csv",
        "physionpp-deform_merge_230120.csv",
    )
    PAPER = ("Mass.csv", "Friction.csv", "Elasticity.csv", "Deformability.csv")
    MEANINGLESS = ("list01.csv", "list02.csv", "list03.csv", "list04.csv")


class Columns(Enum):
    """The columns of the lists; a leading index comes on top."""

    CURRENT = (
        "full_stim_paths",
        "full_stim_apaths",
        "filenames",
        "filenames_a",
        "target_hit_zone_labels",
        "start_frame_for_prediction",
    )
    OLDER = (
        "full_stim_paths",
        "filenames",
        "full_map_paths",
        "mapnames",
        "full_hdf5_paths",
        "hdf5_names",
        "target_hit_zone_labels",
        "start_frame_after_curtain",
    )
    DV2 = (*OLDER, "full_stim_ifpaths", "filenames_if", "star_phy", "nonstar_phy")


# What a path or name column points to.
_ENDINGS = {
    "full_stim_paths": "_img.mp4",
    "full_stim_apaths": "_aimg.mp4",
    "full_stim_ifpaths": "_ifimg.mp4",
    "full_map_paths": "_map.png",
    "full_hdf5_paths": ".hdf5",
    "filenames": "_img.mp4",
    "filenames_a": "_aimg.mp4",
    "filenames_if": "_ifimg.mp4",
    "mapnames": "_map.png",
    "hdf5_names": ".hdf5",
}


@dataclass(frozen=True)
class ListDialect:
    """How the lists are written."""

    names: ListNames
    columns: Columns
    has_index: bool
    root: str
    traps: Collection[Trap]

    def file_names(self) -> tuple[str, ...]:
        """Name the list of each property; the third family of columns shows in its names."""
        is_marked = self.columns is Columns.DV2 and self.names is ListNames.MERGED
        return tuple(n.replace(".csv", "_dv2.csv") if is_marked else n for n in self.names.value)

    def split_names(self) -> tuple[str, str]:
        """Name the two files over which the first list is split."""
        first = self.file_names()[0]
        return first, first.replace(".csv", "_2.csv")


def folder_of(trial: Trial, traps: Collection[Trap]) -> str:
    """Name the folder with scenario and copy, as it reads in paths."""
    return f"{trial.scenario}-copy{trial.copy}{'_mp4' if Trap.COPY_FOLDER_MP4 in traps else ''}"


def write_lists(trials: Sequence[Trial], dialect: ListDialect) -> dict[str, bytes]:
    """Render each property's list, by the name of its file."""
    files: dict[str, bytes] = {}
    properties = dict.fromkeys(trial.property_name for trial in trials)
    for index, (property_, name) in enumerate(zip(properties, dialect.file_names(), strict=True)):
        rows = [trial for trial in trials if trial.property_name == property_]
        rows = _add_rows(rows, dialect.traps) if index == 0 else rows
        if index == 0 and Trap.SPLIT_LIST in dialect.traps:
            first, second = dialect.split_names()
            middle = len(rows) // 2 + 1  # inside a pair
            files[first] = render_list(rows[:middle], dialect)
            files[second] = render_list(rows[middle:], dialect)
        else:
            files[name] = render_list(rows, dialect)
    return files


def repeated_trial(trials: Sequence[Trial]) -> Trial:
    """Return the trial of the first list that ``REPEATED_ROW`` lists twice."""
    return trials[3]


def contradicted_trial(trials: Sequence[Trial]) -> Trial:
    """Return the trial of the first list that ``CONTRADICTORY_ROW`` lists with both labels."""
    return trials[4]


def unknown_trials(trials: Sequence[Trial]) -> list[Trial]:
    """Make the pair of a scenario that the benchmark lacks."""
    first = replace(trials[0], scenario=UNKNOWN_SCENARIO, copy=0)
    return [first, replace(first, copy=1, label=not first.label)]


def readout_trials(trials: Sequence[Trial], seed: int) -> list[Trial]:
    """Make training trials: half have names of their own, half have those of test trials, with other labels.

    The authors numbered the scenes of each set from zero, so the same name may mean a training scene. Only
    where it lies tells: the list in a folder readout/, the videos below readoutdata instead of testdata.
    """
    rng = stream(seed, "readout")
    some = [trial for trial in trials if rng.random() < 0.5] or list(trials)
    return [
        replace(t, number=f"{int(t.number) + 500:04d}") if index % 2 else replace(t, label=not t.label)
        for index, t in enumerate(some)
    ]


def _add_rows(rows: list[Trial], traps: Collection[Trap]) -> list[Trial]:
    added = list(rows)
    if Trap.REPEATED_ROW in traps:
        added.append(repeated_trial(rows))
    if Trap.CONTRADICTORY_ROW in traps:
        trial = contradicted_trial(rows)
        added.append(replace(trial, label=not trial.label))
    if Trap.UNKNOWN_SCENARIO in traps:
        added += unknown_trials(rows)
    return added


def render_list(trials: Iterable[Trial], dialect: ListDialect) -> bytes:
    """Render one list."""
    header = (("",) if dialect.has_index else ()) + dialect.columns.value
    rows = []
    for index, trial in enumerate(trials):
        cells = [_cell(column, trial, dialect) for column in dialect.columns.value]
        rows.append([str(index), *cells] if dialect.has_index else cells)
    return render_table([header, *rows], dialect.traps)


def render_table(rows: Iterable[Iterable[object]], traps: Collection[Trap]) -> bytes:
    """Render a CSV file with the traps that concern any file."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerows(rows)
    text = buffer.getvalue() + ("\n\n" if Trap.BLANK_LINES in traps else "")
    text = text.replace("\n", "\r\n") if Trap.CRLF in traps else text
    return text.encode("utf-8-sig" if Trap.BYTE_ORDER_MARK in traps else "utf-8")


def _cell(column: str, trial: Trial, dialect: ListDialect) -> str:
    if column == "target_hit_zone_labels":
        return _label(trial.label, dialect.traps)
    if column.startswith("start_frame"):
        return str(trial.start_frame)
    if column not in _ENDINGS:  # star_phy, nonstar_phy: what differs between the copies
        return f"{{'mass': {1.5 + trial.copy}}}"
    parts = [folder_of(trial, dialect.traps), trial.config, trial.number + _ENDINGS[column]]
    if column.startswith("full_"):
        parts.insert(0, dialect.root)
    elif Trap.FILENAMES_WITHOUT_COPY in dialect.traps:
        parts.pop(0)
    elif Trap.FILENAMES_OF_PAIRS in dialect.traps:
        parts[0] = trial.scenario
    return ("\\" if "\\" in dialect.root else "/").join(parts)


def _label(label: bool, traps: Collection[Trap]) -> str:
    if Trap.NUMERIC_LABELS in traps:
        return str(int(label))
    return str(label).lower() if Trap.LOWER_CASE_LABELS in traps else str(label)
