"""Keeping the ledger: what it must say of the submissions, and that it was only appended to."""

from leaderboard.recording.checking import LedgerCheck, check_ledger
from leaderboard.recording.history import History, open_history
from leaderboard.recording.updating import LedgerUpdate, update_ledger

__all__ = ["History", "LedgerCheck", "LedgerUpdate", "check_ledger", "open_history", "update_ledger"]
