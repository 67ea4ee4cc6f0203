"""Numbers that were published do not move by a bit: the tightest net under the whole of grading."""

import datetime as dt
from pathlib import Path

import pytest

from builders import build_reference
from leaderboard.assessing import assess
from leaderboard.grading import Yardstick, grade_people, result_bytes
from leaderboard.instance import Instance
from leaderboard.reference import load_reference
from leaderboard.submission import read_submission

DAY = dt.date(2100, 1, 1)


@pytest.fixture(scope="module")
def yardstick() -> Yardstick:
    """Load the embedded reference once."""
    return Yardstick.of(load_reference(Instance(Path(__file__).resolve().parents[2])))


@pytest.mark.parametrize("slug", ["example-slots", "example-pixels", "baseline-human-mean"])
def test_a_committed_result_is_graded_again(slug: str, yardstick: Yardstick) -> None:
    """Byte for byte."""
    folder = Path(__file__).resolve().parents[2] / "submissions" / slug
    raw = read_submission(folder, slug)
    result = assess(raw, yardstick.reference, today=DAY, yardstick=yardstick).result
    assert result is not None
    assert result_bytes(result) == (folder / "result.json").read_bytes()


def test_peoples_scores_stay() -> None:
    """Those of a small reference whose trials were judged by six or seven were written down once."""
    people = grade_people(build_reference(n_people=13))["overall"]
    scores = {
        (subset, name): (score.value, score.low, score.high)
        for subset, cell in people.items()
        for name, score in cell.metrics.items()
    }
    assert scores == {
        ("all", "accuracy"): (0.606399, 0.539386, 0.660809),
        ("all", "yes_rate"): (0.484375, 0.373456, 0.602362),
        ("all", "split_half_r"): (0.394571, 0.262859, 0.548674),
        ("all", "reliability"): (0.565823, 0.431651, 0.722579),
        ("all", "reliability_from_counts"): (0.535664, 0.383852, 0.700901),
        ("all", "ceiling"): (0.752193, 0.644788, 0.844669),
        ("easy", "accuracy"): (0.658333, 0.596577, 0.723214),
        ("easy", "yes_rate"): (0.452778, 0.32396, 0.647232),
        ("hard", "accuracy"): (0.53869, 0.517857, 0.559524),
        ("hard", "yes_rate"): (0.342262, 0.196163, 0.494822),
        ("easy_crossfit", "accuracy"): (0.588167, 0.493574, 0.642171),
        ("hard_crossfit", "accuracy"): (0.657838, 0.60638, 0.746063),
    }
