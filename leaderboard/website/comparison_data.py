"""What the script that compares any two to six submissions needs: trials, scopes, draws, and answers."""

import json
from collections.abc import Iterator
from math import isnan

import numpy as np

from leaderboard.files import sha256_hex
from leaderboard.grading import find_metric, list_scopes
from leaderboard.grading.draws import PAIR_STREAM, find_strata
from leaderboard.metrics.resampling import CHUNK
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Entry
from leaderboard.reference import Reference
from leaderboard.website.describing import title_scopes
from leaderboard.website.material import Material
from leaderboard.website.numbers import Footnotes
from leaderboard.website.pages import DataFile
from leaderboard.website.rendering import N_HASH_DIGITS
from leaderboard.website.trial_paths import trial_path

SHOWN = ("accuracy", "human_r")
LIMB_BITS = 16
N_LIMBS = 8


def render_ground(reference: Reference) -> DataFile:
    """Render what all comparisons share, as a script that does nothing but assign ``comparing``.

    It is a script because a page that was opened as a file may load nothing else.
    """
    ground = {
        "trials": _list_trials(reference),
        "scopes": _list_scopes(reference),
        "draws": _list_draws(reference),
    }
    content = f"var comparing = {_pack(ground)};\n".encode()
    return _name_file("comparing", content)


def render_contenders(material: Material) -> Iterator[DataFile]:
    """Render the answers of every submission, and its scores as the board prints them, each as a script."""
    scopes = [scope["name"] for scope in _list_scopes(material.reference)]
    shown = SHOWN if material.people else SHOWN[:1]
    for publication in material.publications:
        entry = publication.entry
        contender = {
            "p": [None if isnan(p) else p for p in entry.probabilities.tolist()],
            "scores": [_print_scores(entry, str(scope), shown) for scope in scopes],
        }
        statement = f"(window.contenders ??= {{}})[{json.dumps(entry.slug)}] = {_pack(contender)};\n"
        yield _name_file(f"contenders/{entry.slug}", statement.encode())


def _name_file(name: str, content: bytes) -> DataFile:
    """Name a file after its content, so that a browser never joins what belongs to two builds."""
    return DataFile(f"data/{name}.{sha256_hex(content)[:N_HASH_DIGITS]}.js", content)


def _pack(content: object) -> str:
    return json.dumps(content, separators=(",", ":"), allow_nan=False)


def _list_trials(reference: Reference) -> dict[str, object]:
    """List trials column by column; people's is the share who said YES, and missing without human data."""
    columns: dict[str, object] = {
        "id": reference.trial_ids,
        "path": [trial_path(trial_id) for trial_id in reference.trial_ids],
        "label": reference.labels.tolist(),
        "pair": reference.pairs.tolist(),
        "stratum": reference.scenarios.tolist(),
    }
    if reference.people is not None:
        counts = zip(reference.people.n.tolist(), reference.people.n_yes.tolist(), strict=True)
        columns["people"] = [n_yes / n if n else None for n, n_yes in counts]
    return columns


def _list_scopes(reference: Reference) -> list[dict[str, object]]:
    """List scopes as they are shown, each with its scenarios; overall with the scopes that it averages."""
    masks = {s.name: s.mask for s in list_scopes(reference, np.ones(reference.n_trials, bool))}
    titled = [scope for scope in title_scopes(masks, reference.benchmark) if scope[0] in masks]
    listed: list[dict[str, object]] = [
        {
            "name": name,
            "title": title,
            "level": level,
            "strata": sorted(set(reference.scenarios[masks[name]].tolist())),
        }
        for name, title, level in titled
    ]
    for scope in listed:
        if scope["name"] == OVERALL:
            scope["parts"] = [index for index, (*_, level) in enumerate(titled) if level == 1]
    return listed


def _list_draws(reference: Reference) -> dict[str, object]:
    """Say how pairs are drawn: how often, within what, and where the random numbers begin.

    The state and the increment of PCG64 are split into whole numbers below 2^16, the lowest first.
    """
    grading = reference.benchmark.grading
    start = np.random.PCG64(np.random.SeedSequence([grading.seed, PAIR_STREAM])).state["state"]
    return {
        "n": grading.resamples,
        "chunk": CHUNK,
        "strata": find_strata(reference).tolist(),
        "state": _split(start["state"]),
        "increment": _split(start["inc"]),
    }


def _split(number: int) -> list[int]:
    return [number >> (LIMB_BITS * place) & (2**LIMB_BITS - 1) for place in range(N_LIMBS)]


def _print_scores(entry: Entry, scope: str, metrics: tuple[str, ...]) -> list[list[str | int]] | None:
    """Print scores of a scope, each with interval, reason for none, and how many resamples are left out.

    Nothing where the scope was not graded.
    """
    if scope not in entry.result.scores:
        return None
    cells = [
        Footnotes().cell(find_metric(name), entry.score(name, scope), absent="not graded") for name in metrics
    ]
    return [[cell.text, cell.interval, cell.why, cell.n_undefined] for cell in cells]
