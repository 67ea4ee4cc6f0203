"""Who stands where on a board, and which results may stand there at all."""

import datetime as dt
import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tomli_w

from builders import build_entry, build_metadata, build_reference, build_submission
from leaderboard.comparing import compare
from leaderboard.errors import InstanceError, LeaderboardError
from leaderboard.files import csv_text, sha256_hex
from leaderboard.grading import Yardstick, grade, result_bytes
from leaderboard.metrics.undefined import Undefined
from leaderboard.ranking import Entry, Standing, find_gains, load_entry, rank_entries
from leaderboard.ranking.shares import denominator, share_out
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
    """Write a graded submission that is undecided on every trial."""
    folder.mkdir()
    rows = [[trial_id, 0.5] for trial_id in reference.trial_ids]
    predictions = csv_text(["trial_id", "probability"], rows).encode()
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
    assert entry.credits.tolist() == [0.5] * reference.n_trials


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


def _simulate_credits(reference: Reference, accuracy: float, seed: int) -> list[float]:
    rng = np.random.default_rng(seed)
    is_right = rng.random(reference.n_trials) < accuracy
    return [0.9 if is_yes else 0.1 for is_yes in is_right == (reference.labels == 1)]


@pytest.fixture(scope="module")
def large() -> Reference:
    """Build a reference with pairs enough to tell systems apart."""
    return build_reference(40, n_people=4)


def test_a_board_by_accuracy_says_how_sure_its_ranks_are(large: Reference) -> None:
    """Rank sets hold the ranks, the best one is in the best group, and chances to be the best add up to 1."""
    entries = [build_entry(large, f"s{i}", _simulate_credits(large, 0.5 + i / 20, i)) for i in range(8)]
    board = rank_entries(entries, large.benchmark.default_track, yardstick=Yardstick.of(large))
    standings = [row.standing for row in board.ranked if row.standing]
    assert len(standings) == 8
    for row, standing in zip(board.ranked, standings, strict=True):
        assert row.rank is not None
        assert 1 <= standing.low <= row.rank <= standing.high <= 8
    assert standings[0].is_among_best
    assert not standings[-1].is_among_best
    assert sum(s.best_probability for s in standings) == pytest.approx(1, abs=1e-5)
    assert isinstance(board.detectable, float)
    assert 0.02 < board.detectable < 0.3


def test_equal_submissions_stand_alike_and_sixty_are_as_good_as_one(large: Reference) -> None:
    """Copies have one rank, one set that holds all the ranks they could be given, and equal chances."""
    same = _simulate_credits(large, 0.7, 1)
    entries = [build_entry(large, f"same{i:02d}", same) for i in range(60)]
    board = rank_entries(entries, large.benchmark.default_track, yardstick=Yardstick.of(large))
    assert {row.rank for row in board.ranked} == {1}
    assert {row.standing for row in board.ranked} == {Standing(1, 60, round(1 / 60, 6), is_among_best=True)}
    assert board.detectable == Undefined("there are fewer than two different systems")


def test_partial_submissions_have_no_standing(large: Reference) -> None:
    """Only complete submissions are compared, and a board by another metric has no rank sets."""
    covered = large.in_property("Beta").tolist()
    partial = build_entry(large, "part", [0.9] * large.n_trials, covered=covered)
    whole = build_entry(large, "whole", _simulate_credits(large, 0.6, 2))
    yardstick = Yardstick.of(large)
    board = rank_entries([partial, whole], large.benchmark.default_track, yardstick=yardstick)
    assert [(row.entry.slug, row.standing is not None) for row in board.rows] == [
        ("whole", True),
        ("part", False),
    ]
    board = rank_entries([whole], large.benchmark.default_track, "auc", yardstick=yardstick)
    assert board.ranked[0].standing is None


def test_gain_is_that_of_comparing_the_two(large: Reference) -> None:
    """With minus without property inference: the same difference, interval and p as ``compare`` gives."""
    good, bad = _simulate_credits(large, 0.8, 3), _simulate_credits(large, 0.6, 4)
    with_it = build_entry(large, "with-it", good)
    old = build_entry(large, "old", good, testing="without_property", date=dt.date(2025, 1, 1))
    new = build_entry(large, "new", bad, testing="without_property")
    other_team = build_entry(
        large, "other", good, testing="without_property", team="Other", date=dt.date(2026, 9, 9)
    )
    other_training = build_entry(large, "zero", good, testing="without_property", training="zero_shot")
    yardstick = Yardstick.of(large)
    everybody = [with_it, old, new, other_team, other_training]
    gains = find_gains(everybody, everybody, yardstick)
    assert set(gains) == {"with-it"}
    expected = compare(build_submission(large, good), build_submission(large, bad), large).scopes[0]
    found = gains["with-it"]
    assert found.without == "new"
    assert (found.value, found.low, found.high) == pytest.approx(
        (expected.difference.value, expected.difference.low, expected.difference.high), abs=1e-6
    )
    assert found.p == expected.p
    board = rank_entries([with_it, new], large.benchmark.default_track, yardstick=yardstick)
    assert [row.gain for row in board.ranked] == [found]


def test_shares_add_up_to_the_accuracy(reference: Reference) -> None:
    """Whole numbers by pair whose sum over the denominator is the mean of the properties' accuracies."""
    credits = np.random.default_rng(0).choice([0, 0.5, 1], reference.n_trials)
    shares = share_out([credits], reference)
    parts = [credits[reference.in_property(name)].mean() for name in ("Alpha", "Beta")]
    assert shares.dtype == np.int64
    assert shares.sum() / denominator(reference) == pytest.approx(np.mean(parts))
