"""How much single trials and single people move a metric: first derivatives with respect to their weights."""

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.agreement import MIN_TRIALS

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Responses = tuple[Integers, Integers, Integers]


def correlation_slopes(predicted: Floats, observed: Floats, groups: Integers) -> Floats:
    """Derivative of Pearson's r by each observed value, after both were centred within groups.

    With a and b the centred variables scaled to length 1, r = sum a b, and moving observed value i moves r by
    (a_i - r b_i) / length of the centred observed values: centring is a projection, so it changes nothing
    else. One group gives the derivative of r, the labels as groups that of the partial correlation.

    Parameters
    ----------
    predicted, observed : (n_trials,)
        Neither may be constant within all groups.
    groups : (n_trials,)
        0 or 1.

    Returns
    -------
    (n_trials,)

    Examples
    --------
    >>> x, y = np.array([0.0, 0.0, 1.0, 1.0]), np.array([0.0, 1.0, 1.0, 2.0])
    >>> correlation_slopes(x, y, np.zeros(4, np.int64))[1:3].round(3).tolist()
    [-0.354, 0.354]
    """
    sizes = np.maximum(np.bincount(groups, minlength=2), 1)
    centred = [v - (np.bincount(groups, v, minlength=2) / sizes)[groups] for v in (predicted, observed)]
    lengths = [np.sqrt((v**2).sum()) for v in centred]
    a, b = centred[0] / lengths[0], centred[1] / lengths[1]
    slopes: Floats = (a - (a * b).sum() * b) / lengths[1]
    return slopes


def spread_to_responses(slopes: Floats, responses: Responses, n: Integers, n_yes: Integers) -> Floats:
    """Turn derivatives by human means into derivatives by the weights of single responses.

    With weights v of the responses, h_i = sum v x / sum v over those to trial i, so at v = 1 a response moves
    it by (x - h_i) / n_i.

    Parameters
    ----------
    slopes : (..., n_trials)
        Derivatives by the human mean of each trial, of one metric or several.
    responses : (n_responses,) each
        Trial, person and answer.
    n, n_yes : (n_trials,)

    Returns
    -------
    (..., n_responses)
    """
    trials, _, answers = responses
    pulls: Floats = slopes[..., trials] * (answers - n_yes[trials] / n[trials]) / n[trials]
    return pulls


def gather_people(pulls: Floats, persons: Integers) -> Floats:
    """Sum derivatives by responses within people, less what drawing trials accounts for already.

    The variance of an estimate that depends on trials and on people is V_trials + V_people - V_both, where
    V_both is that of single responses, which is in both of the others (two-way clustering: Cameron, Gelbach
    and Miller 2011). Trials and people are drawn independently, so the sums over people are scaled such that
    their sum of squares is V_people - V_both, or 0 if that is negative.

    Parameters
    ----------
    pulls : (n_responses,)
        Derivatives by the weights of responses.
    persons : (n_responses,)
        Who responded.

    Returns
    -------
    (n_people,), the last person being the last who responded

    Examples
    --------
    >>> gather_people(np.array([1.0, 1.0, -2.0]), np.array([0, 0, 1])).round(3).tolist()
    [1.0, -1.0]
    """
    sums = np.bincount(persons, pulls).astype(np.float64)
    return sums * _discount(sums, pulls)


def kappa_influences(predicted: Floats, responses: Responses) -> tuple[Floats, Floats]:
    """Derivatives of the mean kappa by the weights of trials and of people; those of people as gathered.

    A person's kappa is 2 (n m - s t) / (n (s + t) - 2 s t), with n trials, s and t the sums of the model's
    and the person's values, and m the sum of their products: the formula of ``mean_kappa`` for values of 0
    and 1 of the person. People whom ``mean_kappa`` leaves out have no influence.

    Parameters
    ----------
    predicted : (n_trials,), each 0, 0.5 or 1
    responses : (n_responses,) each
        Trial, person, and the person's value on it, 0 or 1.

    Returns
    -------
    by_trial : (n_trials,)
        Sums to 0.
    by_person : (n_people,)
        The difference between the person's kappa and the mean, divided by the number of people and scaled as
        in ``gather_people``.
    """
    trials, persons, values = responses
    a, b = predicted[trials], values.astype(np.float64)
    n, s, t, m = (np.bincount(persons, v) for v in (np.ones(a.size), a, b, a * b))
    below = n * (s + t) - 2 * s * t
    usable = (n >= MIN_TRIALS) & (below > 0)
    divisor = np.where(usable, below, 1)
    kappas = np.where(usable, 2 * (n * m - s * t) / divisor, 0)
    n_usable = max(int(usable.sum()), 1)
    by_person: Floats = np.where(usable, kappas - kappas.sum() / n_usable, 0) / n_usable
    n, s, t, m, k, divisor = (v[persons] for v in (n, s, t, m, kappas, divisor))
    slopes = 2 * (m + n * a * b - a * t - s * b) - k * (s + t + n * (a + b) - 2 * (a * t + s * b))
    pulls = np.where(usable[persons], slopes / divisor, 0) / n_usable
    by_trial = np.bincount(trials, pulls, minlength=predicted.size).astype(np.float64)
    return by_trial, by_person * _discount(by_person, pulls)


def _discount(by_person: Floats, by_response: Floats) -> float:
    """The factor that takes the sum of squares of single responses out of that of people."""
    of_people, of_both = float((by_person**2).sum()), float((by_response**2).sum())
    return sqrt(1 - of_both / of_people) if of_people > of_both else 0.0
