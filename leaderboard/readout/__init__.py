"""Features of trials to predictions, by the paper's readout protocol; the test labels are never read."""

from leaderboard.readout.account import (
    METADATA,
    readout_data,
    render_account,
    render_predictions,
    render_report,
)
from leaderboard.readout.feature_files import read_features
from leaderboard.readout.features import Features, features_from_columns
from leaderboard.readout.fitting import DEFAULT_SEEDS, Settings, fit_readout
from leaderboard.readout.outcome import Readout
from leaderboard.readout.reliability_plot import render_reliability

__all__ = [
    "DEFAULT_SEEDS",
    "METADATA",
    "Features",
    "Readout",
    "Settings",
    "features_from_columns",
    "fit_readout",
    "read_features",
    "readout_data",
    "render_account",
    "render_predictions",
    "render_reliability",
    "render_report",
]
