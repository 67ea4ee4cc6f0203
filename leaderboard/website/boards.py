"""From the board of a track to its page."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from leaderboard.grading import find_metric
from leaderboard.models import Score
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Board, Row
from leaderboard.website.board_pages import (
    BoardColumn,
    BoardPage,
    BoardRow,
    BoardSection,
    ColumnGroup,
    Traits,
)
from leaderboard.website.comparison_tables import COMPARISONS_PATH, list_comparisons, pair_key
from leaderboard.website.describing import (
    badges_of,
    board_path,
    count_of,
    describe_coverage,
    describe_people,
    figure_path,
    submission_path,
)
from leaderboard.website.forests import draw_board
from leaderboard.website.material import Count, Material
from leaderboard.website.numbers import EN_DASH, Footnotes, name_p
from leaderboard.website.pages import Cell, Link
from leaderboard.website.quantities import Described, find_quantity
from leaderboard.website.remarks import list_remarks

NOT_COVERED = "not all of these trials are covered"
NOT_FOR_PEOPLE = "not computed for people"
NO_COUNTERPART = "not tested both with and without property inference"
GAIN = find_quantity("property_gain")
CEILING = find_quantity("ceiling")
FACT_TITLES = ("Family, inputs", "Date")
FIRST_ORDERS = {"higher": "desc", "lower": "asc", "none": "desc"}


@dataclass(frozen=True)
class ScoreColumn:
    """A score of the board: which one, under which title, and which group of columns it belongs to."""

    group: str
    title: str
    metric: str
    scope: str = OVERALL
    subset: str = "all"

    @property
    def key(self) -> str:
        """Its name in addresses and downloads, which begins as in the table of all numbers."""
        name = f"{self.metric}.{self.scope}"
        return name if self.subset == "all" else f"{name}.{self.subset}"


def compose_board(board: Board, material: Material) -> BoardPage:
    """Gather what the page of a board shows."""
    has_gain = any(row.gain for row in board.ranked)
    composer = _RowComposer(material, _choose_columns(material), has_gain, Footnotes())
    sections = _compose_sections(board, composer)
    return BoardPage(
        path=board_path(board),
        title=board.track.title,
        summary=_describe_size(material),
        tracks=link_tracks(material, board, board_path),
        caption=_describe_order(material),
        groups=_group_columns(composer, material),
        fact_titles=FACT_TITLES,
        sections=sections,
        footnotes=composer.footnotes.texts,
        drawings=draw_board(board, material),
        figure=Link("by property, on easy and on hard trials", figure_path(board)),
        remarks=list_remarks(board, material),
        comparisons=_link_comparisons(material),
        pairs=tuple(pair_key(c.a, c.b) for c in list_comparisons(board, material)),
        elsewhere=_link_unplaced(material) if board.track.default else (),
        has_citation=bool(material.texts.citation),
    )


def _link_comparisons(material: Material) -> Link | None:
    return Link("comparisons", COMPARISONS_PATH) if len(material.publications) > 1 else None


def _choose_columns(material: Material) -> tuple[ScoreColumn, ...]:
    """Choose what the reference has the data for."""
    shares = "Accuracy, %"
    columns = [ScoreColumn(shares, "Overall", "accuracy")]
    names = [property_.name for property_ in material.reference.benchmark.properties]
    columns += [ScoreColumn(shares, name, "accuracy", scope=name) for name in names]
    if material.people:
        columns += [ScoreColumn(shares, s.title(), "accuracy", subset=s) for s in ("easy", "hard")]
        columns.append(ScoreColumn("Agreement with people", find_metric("human_r").title, "human_r"))
        columns.append(ScoreColumn("Agreement with people", "Share of ceiling", "human_r_normalized"))
    if material.has_pairs:
        columns.append(ScoreColumn("Pairs, %", find_metric("pair_accuracy").title, "pair_accuracy"))
    return tuple(columns)


def _group_columns(composer: "_RowComposer", material: Material) -> tuple[ColumnGroup, ...]:
    groups: dict[str, list[BoardColumn]] = {}
    for column in composer.columns:
        below = _describe_count(column.metric, material.count(column.scope, column.subset))
        described = _describe_column(find_metric(column.metric), column.title, below, column.key)
        groups.setdefault(column.group, []).append(described)
    if composer.has_gain:
        below = count_of(material.count(OVERALL).n, "trial")
        groups["Gain, points"] = [_describe_column(GAIN, GAIN.title, below, f"{GAIN.name}.{OVERALL}")]
    return tuple(ColumnGroup(title, tuple(members)) for title, members in groups.items())


def _describe_column(quantity: Described, title: str, below: str, key: str) -> BoardColumn:
    first = FIRST_ORDERS[quantity.direction]
    return BoardColumn(title, below, quantity.name, quantity.meaning, key=key, first=first)


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
    has_gain: bool
    footnotes: Footnotes

    def compose(self, rows: Sequence[Row]) -> tuple[BoardRow, ...]:
        """Print submissions."""
        best = _name_best(rows)
        names = sorted({_sort_name(row) for row in rows})
        places = {name: place for place, name in enumerate(names)}
        return tuple(self._compose_row(row, best, places[_sort_name(row)]) for row in rows)

    def compose_people(self) -> BoardRow:
        """Print people; where submissions have their human r, people have its ceiling."""
        cells = [self._print_people(column) for column in self.columns]
        if self.has_gain:
            cells.append(self.footnotes.cell(GAIN, None, absent=NOT_FOR_PEOPLE))
        details = (describe_people(self.material),)
        return BoardRow("", "", "", "People", (), details, tuple(cells), ("",) * len(FACT_TITLES))

    def _print_people(self, column: ScoreColumn) -> Cell:
        if column.metric == "human_r":
            ceiling = self.material.people_score(CEILING.name, column.scope, column.subset)
            return self.footnotes.cell(CEILING, ceiling, absent=NOT_FOR_PEOPLE, remark="ceiling")
        score = self.material.people_score(column.metric, column.scope, column.subset)
        return self.footnotes.cell(find_metric(column.metric), score, absent=NOT_FOR_PEOPLE)

    def _compose_row(self, row: Row, best: str, place: int) -> BoardRow:
        entry, about = row.entry, row.entry.metadata.submission
        model = entry.metadata.model
        coverage = () if entry.is_complete else (describe_coverage(entry, self.material),)
        standing = row.standing
        judged = (best,) if best and standing and standing.is_among_best else ()
        return BoardRow(
            slug=entry.slug,
            rank="" if row.rank is None else str(row.rank),
            ranks=f"{standing.low}{EN_DASH}{standing.high}" if standing else "",
            name=about.name,
            badges=(*judged, *badges_of(entry)),
            details=(about.team, *coverage),
            cells=tuple(self._print_scores(row)),
            facts=(f"{model.family}, {model.inputs}", about.date.isoformat()),
            traits=Traits(place, model.family, model.inputs, about.date.isoformat()),
        )

    def _print_scores(self, row: Row) -> Iterator[Cell]:
        for column in self.columns:
            score = row.entry.score(column.metric, column.scope, column.subset)
            yield self.footnotes.cell(find_metric(column.metric), score, absent=NOT_COVERED)
        if self.has_gain:
            gain = row.gain
            score = Score(value=gain.value, low=gain.low, high=gain.high) if gain else None
            remark = name_p(gain.p) if gain else ""
            yield self.footnotes.cell(GAIN, score, absent=NO_COUNTERPART, remark=remark)


def _sort_name(row: Row) -> str:
    return row.entry.metadata.submission.name.casefold()


def _name_best(rows: Sequence[Row]) -> str:
    """Say in words who cannot be told from the best; nothing where there is nobody to be told from."""
    are_best = [row.standing.is_among_best for row in rows if row.standing]
    if len(are_best) <= 1:
        return ""
    return "among the best" if sum(are_best) > 1 else "the best"


def link_tracks(material: Material, current: Board, path_of: Callable[[Board], str]) -> tuple[Link, ...]:
    """Link the pages of one kind of all tracks."""
    return tuple(
        Link(
            board.track.title,
            path_of(board),
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
