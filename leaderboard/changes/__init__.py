"""What a branch changes, read from git objects alone, and whether a submission may change it."""

from leaderboard.changes.checking import ChangeCheck, check_changes

__all__ = ["ChangeCheck", "check_changes"]
