"""What a readout says of itself: predictions, a report for programs, and lines for the eye."""

import json
from dataclasses import replace

import pytest

from builders import build_reference
from feature_sets import simulate_readout
from leaderboard.models.metadata import Protocol
from leaderboard.readout import (
    Readout,
    Settings,
    fit_readout,
    render_account,
    render_predictions,
    render_report,
)
from leaderboard.readout.matching import Coverage

REFERENCE = build_reference()


@pytest.fixture(scope="module")
def readout() -> Readout:
    return fit_readout(*simulate_readout(REFERENCE), REFERENCE, Settings(n_seeds=2))


def test_predictions_are_a_table(readout: Readout) -> None:
    """Each test trial has a row with its probability, in the order of the reference."""
    header, *rows = render_predictions(readout).decode().splitlines()
    assert header == "trial_id,probability"
    first = REFERENCE.trial_ids[0]
    assert rows[0] == f'"{first}",{readout.probabilities[first]}'
    assert len(rows) == 24


def test_report_says_how_it_was_selected(readout: Readout) -> None:
    """The report's metadata are valid keys of submission.toml: selected on the readout's data."""
    metadata = json.loads(render_report(readout))["metadata"]
    assert metadata == {"protocol": {"selection": "readout"}}
    protocol = {"training": "separate", "testing": "with_property", **metadata["protocol"]}
    assert Protocol.model_validate(protocol).selection == "readout"


def test_report_holds_what_was_found(readout: Readout) -> None:
    """Folds, strength, held-out accuracy with its interval, AUC, calibration, seeds and hashes are there."""
    report = json.loads(render_report(readout))
    part = report["parts"][0]
    assert (part["name"], part["trials"], part["features"], part["test_trials"]) == ("Alpha", 20, 6, 16)
    assert part["held_out"].keys() == {"accuracy", "auc", "brier", "ece", "bins"}
    assert part["held_out"]["accuracy"].keys() == {"value", "low", "high"}
    assert sum(bin_["n"] for bin_ in part["held_out"]["bins"]) == 20
    assert part["spread_over_seeds"].keys() == {"held_out_accuracy", "test_probability"}
    assert [seed["seed"] for seed in part["seeds"]] == [0, 1]
    assert len(part["pairs"]) == 10
    for seed in part["seeds"]:
        assert seed["strength"] in [pytest.approx(10.0**k / 6) for k in range(-3, 5)]
        assert sorted(seed["folds"]) == sorted("0011223344")
    assert [origin["name"] for origin in report["features"]["fit"]] == ["Alpha", "Beta"]
    assert len(report["features"]["test"][0]["sha256"]) == 64
    assert report["versions"].keys() == {"leaderboard", "numpy", "scikit-learn"}


def test_report_is_the_same_each_time(readout: Readout) -> None:
    """The same features give the same bytes."""
    again = fit_readout(*simulate_readout(REFERENCE), REFERENCE, Settings(n_seeds=2))
    assert render_report(again) == render_report(readout)


def test_account_for_the_eye(readout: Readout) -> None:
    """A line for each part has accuracy, AUC, sizes and the strength; the last says what is predicted."""
    lines = render_account(readout).splitlines()
    assert lines[0] == "Tiny: logistic regression, one per property, the mean of 2 seeds"
    assert lines[1] == "  on the trials to fit on, 5 folds, pairs never split:"
    part = readout.parts[0]
    accuracy = f"accuracy {part.accuracy.value:.3f} ({part.accuracy.low:.3f} to {part.accuracy.high:.3f})"
    start = f"    Alpha  {accuracy}, AUC {part.agreement.auc:.3f}; 20 trials, 6 features; strength "
    assert lines[2].startswith(start)
    assert lines[-1] == "  predicts 24 test trials, 3 of 3 scenarios; how they end was not looked at"


def test_account_of_what_is_left_out(readout: Readout) -> None:
    """Broken scenarios, names that fit nothing, unused properties and constant features are told."""
    coverage = Coverage(("alpha_two", "beta_one"), {"alpha_one": (7, 8)}, ("x\n1",))
    parts = (replace(readout.parts[0], n_constant=3), readout.parts[1])
    lines = render_account(
        replace(readout, scope="all", coverage=coverage, unused=("Beta",), parts=parts)
    ).splitlines()
    assert lines[0] == "Tiny: logistic regression, one per benchmark, the mean of 2 seeds"
    assert lines[-4:] == [
        "  left out: alpha_one, features of 7 of its 8 trials",
        "  left out: 1 name that fit no test trial or several, such as 'x\\n1'",
        "  left out: Beta: trials to fit on, and no test trials",
        "  left out: Alpha: 3 features that are the same on all trials to fit on",
    ]
