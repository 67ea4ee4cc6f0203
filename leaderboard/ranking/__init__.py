"""Graded submissions in order, how sure their ranks are, and what they gain from inferring properties."""

from leaderboard.ranking.board import Board, Row, rank_entries
from leaderboard.ranking.entries import Entry, load_entries, load_entry
from leaderboard.ranking.gains import Gain, find_gains, is_counterpart
from leaderboard.ranking.standings import Standing

__all__ = [
    "Board",
    "Entry",
    "Gain",
    "Row",
    "Standing",
    "find_gains",
    "is_counterpart",
    "load_entries",
    "load_entry",
    "rank_entries",
]
