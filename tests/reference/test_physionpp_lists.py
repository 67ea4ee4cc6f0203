"""The released lists of test trials: every dialect gives the same trials, and nothing is guessed."""

import csv
import io
from collections.abc import Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from builders import build_benchmark
from leaderboard.problems import Problem, Problems
from leaderboard.reference.recipes.physionpp_lists import (
    ListedTrial,
    is_other_split,
    is_trial_list,
    parse_trial_lists,
    parse_trial_path,
)
from leaderboard.reference.source_files import SourceFile
from leaderboard.reference.source_tables import SourceTable, parse_source_table

HEADER = ("full_stim_paths", "filenames", "target_hit_zone_labels", "start_frame_for_prediction")


def write_table(rows: Sequence[Sequence[object]], header: Sequence[str] = HEADER) -> SourceTable:
    buffer = io.StringIO()
    csv.writer(buffer).writerows([header, *rows])
    return parse_source_table(SourceFile("Mass.csv", "Mass.csv", buffer.getvalue().encode()))


def row(copy: int, label: object, start: object = 90, *, scenario: str = "alpha_one") -> tuple[object, ...]:
    path = f"{scenario}-copy{copy}/size=1,2/0003_img.mp4"
    return (f"/mnt/some one/test/{path}", path, label, start)


def parse(*tables: SourceTable) -> tuple[dict[str, ListedTrial], list[Problem]]:
    problems = Problems()
    trials, contested = parse_trial_lists(tables, build_benchmark(), problems)
    assert bool(contested) == any(problem.code == "import-label-conflict" for problem in problems)
    return trials, list(problems)


def describe(trials: dict[str, ListedTrial]) -> dict[str, tuple[bool, int | None]]:
    return {trial_id: (trial.is_yes, trial.start_frame) for trial_id, trial in trials.items()}


REGULAR = {
    "alpha_one-copy0/size=1,2/0003": (True, 90),
    "alpha_one-copy1/size=1,2/0003": (False, 90),
}


def test_rows_become_trials_by_their_last_three_parts() -> None:
    """Folders before the last three parts do not matter, nor what a file's name ends in."""
    trials, problems = parse(write_table([row(1, "False"), row(0, "True")]))
    assert describe(trials) == REGULAR
    assert problems == []


@pytest.mark.parametrize(
    ("path", "trial_id"),
    [
        ("/a/wall_pp-copy0/size=1,2-zone=far/0007_img.mp4", "wall_pp-copy0/size=1,2-zone=far/0007"),
        ("D:\\some one\\wall_pp-copy1\\zone=0.5\\0007_aimg.mp4", "wall_pp-copy1/zone=0.5/0007"),
        ("wall_pp-copy1_mp4/zone/0007-redyellow_img.mp4", "wall_pp-copy1/zone/0007"),
        ("x/wall_pp-copy0/zone/0007.hdf5", "wall_pp-copy0/zone/0007"),
        ("x/wall_pp-copy0/zone/0007", "wall_pp-copy0/zone/0007"),
        ("https://example.com/v/wall_pp-copy0/zone/0007_map.png", "wall_pp-copy0/zone/0007"),
    ],
)
def test_paths_of_every_dialect_name_their_trial(path: str, trial_id: str) -> None:
    """POSIX and Windows paths, folders of videos, and every kind of file name the same trial."""
    name = parse_trial_path(path)
    assert name is not None
    assert name.trial_id == trial_id


@pytest.mark.parametrize("path", ["", "0007_img.mp4", "zone/0007_img.mp4", "a/b/video.mp4", "/", "a//b"])
def test_other_paths_name_no_trial(path: str) -> None:
    """A path of fewer parts, or one that ends in no number, names no trial."""
    assert parse_trial_path(path) is None


def test_the_copy_may_stand_in_any_column() -> None:
    """Where file names lack the copy, the full path tells it; the two columns still agree."""
    rows = [
        (full, name.replace(f"-copy{copy}", ""), label, 90)
        for copy, (full, name, label, _) in enumerate([row(0, "True"), row(1, "False")])
        if isinstance(name, str)
    ]
    trials, problems = parse(write_table(rows))
    assert (describe(trials), problems) == (REGULAR, [])
    swapped = write_table([(name, full, label, start) for full, name, label, start in rows])
    assert describe(parse(swapped)[0]) == REGULAR


def test_a_trial_without_copy_is_refused() -> None:
    """Where no column says the copy, the row is an error: its label could be either trial's."""
    trials, problems = parse(write_table([("x/alpha_one/size/0003_img.mp4", "size/0003_img.mp4", "True", 1)]))
    assert trials == {}
    message = "full_stim_paths 'x/alpha_one/size/0003_img.mp4' names no copy; it must be copy0 or copy1"
    assert problems == [Problem("import-trial-name", message, "Mass.csv", 2)]


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("nothing", "names no trial; it must end in <scenario>-copy<k>/<config>/<number>"),
        ("a-copy2/b/0001.mp4", "names copy 2; it must be copy0 or copy1"),
        ("a-copy0/b c/0001.mp4", "cannot be a trial id: an id has 1 to 200 printable"),
    ],
)
def test_what_names_no_trial_is_an_error(path: str, message: str) -> None:
    """A row whose paths cannot be a trial's is reported with its line, never left out in silence."""
    trials, (problem,) = parse(write_table([(path, path, "True", 1)]))
    assert trials == {}
    assert problem.is_error
    assert problem.message.startswith(f"full_stim_paths '{path}' {message}")
    assert (problem.file, problem.line) == ("Mass.csv", 2)


def test_columns_that_name_different_trials_are_an_error() -> None:
    """If path and file name are of different trials, nobody can know whose label it is."""
    full, _, label, start = row(0, "True")
    _, problems = parse(write_table([(full, row(1, "")[1], label, start)]))
    message = (
        "filenames is 'alpha_one-copy1/size=1,2/0003_img.mp4', but the row's video is of "
        "alpha_one-copy0/size=1,2/0003"
    )
    assert problems == [Problem("import-contradiction", message, "Mass.csv", 2)]


def test_side_columns_of_other_trials_are_a_warning() -> None:
    """A picture or a scene file of another trial is told once for each column; the video counts."""
    rows = [(*row(0, "True"), row(1, "")[1]), (*row(1, "False"), row(0, "")[1])]
    trials, problems = parse(write_table(rows, (*HEADER, "hdf5_names")))
    assert describe(trials) == REGULAR
    message = "hdf5_names names another trial than full_stim_paths in 2 rows; full_stim_paths is used"
    assert problems == [Problem("import-other-name", message, "Mass.csv", 2)]


@pytest.mark.parametrize("labels", [("True", "False"), ("true", "false"), ("1", "0"), (" TRUE", "0.0")])
def test_labels_may_be_spelled_in_any_usual_way(labels: tuple[str, str]) -> None:
    """True, true and 1 are YES; their opposites NO."""
    assert describe(parse(write_table([row(0, labels[0]), row(1, labels[1])]))[0]) == REGULAR


@pytest.mark.parametrize("label", ["", "nan", "yes?", "2"])
def test_other_labels_are_errors(label: str) -> None:
    """A label that is neither True nor False is reported with its line."""
    trials, problems = parse(write_table([row(0, label)]))
    assert trials == {}
    message = f"target_hit_zone_labels is '{label}', neither True nor False"
    assert problems == [Problem("import-label", message, "Mass.csv", 2)]


def test_a_trial_listed_twice_counts_once() -> None:
    """Repetition with the same label is a note that says where the trial stands first."""
    trials, problems = parse(write_table([row(0, "True")]), write_table([row(1, "False"), row(0, "True")]))
    assert describe(trials) == REGULAR
    message = "alpha_one-copy0/size=1,2/0003 is listed in Mass.csv:2 already, with the same label"
    assert problems == [Problem("import-listed-twice", message, "Mass.csv", 3)]


def test_a_trial_with_both_labels_is_contested() -> None:
    """Which of two labels is right cannot be known, so the trial is named as one to be dropped."""
    table = write_table([row(0, "True"), row(1, "False"), row(0, "False")])
    trials, problems = parse(table)
    assert describe(trials) == REGULAR
    _, contested = parse_trial_lists([table], build_benchmark(), Problems())
    assert contested == {"alpha_one-copy0/size=1,2/0003"}
    message = "alpha_one-copy0/size=1,2/0003 ends in NO here and in YES in Mass.csv:2; it is dropped"
    assert problems == [Problem("import-label-conflict", message, "Mass.csv", 4)]


def test_unknown_scenarios_are_errors() -> None:
    """A scenario that the definition lacks is named once, with the nearest and what to do."""
    rows = [row(0, "True", scenario="alpha_onn"), row(1, "False", scenario="alpha_onn")]
    _, problems = parse(write_table(rows))
    rule = "a scenario that benchmark.toml does not define"
    message = f"2 trials are of 'alpha_onn', {rule}; the nearest is alpha_one"
    hint = "add it to reference/benchmark.toml, or leave the file out"
    assert problems == [Problem("import-unknown-scenario", message, "Mass.csv", 2, hint)]


@pytest.mark.parametrize(("cell", "frame"), [("90", 90), ("90.0", 90), ("", None), ("nan", None)])
def test_start_frames_are_whole_or_missing(cell: str, frame: int | None) -> None:
    """A frame may be written as a decimal number, as tables with gaps have it, or not be there."""
    trials, problems = parse(write_table([row(0, "True", cell)]))
    assert [trial.start_frame for trial in trials.values()] == [frame]
    assert problems == []


def test_odd_start_frames_are_left_empty() -> None:
    """What is no frame is told and left out; a repetition with another frame keeps the first."""
    trials, problems = parse(write_table([row(0, "True", "9.5"), row(0, "True", 7)]))
    assert [trial.start_frame for trial in trials.values()] == [None]
    assert [(p.code, p.line) for p in problems] == [
        ("import-start-frame", 2),
        ("import-listed-twice", 3),
        ("import-start-frame", 3),
    ]


def test_trials_come_in_the_order_of_the_definition() -> None:
    """The order of files and rows does not matter."""
    rows = [
        row(copy, "True", scenario=scenario)
        for scenario in ("beta_one", "alpha_two", "alpha_one")
        for copy in (1, 0)
    ]
    forward, _ = parse(write_table(rows))
    backward, _ = parse(write_table(rows[::-1][:2]), write_table(rows[::-1][2:]))
    assert list(forward) == list(backward)
    assert [trial.name.scenario for trial in forward.values()] == (
        ["alpha_one"] * 2 + ["alpha_two"] * 2 + ["beta_one"] * 2
    )


def test_lists_are_told_from_people_by_their_columns() -> None:
    """A list has videos and labels and no answers."""
    assert is_trial_list(write_table([row(0, "True")]))
    people = ("stim_ID", "response", "target_hit_zone_label", "filenames")
    assert not is_trial_list(write_table([("a", "YES", "True", "b")], people))
    assert not is_trial_list(write_table([("a", "0.5", "10")], ("stim_ID", "correct", "c")))


@pytest.mark.parametrize(
    ("name", "folder", "is_other"),
    [
        ("testdata_v1/Mass.csv", "testdata", False),
        ("readout/Mass.csv", "testdata", True),
        ("Mass_training.csv", "data", True),
        ("Mass.csv", "readoutdata", True),
        ("Mass.csv", "trained_models/test", False),
        ("Mass.csv", "strain", False),
    ],
)
def test_lists_for_other_purposes_are_recognised(name: str, folder: str, *, is_other: bool) -> None:
    """Folders and names that speak of training or readouts set a list apart; those of tests do not."""
    rows = [(f"/{folder}/{path}", path, label, 1) for _, path, label, _ in [row(0, "True"), row(1, "False")]]
    assert is_other_split(name, write_table(rows)) is is_other


@given(st.lists(st.lists(st.text(max_size=12), min_size=4, max_size=4), min_size=1, max_size=4))
def test_any_cells_give_trials_or_errors(cells: list[list[str]]) -> None:
    """Whatever the cells hold, each row becomes a trial or is reported."""
    rows = [[cell.replace("\0", "") for cell in row] for row in cells]
    trials, problems = parse(write_table(rows))
    assert trials or any(problem.is_error for problem in problems)
