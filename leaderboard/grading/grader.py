"""Computing a result: each metric on each subset of each scope, with intervals."""

from collections.abc import Collection, Sequence

from leaderboard import __version__
from leaderboard.files import canonical_json
from leaderboard.grading.binning import bin_scopes
from leaderboard.grading.cells import Cell
from leaderboard.grading.crossfitted import CrossMeasured
from leaderboard.grading.intervals import Measured, resample_cells
from leaderboard.grading.metrics import METRICS, METRICS_VERSION
from leaderboard.grading.observations import NOT_A_PROPERTY, Observations
from leaderboard.grading.scopes import EMPTY_SUBSET, SUBSETS, list_scopes
from leaderboard.grading.sums import sum_columns
from leaderboard.grading.tally import Tally
from leaderboard.grading.yardstick import Yardstick
from leaderboard.metrics.accuracy import Booleans
from leaderboard.metrics.undefined import Estimate
from leaderboard.models import Bootstrap, Check, Coverage, Inputs, Result
from leaderboard.models.benchmark import OVERALL
from leaderboard.reference import Reference
from leaderboard.submission import Submission

NAMES = frozenset(metric.name for metric in METRICS)


def grade(
    submission: Submission,
    reference: Reference,
    *,
    yardstick: Yardstick | None = None,
    checks: Sequence[Check] = (),
) -> Result:
    """Score a submission against a reference.

    Scores are given for every scope that the submission covers wholly: scenarios on all trials, properties
    and overall on all, easy and hard, these also cross-fitted. ``checks`` are kept in the result as they are.

    Parameters
    ----------
    yardstick
        That of the reference, if several submissions are graded; made anew if not given.
    """
    yardstick = yardstick or Yardstick.of(reference)
    observations = Observations.of(submission, reference)
    tally = tally_scores(observations, submission.covered, yardstick, keeps_resamples=False)
    scopes = list_scopes(reference, submission.covered)
    properties = tuple(scope.name for scope in scopes if scope.kind == "property")
    grading = reference.benchmark.grading
    return Result(
        metrics_version=METRICS_VERSION,
        grader=__version__,
        submission=submission.slug,
        inputs=Inputs(
            predictions_sha256=submission.predictions_sha256,
            reference_digest=reference.manifest.digest,
            reference_kind=reference.manifest.kind,
        ),
        bootstrap=Bootstrap(resamples=grading.resamples, seed=grading.seed),
        coverage=Coverage(
            trials=int(submission.covered.sum()),
            answered=int(submission.answered.sum()),
            properties=properties,
            complete=OVERALL in tally.estimates,
        ),
        scores=tally.assemble([scope.name for scope in scopes]),
        calibration=bin_scopes(observations, [scope for scope in scopes if scope.kind != "scenario"]),
        checks=tuple(checks),
    )


def tally_scores(
    observations: Observations,
    covered: Booleans,
    yardstick: Yardstick,
    *,
    subsets: Collection[str] = SUBSETS,
    metrics: Collection[str] = NAMES,
    keeps_resamples: bool = True,
) -> Tally:
    """Compute metrics of every cell with their resamples, and the averages over the properties.

    Parameters
    ----------
    subsets, metrics
        Those that are wanted, which says nothing about what they give; the cross-fitted need ``all``, and
        have every metric.
    keeps_resamples
        Whether the resamples themselves are wanted, not only the intervals, which are faster alone.
    """
    tally = Tally(yardstick.properties, keeps_resamples)
    for group in yardstick.group_cells(covered):
        cells = [cell for cell in group if cell.subset in subsets]
        measured = [_measure(observations, cell, yardstick, metrics) for cell in cells]
        _score_cells(tally, measured, yardstick, subsets)
    if covered.all():
        tally.average()
        _pool_p_values(tally, observations, yardstick)
    return tally


def _score_cells(
    tally: Tally, measured: Sequence[Measured], yardstick: Yardstick, subsets: Collection[str]
) -> None:
    """Resample the metrics of the cells of a property, and compute those of its cross-fitted subsets."""
    cells = [m.cell for m in measured]
    pairs = [(c, m.observed) for m in measured for c in yardstick.find_cross_cells(m.cell)]
    crossed = [CrossMeasured(cross, observed) for cross, observed in pairs if cross.name in subsets]
    columns = [m.columns for m in measured] + [c.columns for c in crossed]
    sums = sum_columns([*cells, *(c.cross.cell for c in crossed)], columns)
    resamples = resample_cells(measured, sums[: len(cells)], yardstick)
    for m, resampled in zip(measured, resamples, strict=True):
        tally.add(m.cell.key, m.cell.counts, m.estimates, resampled)
    for c, of_subset in zip(crossed, sums[len(cells) :], strict=True):
        tally.add(c.cross.key, c.cross.counts, c.estimates, c.resample(of_subset))


def _measure(
    observations: Observations, cell: Cell, yardstick: Yardstick, metrics: Collection[str]
) -> Measured:
    found = yardstick.find_reliability(cell)
    o = cell.observe(observations, reliability=found.value if found else NOT_A_PROPERTY)
    return Measured(cell, o, _estimate(o, metrics))


def _pool_p_values(tally: Tally, observations: Observations, yardstick: Yardstick) -> None:
    """Overall p-values pool the trials of all properties."""
    for subset in tally.estimates[OVERALL].keys() & yardstick.masks.keys():
        pooled = observations.select(yardstick.masks[subset])
        if pooled.labels.size:
            p_values = {metric.name: metric.compute(pooled) for metric in METRICS if metric.is_p_value}
            tally.estimates[OVERALL][subset] |= p_values


def _estimate(observations: Observations, metrics: Collection[str]) -> dict[str, Estimate]:
    wanted = [metric for metric in METRICS if metric.name in metrics]
    if not observations.labels.size:
        return {metric.name: EMPTY_SUBSET for metric in wanted}
    return {metric.name: metric.compute(observations) for metric in wanted}


def result_bytes(result: Result) -> bytes:
    """Write a result as the bytes of ``result.json``; equal results give equal bytes."""
    return canonical_json(result.model_dump(mode="json", by_alias=True)).encode()
