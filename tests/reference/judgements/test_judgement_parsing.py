"""What answers mean, what is refused, and how to say which column is which."""

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
from leaderboard.errors import SourceError
from leaderboard.reference.judgements import FileAccount
from leaderboard.reference.judgements.columns import ROLES
from leaderboard.reference.source_files import SourceFile

FULL = ("gameID", "stim_ID", "response", "correct", "label")


def test_every_row_is_accounted_for() -> None:
    """Practice, screens without answer, unknown names and unclear answers each have a number."""
    rows = [
        (ANN, "practice_1", "YES"),
        (ANN, RAMP0, "Next"),
        (ANN, RAMP0, "YES"),
        (ANN, f"{RAMP0}9", "YES"),
        (ANN, RAMP1, "maybe"),
        ("", RAMP1, "NO"),
        (BOB, "", "NO"),
        (BOB, RAMP0, "NO"),
    ]
    reading = read_rows(LONG, rows, allow_unmatched=True)
    assert reading.judgements is not None
    (account,) = reading.judgements.account.files
    assert account == FileAccount(
        file="people.csv",
        layout="one row for each answer",
        n_rows=8,
        n_practice=1,
        n_empty=2,
        n_unmatched=1,
        n_unclear=1,
        n_anonymous=1,
        n_used=2,
    )
    assert (account.n_matched, account.n_named) == (4, 5)
    assert [(p.code, p.line, p.message) for p in reading.problems[1:]] == [
        ("import-practice", 2, "answers to practice trials, left out: 1"),
        ("import-non-answer", 3, "answers that are empty or about no trial, left out: 2"),
        ("import-no-participant", 7, "answers without participant, left out: 1"),
        ("import-match", None, "4 of 5 answers name a trial"),
        ("import-unmatched", 5, f"1 of 5 answers name no trial, such as '{RAMP0}9'; left out"),
        ("import-answer-left-out", 6, "answers that are neither YES nor NO: 1, such as 'maybe'; left out"),
    ]


def test_answers_follow_from_correctness_and_label() -> None:
    """Without response, people said the label where they were right; without label, the reference's."""
    rows = [
        (ANN, RAMP0, True),
        (ANN, RAMP1, True),
        (BOB, RAMP0, False),
        (BOB, RAMP1, False),
        (CAT, RAMP0, ""),
    ]
    reading = read_rows(("gameID", "stim_ID", "correct"), rows)
    assert reading.counts == {RAMP0: (2, 1), RAMP1: (2, 1)}
    assert reading.codes == ["import-non-answer"]


def test_correctness_is_relative_to_the_label_of_its_file() -> None:
    """Where the file has another label than the list, its correctness was worked out with its own."""
    rows = [(ANN, t, True, label) for t, label in (TRIALS | {RAMP0: False}).items()]
    reading = read_rows(("gameID", "stim_ID", "correct", "label"), rows)
    assert reading.counts == {RAMP0: (1, 0), RAMP1: (1, 0), WALL0: (1, 1), WALL1: (1, 0)}
    problem = reading.find("import-people-label")
    assert (problem.line, problem.message) == (
        2,
        f"gives another label than the list, whose labels count, for 1 of 4 trials: {RAMP0}",
    )


def test_labels_that_mostly_differ_are_refused_if_answers_follow_from_them() -> None:
    """A label that is turned round would turn every answer; beside responses it is only reported."""
    rows = [(ANN, t, "YES", not label, True) for t, label in TRIALS.items()]
    turned = read_rows((*FULL[:2], "said", "label", "correct"), rows, columns={"correct": "correct"})
    assert turned.judgements is None
    assert turned.find("import-answer-meaning").message == (
        "answers follow from correctness and label here, and the label of 4 of 4 trials is another one"
    )
    beside = read_rows((*FULL[:2], "response", "label"), [row[:4] for row in rows])
    assert beside.counts == dict.fromkeys(TRIALS, (1, 1))
    assert beside.codes == ["import-people-label"]


def test_responses_go_before_correctness() -> None:
    """What a person did is taken; correctness was worked out from it, and a contradiction is reported."""
    rows = [(ANN, t, "YES", label, label) for t, label in TRIALS.items()] + [(BOB, RAMP0, "NO", True, True)]
    reading = read_rows(FULL, rows)
    assert reading.counts == dict.fromkeys(TRIALS, (1, 1)) | {RAMP0: (2, 1)}
    problem = reading.find("import-answer-contradiction")
    assert problem.line == 6
    assert problem.message == (
        "1 of 5 responses contradict their correctness; the responses are taken, "
        "since correctness was worked out from them"
    )


@pytest.mark.parametrize(("column", "n_yes"), [("response", 2), ("correct", 1)])
def test_answers_that_contradict_correctness_too_often_are_refused(column: str, n_yes: int) -> None:
    """Beyond slips, one of the two columns means something else; naming one says which counts."""
    rows = [(person, t, "YES", False, label) for person in (ANN, BOB) for t, label in TRIALS.items()]
    rows[0] = (ANN, RAMP0, "YES", True, True)
    reading = read_rows(FULL, rows)
    assert reading.judgements is None
    problem = reading.find("import-answer-meaning")
    assert problem.message == (
        "3 of 8 responses contradict their correctness, so one of the two does not mean what it seems to"
    )
    assert (
        problem.hint == "--columns response=... or correct=... names the column that counts, and then alone"
    )
    assert read_rows(FULL, rows, columns={column: column}).counts[RAMP0] == (2, n_yes)


def test_numbers_of_buttons_are_not_taken_for_answers() -> None:
    """Where buttons are listed, 1 may be the second of them, until somebody says that it is YES."""
    header = (*LONG, "choices")
    rows = [(ANN, RAMP0, 0, "['YES', 'NO']"), (BOB, RAMP0, 1, "['NO', 'YES']")]
    reading = read_rows(header, rows)
    assert reading.judgements is None
    problem = reading.find("import-answer-meaning")
    assert (
        problem.message == "choices lists the buttons, so 1 in response may be YES or the number of a button"
    )
    assert problem.hint == "--columns response=response takes it as YES"
    assert read_rows(header, rows, columns={"response": "response"}).counts == {RAMP0: (2, 1)}
    assert read_rows(header, [(ANN, RAMP0, "NO", "['YES', 'NO']")]).counts == {RAMP0: (1, 0)}


def test_unclear_answers_are_refused() -> None:
    """An answer that is neither YES nor NO might be all of one kind, so leaving them out is asked for."""
    rows = [(ANN, RAMP0, "YES"), (ANN, RAMP1, "73"), (BOB, RAMP1, "nope"), (BOB, RAMP0, "see me@example.com")]
    reading = read_rows(LONG, rows)
    assert reading.judgements is None
    problem = reading.find("import-answer")
    assert (problem.line, problem.message) == (
        3,
        "answers that are neither YES nor NO: 3, such as '73', 'nope'",
    )
    assert problem.hint == "--columns response=... names another column; --allow-unmatched leaves them out"
    assert read_rows(LONG, rows, allow_unmatched=True).counts == {RAMP0: (1, 1)}


def test_names_that_fit_two_trials_are_refused() -> None:
    """A name without its copy means neither of the two."""
    name = "0001_img.mp4"
    trials = {"ramp/0001": True, "0001": True, "wall/0002": True}
    rows = [(ANN, f"x/ramp/{name}", "YES"), (ANN, "wall/0002", "NO")]
    strict, lenient = (
        read(make_file(LONG, rows), trials=trials, allow_unmatched=allow) for allow in (False, True)
    )
    assert strict.judgements is None
    problem = strict.find("import-match-rate")
    assert (problem.line, problem.message) == (
        2,
        "1 of 2 answers fit several trials, such as 'x/ramp/0001_img.mp4', which fits 0001 and ramp/0001",
    )
    assert (
        problem.hint
        == "--columns trial=... names a column with longer names; --allow-unmatched leaves them out"
    )
    assert lenient.counts == {"wall/0002": (1, 0)}
    assert lenient.codes == ["import-ambiguous"]


def test_names_that_hold_an_id_are_not_quoted() -> None:
    """A path may lead through a person's folder; its line says enough."""
    names = (f"{ANN}/x/0001.mp4", f"{ANN}/{RAMP0}9")
    rows = [(ANN, name, "YES") for name in names]
    reading = read(make_file(LONG, rows), trials={"x/0001": True, "0001": False, **TRIALS})
    assert [(p.line, p.message) for p in reading.problems if p.is_error] == [
        (3, "1 of 2 answers name no trial"),
        (2, "1 of 2 answers fit several trials"),
    ]


def test_human_data_of_other_trials_are_refused() -> None:
    """People's answers of which none names a trial are no file to be passed over."""
    reading = read_rows(LONG, [(ANN, "elsewhere_1", "YES"), (BOB, "elsewhere_2", "NO")])
    assert reading.judgements is None
    problem = reading.find("import-match-rate")
    assert (problem.line, problem.message) == (2, "2 of 2 answers name no trial")
    assert problem.hint == "--allow-unmatched leaves them out"


def test_nothing_usable_is_an_error() -> None:
    """Neither no file nor only others give judgements."""
    assert read().find("import-no-judgements").message == (
        "none of 0 files holds answers or counts that can be used"
    )
    problem = read_rows(("a", "b"), [(1, 2)]).find("import-no-judgements")
    assert problem.message == "none of 1 files holds answers or counts that can be used"
    assert problem.hint == "--columns participant=...,trial=...,response=... names the columns that hold them"


def test_named_columns_go_before_recognised_ones() -> None:
    """Any column can be named for what it holds, in any case; the others are still recognised."""
    header = ("who", "clip", "stim_ID", "said", "response", "truth")
    rows = [(ANN, RAMP0, RAMP1, "NO", "YES", True), (BOB, RAMP0, RAMP1, "NO", "YES", True)]
    columns = {"participant": "WHO", "trial": "clip", "response": "said"}
    reading = read_rows(header, rows, columns=columns)
    assert reading.counts == {RAMP0: (2, 0)}
    assert reading.find("import-layout").message == (
        "is read as one row for each answer: participant from who, trial from clip, response from said, "
        "label from truth"
    )


def test_a_name_need_not_be_in_every_file() -> None:
    """Files without a named column are recognised as if nothing were named."""
    ours = make_file(("who", "stim", "response"), [(ANN, RAMP0, "YES"), (BOB, RAMP0, "NO")], "a.csv")
    theirs = make_file(LONG, [(CAT, RAMP1, "NO")], "b.csv")
    reading = read(ours, theirs, columns={"participant": "who"})
    assert reading.counts == {RAMP0: (2, 1), RAMP1: (1, 0)}
    assert reading.codes == []


def test_named_columns_that_are_not_there_are_refused() -> None:
    """The columns that are there are listed, but not those that may be named for people."""
    wide = make_file(("stim_ID", "rt", "", ANN, "anna", "remark"), [(RAMP0, 1.5, 0, "YES", "NO", "?")])
    reading = read(wide, columns={"participant": "who", "person": "x"})
    assert reading.judgements is None
    assert [(p.code, p.file, p.message, p.hint) for p in reading.problems] == [
        (
            "import-columns",
            "--columns",
            "no file has a column 'who' for the participant",
            "people.csv has stim_ID, rt, remark, 3 more that may be named for people or have no name",
        ),
        (
            "import-columns",
            "--columns",
            f"--columns knows no 'person'; it knows {', '.join(ROLES)}",
            "",
        ),
    ]


@pytest.mark.parametrize(
    "content",
    [
        f"\ufeffprolificID,stim_ID,response\r\n{ANN},{RAMP0},YES\r\n{BOB},{RAMP0},NO\r\n",
        f"prolificID;stim_ID;response\n{ANN};{RAMP0};YES\n{BOB};{RAMP0};NO\n\n\n",
        f"prolificID\tstim_ID\tresponse\n{ANN}\t{RAMP0}\tYES\n{BOB}\t{RAMP0}\tNO\n",
        f',prolificID,stim_ID,response,note\n0,{ANN},{RAMP0},YES,"two\nlines, a ""quote"""\n1,{BOB},{RAMP0},NO,\n',  # noqa: E501
    ],
)  # fmt: skip
def test_encodings_and_separators_do_not_matter(content: str) -> None:
    """Byte-order mark, CRLF, semicolons, tabs, comments over several lines and an index column."""
    assert read(SourceFile("people.csv", "people.csv", content.encode())).counts == {RAMP0: (2, 1)}


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (
            f"prolificID,stim_ID,response\n{ANN},{RAMP0}\n",
            r"people\.csv:2: has 2 cells where the header has 3",
        ),
        (f"stim_ID,{ANN},{BOB},{ANN}\n{RAMP0},1,0,1\n", r"people\.csv:1: columns 2 and 4 have the same name"),
    ],
)
def test_irregular_tables_are_refused_without_naming_anybody(content: str, message: str) -> None:
    """A ragged row and two equal columns are refused by line and place."""
    with pytest.raises(SourceError, match=f"^{message}$"):
        read(SourceFile("people.csv", "people.csv", content.encode()))
