"""Submissions that were made before a trial was dropped stay valid, and so do those made after."""

from builders import build_reference
from leaderboard.reference.dropping import drop_trials
from raw_submissions import judge_predictions_file, predictions_csv

BEFORE = build_reference()
DROPPED = BEFORE.trial_ids[3]
AFTER = drop_trials(BEFORE, {DROPPED: "The video is empty."})
OLD_LINES = predictions_csv(BEFORE).splitlines()
NEW_LINES = [line for line in OLD_LINES if DROPPED not in line]


def judge(lines: list[str]) -> list[tuple[str, int | None, str]]:
    problems = judge_predictions_file("\n".join(lines), AFTER).problems
    return [(problem.code, problem.line, problem.message) for problem in problems]


def test_a_dropped_trial_is_ignored() -> None:
    """With and without its row a file gives the same predictions for the trials that are left."""
    old = judge_predictions_file("\n".join(OLD_LINES), AFTER).submission
    new = judge_predictions_file("\n".join(NEW_LINES), AFTER).submission
    assert old is not None
    assert new is not None
    assert old.probabilities.tolist() == new.probabilities.tolist()
    assert old.probabilities.size == BEFORE.n_trials - 1
    assert old.covered.all()
    assert new.covered.all()


def test_a_dropped_trial_may_stand_alone_of_its_scenario() -> None:
    """Its row begins no scenario, so the others of it are not missing."""
    scenario = DROPPED.partition("-copy")[0]
    others = [line for line in NEW_LINES if scenario not in line]
    submission = judge_predictions_file("\n".join([*others, f'"{DROPPED}",0.5']), AFTER).submission
    assert submission is not None
    assert not submission.covered[AFTER.in_scenario(scenario)].any()


def test_the_row_of_a_dropped_trial_is_judged_like_any() -> None:
    """It stood in a valid file, so it is no excuse for a broken value or for standing there twice."""
    broken = [f'"{DROPPED}",2' if DROPPED in line else line for line in OLD_LINES]
    assert [code for code, _, _ in judge(broken)] == ["probability-out-of-range"]
    assert [code for code, _, _ in judge([*OLD_LINES, f'"{DROPPED}",0.5'])] == ["duplicate-trial"]


def test_nothing_but_dropped_trials_is_no_submission() -> None:
    """There is nothing to grade, and the reason is told."""
    (problem,) = judge_predictions_file(f'{OLD_LINES[0]}\n"{DROPPED}",0.5', AFTER).problems
    assert (problem.code, problem.line) == ("other-benchmark", 2)
    assert problem.message == "every trial of the file was dropped from Tiny"
    assert problem.hint == f"the reason for {DROPPED}: The video is empty."
