"""Data frames go into the readout and the converters as they are, and come out of them."""

import numpy as np
import pandas as pd
import pytest
from pandas.testing import assert_frame_equal

from builders import build_reference
from feature_sets import simulate_files, simulate_readout
from leaderboard.converting import convert_run, make_run
from leaderboard.readout import Settings, features_from_columns, fit_readout, logistic

REFERENCE = build_reference()
ONE_SEED = Settings(n_seeds=1)


def frame_of(arrays: dict[str, np.ndarray]) -> pd.DataFrame:
    """Lay a column out for each feature, under an index that says nothing."""
    features = {f"feature_{number}": column for number, column in enumerate(arrays["features"].T)}
    columns = {name: column for name, column in arrays.items() if name != "features"} | features
    return pd.DataFrame(columns, index=range(7, 7 + len(arrays["features"])))


def test_a_readout_takes_frames_and_gives_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """The predictions are those from arrays, one row for each test trial in the reference's order."""
    monkeypatch.setattr(logistic, "EXPONENTS", (-1, 1))
    own, test = simulate_files(REFERENCE)
    fitting = [
        features_from_columns(frame_of(arrays), property_name=name, with_labels=True)
        for name, arrays in own.items()
    ]
    readout = fit_readout(
        fitting, [features_from_columns(frame_of(test), with_labels=False)], REFERENCE, ONE_SEED
    )
    plain = fit_readout(*simulate_readout(REFERENCE), REFERENCE, ONE_SEED)
    expected = pd.DataFrame(
        {"trial_id": REFERENCE.trial_ids, "probability": list(plain.probabilities.values())}
    )
    assert_frame_equal(pd.DataFrame(readout.to_columns()), expected)


def test_answers_in_a_frame_become_a_frame_of_predictions() -> None:
    """Rows of one trial are repeats; a cell without text is an answer that cannot be read."""
    first, second, *others = REFERENCE.trial_ids
    frame = pd.DataFrame(
        {
            "video": [f"{name}_img.mp4" for name in (first, first, second, *others)],
            "response": ["Yes.", "No.", None, *["<answer>yes</answer>"] * len(others)],
        }
    )
    conversion = convert_run(make_run(frame["video"], frame["response"]), REFERENCE)
    found = pd.DataFrame(conversion.to_columns())
    assert found["trial_id"].tolist() == list(REFERENCE.trial_ids)
    assert found["probability"].tolist() == ["0.5", "", *["1"] * len(others)]
    assert found["status"].tolist() == ["answered", "unparsable", *["answered"] * len(others)]
