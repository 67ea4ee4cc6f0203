"""Like people or not: correlation with the human mean, and agreement with single people."""

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.undefined import NO_RATED_TRIALS, Estimate, Undefined

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

MIN_TRIALS = 2
TOO_FEW = Undefined("fewer than two rated trials")
CONSTANT_PREDICTED = Undefined("all probabilities are equal")
CONSTANT_OBSERVED = Undefined("all human means are equal")
LABEL_EXPLAINS_PREDICTED = Undefined("probabilities do not vary apart from the label")
LABEL_EXPLAINS_OBSERVED = Undefined("human means do not vary apart from the label")
NO_PERSON_WITH_TWO = Undefined("no person rated two of these trials")
NOT_RELIABLE = Undefined("people agree no more than chance would have it, so there is no ceiling")
CHANCE_IS_CERTAIN = Undefined("for every person, chance alone already gives full agreement")


def human_r(predicted: Floats, observed: Floats) -> Estimate:
    """Pearson correlation of P(YES) with the share of people who said YES, in [-1, 1].

    Undefined with fewer than two trials or if either does not vary.

    Parameters
    ----------
    predicted, observed : (n_rated,)

    Examples
    --------
    >>> round(human_r(np.array([0.0, 0.5, 1.0]), np.array([0.2, 0.3, 0.4])), 6)
    1.0
    """
    constant = _find_constant(predicted, observed)
    if constant:
        return constant
    one_group = np.zeros(predicted.size, np.int64)
    return _correlate(_centre(predicted, one_group), _centre(observed, one_group))


def human_r_normalized(r: Estimate, reliability: Estimate) -> Estimate:
    """Divide human r by its ceiling, the square root of the reliability of the human means; not clipped.

    Spearman's (1904) correction for attenuation on people's side: noise in the human means keeps the
    correlation of even the best predictions at sqrt(reliability). Undefined as either is, and where the
    reliability is not above 0.

    >>> human_r_normalized(0.3, 0.36)
    0.5
    """
    if isinstance(r, Undefined) or isinstance(reliability, Undefined):
        return r if isinstance(r, Undefined) else reliability
    return r / sqrt(reliability) if reliability > 0 else NOT_RELIABLE


def human_r_partial(predicted: Floats, observed: Floats, labels: Integers) -> Estimate:
    """Correlation of P(YES) with the human mean, with the label partialled out, in [-1, 1].

    The label is 0 or 1, so regressing on it means subtracting the mean of each label's trials (Fisher 1924).
    Where all labels are equal there is nothing to take out and it equals ``human_r``. Undefined as
    ``human_r`` is, and where either is constant within each label.

    Parameters
    ----------
    predicted, observed, labels : (n_rated,)

    Examples
    --------
    >>> predicted, observed = np.array([0.1, 0.2, 0.8, 0.9]), np.array([0.4, 0.3, 0.9, 0.8])
    >>> round(human_r_partial(predicted, observed, np.array([0, 0, 1, 1])), 6)
    -1.0
    """
    constant = _find_constant(predicted, observed)
    if constant:
        return constant
    residual_predicted, residual_observed = _centre(predicted, labels), _centre(observed, labels)
    if not residual_predicted.any():
        return LABEL_EXPLAINS_PREDICTED
    if not residual_observed.any():
        return LABEL_EXPLAINS_OBSERVED
    return _correlate(residual_predicted, residual_observed)


def human_rmse(predicted: Floats, observed: Floats) -> Estimate:
    """Root of the mean squared difference between P(YES) and the human mean, in [0, 1], lower is better.

    >>> human_rmse(np.array([0.5, 0.5]), np.array([0.0, 1.0]))
    0.5
    """
    if not predicted.size:
        return NO_RATED_TRIALS
    return float(np.sqrt(np.mean((predicted - observed) ** 2)))


def mean_kappa(predicted: Floats, observed: Floats | Integers, persons: Integers) -> Estimate:
    """Mean over people of Cohen's kappa between a model and a person, in [-1, 1]; chance gives 0.

    With a the model's value and b the person's over the trials that this person saw,
    agreement = mean(1 - abs(a - b)), chance = p1 p2 + (1 - p1)(1 - p2) with the two means p1 and p2, and
    kappa = (agreement - chance) / (1 - chance). Values of 1/2 enter as probabilities. People with fewer than
    two trials are left out, and those for whom chance is 1. Geirhos et al. (2020) on right and wrong is error
    consistency; on YES and NO it is the usual kappa.

    Parameters
    ----------
    predicted : (n_responses,), each 0, 0.5 or 1
        The model's value on the trial of each response.
    observed : (n_responses,), each 0, 0.5 or 1
        The person's, or another model's.
    persons : (n_responses,)
        Who responded, as non-negative integers.

    Examples
    --------
    >>> mean_kappa(np.array([1.0, 0.0, 1.0, 0.0]), np.array([1, 0, 0, 1]), np.array([0, 0, 1, 1]))
    0.0
    """
    if not persons.size:
        return NO_RATED_TRIALS
    n = np.bincount(persons)
    # Sums of halves and ones are exact in float64, so "chance is 1" can be asked exactly.
    sum_predicted = np.bincount(persons, predicted)
    sum_observed = np.bincount(persons, observed)
    agreed = np.bincount(persons, 1 - np.abs(predicted - observed))
    is_certain = ((sum_predicted == 0) & (sum_observed == 0)) | ((sum_predicted == n) & (sum_observed == n))
    has_two = n >= MIN_TRIALS
    usable = has_two & ~is_certain
    if not usable.any():
        return CHANCE_IS_CERTAIN if has_two.any() else NO_PERSON_WITH_TWO
    n, p1, p2 = n[usable], sum_predicted[usable] / n[usable], sum_observed[usable] / n[usable]
    chance = p1 * p2 + (1 - p1) * (1 - p2)
    return float(np.mean((agreed[usable] / n - chance) / (1 - chance)))


def answers_of(probabilities: Floats) -> Floats:
    """Turn P(YES) into answers: 1 above 0.5, 0 below, 1/2 at 0.5; (n_trials,).

    >>> answers_of(np.array([0.2, 0.5, 0.7]))
    array([0. , 0.5, 1. ])
    """
    return (1 + np.sign(probabilities - 0.5)) / 2


def _find_constant(predicted: Floats, observed: Floats) -> Undefined | None:
    """Say why there is no correlation, if there is none."""
    if predicted.size < MIN_TRIALS:
        return TOO_FEW
    if (predicted == predicted[0]).all():
        return CONSTANT_PREDICTED
    return CONSTANT_OBSERVED if (observed == observed[0]).all() else None


def _centre(values: Floats, groups: Integers) -> Floats:
    """Subtract from each value the mean of its group (0 or 1), after scaling all to at most 1.

    All zeros exactly where no group varies: a group's first value is subtracted before its mean is, so that
    equal values leave nothing, neighbouring ones keep their digits, and tiny ones do not underflow.
    """
    first = np.array([np.argmax(groups == group) for group in (0, 1)])
    shifted: Floats = values - values[first][groups]
    largest = np.abs(shifted).max()
    if largest == 0:
        return shifted
    scaled = shifted / largest
    means = np.bincount(groups, scaled, minlength=2) / np.maximum(np.bincount(groups, minlength=2), 1)
    centred: Floats = scaled - means[groups]
    return centred


def _correlate(predicted: Floats, observed: Floats) -> float:
    """Correlate two centred variables; clipped, since rounding may exceed 1 by the last digit.

    Plain sums, not a linear algebra library's, whose last digits depend on the machine.
    """
    norms = np.sqrt((predicted**2).sum() * (observed**2).sum())
    return float(np.clip((predicted * observed).sum() / norms, -1, 1))
