"""The trials and answers that a stand-in of the release is made of, before any dialect."""

import random
import tomllib
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import NamedTuple

from release_traps import Trap

TRIALS_PER_PERSON = 32
PEOPLE_PER_PROPERTY = 50
PEOPLE_OF_SMALL_RELEASE = 10
CONFIGS = ("target=bowl-zdloc=1", "target=cube-zdloc=2", "star=pipe-height=1.2-tilt=0.25", "zone=far")
CONFIGS_WITH_COMMAS = (
    "target=bowl-tscale=0.3,0.5,0.3-zdloc=1",
    "target=cube-tscale=0.4,0.4,0.4-zdloc=2",
    "drop=0.9,1.1",
)


@dataclass(frozen=True)
class Trial:
    """A trial of the release."""

    property_name: str
    scenario: str
    copy: int
    config: str
    number: str
    label: bool
    start_frame: int

    @property
    def trial_id(self) -> str:
        return f"{self.scenario}-copy{self.copy}/{self.config}/{self.number}"

    @property
    def pair_id(self) -> str:
        return f"{self.scenario}/{self.config}/{self.number}"


class Answer(NamedTuple):
    """One person's answer to one trial."""

    person: str
    trial_id: str
    is_yes: bool


class Sitting(NamedTuple):
    """One person of one property, and the answers in the order in which they were given."""

    person: str
    property_name: str
    answers: tuple[Answer, ...]


@cache
def scenarios() -> tuple[tuple[str, str, int], ...]:
    """List the scenarios of the definition: id, property, number of trials."""
    file = Path(__file__).resolve().parent.parent / "reference" / "benchmark.toml"
    definition = tomllib.loads(file.read_text(encoding="utf-8"))
    return tuple(
        (str(each["id"]), str(each["property"]), int(each["trials"])) for each in definition["scenarios"]
    )


def stream(seed: int, purpose: str) -> random.Random:
    """Open a stream of random numbers that no other purpose disturbs."""
    return random.Random(f"{purpose} {seed}")


def make_trials(seed: int, pairs_per_scenario: int | None, traps: Collection[Trap]) -> tuple[Trial, ...]:
    """Make the trials in the order of their lists, copy 0 before copy 1."""
    trials: list[Trial] = []
    for index, (scenario, property_, n_trials) in enumerate(scenarios()):
        own = _make_scenario(seed, scenario, property_, pairs_per_scenario or n_trials // 2, traps)
        missing = index == 0 and Trap.MISSING_TRIAL in traps
        trials += own[:-1] if missing else own
    return tuple(trials)


def missing_trial(seed: int, pairs_per_scenario: int | None, traps: Collection[Trap]) -> str:
    """Name the trial that ``MISSING_TRIAL`` leaves out."""
    scenario, property_, n_trials = scenarios()[0]
    return _make_scenario(seed, scenario, property_, pairs_per_scenario or n_trials // 2, traps)[-1].trial_id


def _make_scenario(
    seed: int, scenario: str, property_: str, n_pairs: int, traps: Collection[Trap]
) -> list[Trial]:
    rng = stream(seed, f"trials of {scenario}")
    names = CONFIGS_WITH_COMMAS if Trap.CONFIG_COMMAS in traps else CONFIGS
    configs = [f"{scenario.removesuffix('_pp')}-{name}" for name in names]
    places = sorted((index % len(configs), index // len(configs)) for index in range(n_pairs))
    trials = []
    for index, (config, number) in enumerate(places):
        first, start_frame = rng.random() < 0.5, rng.randrange(60, 150)
        second = first if index == 0 and Trap.SAME_LABEL_PAIRS in traps else not first
        for copy, label in enumerate((first, second)):
            # Numbers have gaps, as where the authors dropped scenes.
            name = f"{3 * number + config:04d}"
            trials.append(Trial(property_, scenario, copy, configs[config], name, label, start_frame))
    return trials


def pairs_of(trials: Iterable[Trial]) -> list[list[Trial]]:
    """Group trials into pairs, the member with YES first."""
    pairs: dict[str, list[Trial]] = {}
    for trial in trials:
        pairs.setdefault(trial.pair_id, []).append(trial)
    return [sorted(pair, key=lambda trial: not trial.label) for pair in pairs.values()]


def deal_sets(trials: Collection[Trial], rng: random.Random) -> list[list[Trial]]:
    """Deal a property's trials into disjoint sets with at most one of each pair, as many YES as NO in each.

    As many trials in a set as a person judges; a small release has two sets.
    """
    n_sets = max(2, len(trials) // TRIALS_PER_PERSON)
    sets: list[list[Trial]] = [[] for _ in range(n_sets)]
    pairs = pairs_of(trials)
    rng.shuffle(pairs)
    for index, pair in enumerate(pairs):
        members = pair if index // n_sets % 2 == 0 else pair[::-1]
        for member, trial in enumerate(members):
            sets[(index + member * (n_sets // 2)) % n_sets].append(trial)
    return sets


def ask_people(
    seed: int, trials: Collection[Trial], n_people: int, traps: Collection[Trap]
) -> tuple[Sitting, ...]:
    """Let people judge the trials of their property, everyone one set in an order of their own."""
    sittings: list[Sitting] = []
    for property_ in dict.fromkeys(trial.property_name for trial in trials):
        rng = stream(seed, f"people of {property_}")
        own = [trial for trial in trials if trial.property_name == property_]
        sets, ease = deal_sets(own, rng), {trial: rng.uniform(0.3, 0.9) for trial in own}
        for index in range(n_people):
            person = f"{rng.getrandbits(96):024x}"
            if Trap.SERVICE_IDS not in traps:
                person = f"anon-{property_.lower()}-{index:02d}"
            seen = list(sets[index % len(sets)])
            if index == 2 and Trap.BOTH_MEMBERS in traps:
                seen += _partners(seen[:2], own)
            rng.shuffle(seen)
            said = [trial.label == (rng.random() < ease[trial]) for trial in seen]
            said = _pattern(index, said, traps)
            answers = (Answer(person, t.trial_id, is_yes) for t, is_yes in zip(seen, said, strict=True))
            sittings.append(Sitting(person, property_, tuple(answers)))
    return tuple(sittings)


def _partners(seen: Collection[Trial], trials: Collection[Trial]) -> list[Trial]:
    pair_ids = {trial.pair_id for trial in seen}
    return [trial for trial in trials if trial.pair_id in pair_ids and trial not in seen]


def _pattern(index: int, said: list[bool], traps: Collection[Trap]) -> list[bool]:
    if index == 0 and Trap.STREAK_RATERS in traps:
        return [True] * len(said)
    if index == 1 and Trap.ALTERNATING_RATERS in traps:
        return [place % 2 == 0 for place in range(len(said))]
    return said
