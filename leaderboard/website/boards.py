"""From the board of a track to its page."""

from collections.abc import Sequence
from dataclasses import dataclass

from leaderboard.grading import find_metric
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Board, Row
from leaderboard.website.describing import (
    badges_of,
    board_path,
    count_of,
    describe_coverage,
    describe_people,
    describe_subset,
    submission_path,
)
from leaderboard.website.material import Count, Material
from leaderboard.website.numbers import Footnotes
from leaderboard.website.pages import BoardPage, BoardRow, BoardSection, Column, ColumnGroup, Fact, Link

NOT_COVERED = "not all of these trials are covered"
NOT_FOR_PEOPLE = "not computed for people"
FACT_TITLES = ("Family", "Inputs", "Date")


@dataclass(frozen=True)
class ScoreColumn:
    """A score of the board: which one, under which title, and which group of columns it belongs to."""

    group: str
    title: str
    metric: str
    scope: str = OVERALL
    subset: str = "all"


def compose_board(board: Board, material: Material) -> BoardPage:
    """Gather what the page of a board shows."""
    composer = _RowComposer(material, _choose_columns(material), Footnotes())
    sections = _compose_sections(board, composer)
    return BoardPage(
        path=board_path(board),
        title=board.track.title,
        summary=_describe_size(material),
        tracks=_link_tracks(material, board),
        caption=_describe_order(material),
        groups=_group_columns(composer.columns, material),
        fact_titles=FACT_TITLES,
        sections=sections,
        footnotes=composer.footnotes.texts,
        remarks=_list_remarks(material),
        elsewhere=_link_unplaced(material) if board.track.default else (),
    )


def _choose_columns(material: Material) -> tuple[ScoreColumn, ...]:
    """Choose what the reference has the data for."""
    shares = "Accuracy, %"
    columns = [ScoreColumn(shares, "Overall", "accuracy")]
    names = [property_.name for property_ in material.reference.benchmark.properties]
    columns += [ScoreColumn(shares, name, "accuracy", scope=name) for name in names]
    if material.people:
        columns += [ScoreColumn(shares, s.title(), "accuracy", subset=s) for s in ("easy", "hard")]
        columns.append(ScoreColumn("Agreement", find_metric("human_r").title, "human_r"))
    if material.has_pairs:
        columns.append(ScoreColumn("Pairs, %", find_metric("pair_accuracy").title, "pair_accuracy"))
    return tuple(columns)


def _group_columns(columns: Sequence[ScoreColumn], material: Material) -> tuple[ColumnGroup, ...]:
    groups: dict[str, list[Column]] = {}
    for column in columns:
        metric = find_metric(column.metric)
        below = _describe_count(column.metric, material.count(column.scope, column.subset))
        groups.setdefault(column.group, []).append(Column(column.title, below, metric.name, metric.meaning))
    return tuple(ColumnGroup(title, tuple(members)) for title, members in groups.items())


def _describe_count(metric: str, count: Count) -> str:
    if find_metric(metric).needs != "labels":
        return count_of(count.n_rated, "trial")
    return count_of(count.n_pairs, "pair") if metric == "pair_accuracy" else count_of(count.n, "trial")


def _compose_sections(board: Board, composer: "_RowComposer") -> tuple[BoardSection, ...]:
    sections = []
    if composer.material.people:
        sections.append(BoardSection("people", "", (composer.compose_people(),)))
    is_empty = not board.ranked and not board.partial
    note = "No submissions yet." if is_empty else "No complete submission yet."
    sections.append(BoardSection("ranked", "", composer.compose(board.ranked), note))
    if board.partial:
        title = "Partial: not ranked, because they leave out some scenarios"
        sections.append(BoardSection("partial", title, composer.compose(board.partial)))
    if board.baselines:
        title = "Baselines: what rules without a model reach"
        sections.append(BoardSection("baseline", title, composer.compose(board.baselines)))
    return tuple(sections)


@dataclass(frozen=True)
class _RowComposer:
    """Prints the rows of one board, which share columns and footnotes."""

    material: Material
    columns: tuple[ScoreColumn, ...]
    footnotes: Footnotes

    def compose(self, rows: Sequence[Row]) -> tuple[BoardRow, ...]:
        """Print submissions."""
        return tuple(self._compose_row(row) for row in rows)

    def compose_people(self) -> BoardRow:
        """Print people."""
        cells = tuple(
            self.footnotes.cell(
                find_metric(column.metric),
                self.material.people_score(column.metric, column.scope, column.subset),
                absent=NOT_FOR_PEOPLE,
            )
            for column in self.columns
        )
        details = (describe_people(self.material),)
        return BoardRow("", "", "People", (), details, cells, ("",) * len(FACT_TITLES))

    def _compose_row(self, row: Row) -> BoardRow:
        entry, about = row.entry, row.entry.metadata.submission
        model = entry.metadata.model
        cells = tuple(
            self.footnotes.cell(
                find_metric(column.metric),
                entry.score(column.metric, column.scope, column.subset),
                absent=NOT_COVERED,
            )
            for column in self.columns
        )
        coverage = () if entry.is_complete else (describe_coverage(entry, self.material),)
        return BoardRow(
            slug=entry.slug,
            rank="" if row.rank is None else str(row.rank),
            name=about.name,
            badges=badges_of(entry),
            details=(about.team, *coverage),
            cells=cells,
            facts=(model.family, model.inputs, about.date.isoformat()),
        )


def _link_tracks(material: Material, current: Board) -> tuple[Link, ...]:
    return tuple(
        Link(
            board.track.title,
            board_path(board),
            count_of(len(board.ranked) + len(board.partial), "submission"),
            is_current=board is current,
        )
        for board in material.boards
    )


def _link_unplaced(material: Material) -> tuple[Link, ...]:
    return tuple(
        Link(entry.metadata.submission.name, submission_path(entry.slug)) for entry in material.unplaced
    )


def _describe_size(material: Material) -> str:
    benchmark = material.reference.benchmark
    count = material.count(OVERALL)
    in_pairs = f" in {count_of(count.n_pairs, 'pair')}" if count.n_pairs else ""
    properties = count_of(len(benchmark.properties), "property", "properties")
    people = " and agreement with people" if material.people else ""
    return (
        f"“{benchmark.question}” asked of {count_of(count.n, 'trial')}{in_pairs}, on {properties}. "
        f"Submissions are scored by accuracy{people}."
    )


def _describe_order(material: Material) -> str:
    simulated = " Labels and people are simulated." if material.reference.is_synthetic else ""
    return (
        "Complete submissions in order of overall accuracy, the plain mean of the properties; "
        f"equal scores share a rank.{simulated}"
    )


def _list_remarks(material: Material) -> tuple[Fact, ...]:
    remarks = [
        Fact(
            "How sure",
            "Intervals are not shown yet. leaderboard compare A B says how sure a difference is.",
        )
    ]
    if material.people:
        remarks += [Fact(subset.title(), describe_subset(subset, material)) for subset in ("easy", "hard")]
        caution = (
            "Trials are chosen and people measured on the same responses, so people look better on easy and "
            "worse on hard trials than they are. Scores of submissions are free of that."
        )
        both = " A pair can be easy and hard at once." if material.has_pairs else ""
        remarks.append(Fact("Caution", caution + both))
    return tuple(remarks)
