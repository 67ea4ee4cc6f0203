"""Measure what scoring costs: one submission, a thousand, and intervals with ranks beside other packages.

Run with `python benchmarks/scoring.py`. The other packages belong to this comparison alone; the project does
not depend on them. Where one is missing, the run says so and leaves it out:

    python -m pip install errorbars==0.2.4 honestboard==0.6.1 scipy

All times are wall times in this process, after imports and a warm-up: medians of several runs, and of runs
in turn where packages are compared. Exit status 1 if a limit is exceeded.
"""

import argparse
import datetime as dt
import importlib
import multiprocessing
import resource
import statistics
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from statistics import NormalDist
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from leaderboard.grading import Yardstick, grade
from leaderboard.instance import Instance
from leaderboard.metrics.accuracy import credits_of
from leaderboard.metrics.ranks import find_best_probabilities, find_rank_sets, resample_scores
from leaderboard.metrics.resampling import Interval, draw_weights, percentile_interval
from leaderboard.models import Metadata, Result
from leaderboard.ranking import Entry, rank_entries
from leaderboard.reference import Reference, load_reference
from leaderboard.submission import Submission

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
T = TypeVar("T")

ROOT = Path(__file__).resolve().parent.parent
INSTALL = "python -m pip install errorbars==0.2.4 honestboard==0.6.1 scipy"
SEED = 20231105
N_RESAMPLES = 10_000
DATE = dt.date(2026, 11, 21)

SIZES = (10, 100, 1_000)
N_PROCESSES = 2
GRADE_LIMIT = 0.060  # seconds, one submission
BOARD_LIMIT = 10.0  # seconds, a whole board
MEMORY_LIMIT = 1_000  # MB, the process

N_SYSTEMS, N_PAIRS, N_SCENARIOS = 30, 384, 10
LOWEST, HIGHEST = 0.48, 0.68
FASTER_LIMIT = 10.0  # times, beside the fastest rival
BATCH = 250  # resamples that SciPy takes at a time: fastest of 50 to 10,000


@dataclass(frozen=True)
class Case:
    """A board for all packages: what is right, and what belongs together.

    Attributes
    ----------
    right : (n_systems, n_pairs, 2)
        1 where a system is right on a member of a pair, otherwise 0; the first system is the best.
    strata : (n_pairs,)
        Each pair's scenario.
    """

    right: Integers
    strata: Integers

    @property
    def trials(self) -> Integers:
        """The same with members side by side, shape (n_systems, n_trials)."""
        return self.right.reshape(len(self.right), -1)

    @property
    def pair_of_trial(self) -> Integers:
        """Each trial's pair, shape (n_trials,)."""
        return np.repeat(np.arange(len(self.strata)), 2)


@dataclass(frozen=True)
class Answer:
    """What a package says of the system that scored best: its 95 % interval and its possible ranks."""

    low: float
    high: float
    ranks: str


@dataclass(frozen=True)
class Contender:
    """A package, what it is asked to do, and how; preparing its data is not timed."""

    name: str
    task: str
    run: Callable[[], Answer]


def simulate_case() -> Case:
    """Simulate systems of evenly spread true accuracy.

    For half of the pairs a system sees no difference between the twins and gives both the same answer, so it
    is right on exactly one; for the others it is right independently, as often as its accuracy then asks.
    """
    rng = np.random.default_rng(SEED)
    accuracy = np.linspace(HIGHEST, LOWEST, N_SYSTEMS)
    shape = (N_SYSTEMS, N_PAIRS)
    first, is_same = rng.integers(0, 2, (2, *shape))
    same = np.stack([first, 1 - first], axis=-1)
    own = rng.random((*shape, 2)) < (2 * accuracy - 0.5)[:, None, None]
    right = np.where(is_same[..., None], same, own)
    right = right[np.argsort(-right.sum(axis=(1, 2)), kind="stable")]
    return Case(right, np.arange(N_PAIRS) * N_SCENARIOS // N_PAIRS)


def prepare_ours(case: Case, *, is_drawn: bool) -> Contender:
    """Prepare this project: it draws resamples as the others do, or finds them drawn, as after grading."""
    shares = case.right.sum(axis=2)
    n_trials = case.pair_of_trial.size
    drawn = draw_case(case) if is_drawn else None

    def run() -> Answer:
        weights = draw_case(case) if drawn is None else drawn
        scores = resample_scores(shares, weights)
        means = scores.astype(np.float64) / n_trials
        values = (shares.sum(axis=1) / n_trials).tolist()
        intervals = [percentile_interval(value, row) for value, row in zip(values, means, strict=True)]
        ranks = find_rank_sets(shares, case.strata, scores).tolist()
        find_best_probabilities(scores)
        best = intervals[0]
        if not isinstance(best, Interval):
            raise TypeError("a mean over drawn pairs always has a value")
        return Answer(best.low, best.high, f"{ranks[0][0]}-{ranks[0][1]}")

    if is_drawn:
        return Contender("this project, resamples at hand", "the same from resamples that grading drew", run)
    task = f"{N_RESAMPLES:,} resamples of pairs within scenarios; percentiles; rank sets by test inversion"
    return Contender("this project", task, run)


def draw_case(case: Case) -> NDArray[np.float32]:
    """Draw the resamples of the case, shape (n_resamples, n_pairs)."""
    return draw_weights(case.strata, N_RESAMPLES, seed=SEED, stream=0).astype(np.float32)


def prepare_scipy(case: Case) -> Contender:
    """Prepare SciPy's bootstrap in the fastest form found: a sample per scenario, batches at once, float32.

    It has no ranks; they are taken from its resamples.
    """
    stats = importlib.import_module("scipy.stats")
    shares = case.right.sum(axis=2, dtype=np.float32)
    samples = [shares[:, case.strata == stratum] for stratum in range(N_SCENARIOS)]
    n_trials = case.pair_of_trial.size

    def mean(*resampled: NDArray[np.float32], axis: int) -> NDArray[np.float32]:
        total: NDArray[np.float32] = np.add.reduce([sample.sum(axis=axis) for sample in resampled])
        return total / np.float32(n_trials)

    def run() -> Answer:
        rng = np.random.default_rng(SEED)
        options = {"n_resamples": N_RESAMPLES, "batch": BATCH, "method": "percentile", "rng": rng}
        result = stats.bootstrap(samples, mean, vectorized=True, axis=-1, **options)
        ranks = stats.rankdata(-result.bootstrap_distribution, method="min", axis=0)
        first, last = np.percentile(ranks, (2.5, 97.5), axis=1)
        low, high = result.confidence_interval
        return Answer(low[0], high[0], f"{first[0]:.0f}-{last[0]:.0f}")

    task = f"{N_RESAMPLES:,} resamples of pairs within scenarios; percentiles of accuracy and of ranks"
    return Contender(f"SciPy {version('scipy')}", task, run)


def prepare_honestboard(case: Case) -> Contender:
    """Prepare honestboard: its rank summary, and intervals from its covariance matrix, as it gives none."""
    honestboard = importlib.import_module("honestboard")
    names = [f"system {index}" for index in range(N_SYSTEMS)]
    board = honestboard.Board(names, case.trials, clusters=case.pair_of_trial)

    def run() -> Answer:
        summary = board.rank_summary(B=N_RESAMPLES, cluster=True)
        reach = NormalDist().inv_cdf(0.975) * np.sqrt(np.diag(board.sigma(cluster=True)))
        best = summary[0]
        ranks = f"{best['rank_lo']:.0f}-{best['rank_hi']:.0f}"
        return Answer(best["score"] - reach[0], best["score"] + reach[0], ranks)

    task = f"{N_RESAMPLES:,} resamples of pairs; normal intervals; percentiles of ranks"
    return Contender(f"honestboard {version('honestboard')}", task, run)


def prepare_errorbars(case: Case) -> Contender:
    """Prepare errorbars: its leaderboard, and intervals by pairs, as its ``summarize`` gives them."""
    stats, board = (importlib.import_module(f"errorbars.{name}") for name in ("stats", "leaderboard"))
    names = [f"system {index}" for index in range(N_SYSTEMS)]
    pairs = [str(pair) for pair in case.pair_of_trial.tolist()]
    data = importlib.import_module("errorbars.io").EvalData(
        question_id=[str(trial) for trial in range(len(pairs))] * N_SYSTEMS,
        model=[name for name in names for _ in pairs],
        score=case.trials.astype(float).ravel().tolist(),
        cluster_id=pairs * N_SYSTEMS,
    )

    def run() -> Answer:
        made = board.build_leaderboard(data)
        critical = stats.t_for_confidence(0.95, N_PAIRS - 1)
        reach = [critical * stats.cluster_robust_se(row, pairs) for row in case.trials]
        best = made.entries[0]
        equals = set().union(*(group for group in made.groups if best.model in group))
        return Answer(best.mean - reach[0], best.mean + reach[0], f"1-{len(equals)}")

    task = "no resamples: standard errors by pairs; 435 paired t-tests with Holm's correction, groups"
    return Contender(f"errorbars {version('errorbars')}", task, run)


def prepare_rivals(case: Case) -> list[Contender]:
    """Prepare the rivals that are installed, and say which are not."""
    rivals = []
    for prepare in (prepare_scipy, prepare_honestboard, prepare_errorbars):
        try:
            rivals.append(prepare(case))
        except ModuleNotFoundError as error:
            print(f"{error.name} is not installed, so it is left out below. For this benchmark: {INSTALL}\n")
    return rivals


def run_in_turn(contenders: Sequence[Contender], runs: int) -> list[tuple[Answer, float]]:
    """Let each answer once for warming up, then all in turn; return answers and median seconds."""
    answers = [contender.run() for contender in contenders]
    rounds = [[measure(contender.run)[1] for contender in contenders] for _ in range(runs)]
    return list(zip(answers, map(statistics.median, zip(*rounds, strict=True)), strict=True))


def compare_packages(runs: int) -> bool:
    """Print intervals and ranks of all packages; return whether the fastest rival is beaten by enough."""
    case = simulate_case()
    rivals = prepare_rivals(case)
    contenders = [prepare_ours(case, is_drawn=False), prepare_ours(case, is_drawn=True), *rivals]
    measured = run_in_turn(contenders, runs)
    ours = measured[0][1]
    print("| package | what it did | ms | times ours | best system's accuracy | its ranks |")
    print("|---|---|---:|---:|---|---:|")
    for contender, (answer, seconds) in zip(contenders, measured, strict=True):
        times = f"{1000 * seconds:.0f} | {seconds / ours:.2f}"
        answered = f"[{answer.low:.3f}, {answer.high:.3f}] | {answer.ranks}"
        print(f"| {contender.name} | {contender.task} | {times} | {answered} |")
    print()
    if not rivals:
        return True
    ratio = min(seconds for _, seconds in measured[2:]) / ours
    is_within = ratio >= FASTER_LIMIT
    limit = f"limit: at least {FASTER_LIMIT:g} times; within? {say(is_within)}"
    print(f"The fastest of the others takes {ratio:.1f} times as long as this project; {limit}.")
    return is_within


def simulate_submissions(reference: Reference, n: int) -> list[Submission]:
    """Simulate complete submissions of evenly spread skill: logistic of a pull to the label plus noise."""
    rng = np.random.default_rng(SEED)
    noise = rng.standard_normal((n, reference.n_trials))
    logits = np.linspace(-0.1, 0.9, n)[:, None] * (2 * reference.labels - 1) + noise
    everything = np.ones(reference.n_trials, bool)
    return [
        Submission(None, None, "0" * 64, probabilities, everything, everything)
        for probabilities in (1 / (1 + np.exp(-logits))).round(4)
    ]


def grade_all(submissions: Sequence[Submission], reference: Reference, yardstick: Yardstick) -> list[Result]:
    """Grade submissions with what they share: resamples, subsets, and how well people agree."""
    return [grade(submission, reference, yardstick=yardstick) for submission in submissions]


def grade_on_two_cores(
    submissions: Sequence[Submission], reference: Reference, yardstick: Yardstick
) -> list[Result]:
    """Do the same in two processes, each of which grades every other submission.

    They are forks of this one once everything shared is computed, so that they share its memory.
    """
    first = grade_all(submissions[:1], reference, yardstick)
    _memory_when_forked[:] = [read_memory()]
    context = multiprocessing.get_context("fork")
    with ProcessPoolExecutor(N_PROCESSES, context, _remember, (reference, yardstick)) as pool:
        return first + list(pool.map(_grade_remembered, submissions[1:], chunksize=8))


_shared: list[tuple[Reference, Yardstick]] = []
_memory_when_forked = [0.0]


def _remember(reference: Reference, yardstick: Yardstick) -> None:
    """Keep what all grades of a process share."""
    _shared.append((reference, yardstick))


def _grade_remembered(submission: Submission) -> Result:
    reference, yardstick = _shared[0]
    return grade(submission, reference, yardstick=yardstick)


def rank_all(
    submissions: Sequence[Submission], results: Sequence[Result], reference: Reference, yardstick: Yardstick
) -> None:
    """Rank graded submissions on the default track, with rank sets and all else that a board says."""
    entries = []
    for index, (submission, result) in enumerate(zip(submissions, results, strict=True)):
        credits = credits_of(submission.probabilities, reference.labels, submission.answered)
        slug = f"system-{index:04d}"
        given = np.where(submission.answered, submission.probabilities, np.nan)
        entries.append(Entry(slug, describe_system(slug, reference), result, credits, given))
    rank_entries(entries, reference.benchmark.default_track, yardstick=yardstick)


def describe_system(slug: str, reference: Reference) -> Metadata:
    """Describe a simulated system of the default track."""
    track = reference.benchmark.default_track
    return Metadata.model_validate(
        {
            "submission": {
                "name": slug,
                "system": slug,
                "team": "Team",
                "date": DATE,
                "description": "Simulated.",
            },
            "protocol": {"training": track.training, "testing": track.testing},
            "model": {"family": "other", "inputs": "rgb"},
            "contact": {"github": "ghost"},
        }
    )


def measure_one(reference: Reference, runs: int) -> bool:
    """Print what one submission costs; return whether it is within the limit."""
    submissions = simulate_submissions(reference, 1)
    shared = Yardstick.of(reference)

    def take_median(get_yardstick: Callable[[], Yardstick]) -> float:
        grade_all(submissions, reference, get_yardstick())
        times = [measure(lambda: grade_all(submissions, reference, get_yardstick()))[1] for _ in range(runs)]
        return statistics.median(times)

    alone, further = take_median(lambda: Yardstick.of(reference)), take_median(lambda: shared)
    is_within = alone <= GRADE_LIMIT
    print("| grading a complete submission | ms | limit | within? |\n|---|---:|---:|---|")
    print(f"| by itself | {1000 * alone:.1f} | {1000 * GRADE_LIMIT:g} | {say(is_within)} |")
    print(f"| after others, with what they share | {1000 * further:.1f} | | |\n")
    return is_within


def measure_board(reference: Reference, n: int) -> bool:
    """Print a row of what a board of ``n`` submissions costs; return whether it is within the limits."""
    submissions = simulate_submissions(reference, n)
    yardstick, preparing = measure(lambda: Yardstick.of(reference))
    results, grading = measure(lambda: grade_on_two_cores(submissions, reference, yardstick))
    _, ranking = measure(lambda: rank_all(submissions, results, reference, yardstick))
    grading += preparing
    seconds, peak = grading + ranking, read_peak_memory()
    is_within = seconds <= BOARD_LIMIT and peak <= MEMORY_LIMIT
    parts = f"{grading:.2f} | {ranking:.2f} | {seconds:.2f} | {1000 * seconds / len(results):.1f}"
    print(f"| {n:,} | {parts} | {peak:.0f} | {say(is_within)} |")
    return is_within


def measure_growth(reference: Reference) -> bool:
    """Print what boards of growing size cost; return whether all are within the limits."""
    limits = f"at most {BOARD_LIMIT:g} s and {MEMORY_LIMIT:,} MB?"
    print(f"| submissions | grading, s | ranking, s | both, s | each, ms | peak memory, MB | {limits} |")
    print("|---:|---:|---:|---:|---:|---:|---|")
    are_within = [measure_board(reference, n) for n in SIZES]
    print()
    return all(are_within)


def measure(function: Callable[[], T]) -> tuple[T, float]:
    """Call a function; return its value and the seconds that it took."""
    start = time.perf_counter()
    value = function()
    return value, time.perf_counter() - start


def read_memory() -> float:
    """Memory that this process holds now, in MB; 0 where the system does not say."""
    file = Path("/proc/self/statm")
    return int(file.read_text().split()[1]) * resource.getpagesize() / 1e6 if file.exists() else 0.0


def read_peak_memory() -> float:
    """Most memory that this process has held so far and its forks besides, in MB.

    The system counts in kB, macOS in bytes; what forks hold includes what they share with this process.
    """
    unit = 1e6 if sys.platform == "darwin" else 1e3
    own, fork = (
        resource.getrusage(who).ru_maxrss / unit for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )
    return own + N_PROCESSES * max(fork - _memory_when_forked[0], 0)


def say(is_within: bool) -> str:  # noqa: FBT001
    """Answer with a word."""
    return "yes" if is_within else "no"


def main() -> None:
    """Print the tables as Markdown; exit status 1 if a limit is exceeded."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--runs", type=int, default=15)
    runs = parser.parse_args().runs
    reference = load_reference(Instance(ROOT))
    # Boards first: the peak of memory is the process's, and the rivals are to have no part in it.
    are_within = [measure_one(reference, runs), measure_growth(reference), compare_packages(runs)]
    sys.exit(0 if all(are_within) else 1)


if __name__ == "__main__":
    main()
