"""Graded submissions in order: one board per track, with how sure each rank is."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from leaderboard.errors import LeaderboardError
from leaderboard.grading import METRICS, Yardstick
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.models import Track
from leaderboard.ranking.entries import Entry
from leaderboard.ranking.gains import Gain, find_gains
from leaderboard.ranking.standings import Standing, find_standings

NOT_RANKED = Undefined("the board is not ordered by accuracy, or nobody is ranked")


@dataclass(frozen=True)
class Row:
    """A line of the board.

    Attributes
    ----------
    rank
        None for baselines, partial submissions and undefined scores.
    standing
        How sure the rank is; only where the board is ordered by accuracy.
    gain
        What the system gains from inferring properties, where it was tested both with and without.
    """

    entry: Entry
    rank: int | None
    standing: Standing | None = None
    gain: Gain | None = None


@dataclass(frozen=True)
class Board:
    """The board of one track.

    Attributes
    ----------
    track, metric
        Which board, ordered by which metric's overall value.
    ranked
        Complete submissions, best first; equal scores share a rank.
    partial
        Submissions that leave out scenarios, by slug.
    baselines
        Reference lines, best first; the same on every track.
    detectable
        The smallest difference in accuracy that this many pairs can tell from none.
    """

    track: Track
    metric: str
    ranked: tuple[Row, ...]
    partial: tuple[Row, ...]
    baselines: tuple[Row, ...]
    detectable: Estimate = NOT_RANKED

    @property
    def rows(self) -> tuple[Row, ...]:
        """All rows: ranked, then partial, then baselines."""
        return self.ranked + self.partial + self.baselines


def rank_entries(
    entries: Iterable[Entry], track: Track, metric: str = "accuracy", *, yardstick: Yardstick | None = None
) -> Board:
    """Order the entries of one track by a metric's overall value.

    Complete submissions are ranked, best first by the metric's own direction; equal scores share a rank
    and the next one skips (1, 1, 3). Ties are listed by slug.

    Parameters
    ----------
    yardstick
        With it, a board by accuracy says how sure its ranks are, and every board what systems gain from
        inferring properties.

    Raises
    ------
    LeaderboardError
        If the metric is unknown or has no better and worse end.
    """
    known = sorted(entries, key=lambda entry: entry.slug)
    competitors = [e for e in known if not e.is_baseline and track.accepts(e.metadata.protocol)]
    complete = [entry for entry in competitors if entry.is_complete]
    partial = [entry for entry in competitors if not entry.is_complete]
    baselines = [entry for entry in known if entry.is_baseline]
    sign = _sign_of(metric)
    board = Board(
        track=track,
        metric=metric,
        ranked=_assign_ranks(complete, metric, sign),
        partial=tuple(Row(entry, None) for entry in partial),
        baselines=tuple(Row(row.entry, None) for row in _assign_ranks(baselines, metric, sign)),
    )
    return board if yardstick is None else _judge_ranks(board, known, yardstick)


def _judge_ranks(board: Board, known: Sequence[Entry], yardstick: Yardstick) -> Board:
    """Say of each ranked row how sure its rank is and what its system gains."""
    gains = find_gains([row.entry for row in board.ranked], known, yardstick)
    rows = [replace(row, gain=gains.get(row.entry.slug)) for row in board.ranked]
    if board.metric != "accuracy" or not rows:
        return replace(board, ranked=tuple(rows))
    standings, detectable = find_standings([row.entry for row in rows], yardstick)
    ranked = (replace(row, standing=s) for row, s in zip(rows, standings, strict=True))
    return replace(board, ranked=tuple(ranked), detectable=detectable)


def _sign_of(metric: str) -> int:
    """Return +1 where higher is better and -1 where lower is."""
    directions = {m.name: m.direction for m in METRICS}
    rankable = [name for name, direction in directions.items() if direction != "none"]
    if metric not in rankable:
        raise LeaderboardError(f"cannot rank by {metric!r}", f"choose one of {', '.join(rankable)}")
    return 1 if directions[metric] == "higher" else -1


def _assign_ranks(entries: Sequence[Entry], metric: str, sign: int) -> tuple[Row, ...]:
    keyed = [
        (sign * score.value, e) for e in entries if (score := e.score(metric)) and score.value is not None
    ]
    keyed.sort(key=lambda pair: -pair[0])
    first_with: dict[float, int] = {}
    for place, (value, _) in enumerate(keyed, 1):
        first_with.setdefault(value, place)
    ranked = {entry.slug for _, entry in keyed}
    undefined = [Row(entry, None) for entry in entries if entry.slug not in ranked]
    return tuple(Row(entry, first_with[value]) for value, entry in keyed) + tuple(undefined)
