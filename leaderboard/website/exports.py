"""The numbers behind the pages, for programs: JSON under ``api/`` and one CSV table."""

from collections.abc import Iterator
from math import isinf

from leaderboard import __version__
from leaderboard.files import canonical_json, csv_text
from leaderboard.grading import METRICS, METRICS_VERSION, subset_masks
from leaderboard.grading.metrics import P_VALUES
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Board, Entry, Row
from leaderboard.reference import People
from leaderboard.report.board import (
    board_detectable,
    entry_data,
    escape_formula,
    row_data,
    row_kind,
    scores_data,
)
from leaderboard.website.material import Count, Material

SCHEMA = 1
CSV_FACTS = [
    *("track", "rank", "rank_low", "rank_high", "kind", "slug", "name", "system", "team", "date"),
    *("family", "inputs", "training", "testing", "reference"),
]


def render_exports(material: Material) -> Iterator[tuple[str, bytes]]:
    """Render every file for programs as its path in the site and its bytes."""
    yield "api/leaderboard.json", canonical_json(leaderboard_data(material)).encode()
    yield "api/reference.json", canonical_json(reference_data(material)).encode()
    for publication in material.publications:
        slug = publication.entry.slug
        data = canonical_json(submission_data(publication.entry, material))
        yield f"api/submissions/{slug}.json", data.encode()
    yield "leaderboard.csv", render_csv(material).encode()


def leaderboard_data(material: Material) -> dict[str, object]:
    """Lay out all boards with all scores; an end of a metric's range that is infinite is null."""
    return {
        "schema": SCHEMA,
        "benchmark": material.reference.benchmark.name,
        "version": material.reference.benchmark.version,
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
        "tracks": [_board_data(board) for board in material.boards],
        "unplaced": [entry_data(entry) for entry in material.unplaced],
    }


def submission_data(entry: Entry, material: Material) -> dict[str, object]:
    """Lay out one submission with its place on its board, if it has one."""
    board, row = material.standings.get(entry.slug, (None, Row(entry, None)))
    return {
        "schema": SCHEMA,
        "reference": _identity(material),
        "track": board.track.id if board else None,
        **row_data(row),
    }


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
        "rows": [row_data(row) for row in board.rows],
    }


def _identity(material: Material) -> dict[str, object]:
    manifest = material.reference.manifest
    return {"kind": manifest.kind, "digest": manifest.digest}


def _count_data(count: Count) -> dict[str, int]:
    return {"trials": count.n, "pairs": count.n_pairs, "rated_trials": count.n_rated}
