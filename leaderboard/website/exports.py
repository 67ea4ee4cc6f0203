"""The numbers behind the pages, for programs: JSON under ``api/`` and one CSV table."""

from collections.abc import Iterator

from leaderboard import __version__
from leaderboard.files import canonical_json, csv_text
from leaderboard.grading import METRICS, METRICS_VERSION, subset_masks
from leaderboard.models import Score
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Board, Entry, Row
from leaderboard.reference import People
from leaderboard.report.board import entry_data, escape_formula, row_data, row_kind, scores_data
from leaderboard.website.material import Count, Material

SCHEMA = 1
CSV_FACTS = [
    *("track", "rank", "kind", "slug", "name", "system", "team", "date"),
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
    """Lay out all boards with all scores."""
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
                "low": metric.low,
                "high": metric.high,
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

    Text that a spreadsheet could run as a formula gets a leading apostrophe.
    """
    scopes = [OVERALL, *(property_.name for property_ in material.reference.benchmark.properties)]
    keys = [(metric.name, scope) for metric in METRICS for scope in scopes]
    header = [*CSV_FACTS, *(f"{metric}.{scope}" for metric, scope in keys)]
    kind = material.reference.manifest.kind
    rows = []
    for track, row in _list_rows(material):
        values = [_value(row.entry.score(metric, scope)) for metric, scope in keys]
        facts = [track, row.rank or "", row_kind(row), *_describe(row.entry), kind]
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


def _value(score: Score | None) -> object:
    return "" if score is None or score.value is None else score.value


def _board_data(board: Board) -> dict[str, object]:
    track = board.track
    return {
        "id": track.id,
        "title": track.title,
        "default": track.default,
        "conditions": track.conditions,
        "metric": board.metric,
        "rows": [row_data(row) for row in board.rows],
    }


def _identity(material: Material) -> dict[str, object]:
    manifest = material.reference.manifest
    return {"kind": manifest.kind, "digest": manifest.digest}


def _count_data(count: Count) -> dict[str, int]:
    return {"trials": count.n, "pairs": count.n_pairs, "rated_trials": count.n_rated}
