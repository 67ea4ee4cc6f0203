"""The numbers behind the pages, for programs: JSON under ``api/``, and CSV tables of submissions and trials.

The JSON has no blanks: it is half as large so, and takes a quarter of the time. A row is rendered once, for
the file of its submission and for the one of all boards.
"""

import json
from collections.abc import Iterable, Iterator, Mapping
from math import isinf

from leaderboard import __version__
from leaderboard.files import csv_text
from leaderboard.grading import METRICS, METRICS_VERSION, subset_masks
from leaderboard.grading.metrics import P_VALUES
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Board, Entry, Row
from leaderboard.reference import People, Reference
from leaderboard.report.board import (
    board_detectable,
    entry_data,
    escape_formula,
    row_data,
    row_kind,
    scores_data,
)
from leaderboard.website.material import Count, Material
from leaderboard.website.trial_paths import TRIALS_TABLE

SCHEMA = 1
CSV_FACTS = [
    *("track", "rank", "rank_low", "rank_high", "kind", "slug", "name", "system", "team", "date"),
    *("family", "inputs", "training", "testing", "reference"),
]

TRIAL_FACTS = ("trial", "trial_id", "property", "scenario", "pair_id", "label", "people", "people_yes")


def render_exports(material: Material) -> Iterator[tuple[str, bytes]]:
    """Render every file for programs as its path in the site and its bytes."""
    rows = {}
    for entry in (publication.entry for publication in material.publications):
        board, row = material.standings.get(entry.slug, (None, Row(entry, None)))
        place = {**_origin(material), "track": board.track.id if board else None}
        rows[entry.slug] = _render(row_data(row))
        yield f"api/submissions/{entry.slug}.json", _finish(_merge(_render(place), rows[entry.slug]))
    yield "api/leaderboard.json", _finish("".join(_list_boards(material, rows)))
    yield "api/reference.json", _finish(_render(reference_data(material)))
    yield "leaderboard.csv", render_csv(material).encode()
    yield TRIALS_TABLE, render_trials(material.reference).encode()


def _list_boards(material: Material, rows: Mapping[str, str]) -> Iterator[str]:
    """Yield all boards with all scores, piece by piece; each row, rendered already, has a line of its own."""
    boards = (
        _embed(_board_data(board), rows=((rows[row.entry.slug],) for row in board.rows))
        for board in material.boards
    )
    unplaced = ((_render(entry_data(entry)),) for entry in material.unplaced)
    return _embed(_describe_boards(material), tracks=boards, unplaced=unplaced)


def _describe_boards(material: Material) -> dict[str, object]:
    """Lay out what all boards share; an end of a metric's range that is infinite is null."""
    benchmark = material.reference.benchmark
    return {
        "schema": SCHEMA,
        "benchmark": benchmark.name,
        "version": benchmark.version,
        "reference": _identity(material),
        "grader": __version__,
        "metrics_version": METRICS_VERSION,
        "metrics": [
            {
                "name": metric.name,
                "title": metric.title,
                "meaning": metric.meaning,
                "direction": metric.direction,
                "low": _finite(metric.low),
                "high": _finite(metric.high),
                "chance": metric.chance,
            }
            for metric in METRICS
        ],
        "people": scores_data(material.people),
    }


def _render(data: Mapping[str, object]) -> str:
    return json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))


def _embed(data: Mapping[str, object], **lists: Iterable[Iterable[str]]) -> Iterator[str]:
    """Yield an object with further lists, whose members are rendered already, as pieces.

    Were they one text at each step, the largest board would be in memory many times over.

    >>> print("".join(_embed({"a": 1}, b=[["[2", "]"]])))
    {"a":1,"b":[
    [2]
    ]}
    """
    yield _render(data)[:-1]
    for name, members in lists.items():
        yield f',"{name}":['
        for number, pieces in enumerate(members):
            yield ",\n" if number else "\n"
            yield from pieces
        yield "\n]"
    yield "}"


def _merge(first: str, second: str) -> str:
    """Make one object of two that are rendered already, none of them empty.

    >>> _merge('{"a":1}', '{"b":2}')
    '{"a":1,"b":2}'
    """
    return f"{first[:-1]},{second[1:]}"


def _finish(text: str) -> bytes:
    return f"{text}\n".encode()


def reference_data(material: Material) -> dict[str, object]:
    """Lay out what the submissions are graded against: identity, sizes and origin, but no labels."""
    benchmark = material.reference.benchmark
    return {
        "schema": SCHEMA,
        "benchmark": benchmark.name,
        "title": benchmark.title,
        "version": benchmark.version,
        "question": benchmark.question,
        **_identity(material),
        "counts": {
            subset: _count_data(material.count(OVERALL, subset))
            for subset in subset_masks(material.reference)
        },
        "people": _people_data(material.reference.people),
        "properties": [_property_data(property_.name, material) for property_ in benchmark.properties],
        "sources": [source.model_dump(mode="json") for source in material.reference.manifest.sources],
    }


def _people_data(people: People | None) -> dict[str, int | None]:
    """Count people and their responses; how many people there were is not always known."""
    single = people.responses if people else None
    return {
        "participants": len(single.participant_ids) if single else None,
        "responses": int(people.n.sum()) if people else 0,
    }


def _property_data(name: str, material: Material) -> dict[str, object]:
    scenarios = material.reference.benchmark.scenarios_of(name)
    return {
        "name": name,
        **_count_data(material.count(name)),
        "scenarios": [
            {"id": scenario.id, "title": scenario.title, **_count_data(material.count(scenario.id))}
            for scenario in scenarios
        ],
    }


def render_csv(material: Material) -> str:
    """Render one row per submission: what it is, and every metric overall and by property.

    Each metric is followed by the ends of its 95 % interval, but for p-values, which have none. Text that a
    spreadsheet could run as a formula gets a leading apostrophe.
    """
    scopes = [OVERALL, *(property_.name for property_ in material.reference.benchmark.properties)]
    keys = [(metric.name, scope) for metric in METRICS for scope in scopes]
    header = [*CSV_FACTS, *(name for key in keys for name in _name_columns(*key))]
    kind = material.reference.manifest.kind
    rows = []
    for track, row in _list_rows(material):
        values = [value for key in keys for value in _values(row.entry, *key)]
        ranks = [row.standing.low, row.standing.high] if row.standing else ["", ""]
        facts = [track, row.rank or "", *ranks, row_kind(row), *_describe(row.entry), kind]
        rows.append([*facts, *values])
    return csv_text(header, rows)


def render_trials(reference: Reference) -> str:
    """Render one row per trial: its number, by which figures name it, what it is, and what people said.

    Without human data the last two columns are empty.
    """
    people, benchmark = reference.people, reference.benchmark
    n_asked = [("", "")] * reference.n_trials if people is None else zip(people.n, people.n_yes, strict=True)
    facts = zip(reference.trial_ids, reference.properties, reference.scenarios, strict=True)
    rows = []
    for index, ((trial_id, property_, scenario), asked) in enumerate(zip(facts, n_asked, strict=True)):
        names = [trial_id, benchmark.properties[property_].name, benchmark.scenarios[scenario].id]
        pair = reference.pair_ids[reference.pairs[index]]
        texts = [escape_formula(name) for name in (*names, pair)]
        rows.append([index + 1, *texts, reference.labels[index], *asked])
    return csv_text(TRIAL_FACTS, rows)


def _list_rows(material: Material) -> Iterator[tuple[str, Row]]:
    """Yield each submission once with its track; baselines and those on no board have none."""
    for board in material.boards:
        yield from ((board.track.id, row) for row in (*board.ranked, *board.partial))
    yield from (("", row) for row in material.boards[0].baselines)
    yield from (("", Row(entry, None)) for entry in material.unplaced)


def _describe(entry: Entry) -> list[str]:
    about, model, protocol = entry.metadata.submission, entry.metadata.model, entry.metadata.protocol
    texts = [entry.slug, about.name, about.system, about.team, about.date.isoformat()]
    texts += [model.family, model.inputs, protocol.training, protocol.testing]
    return [escape_formula(text) for text in texts]


def _name_columns(metric: str, scope: str) -> list[str]:
    name = f"{metric}.{scope}"
    return [name] if metric in P_VALUES else [name, f"{name}.low", f"{name}.high"]


def _values(entry: Entry, metric: str, scope: str) -> list[object]:
    score = entry.score(metric, scope)
    found = [score.value, score.low, score.high] if score else [None, None, None]
    wanted = found[: len(_name_columns(metric, scope))]
    return ["" if value is None else value for value in wanted]


def _finite(end: float) -> float | None:
    return None if isinf(end) else end


def _board_data(board: Board) -> dict[str, object]:
    track = board.track
    return {
        "id": track.id,
        "title": track.title,
        "default": track.default,
        "conditions": track.conditions,
        "metric": board.metric,
        "detectable_difference": board_detectable(board),
    }


def _origin(material: Material) -> dict[str, object]:
    return {"schema": SCHEMA, "reference": _identity(material)}


def _identity(material: Material) -> dict[str, object]:
    manifest = material.reference.manifest
    return {"kind": manifest.kind, "digest": manifest.digest}


def _count_data(count: Count) -> dict[str, int]:
    return {"trials": count.n, "pairs": count.n_pairs, "rated_trials": count.n_rated}
