"""Small references and submissions made in memory, for tests of everything that takes them as values."""

import datetime as dt
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from leaderboard.grading import grade
from leaderboard.metrics.accuracy import credits_of
from leaderboard.models import Benchmark, Manifest, Metadata
from leaderboard.ranking import Entry
from leaderboard.reference.data import People, Reference, Responses
from leaderboard.submission import Submission

SCENARIOS = {"Alpha": ("alpha_one", "alpha_two"), "Beta": ("beta_one",)}


def build_benchmark(pairs_per_scenario: int = 4) -> Benchmark:
    """Define a benchmark of two properties and three scenarios with two tracks."""
    return Benchmark.model_validate(
        {
            "name": "tiny",
            "title": "Tiny",
            "version": "1",
            "question": "Will it?",
            "grading": {"easy": "2/3", "hard": "1/3", "resamples": 200, "seed": 7},
            "properties": [
                {"name": name, "file": f"{name}.csv", "trials": 2 * pairs_per_scenario * len(scenarios)}
                for name, scenarios in SCENARIOS.items()
            ],
            "scenarios": [
                {"id": scenario, "title": scenario.replace("_", " "), "property": name}
                for name, scenarios in SCENARIOS.items()
                for scenario in scenarios
            ],
            "tracks": [
                {"id": "with", "title": "With", "testing": "with_property", "default": True},
                {"id": "without", "title": "Without", "testing": "without_property"},
            ],
        }
    )


def build_reference(
    pairs_per_scenario: int = 4, *, seed: int = 0, n_people: int = 12, responses: bool = True
) -> Reference:
    """Build a paired reference in which every person judges one member of each pair.

    ``n_people=0`` leaves human data out; ``responses=False`` keeps only the counts.
    """
    benchmark = build_benchmark(pairs_per_scenario)
    scenario_ids = [scenario.id for scenario in benchmark.scenarios]
    property_names = [p.name for p in benchmark.properties]
    rows = [
        (scenario, pair, copy)
        for scenario in benchmark.scenarios
        for pair in range(pairs_per_scenario)
        for copy in (0, 1)
    ]
    trial_ids = tuple(f"{s.id}-copy{copy}/set=a,b/{pair:04d}" for s, pair, copy in rows)
    pair_names = [f"{s.id}/set=a,b/{pair:04d}" for s, pair, _ in rows]
    pair_ids = tuple(dict.fromkeys(pair_names))
    rng = np.random.default_rng(seed)
    flips = rng.integers(0, 2, len(pair_ids))
    pairs = np.array([pair_ids.index(name) for name in pair_names])
    copies = np.array([copy for _, _, copy in rows])
    labels = copies ^ flips[pairs]
    return Reference(
        benchmark=benchmark,
        manifest=Manifest(kind="synthetic", files={}, digest="0" * 64),
        trial_ids=trial_ids,
        pair_ids=pair_ids,
        properties=np.array([property_names.index(s.property) for s, _, _ in rows]),
        scenarios=np.array([scenario_ids.index(s.id) for s, _, _ in rows]),
        pairs=pairs,
        copies=copies,
        labels=labels,
        people=_simulate_people(labels, pairs, n_people, rng, responses) if n_people else None,
    )


def shuffle_pairs(reference: Reference, seed: int) -> tuple[Reference, np.ndarray]:
    """Number the pairs in another order; also give the new number of each, shape (n_pairs,)."""
    place = np.random.default_rng(seed).permutation(len(reference.pair_ids))
    names = np.array(reference.pair_ids)
    names[place] = reference.pair_ids
    return replace(reference, pairs=place[reference.pairs], pair_ids=tuple(names.tolist())), place


def build_submission(
    reference: Reference,
    probabilities: Sequence[float],
    *,
    answered: Sequence[bool] | None = None,
    covered: Sequence[bool] | None = None,
) -> Submission:
    """Build a valid submission without metadata; by default every trial is covered and answered."""
    everything = np.ones(reference.n_trials, bool)
    return Submission(
        slug=None,
        metadata=None,
        predictions_sha256="1" * 64,
        probabilities=np.asarray(probabilities, float),
        answered=everything if answered is None else np.asarray(answered, bool),
        covered=everything if covered is None else np.asarray(covered, bool),
    )


def _simulate_people(
    labels: np.ndarray, pairs: np.ndarray, n_people: int, rng: np.random.Generator, responses: bool
) -> People:
    n_pairs = int(pairs.max()) + 1
    people, trials = [], []
    for person in range(n_people):
        member = (np.arange(n_pairs) + person) % 2
        seen = np.flatnonzero(np.arange(len(labels)) % 2 == member[pairs])
        people.append(np.full(len(seen), person))
        trials.append(seen)
    persons, seen_trials = np.concatenate(people), np.concatenate(trials)
    is_right = rng.random(len(seen_trials)) < rng.uniform(0.2, 0.95, len(labels))[seen_trials]
    answers = np.where(is_right, labels[seen_trials], 1 - labels[seen_trials])
    n = np.bincount(seen_trials, minlength=len(labels))
    n_yes = np.bincount(seen_trials, weights=answers, minlength=len(labels)).astype(np.int64)
    names = tuple(f"p{person + 1:03d}" for person in range(n_people))
    return People(n, n_yes, Responses(names, persons, seen_trials, answers) if responses else None)


def build_metadata(name: str = "System", **changes: Any) -> Metadata:
    """Build metadata on the default track of ``build_benchmark``; changes go by key, whatever the section."""
    content: dict[str, dict[str, object]] = {
        "submission": {
            "name": name,
            "system": "system",
            "team": "Team",
            "date": dt.date(2026, 1, 2),
            "description": "A test.",
        },
        "protocol": {"training": "separate", "testing": "with_property"},
        "model": {"family": "other", "inputs": "rgb"},
        "contact": {"github": "someone"},
    }
    for key, value in changes.items():
        section = next((s for s, values in content.items() if key in values), "protocol")
        content[section][key] = value
    return Metadata.model_validate(content)


def build_entry(
    reference: Reference,
    slug: str,
    probabilities: Sequence[float],
    *,
    covered: Sequence[bool] | None = None,
    **changes: Any,
) -> Entry:
    """Grade probabilities into an entry of the board; changes go to its metadata."""
    answered = None if covered is None else covered
    submission = build_submission(reference, probabilities, answered=answered, covered=covered)
    credits = credits_of(submission.probabilities, reference.labels, submission.answered)
    metadata = build_metadata(**({"name": slug} | changes))
    given = np.where(submission.answered, submission.probabilities, np.nan)
    return Entry(slug, metadata, grade(submission, reference), credits, given)
