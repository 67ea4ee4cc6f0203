"""What the ledger must say before submissions may be published as they are."""

import datetime as dt
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from git_trees import GitTrees
from leaderboard.files import sha256_hex
from leaderboard.instance import Instance
from leaderboard.ledger import HEADER
from leaderboard.recording import LedgerUpdate, check_ledger, open_history, update_ledger

DAY = dt.date(2026, 6, 1)
HEAD = ",".join(HEADER) + "\n"


def result_json(**changes: Any) -> str:
    """Make a result with one score; changes go by key, those of its inputs too."""
    result: dict[str, Any] = {
        "metrics_version": 1,
        "grader": "0.1.0",
        "inputs": {
            "predictions_sha256": "1" * 64,
            "reference_digest": "2" * 64,
            "reference_kind": "synthetic",
        },
        "coverage": {"trials": 12},
        "scores": {
            "overall": {"all": {"n": 12, "accuracy": {"value": 0.5, "low": 0.4, "high": 0.6}}},
            "Mass": {"hard": {"n": 4, "auc": {"value": None, "why": "no labels"}}},
        },
        "checks": [],
    }
    for key, value in changes.items():
        (result["inputs"] if key in result["inputs"] else result)[key] = value
    return json.dumps(result)


@dataclass(frozen=True)
class Place:
    """An instance in a repository."""

    instance: Instance
    git: GitTrees

    def write(self, slug: str, result: str) -> None:
        folder = self.instance.submission_dir(slug)
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "result.json").write_text(result, encoding="utf-8")

    def commit(self) -> None:
        self.git.run("add", "--all")
        self.git.run("commit", "-q", "--allow-empty", "-m", "message")

    def update(self, day: dt.date = DAY) -> LedgerUpdate:
        history = open_history(self.instance)
        assert history is not None
        return update_ledger(self.instance, history.find_result, today=day)

    def publish(self, day: dt.date = DAY) -> None:
        """Commit the results, then the ledger's new lines, as publishing does."""
        self.commit()
        update = self.update(day)
        assert update.problems == ()
        self.instance.ledger_file.write_bytes(update.content)
        self.commit()

    def ledger(self) -> str:
        return self.instance.ledger_file.read_text(encoding="utf-8")

    def complaints(self) -> list[tuple[str, str, str, int | None]]:
        check = check_ledger(self.instance, open_history(self.instance))
        assert check.is_sound == (not check.problems)
        return [(p.code, p.message, p.file, p.line) for p in check.problems]


@pytest.fixture
def place(tmp_path: Path) -> Place:
    place = Place(Instance(tmp_path), GitTrees(tmp_path).init())
    place.write("first", result_json())
    return place


def test_new_submissions_are_added(place: Place) -> None:
    """One line each, by slug, with the checksum of the result; then nothing is left to add."""
    place.write("second", result_json(grader="x"))
    place.publish()
    digests = [sha256_hex(result_json(**changes).encode()) for changes in ({}, {"grader": "x"})]
    assert place.ledger() == (
        f"{HEAD}2026-06-01,first,added,new submission,{digests[0]}\n"
        f"2026-06-01,second,added,new submission,{digests[1]}\n"
    )
    assert place.update().added == ()
    assert place.complaints() == []


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"metrics_version": 2}, "metrics_version 1 -> 2"),
        (
            {"reference_digest": "3" * 64, "reference_kind": "official"},
            "reference 222222222222 (synthetic) -> 333333333333 (official)",
        ),
        (
            {"metrics_version": 3, "reference_digest": "3" * 64},
            "metrics_version 1 -> 3, reference 222222222222 (synthetic) -> 333333333333 (synthetic)",
        ),
        ({"grader": "0.2.0"}, 'no number changed: grader "0.1.0" -> "0.2.0"'),
        ({"checks": [{"code": "x"}]}, "no number changed: other remarks by the same grader"),
    ],
)
def test_results_are_regraded_for_a_reason(place: Place, changes: dict[str, Any], reason: str) -> None:
    """The reason says what changed, from what to what; scores may change with it."""
    place.publish()
    scores: dict[str, Any] = {} if reason.startswith("no number") else {"scores": {}}
    place.write("first", result_json(**changes, **scores))
    (line,) = place.update().added
    assert (line.slug, line.event, line.reason) == ("first", "regraded", reason)
    place.publish()
    assert place.complaints() == []


def test_a_score_that_changes_without_a_reason_is_refused(place: Place) -> None:
    """Each number is named with its scope, subset and metric, what it was, what it is, and the cause."""
    place.publish()
    scores = {"overall": {"all": {"n": 12, "accuracy": {"value": 0.7, "low": 0.4, "high": 0.9}}}}
    place.write("first", result_json(scores=scores, grader="0.2.0"))
    update = place.update()
    assert not update.is_allowed
    cause = '(grader "0.1.0" -> "0.2.0")'
    assert [(p.code, p.message) for p in update.problems] == [
        ("ledger-score", f"overall all accuracy was 0.5 [0.4, 0.6], is now 0.7 [0.4, 0.9] {cause}"),
        ("ledger-score", f"Mass hard n was 4, is now absent {cause}"),
        ("ledger-score", f'Mass hard auc was {{"value": null, "why": "no labels"}}, is now absent {cause}'),
    ]
    assert {p.file for p in update.problems} == {"submissions/first/result.json"}


def test_edited_numbers_are_told_from_another_grader(place: Place) -> None:
    """The cause is that the same grader is said to have found another number."""
    place.publish()
    place.write("first", result_json(coverage={"trials": 11}))
    (problem,) = place.update().problems
    assert problem.message == "coverage trials was 12, is now 11 (other bytes by the same grader)"


@pytest.mark.parametrize(
    ("result", "expected"),
    [
        (
            result_json(predictions_sha256="9" * 64, metrics_version=2),
            ("ledger-predictions", "is made from other predictions than were published"),
        ),
        (result_json(metrics_version=0), ("ledger-score", "metrics_version goes back from 1 to 0")),
        ("[]", ("ledger-result", "is not a result, or the published one was not")),
        ('{"inputs": 1}', ("ledger-result", "is not a result, or the published one was not")),
        ("[" * 100_000, ("ledger-result", "is not a result, or the published one was not")),
    ],
    ids=["predictions", "backwards", "list", "shape", "deep"],
)
def test_other_replacements_are_refused(place: Place, result: str, expected: tuple[str, str]) -> None:
    """Predictions are frozen, versions only go up, and a result is one."""
    place.publish()
    place.write("first", result)
    assert [(p.code, p.message) for p in place.update().problems] == [expected]


def test_what_replaces_an_unknown_result_is_refused(place: Place) -> None:
    """Without the published result nobody can say what changed."""
    place.publish()
    place.write("first", result_json(metrics_version=2))
    update = update_ledger(place.instance, lambda _slug, _sha256: None, today=DAY)
    hint = (
        "in a shallow clone: git fetch --unshallow; "
        "if its line was never committed, take that line out of the ledger"
    )
    assert [(p.code, p.hint) for p in update.problems] == [("ledger-result", hint)]


def test_a_missing_result_is_refused(place: Place) -> None:
    """What is not graded is not published."""
    (place.instance.submission_dir("first") / "result.json").unlink()
    place.commit()
    assert [(p.code, p.message) for p in place.update().problems] == [("ledger-result", "is missing")]


def test_a_broken_ledger_is_not_extended(place: Place) -> None:
    """What cannot be understood is not appended to."""
    place.instance.ledger_file.write_text("x")
    place.commit()
    update = place.update()
    assert ([p.code for p in update.problems], update.content) == (["ledger-malformed"], b"")


def test_published_submissions_do_not_vanish(place: Place) -> None:
    """A folder may go when a line withdraws it, not before."""
    place.publish()
    (place.instance.submission_dir("first") / "result.json").unlink()
    place.instance.submission_dir("first").rmdir()
    expected = ("ledger-vanished", "first was published and is gone")
    assert [(p.code, p.message) for p in place.update().problems] == [expected]
    assert [found[:2] for found in place.complaints()] == [expected]
    line = place.ledger().splitlines()[1].replace("added,new submission", "withdrawn,its authors asked")
    place.instance.ledger_file.write_text(f"{place.ledger()}{line}\n")
    assert place.complaints() == []


def test_withdrawn_submissions_are_left_alone(place: Place) -> None:
    """Whatever becomes of its result, nothing is added after that."""
    place.publish()
    line = place.ledger().splitlines()[1].replace("added,new submission", "withdrawn,its authors asked")
    place.instance.ledger_file.write_text(f"{place.ledger()}{line}\n")
    place.write("first", result_json(metrics_version=2))
    assert place.update().added == ()
    assert place.complaints() == []


def test_dates_never_go_back(place: Place) -> None:
    """A machine whose clock is slow writes the date of the line above."""
    place.publish(dt.date(2026, 7, 1))
    place.write("second", result_json())
    place.publish(dt.date(2026, 6, 1))
    assert place.ledger().splitlines()[2].startswith("2026-07-01,second,")


def test_what_is_not_recorded_is_named(place: Place) -> None:
    """No line, another result, no result: each says what to run."""
    place.commit()
    folder = "submissions/first"
    assert place.complaints() == [("ledger-unrecorded", "has no line in the ledger", folder, None)]
    place.publish()
    place.write("first", result_json(metrics_version=2))
    message = "its result.json is not the one that the ledger records"
    assert place.complaints() == [("ledger-unrecorded", message, folder, None)]
    (place.instance.submission_dir("first") / "result.json").unlink()
    message = "has no result.json, and the ledger records one"
    assert place.complaints() == [("ledger-unrecorded", message, folder, None)]


def test_lines_are_never_rewritten(place: Place) -> None:
    """Each version must begin with the one before it; the first that does not is named with its line."""
    place.publish()
    commit = place.git.run("rev-parse", "HEAD").decode()[:12]
    place.instance.ledger_file.write_text(place.ledger().replace("new submission", "a better reason"))
    message = f"the file as it is does not begin with what commit {commit} published"
    expected = [("ledger-rewritten", message, "submissions/ledger.csv", 2)]
    assert place.complaints() == expected
    place.commit()
    later = place.git.run("rev-parse", "HEAD").decode()[:12]
    message = f"commit {later} does not begin with what commit {commit} published"
    assert place.complaints() == [("ledger-rewritten", message, "submissions/ledger.csv", 2)]


def test_the_ledger_is_never_removed(place: Place) -> None:
    """Neither for now nor for a while."""
    place.publish()
    text = place.ledger()
    place.instance.ledger_file.unlink()
    assert [found[0] for found in place.complaints()] == ["ledger-rewritten", "ledger-unrecorded"]
    place.commit()
    place.instance.ledger_file.write_text(text)
    place.commit()
    assert place.complaints() == []


def test_what_was_only_on_a_side_branch_was_not_published(place: Place) -> None:
    """A branch that tried other lines before it was merged has rewritten nothing."""
    place.publish()
    text = place.ledger()
    place.git.run("switch", "-q", "-c", "side")
    place.instance.ledger_file.write_text(text + text.splitlines()[1].replace("added", "flagged") + "\n")
    place.commit()
    place.instance.ledger_file.write_text(text)
    place.commit()
    place.git.run("switch", "-q", "main")
    place.git.run("merge", "-q", "--no-ff", "-m", "merge", "side")
    assert place.complaints() == []


def test_without_a_repository_there_is_no_history(tmp_path: Path) -> None:
    """The ledger is checked all the same."""
    instance = Instance(tmp_path / "alone")
    instance.submission_dir("first").mkdir(parents=True)
    (instance.submission_dir("first") / "result.json").write_text(result_json())
    assert open_history(instance) is None
    assert [p.code for p in check_ledger(instance, None).problems] == ["ledger-unrecorded"]


def test_an_instance_may_lie_in_a_folder_of_its_repository(tmp_path: Path) -> None:
    """Its ledger's history is found there."""
    place = Place(Instance(tmp_path / "inner"), GitTrees(tmp_path).init())
    place.write("first", result_json())
    place.publish()
    place.instance.ledger_file.write_text(HEAD)
    assert [found[0] for found in place.complaints()] == ["ledger-rewritten", "ledger-unrecorded"]
