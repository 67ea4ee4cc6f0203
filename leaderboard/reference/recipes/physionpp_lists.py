"""Understanding the released lists of test trials, in every dialect that is known of them."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from leaderboard.ids import find_nearest, format_pair_id, format_trial_id, is_id
from leaderboard.models import Benchmark
from leaderboard.problems import Problems
from leaderboard.reference.cells import ID_RULE, quote
from leaderboard.reference.source_tables import SourceRow, SourceTable

LABEL_COLUMNS = ("target_hit_zone_labels", "target_hit_zone_label", "label", "labels")
START_COLUMNS = ("start_frame_for_prediction", "start_frame_after_curtain")
# The first that a list has names the trial; what the second says of it must be the same.
NAME_COLUMNS = ("full_stim_paths", "filenames")
OTHER_NAME_COLUMNS = (
    "full_stim_apaths",
    "filenames_a",
    "full_stim_ifpaths",
    "filenames_if",
    "full_map_paths",
    "mapnames",
    "full_hdf5_paths",
    "hdf5_names",
)
ANSWER_COLUMNS = ("response", "correct", "gameID", "prolificIDAnon")  # a file with one of these is people's
LABELS = {"true": True, "1": True, "1.0": True, "false": False, "0": False, "0.0": False}
# Beginnings of words in the path of a list, or of the videos in it, that set it apart from the test lists.
OTHER_SPLITS = ("readout", "train", "valid")

_FOLDER = re.compile(r"(?P<scenario>[^/]+?)(?:-copy(?P<copy>[0-9]+))?(?:_(?:mp4|hdf5))?")
_NUMBER = re.compile(r"(?P<number>[0-9]+)(?:_[a-z]+|-redyellow)*(?:\.[a-z0-9]+)?", re.IGNORECASE)
_WHOLE = re.compile(r"(?P<whole>0|[1-9][0-9]{0,8})(?:\.0+)?")
_N_PARTS = 3
_COPIES = ("0", "1")


@dataclass(frozen=True)
class TrialName:
    """What a path says of a trial; ``copy`` is empty if it says none."""

    scenario: str
    copy: str
    config: str
    number: str

    def may_be(self, other: "TrialName") -> bool:
        """Tell whether both can mean the same trial."""
        is_same_copy = not self.copy or not other.copy or self.copy == other.copy
        return is_same_copy and self.pair_id == other.pair_id

    @property
    def pair_id(self) -> str:
        """The id of the trial's pair."""
        return format_pair_id(self.scenario, self.config, self.number)

    @property
    def trial_id(self) -> str:
        """The trial's id; only where the copy is said."""
        return format_trial_id(self.scenario, int(self.copy), self.config, self.number)


@dataclass(frozen=True)
class ListedTrial:
    """A trial as a row lists it; ``start_frame`` is None if it is not given."""

    name: TrialName
    is_yes: bool
    start_frame: int | None
    row: SourceRow


def is_trial_list(table: SourceTable) -> bool:
    """Tell from its columns whether a table lists trials with their labels and is not people's."""
    columns = set(table.header)
    has_name = not columns.isdisjoint(NAME_COLUMNS)
    has_label = not columns.isdisjoint(LABEL_COLUMNS)
    return has_name and has_label and columns.isdisjoint(ANSWER_COLUMNS)


def is_other_split(name: str, table: SourceTable) -> bool:
    """Tell whether a list is for training or for fitting readouts, by its path or those of all its videos."""
    if _has_word(name, OTHER_SPLITS):
        return True
    column = _find_column(table, NAME_COLUMNS)
    folders = {"/".join(_split(row[column])[:-_N_PARTS]) for row in table.rows}
    return all(_has_word(folder, OTHER_SPLITS) and not _has_word(folder, ("test",)) for folder in folders)


def parse_trial_path(path: str) -> TrialName | None:
    r"""Read a trial's name off the last three parts of a path; None if they are none.

    >>> parse_trial_path("D:\\data\\wall_pp-copy1\\zone=far,near\\0007_img.mp4").trial_id
    'wall_pp-copy1/zone=far,near/0007'
    """
    parts = _split(path)[-_N_PARTS:]
    if len(parts) < _N_PARTS:
        return None
    folder, config, file = _FOLDER.fullmatch(parts[0]), parts[1], _NUMBER.fullmatch(parts[2])
    if folder is None or file is None:
        return None
    return TrialName(folder["scenario"], folder["copy"] or "", config, file["number"])


def parse_trial_lists(
    tables: Sequence[SourceTable], benchmark: Benchmark, problems: Problems
) -> tuple[dict[str, ListedTrial], frozenset[str]]:
    """Understand the lists of test trials.

    Returns
    -------
    trials
        By id, scenarios in the order of the definition and then by name. A trial that is listed several times
        counts once, as its first row says.
    contested
        Ids of those that are listed with both labels: nobody can know which is right.
    """
    listed: dict[str, list[ListedTrial]] = {}
    for table in tables:
        for trial in _parse_list(table, problems):
            listed.setdefault(trial.name.trial_id, []).append(trial)
    _check_scenarios(listed, benchmark, problems)
    order = {scenario.id: index for index, scenario in enumerate(benchmark.scenarios)}
    trials = {trial_id: found[0] for trial_id, found in listed.items()}
    keys = {
        trial_id: (order.get(trial.name.scenario, len(order)), trial.name.pair_id, trial_id)
        for trial_id, trial in trials.items()
    }
    contested = frozenset(t for t, found in listed.items() if _is_contested(t, found, problems))
    return {trial_id: trials[trial_id] for trial_id in sorted(trials, key=keys.__getitem__)}, contested


def _parse_list(table: SourceTable, problems: Problems) -> Iterable[ListedTrial]:
    name_column = _find_column(table, NAME_COLUMNS)
    label_column = _find_column(table, LABEL_COLUMNS)
    start_column = _find_column(table, START_COLUMNS)
    contradictions: dict[str, list[SourceRow]] = {}
    for row in table.rows:
        name = _parse_name(row, name_column, problems)
        label = LABELS.get(row[label_column].strip().lower())
        if label is None:
            message = f"{label_column} is {quote(row[label_column])}, neither True nor False"
            problems.add("import-label", message, row.file, line=row.line)
        if name is None or label is None:
            continue
        _compare_names(row, name, contradictions, problems)
        yield ListedTrial(name, label, _parse_start(row, start_column, problems), row)
    for column, rows in contradictions.items():
        message = (
            f"{column} names another trial than {name_column} in {len(rows)} rows; {name_column} is used"
        )
        problems.add("import-other-name", message, table.file, line=rows[0].line)


def _parse_name(row: SourceRow, column: str, problems: Problems) -> TrialName | None:
    """Name the trial of a row by its first path that says the copy."""
    names = [parse_trial_path(row[c]) for c in (column, *NAME_COLUMNS, *OTHER_NAME_COLUMNS) if c in row.cells]
    name = next((name for name in names if name is not None and name.copy), names[0])
    if name is None:
        rule = "it must end in <scenario>-copy<k>/<config>/<number>"
        message = f"{column} {quote(row[column])} names no trial; {rule}"
    elif name.copy not in _COPIES:
        said = f"copy {name.copy}" if name.copy else "no copy"
        message = f"{column} {quote(row[column])} names {said}; it must be copy0 or copy1"
    elif not is_id(name.trial_id):
        message = f"{column} {quote(row[column])} cannot be a trial id: {ID_RULE}"
    else:
        return name
    problems.add("import-trial-name", message, row.file, line=row.line)
    return None


def _compare_names(
    row: SourceRow, name: TrialName, contradictions: dict[str, list[SourceRow]], problems: Problems
) -> None:
    """Hold the other paths of a row against its trial."""
    for column in (*NAME_COLUMNS, *OTHER_NAME_COLUMNS):
        other = parse_trial_path(row.cells.get(column, ""))
        if other is None or name.may_be(other):
            continue
        if column in NAME_COLUMNS:
            message = f"{column} is {quote(row[column])}, but the row's video is of {name.trial_id}"
            problems.add("import-contradiction", message, row.file, line=row.line)
        else:
            contradictions.setdefault(column, []).append(row)


def _parse_start(row: SourceRow, column: str, problems: Problems) -> int | None:
    cell = row.cells.get(column, "").strip()
    if cell in ("", "nan"):
        return None
    found = _WHOLE.fullmatch(cell)
    if found is None:
        message = f"{column} is {quote(cell)}, no number of a frame; it is left empty"
        problems.add("import-start-frame", message, row.file, line=row.line)
        return None
    return int(found["whole"])


def _check_scenarios(
    listed: Mapping[str, Sequence[ListedTrial]], benchmark: Benchmark, problems: Problems
) -> None:
    """Report each scenario that the definition lacks, once."""
    known = {scenario.id for scenario in benchmark.scenarios}
    unknown: dict[str, list[ListedTrial]] = {}
    for found in listed.values():
        if found[0].name.scenario not in known:
            unknown.setdefault(found[0].name.scenario, []).append(found[0])
    for scenario, trials in sorted(unknown.items()):
        nearest = find_nearest(scenario, known)
        message = (
            f"{len(trials)} trials are of {quote(scenario)}, a scenario that benchmark.toml does not define"
        )
        first = trials[0].row
        problems.add(
            "import-unknown-scenario",
            message + (f"; the nearest is {nearest}" if nearest else ""),
            first.file,
            line=first.line,
            hint="add it to reference/benchmark.toml, or leave the file out",
        )


def _is_contested(trial_id: str, found: Sequence[ListedTrial], problems: Problems) -> bool:
    """Tell whether the rows of a trial give it different labels, and report repetitions."""
    first = found[0]
    for other in found[1:]:
        where = f"{first.row.file}:{first.row.line}"
        if other.is_yes != first.is_yes:
            message = f"{trial_id} ends in {_say(other)} here and in {_say(first)} in {where}; it is dropped"
            problems.add("import-label-conflict", message, other.row.file, line=other.row.line)
        else:
            message = f"{trial_id} is listed in {where} already, with the same label"
            problems.add("import-listed-twice", message, other.row.file, line=other.row.line)
        if other.start_frame != first.start_frame:
            message = (
                f"{trial_id} starts at frame {other.start_frame} here, not {first.start_frame} as in {where}"
            )
            problems.add("import-start-frame", message, other.row.file, line=other.row.line)
    return any(trial.is_yes != first.is_yes for trial in found)


def _say(trial: ListedTrial) -> str:
    return "YES" if trial.is_yes else "NO"


def _find_column(table: SourceTable, names: Sequence[str]) -> str:
    return next((name for name in names if name in table.header), "")


def _split(path: str) -> list[str]:
    return [part for part in path.strip().replace("\\", "/").split("/") if part]


def _has_word(path: str, beginnings: tuple[str, ...]) -> bool:
    return any(word.startswith(beginnings) for word in re.split(r"[^a-z]+", path.lower()))
