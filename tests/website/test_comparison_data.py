"""What the script that compares gets: the reference once, and each submission's answers."""

import json
import re
from typing import Any

import numpy as np
import pytest

from builders import build_entry, build_reference
from leaderboard.grading.draws import Draws
from leaderboard.metrics.resampling import CHUNK
from leaderboard.reference import Reference
from leaderboard.website.comparison_data import render_contenders, render_ground
from leaderboard.website.pages import DataFile
from leaderboard.website.trial_paths import trial_path
from site_builders import build_material

HALF = 2**32
DEFAULT_MULTIPLIER = 0x2360ED051FC65DA44385DF649FCCF645
"""Of PCG64, from O'Neill (2014)."""


def unpack(file: DataFile) -> dict[str, Any]:
    """Read what a data file assigns; it is one statement."""
    statement = file.content.decode("ascii")
    assert statement.endswith(";\n")
    assert statement.count("\n") == 1
    found: dict[str, Any] = json.loads(statement.partition(" = ")[2].removesuffix(";\n"))
    return found


@pytest.fixture(scope="module")
def ground(reference: Reference) -> dict[str, Any]:
    return unpack(render_ground(reference))


@pytest.fixture(scope="module")
def reference() -> Reference:
    return build_reference()


def draw_slowly(draws: dict[str, Any]) -> list[list[int]]:
    """Draw pairs as the data say, number by number, with whole numbers of any size."""
    state, increment = (
        sum(limb << (16 * place) for place, limb in enumerate(draws[name])) for name in ("state", "increment")
    )
    strata = draws["strata"]
    weights = [[0] * len(strata) for _ in range(draws["n"])]
    for stratum in sorted(set(strata)):
        units = [unit for unit, other in enumerate(strata) if other == stratum]
        for start in range(0, draws["n"], draws["chunk"]):
            halves: list[int] = []
            for resample in weights[start : start + draws["chunk"]]:
                for _ in units:
                    if not halves:
                        state = (state * DEFAULT_MULTIPLIER + increment) % 2**128
                        mixed, turn = (state >> 64) ^ (state % 2**64), state >> 122
                        number = (mixed >> turn | mixed << (64 - turn)) % 2**64
                        halves = [number % HALF, number // HALF]
                    resample[units[halves.pop(0) * len(units) // HALF]] += 1
    return weights


def test_whoever_has_the_data_draws_the_resamples_of_the_grader(
    ground: dict[str, Any], reference: Reference
) -> None:
    """PCG64 by its definition, begun where the data say, gives every weight of every pair."""
    assert ground["draws"]["chunk"] == CHUNK
    assert np.array_equal(draw_slowly(ground["draws"]), Draws.of(reference).pairs.T)


def test_trials_are_those_of_the_reference(ground: dict[str, Any], reference: Reference) -> None:
    """Ids, pages, labels, pairs, scenarios and the share of people who said YES, in the same order."""
    trials, people = ground["trials"], reference.people
    assert people is not None
    assert trials == {
        "id": list(reference.trial_ids),
        "path": [trial_path(trial_id) for trial_id in reference.trial_ids],
        "label": reference.labels.tolist(),
        "pair": reference.pairs.tolist(),
        "stratum": reference.scenarios.tolist(),
        "people": (people.n_yes / people.n).tolist(),
    }


def test_scopes_say_what_they_are_made_of(ground: dict[str, Any]) -> None:
    """Overall is the mean of the properties; the only scenario of a property is the property."""
    assert ground["scopes"] == [
        {"name": "overall", "title": "Overall", "level": 0, "strata": [0, 1, 2], "parts": [1, 4]},
        {"name": "Alpha", "title": "Alpha", "level": 1, "strata": [0, 1]},
        {"name": "alpha_one", "title": "alpha one", "level": 2, "strata": [0]},
        {"name": "alpha_two", "title": "alpha two", "level": 2, "strata": [1]},
        {"name": "Beta", "title": "Beta", "level": 1, "strata": [2]},
    ]


def test_submissions_say_what_they_answered_and_what_they_scored(
    ground: dict[str, Any], reference: Reference
) -> None:
    """P(YES) with all digits, nothing where there is no answer; scores as they are printed, by scope."""
    beta = (reference.properties == 1).tolist()
    probabilities = [1 / 3 if trial % 2 else 0.75 for trial in range(reference.n_trials)]
    entry = build_entry(reference, "part", probabilities, covered=beta)
    (file,) = render_contenders(build_material(reference, [entry]))
    assert re.fullmatch(r"data/contenders/part\.[0-9a-f]{10}\.js", file.path)
    assert file.content.startswith(b'(window.contenders ??= {})["part"] = {')
    contender = unpack(file)
    assert contender["p"] == [p if isin else None for p, isin in zip(probabilities, beta, strict=True)]
    names = [scope["name"] for scope in ground["scopes"]]
    accuracy, r = (entry.score(name, "Beta") for name in ("accuracy", "human_r"))
    assert accuracy is not None
    assert accuracy.value is not None
    assert r is not None
    assert r.value is not None
    for name, scores in zip(names, contender["scores"], strict=True):
        assert (scores is None) == (name != "Beta")
    (shown, interval, *rest), (shown_r, *_) = contender["scores"][names.index("Beta")]
    assert [shown, *rest] == [f"{100 * accuracy.value:.1f}", "", accuracy.undefined_resamples or 0]
    assert interval.startswith(f"{100 * (accuracy.low or 0):.1f}")
    assert shown_r.replace("\N{MINUS SIGN}", "-") == f"{r.value:.3f}"


def test_without_people_nothing_is_said_of_them() -> None:
    """Neither a share of them nor an agreement with them."""
    reference = build_reference(n_people=0)
    assert "people" not in unpack(render_ground(reference))["trials"]
    entry = build_entry(reference, "one", [0.7] * reference.n_trials)
    (file,) = render_contenders(build_material(reference, [entry]))
    assert {len(scores) for scores in unpack(file)["scores"]} == {1}


def test_another_reference_has_another_name() -> None:
    """So that a browser never takes the trials or the draws of one for those of another."""
    one, other = (render_ground(build_reference(seed=seed)) for seed in (0, 1))
    assert one.path != other.path
    assert one == render_ground(build_reference(seed=0))


def test_other_answers_have_another_name() -> None:
    """So that a browser never joins the answers of one build to the trials of another."""
    reference = build_reference()
    files = [
        next(render_contenders(build_material(reference, [build_entry(reference, "one", [p] * 24)])))
        for p in (0.6, 0.7, 0.6)
    ]
    assert files[0].path != files[1].path
    assert files[0] == files[2]
