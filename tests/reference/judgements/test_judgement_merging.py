"""Nobody counts twice."""

from judgement_files import ANN, BOB, LONG, RAMP0, RAMP1, WALL0, make_file, read, read_rows
from leaderboard.reference.judgements import Response


def test_responses_come_by_participant_in_the_order_of_answering() -> None:
    """Participants are numbered, their answers stay in the order of rows, and counts add them up."""
    reading = read_rows(
        LONG, [(BOB, WALL0, "NO"), (ANN, RAMP1, "YES"), (BOB, RAMP0, "YES"), (ANN, RAMP0, "NO")]
    )
    assert reading.judgements is not None
    assert reading.judgements.responses == (
        Response("p001", RAMP1, is_yes=True),
        Response("p001", RAMP0, is_yes=False),
        Response("p002", WALL0, is_yes=False),
        Response("p002", RAMP0, is_yes=True),
    )
    assert reading.counts == {RAMP0: (2, 1), RAMP1: (1, 1), WALL0: (1, 0)}
    assert list(reading.judgements.ratings) == [RAMP0, RAMP1, WALL0]


def test_a_column_may_number_the_answers() -> None:
    """Where rows are numbered by trial of the session, that is the order, whatever the order of rows."""
    rows = [(ANN, RAMP0, "YES", "2"), (ANN, WALL0, "NO", "0"), (ANN, RAMP1, "YES", "1")]
    reading = read_rows((*LONG, "trialNum"), rows)
    assert reading.judgements is not None
    assert reading.judgements.responses is not None
    assert [response.trial_id for response in reading.judgements.responses] == [WALL0, RAMP1, RAMP0]


def test_tables_of_people_keep_no_order() -> None:
    """Where trials are columns nobody knows when they were answered, so they come as in the reference."""
    reading = read_rows(("participant", WALL0, RAMP1, RAMP0), [(ANN, "YES", "NO", "YES")])
    assert reading.judgements is not None
    assert reading.judgements.responses is not None
    assert [response.trial_id for response in reading.judgements.responses] == [RAMP0, RAMP1, WALL0]


def test_the_first_of_two_answers_counts() -> None:
    """Equal ones are noted; of different ones the first was given without having seen the trial before."""
    rows = [
        (ANN, RAMP0, "YES"),
        (ANN, RAMP1, "NO"),
        (ANN, RAMP0, "yes"),
        (ANN, RAMP1, "YES"),
        (BOB, RAMP1, "YES"),
    ]
    reading = read_rows(LONG, rows)
    assert reading.counts == {RAMP0: (1, 1), RAMP1: (2, 1)}
    assert [(p.code, p.line, p.message) for p in reading.problems[2:]] == [
        (
            "import-same-answer",
            4,
            "answers that repeat an earlier one of the same person to the same trial, and count once: 1",
        ),
        (
            "import-changed-answer",
            5,
            "answers that differ from an earlier one of the same person to the same trial, which counts: 1",
        ),
    ]
    assert reading.judgements is not None
    assert (reading.judgements.account.n_repeated, reading.judgements.account.n_changed) == (1, 1)


def test_people_are_the_same_in_all_files() -> None:
    """One raw id is one person, whichever file comes first."""
    first = make_file(LONG, [(ANN, RAMP0, "YES"), (BOB, RAMP0, "NO")], "a.csv")
    second = make_file(LONG, [(ANN, RAMP1, "NO"), (ANN, RAMP0, "NO")], "b.csv")
    reading = read(first, second)
    assert reading == read(second, first)
    assert reading.counts == {RAMP0: (2, 1), RAMP1: (1, 0)}
    assert reading.judgements is not None
    assert reading.judgements.account.n_participants == 2
    assert reading.codes == ["import-changed-answer"]


def test_numbers_in_several_files_are_asked_about() -> None:
    """Person 1 of one file may be another one than person 1 of the next."""
    files = [
        make_file(LONG, [(1, trial, "YES"), (2, trial, "NO")], f"{trial[:4]}.csv") for trial in (RAMP0, WALL0)
    ]
    reading = read(*files)
    assert reading.counts == {RAMP0: (2, 1), WALL0: (2, 1)}
    problem = reading.find("import-participant-numbers")
    assert problem.message == (
        "participants with the same plain number in several files, each of whom counts as one: 2"
    )
    assert problem.hint == (
        "if the files number different people, make the numbers distinct, such as mass-1 and friction-1"
    )


def test_the_same_file_twice_counts_once() -> None:
    """A copy under another name changes nothing, nor does what an operating system adds to an archive."""
    rows = [(ANN, RAMP0, "YES"), (BOB, RAMP0, "NO")]
    once, again = make_file(LONG, rows, "data/a.csv"), make_file(LONG, rows, "data/b.csv")
    shadow = make_file(("\x07",), [], "__MACOSX/data/._a.csv")
    reading = read(again, shadow, once)
    assert reading.judgements == read(once).judgements
    problem = reading.find("import-same-file")
    assert (problem.file, problem.message) == (
        "data/b.csv",
        "is the same file as data/a.csv, and counts once",
    )


def test_answers_of_nobody_become_counts() -> None:
    """Without participants it cannot be told who answered twice, so single answers are not kept."""
    reading = read_rows(LONG[1:], [(RAMP0, "YES"), (RAMP0, "NO"), (RAMP1, "NO")])
    assert reading.counts == {RAMP0: (2, 1), RAMP1: (1, 0)}
    assert reading.judgements is not None
    assert reading.judgements.responses is None
    problem = reading.find("import-only-counts")
    assert problem.message == "does not say who gave its 3 answers, so only counts are kept"
    assert problem.hint == "--columns participant=... names the column that does"


def test_answers_without_participant_are_left_out() -> None:
    """Where others have one, an answer without an id is nobody's."""
    reading = read_rows(
        LONG, [(ANN, RAMP0, "YES"), ("", RAMP0, "YES"), ("nan", RAMP1, "NO"), (BOB, RAMP0, "NO")]
    )
    assert reading.counts == {RAMP0: (2, 1)}
    problem = reading.find("import-no-participant")
    assert (problem.line, problem.message) == (3, "answers without participant, left out: 2")
