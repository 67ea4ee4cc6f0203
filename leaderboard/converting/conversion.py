"""From the answers of a run to predictions for a reference, with an account of all that does not fit."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from leaderboard.converting.log import Answer, Run
from leaderboard.converting.matching import (
    AmbiguousAnswer,
    MatchedAnswer,
    list_scenario_names,
    match_answers,
)
from leaderboard.converting.merging import Prediction, are_equal, group_by_repeat, merge_repeats
from leaderboard.converting.traps import Traps, count_traps
from leaderboard.errors import SourceError
from leaderboard.files import csv_text, write_atomic
from leaderboard.instance import PREDICTIONS_FILE
from leaderboard.reference import Reference
from leaderboard.reference.cells import quote
from leaderboard.submission import Status


@dataclass(frozen=True)
class RepeatedTrial:
    """A trial that a run answers more than once for a repeat; equal answers count as one, others as none."""

    trial_id: str
    answers: tuple[Answer, ...]

    @property
    def is_consistent(self) -> bool:
        """Whether its answers say the same, repeat by repeat."""
        return all(are_equal(answers) for answers in group_by_repeat(self.answers))


@dataclass(frozen=True)
class OmittedScenario:
    """A scenario that a run does not cover whole."""

    scenario: str
    n_answered: int
    n_trials: int


@dataclass(frozen=True)
class Conversion:
    """The predictions of a run and what was met on the way.

    Attributes
    ----------
    name
        The run's.
    benchmark
        Title of the benchmark whose trials the predictions are for.
    n_rows
        Number of the run's answers in the log.
    predictions
        In the order of the reference, for whole scenarios only.
    scenarios
        Those that the predictions cover.
    omitted
        Scenarios left out because the run answers some of their trials, or none.
    unmatched, ambiguous
        Answers left out because their name fits no trial, or several.
    misplaced
        Answers left out because the log has the trial in another scenario than the reference.
    repeated
        Trials that were answered more than once.
    contradicting
        Answers that are kept although the log takes another outcome to be true than the reference.
    doubtful
        Answers that are kept although their log does not agree with itself about them.
    unknown_scenarios
        Names of scenarios in the log that the reference does not know, so that it could not be checked
        whether their trials belong there.
    traps
        Counts over all trials that the run answers, whether their scenario is whole or not.
    reader
        Version of the reader that turned texts into answers, None if there were no texts to read.
    """

    name: str
    benchmark: str
    n_rows: int
    predictions: tuple[Prediction, ...]
    scenarios: tuple[str, ...]
    omitted: tuple[OmittedScenario, ...]
    unmatched: tuple[Answer, ...]
    ambiguous: tuple[AmbiguousAnswer, ...]
    misplaced: tuple[MatchedAnswer, ...]
    repeated: tuple[RepeatedTrial, ...]
    contradicting: tuple[MatchedAnswer, ...]
    doubtful: tuple[MatchedAnswer, ...]
    unknown_scenarios: tuple[str, ...]
    traps: Traps
    reader: int | None = None

    def to_columns(self) -> dict[str, list[str]]:
        """Give the predictions as columns, from which any library makes its data frame.

        Probabilities are texts, since unanswered trials have none and the log's digits are kept.
        """
        return {
            "trial_id": [prediction.trial_id for prediction in self.predictions],
            "probability": [prediction.probability for prediction in self.predictions],
            "status": [prediction.status.value for prediction in self.predictions],
        }


def convert_run(run: Run, reference: Reference) -> Conversion:
    """Turn a run's answers into predictions for the scenarios that it covers whole.

    Nothing is guessed: an answer counts only if its name means exactly one trial, and a trial only if all
    answers to it agree, but for repeats: these make one probability.
    """
    scenarios_by_name = list_scenario_names(reference)
    matches = match_answers(run, reference, scenarios_by_name)
    repeated = tuple(_find_repeated(matches.matched))
    unusable = {trial.trial_id for trial in repeated if not trial.is_consistent}
    usable = {t: found for t, found in matches.matched.items() if t not in unusable}
    predictions = {t: _predict(t, usable[t]) for t in reference.trial_ids if t in usable}
    omitted = _find_omitted(reference, usable)
    left_out = {scenario.scenario for scenario in omitted}
    written = [t for t in predictions if usable[t][0].scenario not in left_out]
    return Conversion(
        name=run.name,
        benchmark=reference.benchmark.title,
        n_rows=len(run.answers),
        predictions=tuple(predictions[t] for t in written),
        scenarios=tuple(s.id for s in reference.benchmark.scenarios if s.id not in left_out),
        omitted=omitted,
        unmatched=tuple(matches.unmatched),
        ambiguous=tuple(matches.ambiguous),
        misplaced=tuple(matches.misplaced),
        repeated=repeated,
        contradicting=_find_contradicting([usable[t][0] for t in written], reference),
        doubtful=tuple(m for found in matches.matched.values() for m in found if m.answer.doubts),
        unknown_scenarios=tuple(sorted({a.scenario_name for a in run.answers} - {"", *scenarios_by_name})),
        traps=count_traps(
            list(predictions.values()),
            reference,
            n_duplicated=len(repeated),
            n_ambiguous=len(matches.ambiguous),
        ),
        reader=run.reader,
    )


def render_predictions(conversion: Conversion) -> bytes:
    """Render the predictions as the content of ``predictions.csv``, with statuses if one is not answered."""
    rows = [(p.trial_id, p.probability, p.status.value) for p in conversion.predictions]
    if all(prediction.status is Status.ANSWERED for prediction in conversion.predictions):
        return csv_text(("trial_id", "probability"), [row[:2] for row in rows]).encode()
    return csv_text(("trial_id", "probability", "status"), rows).encode()


def write_predictions(conversion: Conversion, file: Path) -> None:
    """Write the predictions, over an older file if there is one.

    Raises
    ------
    SourceError
        If the run covers no scenario whole, so that there is nothing to write.
    """
    _require_predictions([conversion])
    write_atomic(file, render_predictions(conversion))


def write_runs(conversions: Mapping[str, Conversion], folder: Path) -> tuple[Path, ...]:
    """Write ``<run>/predictions.csv`` into a folder for each run that covers a scenario whole.

    Returns
    -------
    tuple of Path
        The files that were written.

    Raises
    ------
    SourceError
        If no run covers a scenario whole.
    """
    _require_predictions(list(conversions.values()))
    files = []
    for name, conversion in conversions.items():
        if conversion.predictions:
            file = folder / name / PREDICTIONS_FILE
            file.parent.mkdir(parents=True, exist_ok=True)
            write_atomic(file, render_predictions(conversion))
            files.append(file)
    return tuple(files)


def _require_predictions(conversions: Sequence[Conversion]) -> None:
    if any(conversion.predictions for conversion in conversions):
        return
    names = ", ".join(conversion.name for conversion in conversions)
    n_rows = sum(conversion.n_rows for conversion in conversions)
    unmatched = [answer for conversion in conversions for answer in conversion.unmatched]
    traps = max((conversion.traps for conversion in conversions), key=lambda traps: traps.n_matched)
    found = f"{n_rows:,} rows give an answer to {traps.n_matched:,} of {traps.n_trials:,} trials"
    if unmatched:
        example = quote(unmatched[0].trial_name)
        found = f"{len(unmatched):,} of {n_rows:,} rows match no trial, for example {example}"
    benchmark = conversions[0].benchmark
    raise SourceError(
        f"{names}: nothing to write, because no scenario of {benchmark} is covered whole; {found}",
        "is this a log of that benchmark, and is it complete?",
    )


def _find_repeated(matched: Mapping[str, Sequence[MatchedAnswer]]) -> Iterator[RepeatedTrial]:
    for trial_id, found in matched.items():
        groups = group_by_repeat([match.answer for match in found]) if len(found) > 1 else []
        answers = tuple(answer for group in groups if len(group) > 1 for answer in group)
        if answers:
            yield RepeatedTrial(trial_id, answers)


def _predict(trial_id: str, found: Sequence[MatchedAnswer]) -> Prediction:
    return merge_repeats(trial_id, [group[0] for group in group_by_repeat([m.answer for m in found])])


def _find_omitted(
    reference: Reference, usable: Mapping[str, Sequence[MatchedAnswer]]
) -> tuple[OmittedScenario, ...]:
    counts = []
    for scenario in reference.benchmark.scenarios:
        n_trials = int(reference.in_scenario(scenario.id).sum())
        n_answered = sum(found[0].scenario == scenario.id for found in usable.values())
        counts.append(OmittedScenario(scenario.id, n_answered, n_trials))
    return tuple(count for count in counts if count.n_answered < max(count.n_trials, 1))


def _find_contradicting(written: Sequence[MatchedAnswer], reference: Reference) -> tuple[MatchedAnswer, ...]:
    return tuple(
        match
        for match in written
        if match.answer.outcome not in (None, bool(reference.labels[reference.trial_index[match.trial_id]]))
    )
