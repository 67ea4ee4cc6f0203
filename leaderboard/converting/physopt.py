"""Results of physopt (first version): a CSV with one row per trial, readout and way of training."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from leaderboard.converting.conversion import Conversion, convert_run
from leaderboard.converting.log import Answer, Run
from leaderboard.converting.records import Options
from leaderboard.errors import SourceError
from leaderboard.ids import is_id
from leaderboard.reference import Reference
from leaderboard.reference.cells import quote
from leaderboard.reference.source_tables import SourceRow, read_source_table

Training = Literal["all", "same"]
Readout = Literal["A", "B", "C"]

COLUMNS = (
    "Model",
    "Readout Train Data",
    "Readout Test Data",
    "Readout Type",
    "Predicted Prob",
    "Predicted Outcome",
    "Actual Outcome",
    "Stimulus Name",
    "Encoder Training Dataset",
    "Dynamics Training Dataset",
)

# The probabilities are printed with eight digits each.
TOLERANCE = 1e-6

_NUMBER = r"[0-9]+(?:\.[0-9]*)?(?:e[+-]?[0-9]{1,3})?"
_PROBABILITIES = re.compile(rf"\[\s*({_NUMBER})\s+({_NUMBER})\s*\]")
_OUTCOMES = {"0": False, "1": True}


@dataclass(frozen=True, order=True)
class _Protocol:
    """What the rows of a run share."""

    model: str
    training: str
    readout: str

    @property
    def name(self) -> str:
        """A name that can serve as a slug."""
        return re.sub(r"[^a-z0-9]+", "-", f"{self.model}-{self.training}-{self.readout}".lower()).strip("-")


def read_runs(files: Sequence[Path], options: Options) -> list[Run]:
    """Read every run in some files; ``options`` say nothing that these files leave open.

    Raises
    ------
    SourceError
        If a file is malformed, or two runs would have the same name.
    """
    del options
    return list(_read_runs(files).values())


def split_runs(files: Sequence[Path], reference: Reference) -> dict[str, Conversion]:
    """Convert every run, by its name: model, training and readout, such as ``cswm-all-a``.

    The rows of one model that was trained on each scenario by itself (``same``) make one run together, as
    do those of a model trained on all scenarios (``all``). Any other training, such as on all scenarios
    but one, makes a run named after the data sets.

    Raises
    ------
    SourceError
        If a file is malformed, or two runs would have the same name.
    """
    return {protocol.name: convert_run(run, reference) for protocol, run in _read_runs(files).items()}


def convert_physopt(
    files: Sequence[Path],
    reference: Reference,
    *,
    training: Training | None = None,
    readout: Readout | None = None,
) -> Conversion:
    """Convert one run.

    Parameters
    ----------
    files
        Files of results; their rows count as one table.
    reference
        The benchmark whose trials the rows are about.
    training
        ``all`` or ``same``; may be left out where the files hold only one.
    readout
        Physopt's protocol of fitting the readout; may be left out where the files hold only one.

    Raises
    ------
    SourceError
        If a file is malformed, or not exactly one run fits.
    """
    runs = _read_runs(files)
    fitting = [
        run
        for protocol, run in runs.items()
        if training in (None, protocol.training) and readout in (None, protocol.readout)
    ]
    if len(fitting) == 1:
        return convert_run(fitting[0], reference)
    found = "none of the runs fits" if not fitting else f"{len(fitting)} runs fit where one is needed"
    raise SourceError(
        f"{', '.join(map(str, files))}: {found}; there are {', '.join(run.name for run in runs.values())}",
        "choose one with --training and --readout, or convert each with --split-runs DIR",
    )


def _read_runs(files: Sequence[Path]) -> dict[_Protocol, Run]:
    """Read all rows and sort them into runs, in alphabetical order."""
    answers: dict[_Protocol, list[Answer]] = {}
    for file in files:
        for row in read_source_table(file, COLUMNS).rows:
            answers.setdefault(_parse_protocol(row), []).append(_parse_answer(row))
    runs = {protocol: Run(protocol.name, tuple(answers[protocol])) for protocol in sorted(answers)}
    by_name: dict[str, _Protocol] = {}
    for protocol in runs:
        other = by_name.setdefault(protocol.name, protocol)
        if other != protocol:
            both = " and ".join(quote(f"{p.model} {p.training} {p.readout}") for p in (other, protocol))
            raise SourceError(f"{files[0]}: {both} would both be named {protocol.name}")
    return runs


def _parse_protocol(row: SourceRow) -> _Protocol:
    """Tell which run a row belongs to."""
    if not re.search("[A-Za-z0-9]", row["Model"]):
        raise row.error(f"Model {quote(row['Model'])} names no model")
    datasets = {row["Encoder Training Dataset"], row["Dynamics Training Dataset"]}
    fitted_on, tested_on = row["Readout Train Data"], row["Readout Test Data"]
    if fitted_on != tested_on:
        training = "-".join([*sorted(datasets), "read", fitted_on])
    else:
        training = "same" if datasets == {tested_on} else "-".join(sorted(datasets))
    return _Protocol(row["Model"], training, row["Readout Type"])


def _parse_answer(row: SourceRow) -> Answer:
    if not row["Stimulus Name"]:
        raise row.error("Stimulus Name is empty")
    if not is_id(row["Readout Test Data"]):
        raise row.error(f"Readout Test Data {quote(row['Readout Test Data'])} names no scenario")
    no, yes = _parse_probabilities(row)
    predicted = _parse_outcome(row, "Predicted Outcome")
    doubts = []
    if abs(float(no) + float(yes) - 1) > TOLERANCE:
        doubts.append(f"{no} for NO and {yes} for YES do not add up to 1")
    if float(no) != float(yes) and predicted != (float(yes) > float(no)):
        doubts.append(f"predicts {'YES' if predicted else 'NO'} with {no} for NO and {yes} for YES")
    return Answer(
        file=row.file,
        line=row.line,
        trial_name=row["Stimulus Name"],
        scenario_name=row["Readout Test Data"],
        probability=yes,
        outcome=_parse_outcome(row, "Actual Outcome"),
        doubts=tuple(doubts),
    )


def _parse_probabilities(row: SourceRow) -> tuple[str, str]:
    """Parse P(NO) and P(YES), keeping their digits but not a point without decimals."""
    match = _PROBABILITIES.fullmatch(row["Predicted Prob"])
    if match is None or max(map(float, match.groups())) > 1:
        found = row["Predicted Prob"]
        raise row.error(f"Predicted Prob {quote(found)} is not two numbers from 0 to 1 such as [0.25 0.75]")
    no, yes = (re.sub(r"\.(?=e|$)", "", number) for number in match.groups())
    return no, yes


def _parse_outcome(row: SourceRow, column: str) -> bool:
    if row[column] not in _OUTCOMES:
        raise row.error(f"{column} {quote(row[column])} is neither 0 nor 1")
    return _OUTCOMES[row[column]]
