"""Show by simulation that people look good on easy trials and bad on hard ones where none is easier.

Run with `python benchmarks/selection.py`. Every simulated person is right with the same probability on every
trial, so accuracy is the same on whatever subset is chosen without looking at the answers that it is then
measured by. The paper's rule looks at them; the cross-fitted subsets are chosen by other people. Trials are
pooled over simulations with a fixed seed; numbers of trials are means.
"""

import argparse
from dataclasses import astuple, dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from leaderboard.metrics.accuracy import is_above, is_below, right_counts
from leaderboard.metrics.crossfit import cross_fit
from leaderboard.metrics.splits import count_halves, split_people

Integers = NDArray[np.int64]

SEED = 20231105
SIZES = (4, 8, 16)
N_TRIALS, N_SPLITS = 192, 100
ACCURACY = 0.6
EASY, HARD = Fraction(2, 3), Fraction(1, 3)


@dataclass(frozen=True)
class Rule:
    """Easy and hard trials by one rule: the sum of people's accuracy over them, and how many they are."""

    easy: float
    n_easy: float
    hard: float
    n_hard: float


@dataclass(frozen=True)
class Sample:
    """Simulated answers to pairs of trials with opposite labels.

    Attributes
    ----------
    said_yes : (n_people, n_trials)
        1 for YES, 0 for NO.
    labels, pairs : (n_trials,)
    """

    said_yes: Integers
    labels: Integers
    pairs: Integers


def simulate(n_people: int, repetition: int) -> Sample:
    """Let everyone judge every trial, right with the same probability."""
    rng = np.random.default_rng([SEED, n_people, repetition])
    labels = np.tile([1, 0], N_TRIALS // 2)
    is_right = rng.random((n_people, N_TRIALS)) < ACCURACY
    return Sample(np.where(is_right, labels, 1 - labels), labels, np.repeat(np.arange(N_TRIALS // 2), 2))


def measure_all(sample: Sample) -> float:
    """Measure people on all trials."""
    return float((sample.said_yes == sample.labels).mean())


def apply_paper_rule(sample: Sample) -> Rule:
    """Choose and measure on the same people."""
    n = np.full(N_TRIALS, len(sample.said_yes))
    right = right_counts(n, sample.said_yes.sum(axis=0), sample.labels)
    found: list[float] = []
    for mask in (is_above(right, n, EASY), is_below(right, n, HARD)):
        chosen = np.isin(sample.pairs, sample.pairs[mask])
        found += [float((right / n)[chosen].sum()), float(chosen.sum())]
    return Rule(*found)


def apply_cross_fitting(sample: Sample, repetition: int) -> Rule:
    """Choose on one half of the people and measure on the other."""
    n_people = len(sample.said_yes)
    persons, trials = (grid.ravel() for grid in np.mgrid[:n_people, :N_TRIALS])
    is_first = split_people(np.zeros(n_people, np.int64), N_SPLITS, seed=SEED, stream=repetition)
    halves = count_halves(is_first, persons, trials, sample.said_yes.ravel(), N_TRIALS)
    found = cross_fit(halves, sample.labels, sample.pairs, easy=EASY, hard=HARD)
    easy, hard = (float(subset.right_sum.sum()) for subset in (found.easy, found.hard))
    return Rule(easy, found.easy.n_trials, hard, found.hard.n_trials)


def main() -> None:
    """Print the table as Markdown."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repetitions", type=int, default=100)
    repetitions = parser.parse_args().repetitions
    print(
        f"| people per trial | rule | all {N_TRIALS} | easy | trials | hard | trials |\n"
        "|---:|---|---:|---:|---:|---:|---:|"
    )
    for n_people in SIZES:
        samples = [simulate(n_people, repetition) for repetition in range(repetitions)]
        overall = np.mean([measure_all(sample) for sample in samples])
        rules = {
            "same people choose and are measured": [apply_paper_rule(sample) for sample in samples],
            "cross-fitted": [apply_cross_fitting(sample, index) for index, sample in enumerate(samples)],
        }
        for name, found in rules.items():
            easy, n_easy, hard, n_hard = np.mean([astuple(rule) for rule in found], axis=0)
            subsets = f"{easy / n_easy:.3f} | {n_easy:.0f} | {hard / n_hard:.3f} | {n_hard:.0f}"
            print(f"| {n_people} | {name} | {overall:.3f} | {subsets} |")


if __name__ == "__main__":
    main()
