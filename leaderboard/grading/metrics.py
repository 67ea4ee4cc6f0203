"""The one table of metrics: what each is called, how it is computed, and what its values mean."""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from typing import Literal

from leaderboard.errors import LeaderboardError
from leaderboard.grading.observations import Observations
from leaderboard.metrics import accuracy as right
from leaderboard.metrics import agreement, calibration, pairs
from leaderboard.metrics.exact_tests import accuracy_p
from leaderboard.metrics.undefined import Estimate, Undefined

METRICS_VERSION = 2
"""Goes up whenever any number could change."""

NO_HUMAN_DATA = Undefined("the reference has no human data")
NO_RESPONSES = Undefined("the reference has no responses of single people")

Direction = Literal["higher", "lower", "none"]
Need = Literal["labels", "people", "responses"]


@dataclass(frozen=True)
class Metric:
    """A metric of the result.

    Attributes
    ----------
    name, title
        As in ``result.json``, and for people.
    function
        From the observations of a scope and subset to a value, or to the reason why there is none.
    meaning
        What it is, in one sentence.
    direction
        Which end is better.
    low, high
        The range of its values.
    chance
        What guessing without knowledge gives on average; None where that depends on the data.
    needs
        What the reference must hold.
    is_p_value
        Whether it is a p-value: overall it pools the trials instead of averaging the properties' values, and
        it is never rounded to 0.
    """

    name: str
    title: str
    function: Callable[[Observations], Estimate]
    meaning: str
    direction: Direction
    low: float
    high: float
    chance: float | None
    needs: Need = "labels"
    is_p_value: bool = False

    def compute(self, observations: Observations) -> Estimate:
        """Compute the value, or say what the reference lacks for it."""
        if self.needs != "labels" and observations.n is None:
            return NO_HUMAN_DATA
        if self.needs == "responses" and observations.responses is None:
            return NO_RESPONSES
        return self.function(observations)


def _human_r_partial(o: Observations) -> Estimate:
    return agreement.human_r_partial(o.probabilities[o.rated], o.human_means, o.labels[o.rated])


def _human_rmse(o: Observations) -> Estimate:
    return agreement.human_rmse(o.probabilities[o.rated], o.human_means)


def _error_consistency(o: Observations) -> Estimate:
    if o.responses is None:
        return NO_RESPONSES
    trials, persons, answers = o.responses
    is_right = (answers == o.labels[trials]).astype(int)
    return agreement.mean_kappa(o.credits[trials], is_right, persons)


def _cohen_kappa(o: Observations) -> Estimate:
    if o.responses is None:
        return NO_RESPONSES
    trials, persons, answers = o.responses
    return agreement.mean_kappa(agreement.answers_of(o.probabilities)[trials], answers, persons)


def _human_ece(o: Observations) -> Estimate:
    return calibration.human_ece(o.probabilities[o.rated], o.human_means)


def _human_gap(o: Observations) -> Estimate:
    if o.n is None or o.n_yes is None:
        return NO_HUMAN_DATA
    return right.human_gap(o.credits, o.n, o.n_yes, o.labels)


METRICS: tuple[Metric, ...] = (
    Metric(
        "accuracy",
        "Accuracy",
        lambda o: right.accuracy(o.credits),
        "Share of trials answered rightly; a probability of exactly 0.5 counts half.",
        "higher",
        0,
        1,
        0.5,
    ),
    Metric(
        "accuracy_p",
        "p of accuracy",
        lambda o: accuracy_p(o.credits, o.labels, o.pairs, o.answered),
        "Exact probability of so high an accuracy if the labels of each pair could as well be swapped.",
        "lower",
        0,
        1,
        None,
        is_p_value=True,
    ),
    Metric(
        "human_r",
        "Human r",
        lambda o: o.human_r,
        "Correlation of P(YES) with the share of people who said YES.",
        "higher",
        -1,
        1,
        0,
        "people",
    ),
    Metric(
        "human_r_normalized",
        "Human r, share of the ceiling",
        lambda o: agreement.human_r_normalized(o.human_r, o.reliability),
        "Human r divided by the highest that noise in people's answers allows; not clipped.",
        "higher",
        -inf,
        inf,
        0,
        "people",
    ),
    Metric(
        "human_r_partial",
        "Human r, label partialled out",
        _human_r_partial,
        "The same after taking out what both owe to the label: being right alone is not being human-like.",
        "higher",
        -1,
        1,
        0,
        "people",
    ),
    Metric(
        "human_rmse",
        "Distance from people",
        _human_rmse,
        "Root mean squared difference between P(YES) and the share of people who said YES.",
        "lower",
        0,
        1,
        None,
        "people",
    ),
    Metric(
        "error_consistency",
        "Error consistency",
        _error_consistency,
        "Cohen's kappa between model right and person right, averaged over people.",
        "higher",
        -1,
        1,
        0,
        "responses",
    ),
    Metric(
        "cohen_kappa",
        "Answer kappa",
        _cohen_kappa,
        "Cohen's kappa between the model's and a person's answers, averaged over people.",
        "higher",
        -1,
        1,
        0,
        "responses",
    ),
    Metric(
        "pair_accuracy",
        "Both right",
        lambda o: pairs.pair_accuracy(o.credits, o.pairs),
        "Share of pairs with both members answered rightly.",
        "higher",
        0,
        1,
        0.25,
    ),
    Metric(
        "pair_order",
        "In order",
        lambda o: pairs.pair_order(o.probabilities, o.pairs, o.labels),
        "Share of pairs whose YES member got the higher P(YES), ties 1/2.",
        "higher",
        0,
        1,
        0.5,
    ),
    Metric(
        "auc",
        "AUC",
        lambda o: calibration.auc(o.probabilities, o.labels),
        "Area under the ROC curve: how often a YES trial got a higher P(YES) than a NO trial.",
        "higher",
        0,
        1,
        0.5,
    ),
    Metric(
        "brier",
        "Brier score",
        lambda o: calibration.brier(o.probabilities, o.labels),
        "Mean squared difference between P(YES) and the label; 0.5 everywhere gives 0.25.",
        "lower",
        0,
        1,
        0.25,
    ),
    Metric(
        "ece",
        "Calibration error",
        lambda o: calibration.ece(o.probabilities, o.labels),
        "Expected distance between P(YES) and how often YES is right, over 10 bins.",
        "lower",
        0,
        1,
        None,
    ),
    Metric(
        "human_ece",
        "Calibration error, people",
        _human_ece,
        "Expected distance between P(YES) and the share of people who said YES, over 10 bins.",
        "lower",
        0,
        1,
        None,
        "people",
    ),
    Metric(
        "yes_rate",
        "YES rate",
        lambda o: calibration.yes_rate(o.probabilities),
        "Share of trials answered YES; neither end is better.",
        "none",
        0,
        1,
        0.5,
    ),
    Metric(
        "human_gap",
        "Gap to people",
        _human_gap,
        "Accuracy minus people's accuracy on the same trials.",
        "higher",
        -1,
        1,
        None,
        "people",
    ),
)


P_VALUES = frozenset(metric.name for metric in METRICS if metric.is_p_value)


def find_metric(name: str) -> Metric:
    """Look a metric up by name.

    Raises
    ------
    LeaderboardError
        If there is none of that name.
    """
    for metric in METRICS:
        if metric.name == name:
            return metric
    raise LeaderboardError(
        f"there is no metric {name!r}", f"choose one of {', '.join(m.name for m in METRICS)}"
    )
