"""Submissions as bytes, for tests of what judges them."""

import datetime as dt
from collections.abc import Iterable

from leaderboard.reference import Reference
from leaderboard.submission import RawFile, RawSubmission
from leaderboard.validation import Validation, validate

TODAY = dt.date(2026, 6, 1)

SUBMISSION_TOML = """\
[submission]
name = "Example"
system = "example"
team = "Example Lab"
date = 2026-05-20
description = "One or two sentences."

[protocol]
training = "separate"
testing = "with_property"

[model]
family = "object-centric"
inputs = "rgb"

[contact]
github = "someone"
"""


def spread_probabilities(reference: Reference) -> list[float]:
    """Probabilities that nothing is remarkable about."""
    return [round((7 * n % 23 + 0.5) / 23.5, 4) for n in range(reference.n_trials)]


def predictions_csv(reference: Reference, probabilities: Iterable[object] | None = None) -> str:
    """Write a valid file, or one with these probabilities in the order of the trials."""
    given = spread_probabilities(reference) if probabilities is None else probabilities
    rows = [f'"{trial_id}",{p}\n' for trial_id, p in zip(reference.trial_ids, given, strict=True)]
    return "".join(["trial_id,probability\n", *rows])


def raw_folder(predictions: bytes | str, toml: bytes | str = SUBMISSION_TOML) -> RawSubmission:
    contents = {"predictions.csv": predictions, "submission.toml": toml}
    return RawSubmission(
        "submissions/example", "example", tuple(_raw_file(*pair) for pair in contents.items())
    )


def raw_predictions(content: bytes | str) -> RawSubmission:
    return RawSubmission("mine.csv", None, (_raw_file("predictions.csv", content),))


def judge_predictions_file(content: bytes | str, reference: Reference) -> Validation:
    return validate(raw_predictions(content), reference, today=TODAY)


def _raw_file(name: str, content: bytes | str) -> RawFile:
    data = content.encode() if isinstance(content, str) else content
    return RawFile(name, "file", len(data), data)
