"""Reference lines that need no model: chance, always YES, the human mean and the label oracle."""

import datetime as dt
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from leaderboard.files import csv_text
from leaderboard.instance import SUBMISSION_FILE, Instance
from leaderboard.reference import Reference
from leaderboard.submitting import render_metadata, replace_submission


@dataclass(frozen=True)
class Baseline:
    """A rule that gives every trial of a reference a probability."""

    slug: str
    name: str
    description: str
    predict: Callable[[Reference], NDArray[np.float64]]


def predict_chance(reference: Reference) -> NDArray[np.float64]:
    """Answer 0.5 everywhere, shape (n_trials,)."""
    return np.full(reference.n_trials, 0.5)


def predict_yes(reference: Reference) -> NDArray[np.float64]:
    """Answer YES with certainty everywhere, shape (n_trials,)."""
    return np.ones(reference.n_trials)


def predict_human_mean(reference: Reference) -> NDArray[np.float64]:
    """Answer with the share of people who said YES, and 0.5 where nobody was asked, shape (n_trials,)."""
    if reference.people is None:
        return predict_chance(reference)
    n, n_yes = reference.people.n, reference.people.n_yes
    return np.where(n > 0, n_yes / np.maximum(n, 1), 0.5)


def predict_labels(reference: Reference) -> NDArray[np.float64]:
    """Answer with the label, shape (n_trials,)."""
    return reference.labels.astype(np.float64)


BASELINES = (
    Baseline("baseline-chance", "Chance", "Answers 0.5 on every trial.", predict_chance),
    Baseline("baseline-always-yes", "Always YES", "Answers YES on every trial.", predict_yes),
    Baseline(
        "baseline-human-mean",
        "Human mean",
        "Answers with the share of people who said YES; 0.5 where nobody was asked.",
        predict_human_mean,
    ),
    Baseline("baseline-oracle", "Label oracle", "Answers with the label itself.", predict_labels),
)


def available_baselines(reference: Reference) -> tuple[Baseline, ...]:
    """The baselines that make sense here: without human data there is no human mean."""
    return tuple(b for b in BASELINES if reference.people is not None or b.predict is not predict_human_mean)


def add_baselines(
    instance: Instance, reference: Reference, *, date: dt.date | None, today: dt.date
) -> list[str]:
    """Write all baselines as graded submissions and return their slugs.

    One that is there already is written anew, so that it fits the reference as it is now; it keeps its date
    unless ``date`` is given. A new one gets ``date`` or ``today``.
    """
    slugs = []
    for baseline in available_baselines(reference):
        folder = instance.submission_dir(baseline.slug)
        day = date or _read_date(folder) or today
        metadata = render_metadata(baseline_metadata(baseline, reference, day))
        predictions = baseline_predictions(baseline, reference)
        replace_submission(instance, reference, baseline.slug, metadata, predictions, today=today)
        slugs.append(baseline.slug)
    return slugs


def baseline_metadata(
    baseline: Baseline, reference: Reference, date: dt.date
) -> dict[str, dict[str, object]]:
    """Describe a baseline as a submission; its protocol is that of the default track, but it is on all."""
    track = reference.benchmark.default_track
    return {
        "submission": {
            "name": baseline.name,
            "system": baseline.slug,
            "team": f"{reference.benchmark.title} maintainers",
            "date": date,
            "description": baseline.description,
        },
        "protocol": {
            "training": track.training or "zero_shot",
            "testing": track.testing or "with_property",
        },
        "model": {"family": "baseline", "inputs": "rgb"},
        "contact": {"github": "ghost"},
    }


def baseline_predictions(baseline: Baseline, reference: Reference) -> bytes:
    """Write a baseline's predictions in the reference's order, as the bytes of ``predictions.csv``."""
    probabilities = baseline.predict(reference).tolist()
    rows = zip(reference.trial_ids, (repr(p) for p in probabilities), strict=True)
    return csv_text(["trial_id", "probability"], rows).encode()


def _read_date(folder: Path) -> dt.date | None:
    try:
        content = tomllib.loads((folder / SUBMISSION_FILE).read_text())
    except (OSError, ValueError):
        return None
    date = content.get("submission", {}).get("date")
    return date if isinstance(date, dt.date) else None
