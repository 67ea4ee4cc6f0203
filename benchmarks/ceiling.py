"""Show by simulation how high a correlation with people's means can be: sqrt(reliability).

Run with `python benchmarks/ceiling.py`. Simulated people answer trials whose true shares of YES are known. A
model that submits exactly these shares cannot be beaten, so its correlation with the people's means is the
ceiling. Beside it stand the estimates that real data allow, where the truth is unknown. Numbers are means
over simulations with a fixed seed.
"""

import argparse
from dataclasses import astuple, dataclass

import numpy as np

from leaderboard.metrics.agreement import human_r
from leaderboard.metrics.reliability import ceiling_of, count_reliability, split_half_reliability
from leaderboard.metrics.splits import count_halves, split_people
from leaderboard.metrics.undefined import Estimate, Undefined

SEED = 20231105
SIZES = (4, 8, 16, 50)
N_TRIALS, N_SPLITS = 192, 100
SHAPE = 2.0
"""The true shares come from a Beta distribution with this number twice: mean 1/2, standard deviation 0.22."""


@dataclass(frozen=True)
class Row:
    """What one simulation gives, in the order of the table's columns.

    Attributes
    ----------
    oracle_r
        Correlation of the true shares with the people's means: the highest possible.
    ceiling, reliability, split_half_r
        As estimated from halves of the people.
    count_ceiling
        Root of the reliability estimated from counts alone.
    """

    oracle_r: float
    ceiling: float
    reliability: float
    split_half_r: float
    count_ceiling: float


def simulate(n_people: int, repetition: int) -> Row:
    """Let as many people judge all trials."""
    rng = np.random.default_rng([SEED, n_people, repetition])
    shares = rng.beta(SHAPE, SHAPE, N_TRIALS)
    said_yes = (rng.random((n_people, N_TRIALS)) < shares).astype(np.int64)
    persons, trials = (grid.ravel() for grid in np.mgrid[:n_people, :N_TRIALS])
    is_first = split_people(np.zeros(n_people, np.int64), N_SPLITS, seed=SEED, stream=repetition)
    halves = split_half_reliability(count_halves(is_first, persons, trials, said_yes.ravel(), N_TRIALS))
    counts = count_reliability(np.full(N_TRIALS, n_people), said_yes.sum(axis=0))
    return Row(
        oracle_r=defined(human_r(shares, said_yes.mean(axis=0))),
        ceiling=defined(ceiling_of(halves.reliability.value)),
        reliability=defined(halves.reliability.value),
        split_half_r=defined(halves.split_half_r.value),
        count_ceiling=defined(ceiling_of(counts.value)),
    )


def defined(estimate: Estimate) -> float:
    """Unwrap an estimate that cannot be undefined in these simulations."""
    if isinstance(estimate, Undefined):
        raise TypeError(estimate.why)
    return estimate


def main() -> None:
    """Print the table as Markdown."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repetitions", type=int, default=100)
    repetitions = parser.parse_args().repetitions
    print(
        "| people per trial | r of the true shares | sqrt(reliability) | reliability | split-half r "
        "| sqrt(reliability from counts) |\n|---:|---:|---:|---:|---:|---:|"
    )
    for n_people in SIZES:
        rows = [astuple(simulate(n_people, repetition)) for repetition in range(repetitions)]
        means = (f"{mean:.3f}" for mean in np.mean(rows, axis=0))
        print(f"| {n_people} | {' | '.join(means)} |")


if __name__ == "__main__":
    main()
