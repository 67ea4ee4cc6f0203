"""Graded submissions in order: one board per track."""

import tomllib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from pydantic import ValidationError

from leaderboard.errors import InstanceError, LeaderboardError
from leaderboard.files import sha256_hex
from leaderboard.grading import METRICS, METRICS_VERSION
from leaderboard.instance import PREDICTIONS_FILE, RESULT_FILE, SUBMISSION_FILE, Instance
from leaderboard.models import Metadata, Result, Score, Track
from leaderboard.models.benchmark import OVERALL
from leaderboard.reference import Reference
from leaderboard.submission import RawSubmission, read_submission


@dataclass(frozen=True)
class Entry:
    """One graded submission: what it says of itself and what grading found."""

    slug: str
    metadata: Metadata
    result: Result

    @property
    def is_baseline(self) -> bool:
        """Whether it is shown as a reference line and not ranked."""
        return self.metadata.is_baseline

    @property
    def is_complete(self) -> bool:
        """Whether it covers every property; only then it is ranked."""
        return self.result.coverage.complete

    def score(self, metric: str, scope: str = OVERALL, subset: str = "all") -> Score | None:
        """Look up one score; None where the scope, subset or metric was not graded."""
        scores = self.result.scores.get(scope, {}).get(subset)
        return scores.metrics.get(metric) if scores else None


@dataclass(frozen=True)
class Row:
    """A line of the board; ``rank`` is None for baselines, partial submissions and undefined scores."""

    entry: Entry
    rank: int | None


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
    """

    track: Track
    metric: str
    ranked: tuple[Row, ...]
    partial: tuple[Row, ...]
    baselines: tuple[Row, ...]

    @property
    def rows(self) -> tuple[Row, ...]:
        """All rows: ranked, then partial, then baselines."""
        return self.ranked + self.partial + self.baselines


def load_entries(instance: Instance, reference: Reference) -> tuple[Entry, ...]:
    """Read the committed results of all submissions, by slug.

    Raises
    ------
    InstanceError
        If a submission has no result, or one made from other predictions or another reference.
    """
    return tuple(
        load_entry(read_submission(folder, instance.display_path(folder)), reference)
        for folder in instance.submission_dirs()
    )


def load_entry(raw: RawSubmission, reference: Reference) -> Entry:
    """Read one committed result and refuse it if it does not belong to the files beside it."""
    metadata = _parse_metadata(raw)
    result = _parse_result(raw)
    hint = f"grade it again: leaderboard grade {raw.location}"
    if result.inputs.predictions_sha256 != sha256_hex(_content(raw, PREDICTIONS_FILE)):
        raise InstanceError(f"{raw.location}: {RESULT_FILE} was made from other predictions", hint)
    if result.metrics_version != METRICS_VERSION:
        raise InstanceError(f"{raw.location}: {RESULT_FILE} was made by another version of the metrics", hint)
    seal = (reference.manifest.digest, reference.manifest.kind)
    if (result.inputs.reference_digest, result.inputs.reference_kind) != seal:
        raise InstanceError(f"{raw.location}: {RESULT_FILE} was made with another reference", hint)
    return Entry(raw.slug or "", metadata, result)


def rank_entries(entries: Iterable[Entry], track: Track, metric: str = "accuracy") -> Board:
    """Order the entries of one track by a metric's overall value.

    Complete submissions are ranked, best first by the metric's own direction; equal scores share a rank
    and the next one skips (1, 1, 3). Ties are listed by slug.

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
    return Board(
        track=track,
        metric=metric,
        ranked=_assign_ranks(complete, metric, sign),
        partial=tuple(Row(entry, None) for entry in partial),
        baselines=tuple(Row(row.entry, None) for row in _assign_ranks(baselines, metric, sign)),
    )


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


def _content(raw: RawSubmission, name: str) -> bytes:
    file = raw.find(name)
    if file is None or file.content is None:
        what = "is missing" if file is None else "is not a plain file within its size limit"
        hint = f"grade it first: leaderboard grade {raw.location}" if name == RESULT_FILE else ""
        raise InstanceError(
            f"{raw.path_of(name)} {what}", hint or f"see: leaderboard validate {raw.location}"
        )
    return file.content


def _parse_metadata(raw: RawSubmission) -> Metadata:
    try:
        return Metadata.model_validate(tomllib.loads(_content(raw, SUBMISSION_FILE).decode()))
    except ValueError as error:
        raise InstanceError(
            f"{raw.path_of(SUBMISSION_FILE)} is not valid", f"see: leaderboard validate {raw.location}"
        ) from error


def _parse_result(raw: RawSubmission) -> Result:
    try:
        return Result.model_validate_json(_content(raw, RESULT_FILE))
    except ValidationError as error:
        raise InstanceError(
            f"{raw.path_of(RESULT_FILE)} is not a result of this version",
            f"grade it again: leaderboard grade {raw.location}",
        ) from error
