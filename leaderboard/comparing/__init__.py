"""Two submissions side by side: paired differences, how sure they are, and where the two part ways."""

from leaderboard.comparing.comparer import compare
from leaderboard.comparing.comparison import Comparison, Overlap, ScopeComparison, TrialDifference

__all__ = ["Comparison", "Overlap", "ScopeComparison", "TrialDifference", "compare"]
