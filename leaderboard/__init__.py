"""Grade predictions against a physical-reasoning benchmark and publish an honest leaderboard."""

__version__ = "0.1.0"
