"""Submissions whose every text is hostile, beside twins with harmless words: outputs differ by these."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from builders import build_entry
from leaderboard.assessing import Assessment, assess
from leaderboard.ranking import Board, Entry, rank_entries
from leaderboard.reference import Reference
from leaderboard.submitting import render_metadata
from raw_submissions import TODAY, predictions_csv, raw_folder


def judge_texts(reference: Reference, **changes: str) -> Assessment:
    """Judge a submission in whose metadata some keys hold other texts."""
    about = {"name": "A", "system": "a-system", "team": "B", "date": TODAY, "description": "C"}
    sections: dict[str, dict[str, object]] = {
        "submission": about,
        "protocol": {"training": "separate", "testing": "with_property"},
        "model": {"family": "other", "inputs": "rgb", "parameters": None, "pretraining": None},
        "links": {"paper": None, "code": None, "weights": None},
        "contact": {"github": "someone"},
    }
    for key, text in changes.items():
        next(values for values in sections.values() if key in values)[key] = text
    raw = raw_folder(predictions_csv(reference), render_metadata(sections))
    return assess(raw, reference, today=TODAY)


class Twins:
    """One submission for each text, and the same submissions with harmless words instead.

    A third are ranked, a third partial, a third baselines: each has a place of its own in a table.
    """

    def __init__(self, reference: Reference, texts: Sequence[str], words: Sequence[str]) -> None:
        self.reference = reference
        self.words = dict(zip(words, texts, strict=True))
        self.hostile = self._build(texts)
        self.harmless = self._build(words)

    def _build(self, texts: Sequence[str]) -> list[Entry]:
        rng = np.random.default_rng(5)
        covered = (self.reference.properties == 1).tolist()
        kinds: list[dict[str, Any]] = [{}, {"covered": covered}, {"family": "baseline"}]
        entries = [
            build_entry(
                self.reference,
                f"entry-{n:02}",
                rng.random(self.reference.n_trials).tolist(),
                name=text,
                team=text,
                description=text,
                **kinds[n % 3],
            )
            for n, text in enumerate(texts)
        ]
        return [_describe_model(entry) for entry in entries]

    def boards(self) -> tuple[Board, Board]:
        track = self.reference.benchmark.default_track
        hostile, harmless = (rank_entries(entries, track) for entries in (self.hostile, self.harmless))
        return hostile, harmless

    def translate(self, text: str, escape: Callable[[str], str] = str) -> str:
        """Put hostile words where the harmless ones are, as an output should write them."""
        for word in sorted(self.words, key=len, reverse=True):
            text = text.replace(word, escape(self.words[word]))
        return text


def _describe_model(entry: Entry) -> Entry:
    """Say of the model, too, what the submission is called."""
    text = entry.metadata.submission.name
    model = entry.metadata.model.model_copy(update={"parameters": text, "pretraining": text})
    return replace(entry, metadata=entry.metadata.model_copy(update={"model": model}))
