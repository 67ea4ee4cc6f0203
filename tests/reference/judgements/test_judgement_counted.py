"""Files of counts instead of single answers."""

import pytest

from judgement_files import ANN, BOB, LONG, RAMP0, RAMP1, WALL0, WALL1, make_file, read, read_rows


@pytest.mark.parametrize(
    ("header", "rows"),
    [
        (("stim_ID", "correct", "c"), [(RAMP0, "0.7142857142857143", 91), (RAMP1, "0.25", 4)]),
        (("stim_ID", "correct", "c"), [(f"{RAMP0}_img", "0.7142857142857143", "91.0"), (RAMP1, "0.25", 4)]),
        (("video", "p_yes", "count"), [(RAMP0, "0.7142857142857143", 91), (RAMP1, "0.75", 4)]),
        (("video", "n_yes", "n"), [(RAMP0, 65, 91), (RAMP1, 3, 4)]),
        (("stim", "accuracy", "n_raters", "label"), [(RAMP0, "0.71", 91, 1), (RAMP1, "0.25", 4, 0)]),
    ],
)
def test_counts_in_every_form(header: tuple[str, ...], rows: list[tuple[object, ...]]) -> None:
    """Shares of right answers or of YES, exact or rounded, and counts of YES come to the same."""
    reading = read_rows(header, rows)
    assert reading.counts == {RAMP0: (91, 65), RAMP1: (4, 3)}
    assert reading.judgements is not None
    assert reading.judgements.responses is None


def test_shares_of_right_answers_are_turned_by_the_label_of_their_file() -> None:
    """People were called right by the label that the file has, whether or not the list has the same."""
    rows = [
        (RAMP0, "0.25", 4, "False"),
        (RAMP1, "0.25", 4, "False"),
        (WALL0, 1, 4, "True"),
        (WALL1, 1, 4, "False"),
    ]
    reading = read_rows(("stim", "accuracy", "n", "label"), rows)
    assert reading.counts == {RAMP0: (4, 3), RAMP1: (4, 3), WALL0: (4, 4), WALL1: (4, 0)}
    assert reading.codes == ["import-people-label"]


def test_share_of_no_whole_number_is_left_out() -> None:
    """With rounded shares a row counts only if exactly one number of people is printed so."""
    rows = [(RAMP0, "0.333", 3), (RAMP1, "0.5", 3), (WALL0, "0.333", 9000)]
    reading = read_rows(("stim_ID", "p_yes", "c"), rows)
    assert reading.counts == {RAMP0: (3, 1)}
    problem = reading.find("import-count")
    assert (problem.line, problem.message) == (
        3,
        "rows whose share is that of no whole number of people, left out: 2",
    )
    assert reading.judgements is not None
    (account,) = reading.judgements.account.files
    assert (account.n_rows, account.n_unclear, account.n_used) == (3, 2, 1)


@pytest.mark.parametrize(
    ("header", "row", "rule"),
    [
        (("stim_ID", "correct", "c"), (RAMP0, 84, 100), "a share from 0 to 1 as correct"),
        (("stim_ID", "n_yes", "c"), (RAMP0, 5, 4), "a whole number of at most that as n_yes"),
    ],
)
def test_impossible_numbers_are_refused(header: tuple[str, ...], row: tuple[object, ...], rule: str) -> None:
    """Percentages, and more people who said YES than were asked, are not guessed at."""
    reading = read_rows(header, [row])
    assert reading.judgements is None
    message = f"1 of 1 rows do not have a whole number as count and {rule}"
    problem = reading.find("import-people-value")
    assert (problem.line, problem.message) == (2, message)


def test_unrated_and_practice_rows_are_left_out() -> None:
    """Trials that nobody judged, rows without numbers and practice trials are no judgements."""
    rows = [(RAMP0, 1, 2), (RAMP1, 0, 0), (WALL0, "", ""), ("practice_1", 1, 2)]
    reading = read_rows(("stim_ID", "n_yes", "n"), rows)
    assert reading.counts == {RAMP0: (2, 1)}
    assert reading.codes == ["import-practice", "import-non-answer"]


def test_rows_that_name_no_trial_are_refused() -> None:
    """A file of counts must match as well as one of answers."""
    reading = read_rows(("stim_ID", "n_yes", "n"), [(RAMP0, 1, 2), (f"{RAMP0}9", 1, 2)])
    assert reading.judgements is None
    problem = reading.find("import-match-rate")
    assert problem.message == f"1 of 2 rows name no trial, such as '{RAMP0}9'"
    assert problem.hint == f"the nearest trial is {RAMP0}; --allow-unmatched leaves them out"


def test_same_counts_twice_count_once_and_others_are_refused() -> None:
    """Two files may hold the same table; where they differ nobody knows which people are in both."""
    header = ("stim_ID", "n_yes", "n")
    one, same, other = (
        make_file(header, [(RAMP0, 1, n)], f"{n}{name}.csv") for n, name in ((2, "a"), (2, "b"), (3, "c"))
    )
    wider = make_file((*header, "scenario"), [(RAMP0, 1, 2, "ramp")], "wider.csv")
    assert read(one, wider).counts == {RAMP0: (2, 1)}
    assert read(one, same).codes == ["import-same-file"]
    problem = read(one, other).find("import-two-counts")
    assert problem.message == (
        f"1 of 3 people said YES to {RAMP0}, and 1 of 2 in 2a.csv:2; trials with such different counts: 1"
    )
    assert problem.hint == "leave out one of the two, or add them up if they are of different people"


def test_single_answers_go_before_counts() -> None:
    """Counts beside single answers of the same trials only check them."""
    people = make_file(LONG, [(ANN, RAMP0, "YES"), (BOB, RAMP0, "NO")])
    same = make_file(("stim_ID", "n_yes", "n"), [(RAMP0, 1, 2)], "counts.csv")
    other = make_file(("stim_ID", "n_yes", "n"), [(RAMP0, 2, 3)], "counts.csv")
    assert read(people, same).codes == []
    reading = read(people, other)
    assert reading.counts == {RAMP0: (2, 1)}
    assert reading.judgements is not None
    assert reading.judgements.responses is not None
    assert reading.find("import-counts-differ").message == (
        f"gives other counts than single answers, which are taken, for 1 of 1 trials: {RAMP0}"
    )


def test_single_answers_to_some_trials_become_counts() -> None:
    """A reference has single answers for all judged trials or for none, so none are kept here."""
    people = make_file(LONG, [(ANN, RAMP0, "YES"), (BOB, RAMP0, "NO")])
    counts = make_file(("stim_ID", "n_yes", "n"), [(RAMP1, 2, 3)], "counts.csv")
    reading = read(people, counts)
    assert reading.counts == {RAMP0: (2, 1), RAMP1: (3, 2)}
    assert reading.judgements is not None
    assert reading.judgements.responses is None
    assert reading.judgements.account.n_participants == 0
    assert reading.find("import-only-counts").message == (
        "of 2 judged trials, 1 have single answers; a reference has these for all judged trials or for none, "
        "so only counts are kept"
    )
