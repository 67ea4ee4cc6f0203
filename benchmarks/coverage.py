"""Simulate how often intervals and rank sets hold the truth.

Run with `python benchmarks/coverage.py`, which takes some minutes on one core; `--simulations` and
`--resamples` make it shorter or finer. Each simulation draws new pairs, answers and people, and asks whether
the 95 % interval of each system holds its true value, and its rank set its true rank.
"""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from leaderboard.grading import Yardstick, grade_people, tally_scores
from leaderboard.grading.draws import Draws
from leaderboard.grading.observations import Observations
from leaderboard.instance import Instance
from leaderboard.metrics.ranks import find_rank_sets, resample_scores
from leaderboard.metrics.resampling import draw_weights
from leaderboard.models import Score
from leaderboard.reference import People, Reference, load_reference
from leaderboard.submission import Submission

ROOT = Path(__file__).resolve().parent.parent
SEED = 20231105
N_STRATA = 10
PAIR_SPREAD = 1.0  # standard deviation of how easy pairs are for all systems, in logits
TAILS = (0.025, 0.975)

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True)
class Setting:
    """Systems of known accuracy, judged on so many pairs."""

    title: str
    accuracies: tuple[float, ...]
    n_pairs: int


def spread(low: float, high: float, number: int) -> tuple[float, ...]:
    """Space accuracies evenly."""
    return tuple(np.linspace(low, high, number).tolist())


SETTINGS = (
    Setting("30 spread .48 to .68", spread(0.48, 0.68, 30), 384),
    Setting("15 exactly at .50, 15 spread .51 to .68", (0.5,) * 15 + spread(0.51, 0.68, 15), 384),
    Setting("15 nearly at .50, 15 spread .51 to .68", spread(0.5, 0.503, 15) + spread(0.51, 0.68, 15), 384),
    Setting("15 close, .50 to .56", spread(0.5, 0.56, 15), 96),
)

PEOPLE_METRICS = (
    *("accuracy", "human_r", "human_r_normalized", "human_r_partial", "human_rmse", "human_gap"),
    *("error_consistency", "cohen_kappa", "pair_accuracy", "pair_order", "auc", "brier", "ece", "human_ece"),
)


@dataclass(frozen=True)
class Coverage:
    """Shares of simulations, by system, in which a statement about it was true; and widths of rank sets."""

    intervals: Floats
    rank_sets: Floats
    percentile_ranks: Floats
    all_rank_sets: float
    width: float


def find_logits(accuracies: Floats) -> Floats:
    """Find the logits that give true accuracies when averaged over pairs of all difficulties (bisection)."""
    nodes, weights = np.polynomial.hermite_e.hermegauss(60)
    low, high = np.full(accuracies.size, -10.0), np.full(accuracies.size, 10.0)
    for _ in range(60):
        middle = (low + high) / 2
        mean = (weights / weights.sum()) @ (1 / (1 + np.exp(-(middle + PAIR_SPREAD * nodes[:, None]))))
        low, high = np.where(mean < accuracies, middle, low), np.where(mean < accuracies, high, middle)
    logits: Floats = (low + high) / 2
    return logits


def simulate_credits(logits: Floats, n_pairs: int, rng: np.random.Generator) -> Integers:
    """Simulate how many of the two trials of each pair each system gets right, (n_systems, n_pairs)."""
    difficulty = PAIR_SPREAD * rng.normal(size=n_pairs)
    chances = 1 / (1 + np.exp(-(logits[:, None] + difficulty)))
    right: Integers = rng.binomial(2, chances)
    return right


def measure_setting(setting: Setting, n_simulations: int, n_resamples: int) -> Coverage:
    """Simulate one setting."""
    truth = np.array(setting.accuracies)
    best = 1 + (truth > truth[:, None] + 1e-12).sum(axis=1)
    worst = truth.size - (truth < truth[:, None] - 1e-12).sum(axis=1)
    strata = np.arange(setting.n_pairs) * N_STRATA // setting.n_pairs
    weights = draw_weights(strata, n_resamples, seed=SEED, stream=0).astype(np.float64)
    logits, rng = find_logits(truth), np.random.default_rng(SEED)
    holds, widths = np.zeros((3, n_simulations, truth.size)), []
    for number in range(n_simulations):
        right = simulate_credits(logits, setting.n_pairs, rng)
        resampled = (weights @ right.T) / (2 * setting.n_pairs)
        low, high = np.quantile(resampled, TAILS, axis=0)
        holds[0, number] = (low <= truth) & (truth <= high)
        found = find_rank_sets(right, strata, resample_scores(right, weights)).T
        holds[1, number] = (found[0] <= best) & (worst <= found[1])
        ranks = 1 + (resampled[:, None, :] > resampled[:, :, None] + 1e-12).sum(axis=2)
        low, high = np.quantile(ranks, TAILS, axis=0)
        holds[2, number] = (low <= best) & (worst <= high)
        widths.append((found[1] - found[0] + 1).mean())
    means = holds.mean(axis=1)
    return Coverage(means[0], means[1], means[2], float(holds[1].all(axis=1).mean()), float(np.mean(widths)))


def simulate_people(reference: Reference, rng: np.random.Generator) -> tuple[Reference, Submission]:
    """Simulate new trials, people and a system on the embedded reference's design.

    Who judges which trial stays. How likely YES is differs between trials and leans toward the label, people
    differ in their leaning toward YES, and the system sees part of what people see and part of the label.
    """
    people = reference.people
    if people is None or people.responses is None:
        raise TypeError("the embedded reference has single responses")
    toward_label = 2 * reference.labels - 1
    logits = 0.5 * toward_label + rng.normal(size=reference.n_trials)
    leaning = 0.5 * rng.normal(size=len(people.responses.participant_ids))
    r = people.responses
    chances = 1 / (1 + np.exp(-(logits[r.trials] + leaning[r.participants])))
    answers = (rng.random(chances.size) < chances).astype(np.int64)
    n_yes = np.bincount(r.trials, answers, minlength=reference.n_trials).astype(np.int64)
    seen = 0.5 * logits + 0.4 * toward_label + rng.normal(size=reference.n_trials)
    simulated = replace(reference, people=People(people.n, n_yes, replace(r, answers=answers)))
    everything = np.ones(reference.n_trials, bool)
    return simulated, Submission(None, None, "0" * 64, 1 / (1 + np.exp(-seen)), everything, everything)


def simulate_scores(n_simulations: int, n_resamples: int) -> Iterator[dict[str, Score]]:
    """Grade simulated systems against simulated people, pairs and people drawn."""
    reference = load_reference(Instance(ROOT))
    grading = reference.benchmark.grading.model_copy(update={"resamples": n_resamples})
    reference = replace(reference, benchmark=reference.benchmark.model_copy(update={"grading": grading}))
    draws, rng = Draws.of(reference), np.random.default_rng(SEED)
    for _ in range(n_simulations):
        simulated, submission = simulate_people(reference, rng)
        yardstick = Yardstick(simulated, draws)
        tally = tally_scores(Observations.of(submission, simulated), submission.covered, yardstick)
        scores = tally.assemble(["overall"])["overall"]["all"].metrics
        human = grade_people(simulated, yardstick=yardstick)["overall"]["all"].metrics
        people_scores = {
            f"people: {name}": human[name] for name in ("accuracy", "split_half_r", "reliability")
        }
        yield {name: scores[name] for name in PEOPLE_METRICS} | people_scores


def print_settings(n_simulations: int, n_resamples: int) -> None:
    """Print the table of systems."""
    print("| systems | pairs | intervals: mean, worst | rank sets: mean, worst, all at once | width ", end="")
    print("| percentile ranks: mean, worst |\n|---|---:|---:|---:|---:|---:|")
    for setting in SETTINGS:
        c = measure_setting(setting, n_simulations, n_resamples)
        cells = [
            f"{c.intervals.mean():.3f}, {c.intervals.min():.3f}",
            f"{c.rank_sets.mean():.3f}, {c.rank_sets.min():.3f}, {c.all_rank_sets:.3f}",
            f"{c.width:.1f}",
            f"{c.percentile_ranks.mean():.3f}, {c.percentile_ranks.min():.3f}",
        ]
        print(f"| {setting.title} | {setting.n_pairs} | {' | '.join(cells)} |", flush=True)


def print_people(n_simulations: int, n_resamples: int) -> None:
    """Print the table of metrics with people drawn; the truth is the mean over the simulations."""
    results = list(simulate_scores(n_simulations, n_resamples))
    print("\n| metric, overall | mean | coverage of the interval |\n|---|---:|---:|")
    for name in results[0]:
        found = np.array([[r[name].value, r[name].low, r[name].high] for r in results], float)
        truth = float(found[:, 0].mean())
        coverage = ((found[:, 1] <= truth) & (truth <= found[:, 2])).mean()
        print(f"| {name} | {truth:.3f} | {coverage:.3f} |")


def main() -> None:
    """Print both tables as Markdown."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--simulations", type=int, default=500)
    parser.add_argument("--resamples", type=int, default=1000)
    options = parser.parse_args()
    print_settings(options.simulations, options.resamples)
    print_people(options.simulations, options.resamples)


if __name__ == "__main__":
    main()
