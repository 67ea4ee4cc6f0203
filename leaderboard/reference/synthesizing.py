"""A simulated reference: trials, labels and people on the definition of a benchmark.

It exists so that everything runs on a fresh machine without the official files. Every config of a trial id
holds the word ``synthetic``, so that nobody takes a simulated trial for a real one.

The design is the paper's: 50 people for each property judge 32 trials each, 16 of them ending in YES. A
property's trials are dealt into disjoint sets with at most one trial of each pair, and everyone judges one
set. A trial's chance to be called YES is logistic:

    logit = ± signal + leaning of the pair + noise of the trial

with + where the label is YES. The leaning is what both trials of a pair suggest at first sight: it moves both
towards the same answer, which makes pairs that are easy and hard at once. Leanings and noise are normal; they
are quantiles in random order, not draws, so that properties of a few hundred trials vary little.

Random numbers are those of ``random.Random(seed).random()`` alone, the one sequence that Python promises to
keep; shuffling, which it does not promise, is sorting by such numbers.
"""

import math
import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import NormalDist
from typing import TypeVar

from leaderboard.errors import BrokenReferenceError, InstanceError
from leaderboard.files import csv_text, write_atomic
from leaderboard.ids import format_pair_id, format_trial_id
from leaderboard.instance import BENCHMARK_FILE, HUMAN_RESPONSES_FILE, HUMAN_TRIALS_FILE, Instance
from leaderboard.models import Benchmark, Manifest, Property, Scenario
from leaderboard.problems import Problems
from leaderboard.reference.definition import read_benchmark, read_manifest, shown
from leaderboard.reference.people import RATING_HEADER, RESPONSE_HEADER
from leaderboard.reference.sealing import broken_reference, seal_reference
from leaderboard.reference.tables import TRIAL_HEADER

PEOPLE_PER_PROPERTY = 50
TRIALS_PER_PERSON = 32

# In logits. Found by trying values on the committed definition until the means over the seeds 0 to 59 were
# those of the paper: human accuracy 0.60 (0.599 ± 0.006 over seeds) and split-half correlation 0.37 (here
# 0.366 ± 0.020). The last property is the hardest, as Deformability is in the paper.
SIGNAL = 0.465
LAST_SIGNAL = 0.36
LEANING_SPREAD = 0.545
NOISE_SPREAD = 0.37

CONFIGS_PER_SCENARIO = 4
CONFIGS = (
    "synthetic-target=bowl-tscale=0.3,0.5,0.3-zdloc=1",
    "synthetic-target=cube-tscale=0.4,0.4,0.4-zdloc=2",
    "synthetic-star=sphere-height=0.8",
    "synthetic-star=pipe-height=1.2-tilt=0.25",
    "synthetic-ramp=30-occluder=none",
    "synthetic-drop=0.9,1.1-distractor=vase",
    "synthetic-zone=far-speed=2.5",
)
FIRST_FRAME, LAST_FRAME = 60, 150

Draw = Callable[[], float]
Item = TypeVar("Item")


@dataclass(frozen=True)
class _Trial:
    trial_id: str
    pair_id: str
    scenario: str
    copy: int
    label: int
    start_frame: int


@dataclass(frozen=True)
class _Judgement:
    participant_id: str
    trial_id: str
    response: int


def synthesize_reference(instance: Instance, seed: int) -> Manifest:
    """Write a simulated reference on the instance's definition, over the one that is there, and seal it.

    Raises
    ------
    BrokenReferenceError
        If there is no usable ``benchmark.toml``, or one that asks for an odd number of trials.
    InstanceError
        If the reference that is there holds official data.
    """
    problems = Problems()
    definition = read_benchmark(instance, problems)
    if definition is None:
        raise broken_reference(problems)
    present = read_manifest(instance, Problems())
    if present is not None and present.kind == "official":
        raise InstanceError(
            f"{shown('')} holds official data, which a simulated reference would replace",
            f"synthesize into a folder of its own (--root DIR) with a copy of {shown(BENCHMARK_FILE)}",
        )
    for name, content in synthesize(definition[1], seed).items():
        write_atomic(instance.reference_file(name), content)
    return seal_reference(instance, "synthetic", sources=())


def synthesize(benchmark: Benchmark, seed: int) -> dict[str, bytes]:
    """Simulate trial lists and human data for a benchmark.

    Parameters
    ----------
    benchmark
        Whose properties and scenarios; a scenario without a number of trials gets an equal share of its
        property's.
    seed
        Equal seeds give equal bytes.

    Returns
    -------
    dict
        Content of each file, by name.
    """
    draw = random.Random(seed).random  # noqa: S311  (a simulation, not a secret)
    files: dict[str, bytes] = {}
    trials: list[_Trial] = []
    judgements: list[_Judgement] = []
    for index, property_ in enumerate(benchmark.properties):
        pairs = _make_pairs(benchmark, property_, draw)
        is_last = property_ is benchmark.properties[-1]
        chances = _draw_chances(pairs, LAST_SIGNAL if is_last else SIGNAL, draw)
        judgements += _ask_people(pairs, chances, index * PEOPLE_PER_PROPERTY, draw)
        own = [trial for pair in pairs for trial in pair]
        files[property_.file] = _render_trials(own)
        trials += own
    files[HUMAN_TRIALS_FILE] = _render_ratings(trials, judgements)
    rows = [(each.participant_id, each.trial_id, each.response) for each in judgements]
    files[HUMAN_RESPONSES_FILE] = csv_text(RESPONSE_HEADER, rows).encode()
    return files


def _make_pairs(benchmark: Benchmark, property_: Property, draw: Draw) -> list[tuple[_Trial, _Trial]]:
    """List a property's pairs in the order of its file, copy 0 first."""
    scenarios = benchmark.scenarios_of(property_.name)
    pairs = []
    for scenario in scenarios:
        n_trials = scenario.trials if scenario.trials is not None else property_.trials // len(scenarios)
        if n_trials % 2:
            raise BrokenReferenceError(
                f"{shown(BENCHMARK_FILE)}: scenario {scenario.id} has {n_trials} trials, which make no pairs",
                "give it an even number of trials",
            )
        pairs += _make_scenario(scenario, benchmark.scenarios.index(scenario), n_trials // 2, draw)
    return pairs


def _make_scenario(
    scenario: Scenario, position: int, n_pairs: int, draw: Draw
) -> list[tuple[_Trial, _Trial]]:
    """List a scenario's pairs; in half of them copy 0 ends in YES."""
    labels = _shuffle([index % 2 for index in range(n_pairs)], draw)
    per_config = math.ceil(n_pairs / CONFIGS_PER_SCENARIO)
    pairs = []
    for index, label in enumerate(labels):
        config = CONFIGS[(position + index // per_config) % len(CONFIGS)]
        number = f"{index % per_config:04d}"
        start_frame = FIRST_FRAME + int(draw() * (LAST_FRAME - FIRST_FRAME + 1))
        first, second = (
            _Trial(
                trial_id=format_trial_id(scenario.id, copy, config, number),
                pair_id=format_pair_id(scenario.id, config, number),
                scenario=scenario.id,
                copy=copy,
                label=label ^ copy,
                start_frame=start_frame,
            )
            for copy in (0, 1)
        )
        pairs.append((first, second))
    return pairs


def _draw_chances(pairs: Sequence[tuple[_Trial, _Trial]], signal: float, draw: Draw) -> dict[str, float]:
    """Give each trial, by its id, the chance that a person calls it YES."""
    leanings = _shuffle(_quantiles(len(pairs), LEANING_SPREAD), draw)
    noises = iter(_shuffle(_quantiles(2 * len(pairs), NOISE_SPREAD), draw))
    chances = {}
    for pair, leaning in zip(pairs, leanings, strict=True):
        for trial in pair:
            logit = (signal if trial.label else -signal) + leaning + next(noises)
            chances[trial.trial_id] = 1 / (1 + math.exp(-logit))
    return chances


def _ask_people(
    pairs: Sequence[tuple[_Trial, _Trial]], chances: dict[str, float], n_before: int, draw: Draw
) -> list[_Judgement]:
    """Let people judge one set of trials each, by participant and then in the order of the file."""
    sets = _deal_sets(pairs, draw)
    judgements = []
    for person in range(PEOPLE_PER_PROPERTY):
        name = f"p{n_before + person + 1:03d}"
        judgements += [
            _Judgement(name, trial.trial_id, int(draw() < chances[trial.trial_id]))
            for trial in sets[person % len(sets)]
        ]
    return judgements


def _deal_sets(pairs: Sequence[tuple[_Trial, _Trial]], draw: Draw) -> list[list[_Trial]]:
    """Deal trials into disjoint sets, each with as many YES as NO and at most one trial of a pair.

    Pairs are dealt out in random order; one that puts its YES trial into some set puts its NO trial into the
    set half-way round.
    """
    n_sets = max(2, round(2 * len(pairs) / TRIALS_PER_PERSON))
    home = {}
    for position, pair in enumerate(_shuffle(pairs, draw)):
        for trial in pair:
            home[trial.trial_id] = (position + (0 if trial.label else n_sets // 2)) % n_sets
    sets: list[list[_Trial]] = [[] for _ in range(n_sets)]
    for pair in pairs:
        for trial in pair:
            sets[home[trial.trial_id]].append(trial)
    return sets


def _render_trials(trials: Sequence[_Trial]) -> bytes:
    rows = [(t.trial_id, t.pair_id, t.scenario, t.copy, t.label, t.start_frame) for t in trials]
    return csv_text(TRIAL_HEADER, rows).encode()


def _render_ratings(trials: Sequence[_Trial], judgements: Sequence[_Judgement]) -> bytes:
    counts = {trial.trial_id: [0, 0] for trial in trials}
    for judgement in judgements:
        counts[judgement.trial_id][0] += 1
        counts[judgement.trial_id][1] += judgement.response
    return csv_text(RATING_HEADER, [(trial_id, *count) for trial_id, count in counts.items()]).encode()


def _quantiles(count: int, spread: float) -> list[float]:
    """Cut a normal distribution with mean 0 into equally likely parts and return the middle of each."""
    normal = NormalDist(0, spread)
    return [normal.inv_cdf((index + 0.5) / count) for index in range(count)]


def _shuffle(items: Sequence[Item], draw: Draw) -> list[Item]:
    return sorted(items, key=lambda _: draw())
