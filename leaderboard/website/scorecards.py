"""From a graded submission to its page: headline numbers, all scores, metadata, files and provenance."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from leaderboard.grading import METRICS, SUBSETS, Metric, find_metric
from leaderboard.models import Benchmark, Metadata, Score
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Entry
from leaderboard.website.describing import (
    badges_of,
    board_path,
    describe_chance,
    describe_coverage,
    describe_subset,
    submission_path,
)
from leaderboard.website.material import Material, Publication
from leaderboard.website.numbers import Footnotes, unit_of
from leaderboard.website.pages import Column, Fact, Link, ScopeRow, ScoreTable, SubmissionPage, Tile

NOT_GRADED = "not all of its scenarios are covered"


def compose_scorecard(publication: Publication, material: Material) -> SubmissionPage:
    """Gather what the page of a submission shows."""
    entry = publication.entry
    about = entry.metadata.submission
    standing = material.standings.get(entry.slug)
    board = standing[0] if standing else material.boards[0]
    return SubmissionPage(
        path=submission_path(entry.slug),
        title=about.name,
        summary=about.description,
        slug=entry.slug,
        team=about.team,
        badges=badges_of(entry),
        standing=_describe_standing(entry, material),
        board=Link(board.track.title, board_path(board)),
        tiles=tuple(_compose_tiles(entry, material)),
        checks=tuple(Fact(check.code, check.message) for check in entry.result.checks),
        tables=tuple(
            compose_score_table(entry, material, subset)
            for subset in SUBSETS
            if _list_scopes(entry, material.reference.benchmark, subset)
        ),
        about=tuple(_list_facts(entry.metadata)),
        downloads=_link_downloads(publication),
        provenance=tuple(_list_provenance(entry, material)),
    )


def _describe_standing(entry: Entry, material: Material) -> str:
    if entry.is_baseline:
        return "A baseline: shown on every board for reference, not ranked."
    if entry.slug not in material.standings:
        return "On no board, because no track has its protocol."
    board, row = material.standings[entry.slug]
    if not entry.is_complete:
        return f"Not ranked, because it is partial: {describe_coverage(entry, material)}."
    if row.rank is None:
        return "Not ranked, because its overall accuracy is undefined."
    return f"Rank {row.rank} of {len(board.ranked)} by overall accuracy."


def _compose_tiles(entry: Entry, material: Material) -> Iterator[Tile]:
    """Choose the headline numbers: overall if there are any, else the accuracy on what is covered."""
    scores = entry.result.scores
    if OVERALL not in scores:
        for scope, title, _ in _list_scopes(entry, material.reference.benchmark, "all"):
            if scope in scores:
                yield _compose_tile(entry, material, title, ("accuracy", scope, "all"))
        return
    accuracy = find_metric("accuracy").title
    yield _compose_tile(entry, material, accuracy, ("accuracy", OVERALL, "all"))
    for subset in ("easy", "hard"):
        if subset in scores[OVERALL]:
            yield _compose_tile(entry, material, f"{accuracy}, {subset}", ("accuracy", OVERALL, subset))
    for name in ("human_r", "pair_accuracy") if material.has_pairs else ("human_r",):
        yield _compose_tile(entry, material, find_metric(name).title, (name, OVERALL, "all"))


def _compose_tile(entry: Entry, material: Material, title: str, key: tuple[str, str, str]) -> Tile:
    metric = find_metric(key[0])
    cell = Footnotes().cell(metric, entry.score(*key), absent=NOT_GRADED)
    human = material.people_score(*key)
    parts = [f"people {Footnotes().cell(metric, human, absent='').text}" if human else ""]
    parts.append(f"chance {describe_chance(metric)}" if metric.chance is not None else "")
    below = cell.why or ", ".join(part for part in parts if part)
    return Tile(title, cell, unit_of(metric) if cell.exact else "", below)


@dataclass(frozen=True)
class _ScoreColumn:
    """A metric of the submission, or of the people beside it."""

    metric: Metric
    is_people: bool

    def score(self, entry: Entry, material: Material, scope: str, subset: str) -> Score | None:
        look_up = material.people_score if self.is_people else entry.score
        return look_up(self.metric.name, scope, subset)

    def describe(self) -> Column:
        metric = self.metric
        if self.is_people:
            meaning = f"{metric.title} of people"
            return Column("People", unit_of(metric), metric.name, meaning, is_people=True)
        return Column(metric.title, unit_of(metric), metric.name, metric.meaning, metric.direction)


def compose_score_table(entry: Entry, material: Material, subset: str) -> ScoreTable:
    """Tabulate every metric on one subset of every scope, people's beside them where they have any."""
    scopes = _list_scopes(entry, material.reference.benchmark, subset)
    columns, omitted = _sort_out(_all_columns(material), entry, material, subset)
    footnotes, rows = Footnotes(), []
    n_counts = None if material.has_pairs else 1
    for scope, title, level in scopes:
        cells = tuple(
            footnotes.cell(column.metric, column.score(entry, material, scope, subset), absent=NOT_GRADED)
            for column in columns
        )
        rows.append(ScopeRow(title, level, _list_counts(entry, scope, subset)[:n_counts], cells))
    return ScoreTable(
        subset=subset,
        title=f"{subset.title()} trials",
        caption=describe_subset(subset, material),
        count_titles=_count_titles(subset)[:n_counts],
        columns=tuple(column.describe() for column in columns),
        rows=tuple(rows),
        footnotes=footnotes.texts,
        omitted=omitted,
    )


def _list_scopes(entry: Entry, benchmark: Benchmark, subset: str) -> list[tuple[str, str, int]]:
    """List what was graded: scope, title, and 0 for overall, 1 for a property, 2 for a scenario.

    A property of which only some scenarios were graded is listed too, as the heading of these. The only
    scenario of a property is left out: its scores are the property's.
    """
    graded = {scope for scope, subsets in entry.result.scores.items() if subset in subsets}
    scopes = [(OVERALL, "Overall", 0)] if OVERALL in graded else []
    for name in (property_.name for property_ in benchmark.properties):
        members = benchmark.scenarios_of(name)
        scenarios = [(s.id, s.title, 2) for s in members if s.id in graded and len(members) > 1]
        if scenarios or name in graded:
            scopes += [(name, name, 1), *scenarios]
    return scopes


def _all_columns(material: Material) -> list[_ScoreColumn]:
    of_people = set(material.people[OVERALL]["all"].metrics) if material.people else set()
    columns = []
    for metric in METRICS:
        columns.append(_ScoreColumn(metric, is_people=False))
        if metric.name in of_people:
            columns.append(_ScoreColumn(metric, is_people=True))
    return columns


def _sort_out(
    columns: Sequence[_ScoreColumn], entry: Entry, material: Material, subset: str
) -> tuple[list[_ScoreColumn], tuple[Fact, ...]]:
    """Take out the columns without any value and for one reason, and name them by reason."""
    kept: list[_ScoreColumn] = []
    omitted: dict[str, list[str]] = {}
    scopes = _list_scopes(entry, material.reference.benchmark, subset)
    for column in columns:
        scores = [column.score(entry, material, scope, subset) for scope, _, _ in scopes]
        reasons = {score.why for score in scores if score}
        if len(reasons) == 1 and (why := reasons.pop()):
            omitted.setdefault(why, []).append(column.metric.title)
        else:
            kept.append(column)
    return kept, tuple(Fact(", ".join(titles), f"undefined: {why}") for why, titles in omitted.items())


def _count_titles(subset: str) -> tuple[str, ...]:
    if subset == "all":
        return ("Trials", "Pairs")
    other = {"easy": "hard", "hard": "easy"}[subset]
    return ("Trials", "Pairs", f"also {other}")


def _list_counts(entry: Entry, scope: str, subset: str) -> tuple[str, ...]:
    scores = entry.result.scores.get(scope, {}).get(subset)
    if scores is None:
        return ("",) * len(_count_titles(subset))
    counts = (scores.n, scores.n_pairs, scores.n_pairs_in_both)
    return tuple(f"{count:,}" for count in counts if count is not None)


def _list_facts(metadata: Metadata) -> Iterator[Fact]:
    about, protocol, model = metadata.submission, metadata.protocol, metadata.model
    yield Fact("Team", about.team)
    yield Fact("System", about.system)
    yield Fact("Date", about.date.isoformat())
    yield Fact("Training", protocol.training.replace("_", " "))
    yield Fact("Testing", protocol.testing.replace("_", " "))
    optional = {
        "Training trials": None if protocol.training_trials is None else f"{protocol.training_trials:,}",
        "Auxiliary": protocol.auxiliary,
        "Selection": protocol.selection,
        "Family": model.family,
        "Inputs": model.inputs,
        "Parameters": model.parameters,
        "Pretraining": model.pretraining,
    }
    yield from (Fact(title, text) for title, text in optional.items() if text)
    for title, link in (
        ("Paper", metadata.links.paper),
        ("Code", metadata.links.code),
        ("Weights", metadata.links.weights),
    ):
        if link:
            yield Fact(title, link, target=link)
    github = metadata.contact.github
    yield Fact("Contact", f"@{github}", target=f"https://github.com/{github}")


def _link_downloads(publication: Publication) -> tuple[Link, ...]:
    folder = f"submissions/{publication.entry.slug}"
    own = [
        Link(name, f"{folder}/{name}", _describe_size(len(content)))
        for name, content in publication.files.items()
    ]
    return (*own, Link("scores and metadata as JSON", f"api/{folder}.json"))


def _describe_size(n_bytes: int) -> str:
    return f"{n_bytes:,} bytes"


def _list_provenance(entry: Entry, material: Material) -> Iterator[Fact]:
    result = entry.result
    coverage, n_trials = result.coverage, material.reference.n_trials
    yield Fact("Trials", f"{coverage.trials:,} of {n_trials:,} given, {coverage.answered:,} answered")
    yield Fact("Predictions (SHA-256)", result.inputs.predictions_sha256, is_code=True)
    yield Fact("Reference", result.inputs.reference_kind)
    yield Fact("Reference digest", result.inputs.reference_digest, is_code=True)
    yield Fact("Grader", f"{result.grader}, metrics version {result.metrics_version}")
    yield Fact("Grade it again", f"leaderboard grade submissions/{entry.slug}", is_code=True)
