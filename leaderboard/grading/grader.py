"""Computing a result: each metric on each subset of each scope, with intervals."""

from collections.abc import Sequence

from leaderboard import __version__
from leaderboard.files import canonical_json
from leaderboard.grading.binning import bin_scopes
from leaderboard.grading.crossfitted import cross_subsets, estimate_crossfit, resample_crossfit
from leaderboard.grading.intervals import resample_cell
from leaderboard.grading.metrics import METRICS, METRICS_VERSION
from leaderboard.grading.observations import NOT_A_PROPERTY, Observations
from leaderboard.grading.scopes import EMPTY_SUBSET, list_scopes
from leaderboard.grading.tally import Tally
from leaderboard.grading.yardstick import Cell, Yardstick
from leaderboard.metrics.accuracy import Booleans
from leaderboard.metrics.undefined import Estimate
from leaderboard.models import Bootstrap, Check, Coverage, Inputs, Result
from leaderboard.models.benchmark import OVERALL
from leaderboard.reference import Reference
from leaderboard.submission import Submission


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
    tally = tally_scores(observations, submission.covered, yardstick)
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


def tally_scores(observations: Observations, covered: Booleans, yardstick: Yardstick) -> Tally:
    """Compute every metric of every cell with its resamples, and the averages over the properties."""
    tally = Tally()
    for cell in yardstick.list_cells(covered):
        _score_cell(tally, observations, cell, yardstick)
    if covered.all():
        tally.average(yardstick.properties)
        _pool_p_values(tally, observations, yardstick)
    return tally


def _score_cell(tally: Tally, observations: Observations, cell: Cell, yardstick: Yardstick) -> None:
    """Compute the metrics of a cell, and on whole properties those of the cross-fitted subsets."""
    found = yardstick.find_reliability(cell)
    o = observations.select(cell.mask, reliability=found.value if found else NOT_A_PROPERTY)
    estimates = _estimate(o)
    tally.add(cell.key, cell.counts, estimates, resample_cell(o, cell, estimates, yardstick))
    crossfit = yardstick.find_crossfit(cell)
    for name, (subset, counts) in cross_subsets(crossfit).items() if crossfit else ():
        estimates = estimate_crossfit(o, subset)
        resampled = resample_crossfit(o, subset, cell, estimates)
        tally.add((cell.scope.name, name), counts, estimates, resampled)


def _pool_p_values(tally: Tally, observations: Observations, yardstick: Yardstick) -> None:
    """Overall p-values pool the trials of all properties."""
    for subset, mask in yardstick.masks.items():
        pooled = observations.select(mask)
        if pooled.labels.size:
            p_values = {metric.name: metric.compute(pooled) for metric in METRICS if metric.is_p_value}
            tally.estimates[OVERALL][subset] |= p_values


def _estimate(observations: Observations) -> dict[str, Estimate]:
    if not observations.labels.size:
        return {metric.name: EMPTY_SUBSET for metric in METRICS}
    return {metric.name: metric.compute(observations) for metric in METRICS}


def result_bytes(result: Result) -> bytes:
    """Write a result as the bytes of ``result.json``; equal results give equal bytes."""
    return canonical_json(result.model_dump(mode="json", by_alias=True)).encode()
