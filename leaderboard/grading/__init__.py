"""A valid submission and a reference to a result: every metric, scope and subset."""

from leaderboard.grading.grader import grade, result_bytes, tally_scores
from leaderboard.grading.metrics import METRICS, METRICS_VERSION, Metric, find_metric
from leaderboard.grading.people_grader import Scores, grade_people
from leaderboard.grading.scopes import SUBSETS, Scope, list_scopes, subset_masks
from leaderboard.grading.yardstick import Yardstick

__all__ = [
    "METRICS",
    "METRICS_VERSION",
    "SUBSETS",
    "Metric",
    "Scope",
    "Scores",
    "Yardstick",
    "find_metric",
    "grade",
    "grade_people",
    "list_scopes",
    "result_bytes",
    "subset_masks",
    "tally_scores",
]
