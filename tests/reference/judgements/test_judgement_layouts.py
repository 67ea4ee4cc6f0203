"""Layouts are recognised by content, and people can be told apart from what only looks like them."""

import pytest

from judgement_files import (
    ANN,
    BOB,
    CAT,
    LONG,
    RAMP0,
    RAMP1,
    TRIALS,
    WALL0,
    WALL1,
    make_file,
    read,
    read_rows,
)

PEOPLE = (ANN, BOB, CAT)
ROWS = [(person, trial, "YES" if trial in {RAMP0, RAMP1} else "NO") for person in PEOPLE for trial in TRIALS]
NOBODY = "no column says who answered or how many people did"
COUNTS = {RAMP0: (3, 3), RAMP1: (3, 3), WALL0: (3, 0), WALL1: (3, 0)}


@pytest.mark.parametrize(
    "header",
    [
        LONG,
        ("gameID", "stimulus", "answer"),
        ("PROLIFIC_PID", "video name", "Resp"),
        ("subj", "filenames", "choice"),
        ("Worker.Id", "clip seen", "judgment"),
        ("participant", "trial_id", "said it would hit"),
    ],
)
def test_columns_go_by_many_names(header: tuple[str, str, str]) -> None:
    """Case, underscores, dots and blanks do not matter; a column of trials or words needs no name."""
    reading = read_rows(header, ROWS)
    assert reading.counts == COUNTS
    person, trial, response = header
    message = f"is read as one row for each answer: participant from {person}, trial from {trial}"
    assert reading.find("import-layout").message == f"{message}, response from {response}"


def test_one_row_for_each_trial() -> None:
    """People are columns of answers under names that say nothing; an index and known flags are none."""
    rows = [
        (index, trial, "x", trial.startswith("ramp"), *["Yes" if "ramp" in trial else "No"] * 3)
        for index, trial in enumerate(TRIALS)
    ]
    reading = read_rows(("", "stim_ID", "note", "flipped", *PEOPLE), rows)
    assert reading.counts == COUNTS
    assert reading.judgements is not None
    assert reading.judgements.account.n_participants == 3
    expected = (
        "one row for each trial and one column for each person: trial from stim_ID, people from 3 columns"
    )
    assert reading.find("import-layout").message == f"is read as {expected}"


def test_one_row_for_each_person() -> None:
    """Trials are the columns that name them; a cell without answer is a trial that somebody did not see."""
    header = ("prolificIDAnon", "age", *(f"videos/{trial}_img.mp4" for trial in TRIALS))
    reading = read_rows(header, [(ANN, 31, "YES", "no", "", "1"), (BOB, 44, "NO", "", "NaN", "0")])
    assert reading.counts == {RAMP0: (2, 1), RAMP1: (1, 0), WALL1: (2, 1)}
    assert reading.find("import-layout").message == (
        "is read as one row for each person and one column for each trial: "
        "participant from prolificIDAnon, trials from 4 columns"
    )


def test_rows_without_ids_are_people() -> None:
    """Where each row is a person, no column need say so; the same rows in another file are other people."""
    header, rows = ("age", RAMP0, RAMP1), [(31, "YES", "NO"), (31, "YES", "NO")]
    reading = read(make_file(header, rows, "a.csv"), make_file(header, [*rows, (44, "NO", "NO")], "b.csv"))
    assert reading.counts == {RAMP0: (5, 4), RAMP1: (5, 0)}


def test_zeros_and_ones_in_wide_files_are_asked_about() -> None:
    """Without a word, 1 is YES, and a warning says what to do if it means right."""
    reading = read_rows(("stim_ID", *PEOPLE), [(RAMP0, 1, 0, 1), (RAMP1, 0, 0, 1)])
    assert reading.counts == {RAMP0: (3, 2), RAMP1: (3, 1)}
    problem = reading.find("import-assumed-yes")
    assert problem.message == "holds 0 and 1 (or False and True), which are taken as NO and YES"
    assert problem.hint == (
        "if they mean wrong and right, give one row for each answer, with a column called correct"
    )


def test_a_person_comes_before_a_session() -> None:
    """Where service and game both have ids, the service's tell people, since somebody may play twice."""
    rows = [("game-1", ANN, RAMP0, "YES"), ("game-2", ANN, RAMP1, "NO"), ("game-3", BOB, RAMP0, "NO")]
    reading = read_rows(("gameID", "prolificIDAnon", "stim_ID", "response"), rows)
    assert reading.judgements is not None
    assert reading.judgements.account.n_participants == 2


@pytest.mark.parametrize("service", [("", "", ""), ("undefined", ANN, BOB), ("x", "x", "x")])
def test_ids_that_do_not_tell_people_apart_are_passed_over(service: tuple[str, str, str]) -> None:
    """A service's id that is missing, or the same for all, gives way to the game's."""
    games = ("game-1", "game-2", "game-3")
    rows = [(g, s, trial, "YES") for g, s in zip(games, service, strict=True) for trial in TRIALS]
    reading = read_rows(("gameID", "prolificID", "stim_ID", "response"), rows)
    assert reading.counts == dict.fromkeys(TRIALS, (3, 3))
    assert "participant from gameID" in reading.find("import-layout").message


def test_a_number_for_each_row_is_no_person() -> None:
    """A column that differs in every row names rows."""
    rows = [
        (f"{index:04x}", f"g{index // 4}", trial, "YES") for index, trial in enumerate([*TRIALS, *TRIALS])
    ]
    reading = read_rows(("session_id", "game_id", "stim_ID", "response"), rows)
    assert "participant from game_id" in reading.find("import-layout").message


def test_the_trials_column_is_the_one_that_names_trials() -> None:
    """A number under `trial` and a name that fits both copies give way to the column with whole paths."""
    rows = [
        (ANN, place, trial.split("/", 1)[1], f"/data/{trial}_img.mp4", "YES")
        for place, trial in enumerate(TRIALS)
    ]
    reading = read_rows(("participant", "trial", "filenames", "full_stim_paths", "response"), rows)
    assert reading.counts == dict.fromkeys(TRIALS, (1, 1))


def test_the_label_is_not_the_answer() -> None:
    """A column `answer` that only ever holds the right one gives way to people's own, or to correctness."""
    trials = [*TRIALS] * 3
    people = [ANN] * 4 + [BOB] * 4 + [CAT] * 4
    rows = [(p, t, TRIALS[t], "pressed", t == RAMP0) for p, t in zip(people, trials, strict=True)]
    reading = read_rows(("participant", "stim", "answer", "response", "correct"), rows)
    assert reading.counts == {RAMP0: (3, 3), RAMP1: (3, 3), WALL0: (3, 0), WALL1: (3, 3)}
    named = reading.find("import-layout").message
    assert named.endswith("participant from participant, trial from stim, correct from correct")


@pytest.mark.parametrize(
    ("header", "rows", "reason"),
    [
        (("gameID",), [("g1",)], "no column names trials"),
        (("participant", "age", "comment"), [(ANN, 31, "no")], "no column names trials"),
        (("stim", "participant"), [("elsewhere_1", ANN)], "no cell names a trial"),
        (("stim", "pred"), [(RAMP0, 1), (RAMP1, 0)], NOBODY),
        (("stim", "count"), [(RAMP0, 50), (RAMP1, 50)], "no column holds answers"),
        (("stim", "correct"), [(RAMP0, "0.7"), (RAMP1, "0.5")], NOBODY),
        (
            ("full_stim_paths", "target_hit_zone_labels", "star_phy"),
            [(RAMP0, True, 1)],
            "no column holds answers",
        ),
    ],
)
def test_other_files_are_passed_over(
    header: tuple[str, ...], rows: list[tuple[object, ...]], reason: str
) -> None:
    """Lists of games, surveys, predictions of models and lists of trials are named and not used."""
    reading = read(make_file(header, rows, "other.csv"), make_file(LONG, ROWS))
    assert reading.counts == COUNTS
    problem = reading.find("import-other-file")
    assert (problem.file, problem.message) == ("other.csv", f"is taken to hold no human data: {reason}")
    assert reading.judgements is not None
    assert reading.judgements.account.other_files == ("other.csv",)


def test_columns_that_may_be_named_for_people_are_told_by_place() -> None:
    """A name with digits that no file is known to use might be an id."""
    reading = read_rows(("participant", "a7", "response"), [(ANN, RAMP0, "YES")])
    assert "trial from column 2" in reading.find("import-layout").message


def test_one_unclear_answer_does_not_hide_a_person() -> None:
    """A column of a person stays one, and what is neither YES nor NO in it is refused."""
    rows = [(trial, "YES", "NO", "no" if trial != RAMP0 else "maybe") for trial in TRIALS]
    reading = read_rows(("stim_ID", *PEOPLE), rows)
    assert reading.judgements is None
    assert reading.find("import-answer").message == "answers that are neither YES nor NO: 1, such as 'maybe'"
