"""Who stands where on a board, and which results may stand there at all."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w

from builders import build_entry, build_metadata, build_reference, build_submission
from leaderboard.errors import InstanceError, LeaderboardError
from leaderboard.files import sha256_hex
from leaderboard.grading import grade, result_bytes
from leaderboard.ranking import Entry, load_entry, rank_entries
from leaderboard.reference import Reference
from leaderboard.submission import RawSubmission, read_submission


@pytest.fixture
def reference() -> Reference:
    """Build a small paired reference with people."""
    return build_reference()


def _entry(reference: Reference, slug: str, n_right: int, **changes: Any) -> Entry:
    """Make an entry that is right on the first so many trials of each property."""
    probabilities = np.where(reference.labels == 1, 0.1, 0.9)
    for index in range(len(reference.benchmark.properties)):
        trials = np.flatnonzero(reference.properties == index)[:n_right]
        probabilities[trials] = 1 - probabilities[trials]
    return build_entry(reference, slug, probabilities.tolist(), **changes)


def test_equal_scores_share_a_rank_and_the_next_one_skips(reference: Reference) -> None:
    """Two equals at the top are both first, and the third is third; equals are listed by slug."""
    entries = [_entry(reference, slug, n) for slug, n in (("ccc", 2), ("bbb", 5), ("aaa", 5))]
    board = rank_entries(entries, reference.benchmark.default_track)
    assert [(row.entry.slug, row.rank) for row in board.ranked] == [("aaa", 1), ("bbb", 1), ("ccc", 3)]


def test_lower_is_better_where_the_metric_says_so(reference: Reference) -> None:
    """By Brier score the smallest comes first."""
    entries = [_entry(reference, "low", 8), _entry(reference, "high", 1)]
    board = rank_entries(entries, reference.benchmark.default_track, "brier")
    assert [row.entry.slug for row in board.ranked] == ["low", "high"]


def test_baselines_and_partial_submissions_are_shown_and_not_ranked(reference: Reference) -> None:
    """They keep their own places, whatever their scores."""
    covered = reference.properties == 0
    partial = build_entry(reference, "part", [0.5] * reference.n_trials, covered=covered.tolist())
    entries = [_entry(reference, "base", 8, family="baseline"), partial, _entry(reference, "full", 1)]
    board = rank_entries(entries, reference.benchmark.default_track)
    shown = [(row.entry.slug, row.rank) for row in board.rows]
    assert shown == [("full", 1), ("part", None), ("base", None)]


def test_each_track_is_its_own_board_but_baselines_are_on_all(reference: Reference) -> None:
    """A submission appears only on the track that its protocol belongs to."""
    entries = [
        _entry(reference, "with", 3),
        _entry(reference, "without", 3, testing="without_property"),
        _entry(reference, "base", 3, family="baseline"),
    ]
    boards = [rank_entries(entries, track) for track in reference.benchmark.tracks]
    assert [[row.entry.slug for row in board.rows] for board in boards] == [
        ["with", "base"],
        ["without", "base"],
    ]


def test_an_undefined_score_has_no_rank_but_is_listed(reference: Reference) -> None:
    """Constant probabilities have no correlation with people; they come last without a rank."""
    constant = build_entry(reference, "constant", [0.5] * reference.n_trials)
    rng = np.random.default_rng(1)
    other = build_entry(reference, "other", rng.random(reference.n_trials).tolist())
    board = rank_entries([constant, other], reference.benchmark.default_track, "human_r")
    assert [(row.entry.slug, row.rank) for row in board.ranked] == [("other", 1), ("constant", None)]


@pytest.mark.parametrize("metric", ["yes_rate", "beauty"])
def test_metrics_without_a_better_end_do_not_rank(reference: Reference, metric: str) -> None:
    """The message names those that do."""
    with pytest.raises(LeaderboardError, match=f"cannot rank by '{metric}'") as caught:
        rank_entries([], reference.benchmark.default_track, metric)
    assert "choose one of accuracy, accuracy_p, human_r" in caught.value.hint


def _write(folder: Path, reference: Reference) -> RawSubmission:
    """Write a graded submission whose predictions file is any text: only its checksum matters here."""
    folder.mkdir()
    predictions = b"trial_id,probability\n"
    submission = build_submission(reference, [0.5] * reference.n_trials)
    submission = replace(submission, predictions_sha256=sha256_hex(predictions))
    metadata = build_metadata().model_dump(exclude_none=True)
    (folder / "predictions.csv").write_bytes(predictions)
    (folder / "submission.toml").write_text(tomli_w.dumps(metadata))
    (folder / "result.json").write_bytes(result_bytes(grade(submission, reference)))
    return read_submission(folder, f"submissions/{folder.name}")


def test_a_fresh_result_is_loaded(tmp_path: Path, reference: Reference) -> None:
    """What was written is what is read."""
    entry = load_entry(_write(tmp_path / "mine", reference), reference)
    assert (entry.slug, entry.metadata) == ("mine", build_metadata())


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("inputs.predictions_sha256", "2" * 64, "was made from other predictions"),
        ("inputs.reference_digest", "2" * 64, "was made with another reference"),
        ("inputs.reference_kind", "official", "was made with another reference"),
        ("metrics_version", 999, "was made by another version of the metrics"),
        ("schema", 2, "is not a result of this version"),
        ("scores", [], "is not a result of this version"),
    ],
)
def test_a_stale_or_forged_result_is_refused(
    tmp_path: Path, reference: Reference, path: str, value: object, message: str
) -> None:
    """A result that does not belong to the files beside it never reaches the board."""
    _write(tmp_path / "mine", reference)
    file = tmp_path / "mine/result.json"
    content = json.loads(file.read_text())
    *parents, last = path.split(".")
    target = content
    for parent in parents:
        target = target[parent]
    target[last] = value
    file.write_text(json.dumps(content))
    with pytest.raises(InstanceError, match=message) as caught:
        load_entry(read_submission(tmp_path / "mine", "submissions/mine"), reference)
    assert caught.value.hint == "grade it again: leaderboard grade submissions/mine"


@pytest.mark.parametrize("name", ["result.json", "predictions.csv", "submission.toml"])
def test_a_missing_file_is_named_with_what_to_do(tmp_path: Path, reference: Reference, name: str) -> None:
    """Without a result the hint is to grade; without anything else, to validate."""
    _write(tmp_path / "mine", reference)
    (tmp_path / "mine" / name).unlink()
    with pytest.raises(InstanceError, match=rf"submissions/mine/{name} is missing") as caught:
        load_entry(read_submission(tmp_path / "mine", "submissions/mine"), reference)
    assert "leaderboard " in caught.value.hint


def test_broken_metadata_is_refused(tmp_path: Path, reference: Reference) -> None:
    """Text that is not TOML never raises anything but the package's own error."""
    _write(tmp_path / "mine", reference)
    (tmp_path / "mine/submission.toml").write_bytes(b"\xff= [")
    with pytest.raises(InstanceError, match=r"submission\.toml is not valid"):
        load_entry(read_submission(tmp_path / "mine", "submissions/mine"), reference)
