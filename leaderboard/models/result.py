"""What grading finds (``result.json``)."""

from typing import Annotated, Literal

from pydantic import Field, ModelWrapValidatorHandler, model_serializer, model_validator

from leaderboard.models.benchmark import ReferenceKind, Sha256
from leaderboard.models.strict import StrictModel

_COUNTS = ("n", "n_pairs", "n_rated", "n_pairs_in_both")


Count = Annotated[int | float, Field(ge=0)]


class Score(StrictModel):
    """One number with its 95 % interval where it has one, or the reason why there is none.

    ``undefined_resamples`` counts the resamples in which it has no value; the interval is that of the others.
    """

    value: float | None
    low: float | None = None
    high: float | None = None
    undefined_resamples: int | None = None
    why: str | None = None

    @model_serializer
    def _leave_out_absent(self) -> dict[str, float | int | str | None]:
        if self.value is None:
            return {"value": None, "why": self.why}
        rest = {"low": self.low, "high": self.high, "undefined_resamples": self.undefined_resamples}
        return {"value": self.value, **{key: number for key, number in rest.items() if number is not None}}


class SubsetScores(StrictModel):
    """The scores of one subset of one scope, with the numbers of trials and pairs behind them.

    In JSON the metrics stand beside the counts. ``n_rated`` counts trials that people judged;
    ``n_pairs_in_both`` is given for easy and hard: how many of the pairs are in the other as well. Counts of
    cross-fitted subsets are means over the splits of the people.
    """

    n: Count
    n_pairs: Count
    n_rated: Count
    n_pairs_in_both: Count | None = None
    metrics: dict[str, Score]

    @model_validator(mode="wrap")
    @classmethod
    def _gather_metrics(
        cls, data: object, handler: ModelWrapValidatorHandler["SubsetScores"]
    ) -> "SubsetScores":
        if isinstance(data, dict) and "metrics" not in data:
            counts = {key: data[key] for key in _COUNTS if key in data}
            data = counts | {"metrics": {key: data[key] for key in data if key not in _COUNTS}}
        return handler(data)

    @model_serializer
    def _spread_metrics(self) -> dict[str, object]:
        counts: dict[str, object] = {k: getattr(self, k) for k in _COUNTS if getattr(self, k) is not None}
        return counts | {name: score.model_dump() for name, score in self.metrics.items()}


class Inputs(StrictModel):
    """What was graded, against what."""

    predictions_sha256: Sha256
    reference_digest: Sha256
    reference_kind: ReferenceKind


class Bootstrap(StrictModel):
    """How the intervals were made."""

    resamples: int
    seed: int
    unit: Literal["pair"] = "pair"


class Bin(StrictModel):
    """A bin of the reliability diagram: upper end, number of trials, and both means, null if it is empty."""

    upto: float
    n: int
    predicted: float | None
    observed: float | None


class Calibration(StrictModel):
    """P(YES) by bin against how often YES was right, and against the share of people who said YES."""

    label: tuple[Bin, ...] = Field(strict=False)
    people: tuple[Bin, ...] | None = Field(default=None, strict=False)


class Coverage(StrictModel):
    """How much of the benchmark was attempted: trials given, trials answered, properties that are whole."""

    trials: int
    answered: int
    properties: tuple[str, ...] = Field(strict=False)
    complete: bool


class Check(StrictModel):
    """A remark on the predictions that a reader should know."""

    code: str
    message: str


class Result(StrictModel):
    """The whole of ``result.json``; ``scores`` goes by scope (overall, property, scenario) and subset.

    ``calibration`` goes by scope, overall and properties; overall pools the trials.
    """

    format: Annotated[Literal[1], Field(alias="schema")] = 1
    metrics_version: int
    grader: str
    submission: str | None
    inputs: Inputs
    bootstrap: Bootstrap
    coverage: Coverage
    scores: dict[str, dict[str, SubsetScores]]
    calibration: dict[str, Calibration]
    checks: tuple[Check, ...] = Field(default=(), strict=False)
