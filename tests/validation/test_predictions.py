"""From rows to a table, or to what is wrong with them."""

import pytest
from raw_submissions import judge_predictions_file, predictions_csv, spread_probabilities

from builders import build_reference

REFERENCE = build_reference()
LINES = predictions_csv(REFERENCE).splitlines()


def judge(lines: list[str]) -> list[tuple[str, int | None, str]]:
    problems = judge_predictions_file("\n".join(lines), REFERENCE).problems
    return [(problem.code, problem.line, problem.message) for problem in problems]


def with_status(statuses: dict[int, tuple[str, str]]) -> list[str]:
    """The valid rows with a status column; some rows (from 0) with another probability and status."""
    given = {row: (str(p), "") for row, p in enumerate(spread_probabilities(REFERENCE))} | statuses
    rows = [f'"{i}",{given[row][0]},{given[row][1]}' for row, i in enumerate(REFERENCE.trial_ids)]
    return ["trial_id,probability,status", *rows]


def test_whole_scenarios_may_be_left_out() -> None:
    """What is not covered is neither answered nor wrong."""
    lines = [line for line in LINES if "alpha_two" not in line]
    submission = judge_predictions_file("\n".join(lines), REFERENCE).submission
    assert submission is not None
    assert (submission.covered == ~REFERENCE.in_scenario("alpha_two")).all()
    assert (submission.answered == submission.covered).all()
    assert (submission.probabilities[~submission.covered] == 0.5).all()


def test_within_a_scenario_every_trial_is_needed() -> None:
    """Each begun scenario says how many are missing, and the first of them."""
    lines = [line for line in LINES if "alpha_two" not in line and "/0002" not in line]
    assert judge(lines) == [
        (
            "missing-trials",
            None,
            (
                f"2 of the 8 trials of {scenario} are missing: "
                f"{scenario}-copy0/set=a,b/0002, {scenario}-copy1/set=a,b/0002"
            ),
        )
        for scenario in ("alpha_one", "beta_one")
    ]


def test_long_lists_of_missing_trials_are_cut() -> None:
    """Three are named and the rest counted."""
    assert judge(LINES[:18])[0][2].endswith(" beta_one-copy1/set=a,b/0001 and 4 more")


@pytest.mark.parametrize("status", ["refused", "unparsable", "error"])
def test_a_trial_may_go_unanswered_if_the_status_says_why(status: str) -> None:
    """It is covered and not answered, and counts 0.5 where a number is needed."""
    submission = judge_predictions_file("\n".join(with_status({3: ("", status)})), REFERENCE).submission
    assert submission is not None
    assert submission.covered.all()
    assert submission.answered.sum() == 23
    assert (submission.answered[3], submission.probabilities[3]) == (False, 0.5)


@pytest.mark.parametrize(
    ("probability", "status", "code", "message"),
    [
        ("", "", "probability-missing", "the probability is empty"),
        ("", "answered", "probability-missing", "the probability is empty though the status is answered"),
        ("0.5", "refused", "contradicting-status", "status refused stands beside the probability '0.5'"),
        ("0.5", "Answered", "unknown-status", "status 'Answered' is unknown"),
        ("", "skipped", "unknown-status", "status 'skipped' is unknown"),
    ],
)
def test_status_and_probability_must_agree(probability: str, status: str, code: str, message: str) -> None:
    """A row that contradicts itself is refused with its line."""
    assert judge(with_status({3: (probability, status)})) == [(code, 5, message)]


def test_a_repeated_trial_names_both_lines_and_values() -> None:
    """Which of the two counts is for the participant to say."""
    assert judge([*LINES, f'"{REFERENCE.trial_ids[0]}",0.9']) == [
        (
            "duplicate-trial",
            26,
            "trial 'alpha_one-copy0/set=a,b/0000' is on line 2 already ('0.0213' there, '0.9' here)",
        )
    ]


def test_ids_are_compared_as_text() -> None:
    """Leading zeros matter: 0001 and 1 are different ids."""
    assert ("unknown-trial", 3, "'alpha_one-copy1/set=a,b/0' is not a trial of Tiny") in judge(
        [line.replace("copy1/set=a,b/0000", "copy1/set=a,b/0") for line in LINES]
    )


def test_a_file_of_another_benchmark_is_one_problem() -> None:
    """Not one problem for each of its rows; a single unknown row is just that."""
    other = ["trial_id,probability", *(f"pilot_{n},0.5" for n in range(500))]
    assert judge(other) == [
        ("other-benchmark", 2, "none of the 500 ids is a trial of Tiny; the first is 'pilot_0'")
    ]
    assert [code for code, _, _ in judge(other[:2])] == ["unknown-trial"]


def test_missing_trials_are_not_counted_where_rows_cannot_be_read() -> None:
    """A row with broken quotes may be the one that seems to be missing."""
    assert [code for code, _, _ in judge([LINES[0], LINES[1][1:], *LINES[2:]])] == ["ragged-row"]


def test_only_the_first_unknown_ids_get_a_suggestion() -> None:
    """As many as are shown; looking for the others would take time for nothing."""
    wrong = [line.replace("_one-", "_on-").replace("_two-", "_to-") for line in LINES[2:]]
    problems = judge_predictions_file("\n".join([*LINES[:2], *wrong]), REFERENCE).problems
    hints = [problem.hint for problem in problems if problem.code == "unknown-trial"]
    assert len(hints) == 23
    assert all(hint.startswith("did you mean") for hint in hints[:20])
    assert hints[20:] == [""] * 3
