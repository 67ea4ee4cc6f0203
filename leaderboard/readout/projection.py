"""Standardised features in as few dimensions as there are trials to fit on, without loss."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from leaderboard.errors import SourceError
from leaderboard.readout.features import Reals
from leaderboard.readout.matching import FittingSet, TargetSet

Floats = NDArray[np.float64]

COLUMNS = 4096  # at a time: the standardised features are never in memory as a whole
SMALLEST = 1e-12  # of the largest eigenvalue; below, there is nothing but rounding


@dataclass(frozen=True)
class Projection:
    """Coordinates that have the same scalar products as the standardised features.

    Attributes
    ----------
    fitting : (n_fitting, n_dimensions)
        Of the trials to fit on.
    test : (n_test, n_dimensions)
        Of the test trials; what of them is orthogonal to all trials to fit on is left out.
    n_features
        Number of features that vary.
    n_constant
        Number of those that are the same on all trials to fit on, and are not used.
    """

    fitting: Floats
    test: Floats
    n_features: int
    n_constant: int


def project(fitting: FittingSet, test: TargetSet) -> Projection:
    """Standardise by the trials to fit on, and turn many features into at most as many as these.

    Weights that are fitted with a penalty on their length lie in the span of the trials that they are fitted
    on (Kimeldorf & Wahba 1971). In an orthonormal basis of it, trials, weights and penalty are the same
    numbers as with all features, so the fit is the same, whatever the number of features. The basis comes
    from the eigenvectors of the trials' scalar products.

    Raises
    ------
    SourceError
        If the two sets have different features, or no feature varies.
    """
    n_fitting, width = fitting.values.shape
    if test.values.shape[1] != width:
        message = f"the trials to fit on have {width:,} features, the test trials {test.values.shape[1]:,}"
        raise SourceError(f"{fitting.name}: {message}", "extract both with the same model and pooling")
    n_constant = 0
    parts, products = [], np.zeros((n_fitting + len(test.values), n_fitting))
    for block, n in _standardise(fitting.values, test.values):
        n_constant += n
        if width <= n_fitting:
            parts.append(block)
        else:
            products += block @ block[:n_fitting].T
    if n_constant == width:
        hint = "are they those of the right layer, and of different videos?"
        raise SourceError(f"{fitting.name}: every feature is the same on all trials to fit on", hint)
    coordinates = np.hstack(parts) if parts else _find_coordinates(products, n_fitting)
    return Projection(coordinates[:n_fitting], coordinates[n_fitting:], width - n_constant, n_constant)


def _standardise(fitting: Reals, test: Reals) -> Iterator[tuple[Floats, int]]:
    """Yield columns of both sets with mean 0 and variance 1 on the first, and how many were constant."""
    for start in range(0, fitting.shape[1], COLUMNS):
        columns = slice(start, start + COLUMNS)
        block = np.vstack([fitting[:, columns], test[:, columns]], dtype=np.float64)
        own = block[: len(fitting)]
        mean, deviation = own.mean(axis=0), own.std(axis=0)
        noise = np.finfo(np.float64).eps * len(own) * np.abs(own).max(axis=0)
        varies = deviation > noise
        block = (block[:, varies] - mean[varies]) / deviation[varies]
        yield block, int(np.count_nonzero(~varies))


def _find_coordinates(products: Floats, n_fitting: int) -> Floats:
    values, vectors = np.linalg.eigh(products[:n_fitting])
    is_kept = values > SMALLEST * values[-1]
    values, vectors = values[is_kept][::-1], vectors[:, is_kept][:, ::-1]
    signs = np.sign(vectors[np.abs(vectors).argmax(axis=0), np.arange(len(values))])
    coordinates: Floats = products @ (vectors * signs / np.sqrt(values))
    return coordinates
