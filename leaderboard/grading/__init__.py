"""A valid submission and a reference to a result: every metric, scope and subset."""

from leaderboard.grading.grader import Scores, grade, grade_people, result_bytes
from leaderboard.grading.metrics import METRICS, METRICS_VERSION, Metric, find_metric
from leaderboard.grading.scopes import SUBSETS, Scope, list_scopes, subset_masks

__all__ = [
    "METRICS",
    "METRICS_VERSION",
    "SUBSETS",
    "Metric",
    "Scope",
    "Scores",
    "find_metric",
    "grade",
    "grade_people",
    "list_scopes",
    "result_bytes",
    "subset_masks",
]
