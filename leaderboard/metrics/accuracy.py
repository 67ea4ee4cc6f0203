"""Right or wrong: credits, accuracy, and people's accuracy on the same trials."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.undefined import NO_RATED_TRIALS, NO_TRIALS, Estimate, Undefined

if TYPE_CHECKING:
    from fractions import Fraction

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Booleans = NDArray[np.bool_]


def credits_of(probabilities: Floats, labels: Integers, answered: Booleans) -> Floats:
    """Give each trial its credit.

    1 if P(YES) is on the label's side of 0.5, 0 if on the other, 1/2 if it is 0.5 exactly, 0 if not answered.

    Parameters
    ----------
    probabilities, labels, answered : (n_trials,)

    Returns
    -------
    (n_trials,), each 0, 0.5 or 1

    Examples
    --------
    >>> credits_of(
    ...     np.array([0.9, 0.9, 0.5, 0.5]), np.array([1, 0, 1, 1]), np.array([True, True, True, False])
    ... )
    array([1. , 0. , 0.5, 0. ])
    """
    side = np.sign(probabilities - 0.5)
    return np.where(answered, (1 + side * (2 * labels - 1)) / 2, 0.0)


def accuracy(credits: Floats) -> Estimate:
    """Mean credit, in [0, 1]; undefined without trials.

    >>> accuracy(np.array([1.0, 0.5, 0.0, 0.0]))
    0.375
    """
    return float(credits.mean()) if credits.size else NO_TRIALS


def right_counts(n: Integers, n_yes: Integers, labels: Integers) -> Integers:
    """Count the people who were right on each trial: k where the label is YES, else n - k; (n_trials,)."""
    return np.where(labels == 1, n_yes, n - n_yes)


def human_accuracy(n: Integers, n_yes: Integers, labels: Integers) -> Estimate:
    """Mean over rated trials of the share of people who were right, in [0, 1].

    Trials weigh the same, however many people saw them; those that nobody rated are left out.

    >>> human_accuracy(np.array([4, 2, 0]), np.array([3, 2, 0]), np.array([1, 0, 1]))
    0.375
    """
    rated = n > 0
    if not rated.any():
        return NO_RATED_TRIALS
    return float((right_counts(n, n_yes, labels)[rated] / n[rated]).mean())


def human_gap(credits: Floats, n: Integers, n_yes: Integers, labels: Integers) -> Estimate:
    """Accuracy minus human accuracy, both over the rated trials, in [-1, 1].

    >>> human_gap(np.array([1.0, 0.0]), np.array([4, 0]), np.array([3, 0]), np.array([1, 0]))
    0.25
    """
    people = human_accuracy(n, n_yes, labels)
    if isinstance(people, Undefined):
        return people
    return float(credits[n > 0].mean()) - people


def is_above(counts: Integers, totals: Integers, threshold: "Fraction") -> Booleans:
    """Tell exactly where counts/totals exceeds a fraction; never where the total is 0.

    >>> from fractions import Fraction
    >>> is_above(np.array([2, 3, 0]), np.array([3, 4, 0]), Fraction(2, 3))
    array([False,  True, False])
    """
    return counts * threshold.denominator > totals * threshold.numerator


def is_below(counts: Integers, totals: Integers, threshold: "Fraction") -> Booleans:
    """Tell exactly where counts/totals is less than a fraction; never where the total is 0.

    >>> from fractions import Fraction
    >>> is_below(np.array([1, 1, 0]), np.array([3, 4, 0]), Fraction(1, 3))
    array([False,  True, False])
    """
    return counts * threshold.denominator < totals * threshold.numerator
