"""What each pair of trials adds to a submission's overall accuracy, in whole numbers."""

from collections.abc import Sequence
from math import lcm

import numpy as np

from leaderboard.metrics.accuracy import Floats, Integers
from leaderboard.reference import Reference


def count_points(credits: Sequence[Floats], reference: Reference) -> Integers:
    """Count the half credits that each pair earned, whatever its property weighs.

    Parameters
    ----------
    credits : n_submissions of (n_trials,), each 0, 0.5 or 1

    Returns
    -------
    (n_submissions, n_pairs)
    """
    points = [np.bincount(reference.pairs, 2 * c, minlength=len(reference.pair_ids)) for c in credits]
    return np.array(points).reshape(len(credits), -1).astype(np.int64)


def share_out(credits: Sequence[Floats], reference: Reference) -> Integers:
    """Split overall accuracies over pairs: a sum over pairs divided by ``denominator`` is the accuracy.

    Overall accuracy is the mean over properties of the mean credit, so a trial adds its credit divided by the
    trials of its property and by the number of properties. Times the denominator that is whole, and sums of
    whole numbers are exact: equal submissions stay equal on every resample.

    Parameters
    ----------
    credits : n_submissions of (n_trials,), each 0, 0.5 or 1

    Returns
    -------
    (n_submissions, n_pairs)
    """
    sizes = np.bincount(reference.properties)
    worth = np.zeros(len(reference.pair_ids), np.int64)
    worth[reference.pairs] = lcm(*sizes.tolist()) // sizes[reference.properties]
    shares: Integers = count_points(credits, reference) * worth
    return shares


def denominator(reference: Reference) -> int:
    """Give the sum of shares of a submission with every trial right."""
    sizes = np.bincount(reference.properties).tolist()
    return 2 * lcm(*sizes) * len(sizes)
