"""The whole way from features to predictions, and that how test trials end plays no part."""

from dataclasses import fields, replace
from importlib.metadata import PackageNotFoundError
from typing import Any

import numpy as np
import pytest

from builders import build_reference
from feature_sets import simulate_files, simulate_readout
from leaderboard.errors import LeaderboardError, SourceError
from leaderboard.readout import Settings, features_from_columns, fit_readout, logistic
from leaderboard.readout import fitting as fitting_module
from leaderboard.readout.fitting import DECIMALS
from leaderboard.reference import Reference

REFERENCE = build_reference()
ONE_SEED = Settings(n_seeds=1)


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Fewer strengths to choose from, so that a test takes no more than a moment."""
    monkeypatch.setattr(logistic, "EXPONENTS", (-1, 1))


class Sealed:
    """A reference whose labels, people and copies cannot be looked at."""

    def __init__(self, reference: Reference) -> None:
        self._reference = reference

    def __getattr__(self, name: str) -> Any:
        assert name not in {"labels", "people", "copies"}, f"{name} of the test trials was read"
        return getattr(self._reference, name)


def test_test_labels_are_never_read() -> None:
    """A reference that fails when its labels, copies or people are touched gives the same predictions."""
    assert {"labels", "people", "copies"} <= {field.name for field in fields(Reference)}
    fitting, test = simulate_readout(REFERENCE)
    sealed: Any = Sealed(REFERENCE)
    with pytest.raises(AssertionError, match="labels of the test trials was read"):
        _ = sealed.labels
    readout = fit_readout(fitting, test, sealed, ONE_SEED)
    assert readout.probabilities == fit_readout(fitting, test, REFERENCE, ONE_SEED).probabilities


@pytest.mark.parametrize("name", ["label", "labels", "y"])
def test_leak_in_test_features_changes_nothing(name: str) -> None:
    """Test labels planted beside the test features change no probability, whatever their column is called."""
    own, arrays = simulate_files(REFERENCE)
    fitting = [
        features_from_columns(a | {"y": a["label"]}, property_name=p, with_labels=True)
        for p, a in own.items()
    ]
    plain = features_from_columns(arrays, with_labels=False)
    leaking = features_from_columns(arrays | {name: REFERENCE.labels}, with_labels=False)
    forced = replace(leaking, labels=REFERENCE.labels)
    found = [fit_readout(fitting, [test], REFERENCE, ONE_SEED) for test in (plain, leaking, forced)]
    assert found[0].probabilities == found[1].probabilities == found[2].probabilities


def test_signal_reaches_the_predictions() -> None:
    """Trials of a strong signal are predicted right, each property by its own readout."""
    readout = fit_readout(*simulate_readout(REFERENCE, signal=20.0, n_features=2), REFERENCE, ONE_SEED)
    answers = np.array([readout.probabilities[t] for t in REFERENCE.trial_ids])
    assert ((answers > 0.5) == REFERENCE.labels).mean() > 0.9
    assert [part.name for part in readout.parts] == ["Alpha", "Beta"]
    assert [part.n_test for part in readout.parts] == [16, 8]
    assert readout.parts[0].agreement.accuracy > 0.9


def test_order_of_files_and_rows_does_not_matter() -> None:
    """Shuffled rows and files give the same bytes."""
    own, arrays = simulate_files(REFERENCE)
    order = np.random.default_rng(0).permutation(20)
    shuffled = [
        features_from_columns({key: a[order] for key, a in given.items()}, property_name=p, with_labels=True)
        for p, given in reversed(own.items())
    ]
    turned = features_from_columns({key: a[::-1] for key, a in arrays.items()}, with_labels=False)
    plain = fit_readout(*simulate_readout(REFERENCE), REFERENCE, ONE_SEED)
    assert fit_readout(shuffled, [turned], REFERENCE, ONE_SEED).probabilities == plain.probabilities


def test_seeds_are_averaged() -> None:
    """Each seed deals folds anew; probabilities are the mean, rounded, and the spread is told."""
    fitting, test = simulate_readout(REFERENCE, signal=1.0)
    three = fit_readout(fitting, test, REFERENCE, Settings(n_seeds=3))
    assert [seed.seed for seed in three.parts[0].seeds] == [0, 1, 2]
    assert len({seed.folds for seed in three.parts[0].seeds}) == 3
    assert three.parts[0].test_spread >= 0
    assert all(p == round(p, DECIMALS) for p in three.probabilities.values())
    one = fit_readout(fitting, test, REFERENCE, ONE_SEED)
    assert one.parts[0].seeds[0] == three.parts[0].seeds[0]
    assert one.parts[0].test_spread == 0
    held_out = [fit_readout(fitting, test, REFERENCE, Settings(n_seeds=n)).parts[0].held_out for n in (1, 2)]
    assert held_out[0].tolist() != held_out[1].tolist()


def test_one_readout_for_all() -> None:
    """With one readout for all, properties need not be said, and there is one part."""
    fitting, test = simulate_readout(REFERENCE)
    nameless = [replace(features, properties=None) for features in fitting]
    readout = fit_readout(nameless, test, REFERENCE, Settings(scope="all", n_seeds=1))
    assert [(part.name, part.n_trials, part.n_test) for part in readout.parts] == [("all", 40, 24)]
    assert list(readout.probabilities) == list(REFERENCE.trial_ids)


def test_part_of_the_benchmark() -> None:
    """Properties without test features are left out and told; without trials to fit on they are refused."""
    fitting, test = simulate_readout(REFERENCE)
    half = features_from_columns(
        {"trial_id": list(test[0].trial_ids[:16]), "features": test[0].values[:16]}, with_labels=False
    )
    readout = fit_readout(fitting, [half], REFERENCE, ONE_SEED)
    assert readout.unused == ("Beta",)
    assert len(readout.probabilities) == 16
    message = "there are features of 8 test trials of Beta, and no trials of it to fit on"
    with pytest.raises(SourceError, match=message) as found:
        fit_readout(fitting[:1], test, REFERENCE, ONE_SEED)
    assert found.value.hint == "give --fit Beta=FILE, or leave its test trials out"


def test_distances() -> None:
    """Distances give probabilities or hard answers, and negative ones are refused, in test features too."""
    own, arrays = simulate_files(REFERENCE, n_features=1)
    near = {name: a | {"features": 2.0 - a["features"] / 10} for name, a in own.items()}
    fitting = [
        features_from_columns(a, property_name=name, pooling="smallest", with_labels=True)
        for name, a in near.items()
    ]
    target = arrays | {"features": 2.0 - arrays["features"] / 10}
    test = features_from_columns(target, pooling="smallest", with_labels=False)
    soft = fit_readout(fitting, [test], REFERENCE, Settings("distance", n_seeds=1))
    hard = fit_readout(fitting, [test], REFERENCE, Settings("threshold", n_seeds=1))
    assert set(hard.probabilities.values()) == {0.0, 1.0}
    sides = [(soft.probabilities[t] > 0.5) == bool(hard.probabilities[t]) for t in REFERENCE.trial_ids]
    assert np.mean(sides) > 0.7
    negative = features_from_columns(
        arrays | {"features": -np.ones((24, 1))}, name="mine", pooling="smallest", with_labels=False
    )
    with pytest.raises(SourceError, match=r"^mine: the distance of trial "):
        fit_readout(fitting, [negative], REFERENCE, Settings("distance", n_seeds=1))


def test_columns_for_data_frames() -> None:
    """Predictions come out as columns too, from which any library makes its data frame."""
    readout = fit_readout(*simulate_readout(REFERENCE), REFERENCE, ONE_SEED)
    columns = readout.to_columns()
    assert columns["trial_id"] == list(REFERENCE.trial_ids)
    assert columns["probability"] == list(readout.probabilities.values())


@pytest.mark.parametrize("installed", [None, "1.7.2"])
def test_without_scikit_learn(installed: str | None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without scikit-learn, or with one that is too old, the message says how to install it."""

    def look_up(name: str) -> str:
        if installed is None:
            raise PackageNotFoundError(name)
        return installed

    monkeypatch.setattr(fitting_module, "version", look_up)
    message = f"readouts are fitted by scikit-learn 1.8 or newer; installed is {installed or 'none'}"
    with pytest.raises(LeaderboardError, match=f"^{message}$") as found:
        fit_readout(*simulate_readout(REFERENCE), REFERENCE, ONE_SEED)
    assert found.value.hint == "pip install 'scikit-learn>=1.8' installs it"
