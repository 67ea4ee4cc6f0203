"""What a benchmark's definition may say."""

from copy import deepcopy
from fractions import Fraction
from typing import Any

import pytest
from pydantic import ValidationError

from builders import build_benchmark
from leaderboard.models import Benchmark, Protocol


def _definition(**changes: object) -> dict[str, Any]:
    definition = deepcopy(build_benchmark().model_dump(exclude_none=True))
    return definition | changes


def test_thresholds_are_exact_fractions() -> None:
    """Two thirds is two thirds, not 0.6667."""
    grading = build_benchmark().grading
    assert (grading.easy_above, grading.hard_below) == (Fraction(2, 3), Fraction(1, 3))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"scenarios": [{"id": "a", "title": "A", "property": "Gamma"}]}, "unknown property 'Gamma'"),
        ({"scenarios": [{"id": "a", "title": "A", "property": "Alpha"}]}, "property Beta has no scenario"),
        ({"surprise": 1}, "Extra inputs are not permitted"),
        (
            {"people": {"per_property": 0}},
            "people.per_property\n  Input should be greater than or equal to 1",
        ),
        ({"people": {"groups": 8}}, "people.groups\n  Extra inputs are not permitted"),
        ({"tracks": [{"id": "all", "title": "All"}]}, "exactly one track must have default = true"),
        (
            {
                "tracks": [
                    {"id": "all", "title": "All", "training": "unified", "default": True},
                    {"id": "some", "title": "Some", "testing": "with_property"},
                ]
            },
            "tracks all and some overlap",
        ),
        (
            {"grading": {"easy": "two", "hard": "1/3", "resamples": 1, "seed": 1}},
            "must be a fraction such as 2/3",
        ),
        ({"grading": {"easy": "3/2", "hard": "1/3", "resamples": 1, "seed": 1}}, "must lie between 0 and 1"),
    ],
)
def test_definitions_that_contradict_themselves_are_refused(changes: dict[str, Any], message: str) -> None:
    """Each contradiction is named."""
    with pytest.raises(ValidationError, match=message):
        Benchmark.model_validate(_definition(**changes))


def test_names_of_properties_and_scenarios_never_clash() -> None:
    """A scenario may not bear a property's name, nor the name of the overall scope."""
    for name in ("Alpha", "overall"):
        definition = _definition()
        definition["scenarios"] = [*definition["scenarios"], {"id": name, "title": "x", "property": "Beta"}]
        with pytest.raises(ValidationError, match=f"distinct names: {name} appears twice"):
            Benchmark.model_validate(definition)


def test_a_protocol_finds_its_track() -> None:
    """A submission belongs to the track whose keys all match."""
    benchmark = build_benchmark()
    track = benchmark.find_track(Protocol(training="separate", testing="without_property"))
    assert track is not None
    assert track.id == "without"
    assert benchmark.find_track(Protocol(training="separate", testing="fully_observed")) is None


def test_the_design_of_the_study_may_be_stated_in_part() -> None:
    """Numbers that are not given are not known, and neither is the licence."""
    benchmark = Benchmark.model_validate(_definition(people={"sets": 6}))
    assert (benchmark.people.per_property, benchmark.people.sets) == (None, 6)
    assert build_benchmark().people.sets is None
    assert build_benchmark().licence == ""
