"""Write the simulated example systems of the demo board into submissions/; run by `make examples`.

Their probabilities come from the embedded reference and a seeded generator: logistic of a signal toward the
label, a pull toward the human mean, and noise that both members of a pair share in part. They stand for no
real system, and their names say so.
"""

import datetime as dt
import math
import random
from dataclasses import dataclass
from pathlib import Path

from leaderboard.files import csv_text
from leaderboard.instance import Instance
from leaderboard.reference import Reference, load_reference
from leaderboard.submitting import render_metadata, replace_submission

DATE = dt.date(2026, 11, 21)


@dataclass(frozen=True)
class Example:
    """A simulated system: its metadata, how strong its signals are, and what it covers (None: everything)."""

    slug: str
    name: str
    system: str
    family: str
    inputs: str
    testing: str
    signal: float
    human_pull: float
    seed: int
    scenarios: tuple[str, ...] | None = None


EXAMPLES = (
    Example(
        slug="example-slots",
        name="Example Slots (simulated)",
        system="example-slots",
        family="object-centric",
        inputs="rgb",
        testing="with_property",
        signal=0.30,
        human_pull=0.8,
        seed=11,
    ),
    Example(
        slug="example-slots-without-property",
        name="Example Slots (simulated)",
        system="example-slots",
        family="object-centric",
        inputs="rgb",
        testing="without_property",
        signal=0.16,
        human_pull=0.8,
        seed=12,
    ),
    Example(
        slug="example-particles",
        name="Example Particles (simulated)",
        system="example-particles",
        family="particle",
        inputs="state",
        testing="with_property",
        signal=0.62,
        human_pull=0.0,
        seed=13,
    ),
    Example(
        slug="example-pixels",
        name="Example Pixels (simulated)",
        system="example-pixels",
        family="video",
        inputs="rgb",
        testing="with_property",
        signal=0.10,
        human_pull=0.2,
        seed=14,
        scenarios=("mass_dominoes_pp", "mass_waterpush_pp", "mass_collision_pp", "friction_platform_pp"),
    ),
)


def simulate_predictions(example: Example, reference: Reference) -> bytes:
    """Simulate P(YES) for every covered trial, as the bytes of ``predictions.csv``."""
    rng = random.Random(example.seed)  # noqa: S311  (simulation, not a secret; stable over Python versions)
    people = reference.people
    shared = [_normal(rng) for _ in reference.pair_ids]
    rows = []
    for index, trial_id in enumerate(reference.trial_ids):
        own = _normal(rng)
        scenario = reference.benchmark.scenarios[reference.scenarios[index]].id
        if example.scenarios is not None and scenario not in example.scenarios:
            continue
        human = people.n_yes[index] / people.n[index] if people and people.n[index] else 0.5
        sign = 2 * int(reference.labels[index]) - 1
        noise = 0.6 * shared[reference.pairs[index]] + 0.8 * own
        logit = example.signal * sign + example.human_pull * (human - 0.5) + noise
        rows.append([trial_id, f"{1 / (1 + math.exp(-logit)):.4f}"])
    return csv_text(["trial_id", "probability"], rows).encode()


def describe_example(example: Example) -> bytes:
    """Write an example's ``submission.toml``."""
    return render_metadata(
        {
            "submission": {
                "name": example.name,
                "system": example.system,
                "team": "Physion++ examples",
                "date": DATE,
                "description": "A simulated system that shows how the board looks. No model was run.",
            },
            "protocol": {"training": "separate", "testing": example.testing},
            "model": {"family": example.family, "inputs": example.inputs},
            "contact": {"github": "ghost"},
        }
    )


def _normal(rng: random.Random) -> float:
    """Draw from a standard normal by Box and Muller, from uniform numbers that Python promises to keep."""
    radius = math.sqrt(-2 * math.log(1 - rng.random()))
    return radius * math.cos(2 * math.pi * rng.random())


def main() -> None:
    """Write all examples into the instance that this file belongs to."""
    instance = Instance(Path(__file__).resolve().parent.parent)
    reference = load_reference(instance)
    for example in EXAMPLES:
        predictions, metadata = simulate_predictions(example, reference), describe_example(example)
        replace_submission(instance, reference, example.slug, metadata, predictions, today=DATE)
        print(f"wrote submissions/{example.slug}")


if __name__ == "__main__":
    main()
