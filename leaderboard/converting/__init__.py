"""Other tools' logs to predictions: one module per format, and this registry."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from leaderboard.converting import (
    answer_tables,
    eureka,
    evalscope,
    inspect_ai,
    lm_eval,
    lmms_eval,
    physmind,
    physopt,
    probability_tables,
    vlmevalkit,
)
from leaderboard.converting.answer_tables import make_run
from leaderboard.converting.answers import READER_VERSION, parse_answer
from leaderboard.converting.conversion import Conversion, convert_run, write_predictions, write_runs
from leaderboard.converting.log import Run
from leaderboard.converting.physopt import convert_physopt
from leaderboard.converting.record_files import read_id_map
from leaderboard.converting.records import Options
from leaderboard.errors import SourceError
from leaderboard.reference import Reference


@dataclass(frozen=True)
class Format:
    """A tool's log format.

    Attributes
    ----------
    name, title
        As commands and documents call it, and what its files are.
    read_runs
        Reads files of this format as runs.
    options
        Which of the attributes of `Options` matter to it.
    """

    name: str
    title: str
    read_runs: Callable[[Sequence[Path], Options], Sequence[Run]]
    options: tuple[str, ...] = ()

    def split_runs(
        self, files: Sequence[Path], reference: Reference, options: Options | None = None
    ) -> dict[str, Conversion]:
        """Convert every run in some files, by the run's name.

        Raises
        ------
        SourceError
            If a file is malformed, or two runs would have the same name.
        """
        conversions: dict[str, Conversion] = {}
        for run in self.read_runs(files, options or Options()):
            if run.name in conversions:
                raise SourceError(
                    f"{files[0]}: two runs would be named {run.name}", "convert them one by one"
                )
            conversions[run.name] = convert_run(run, reference)
        return conversions


def choose_run(conversions: Mapping[str, Conversion], wanted: str | None) -> Conversion:
    """Return the run of that name, or the only one.

    Raises
    ------
    SourceError
        If there is none, or there are several to choose from.
    """
    names = ", ".join(conversions)
    if wanted is None and len(conversions) == 1:
        return next(iter(conversions.values()))
    if wanted is None:
        hint = "choose one with --run, or convert each with --split-runs DIR"
        raise SourceError(f"{len(conversions)} runs are there where one is needed: {names}", hint)
    if wanted not in conversions:
        raise SourceError(f"there is no run {wanted}; there are {names}")
    return conversions[wanted]


_IDS = ("id_field", "id_map")

FORMATS = {
    format_.name: format_
    for format_ in (
        Format(
            "answers",
            "Answers as text beside an id (JSON lines, JSON or CSV)",
            answer_tables.read_runs,
            (*_IDS, "answer_field"),
        ),
        Format(
            "probabilities",
            "Probabilities or logits beside an id (JSON lines, JSON or CSV)",
            probability_tables.read_runs,
            (*_IDS, "probability_field", "is_logit"),
        ),
        Format("physmind", "PhysMind (predictions.json or run.json)", physmind.read_runs, _IDS),
        Format("inspect", "Inspect AI (logs in .json; in .eval with inspect_ai)", inspect_ai.read_runs, _IDS),
        Format("lm-eval", "lm-evaluation-harness (samples_*.jsonl)", lm_eval.read_runs, _IDS),
        Format("lmms-eval", "lmms-eval (*_samples_*.jsonl)", lmms_eval.read_runs, _IDS),
        Format("vlmevalkit", "VLMEvalKit (tables in CSV, TSV or JSON)", vlmevalkit.read_runs, _IDS),
        Format("eureka", "Eureka ML Insights (inference_result.jsonl)", eureka.read_runs, _IDS),
        Format("evalscope", "EvalScope (reviews in JSON lines)", evalscope.read_runs, _IDS),
        Format("physopt", "results of physopt, one row per trial (CSV)", physopt.read_runs),
    )
}

__all__ = [
    "FORMATS",
    "READER_VERSION",
    "Conversion",
    "Format",
    "Options",
    "choose_run",
    "convert_physopt",
    "convert_run",
    "make_run",
    "parse_answer",
    "read_id_map",
    "write_predictions",
    "write_runs",
]
