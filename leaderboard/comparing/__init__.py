"""Two submissions side by side: paired differences, how sure they are, and where the two part ways."""

from leaderboard.comparing.comparer import Contender, compare, compare_contenders
from leaderboard.comparing.comparison import Comparison, Overlap, ScopeComparison, TrialDifference

__all__ = [
    "Comparison",
    "Contender",
    "Overlap",
    "ScopeComparison",
    "TrialDifference",
    "compare",
    "compare_contenders",
]
