"""From the answers of a run to predictions for a reference, with an account of all that does not fit."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from leaderboard.converting.log import Answer, Run
from leaderboard.errors import SourceError
from leaderboard.files import csv_text, write_atomic
from leaderboard.instance import PREDICTIONS_FILE
from leaderboard.reference import Reference
from leaderboard.reference.cells import quote
from leaderboard.trial_names import Ambiguous, Resolved, TrialNames


@dataclass(frozen=True)
class Prediction:
    """A line of ``predictions.csv``; the probability keeps the log's digits."""

    trial_id: str
    probability: str


@dataclass(frozen=True)
class MatchedAnswer:
    """An answer, the trial that it is about, and that trial's scenario."""

    answer: Answer
    trial_id: str
    scenario: str


@dataclass(frozen=True)
class AmbiguousAnswer:
    """An answer whose name fits several trials."""

    answer: Answer
    trial_ids: tuple[str, ...]


@dataclass(frozen=True)
class RepeatedTrial:
    """A trial that a run answers more than once; equal answers count as one, others as none."""

    trial_id: str
    answers: tuple[Answer, ...]

    @property
    def is_consistent(self) -> bool:
        """Whether all its answers have the same probability."""
        return len({answer.probability for answer in self.answers}) == 1


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
        Answers that are kept although their numbers do not fit together.
    unknown_scenarios
        Names of scenarios in the log that the reference does not know, so that it could not be checked
        whether their trials belong there.
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


@dataclass
class _Matches:
    """Answers sorted by what their names mean."""

    matched: dict[str, list[MatchedAnswer]] = field(default_factory=dict)
    unmatched: list[Answer] = field(default_factory=list)
    ambiguous: list[AmbiguousAnswer] = field(default_factory=list)
    misplaced: list[MatchedAnswer] = field(default_factory=list)


def convert_run(run: Run, reference: Reference) -> Conversion:
    """Turn a run's answers into predictions for the scenarios that it covers whole.

    Nothing is guessed: an answer counts only if its name means exactly one trial, and a trial only if all
    answers to it agree.
    """
    scenarios_by_name = _list_scenario_names(reference)
    matches = _match_answers(run, reference, scenarios_by_name)
    repeated = tuple(
        RepeatedTrial(trial_id, tuple(match.answer for match in found))
        for trial_id, found in matches.matched.items()
        if len(found) > 1
    )
    unusable = {trial.trial_id for trial in repeated if not trial.is_consistent}
    usable = {t: found[0] for t, found in matches.matched.items() if t not in unusable}
    omitted = _find_omitted(reference, usable)
    left_out = {scenario.scenario for scenario in omitted}
    written = [usable[t] for t in reference.trial_ids if t in usable and usable[t].scenario not in left_out]
    everything = [match for found in matches.matched.values() for match in found]
    return Conversion(
        name=run.name,
        benchmark=reference.benchmark.title,
        n_rows=len(run.answers),
        predictions=tuple(Prediction(match.trial_id, match.answer.probability) for match in written),
        scenarios=tuple(s.id for s in reference.benchmark.scenarios if s.id not in left_out),
        omitted=omitted,
        unmatched=tuple(matches.unmatched),
        ambiguous=tuple(matches.ambiguous),
        misplaced=tuple(matches.misplaced),
        repeated=repeated,
        contradicting=_find_contradicting(written, reference),
        doubtful=tuple(match for match in everything if match.answer.doubts),
        unknown_scenarios=tuple(sorted({a.scenario_name for a in run.answers} - scenarios_by_name.keys())),
    )


def render_predictions(conversion: Conversion) -> bytes:
    """Render the predictions as the content of ``predictions.csv``."""
    rows = [(prediction.trial_id, prediction.probability) for prediction in conversion.predictions]
    return csv_text(("trial_id", "probability"), rows).encode()


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
    example = f", for example {quote(unmatched[0].trial_name)}" if unmatched else ""
    raise SourceError(
        f"{names}: nothing to write, because no scenario of {conversions[0].benchmark} is covered whole; "
        f"{len(unmatched):,} of {n_rows:,} rows match no trial{example}",
        "is this a log of that benchmark, and is it complete?",
    )


def _list_scenario_names(reference: Reference) -> dict[str, set[str]]:
    """Map ids, property names and aliases to the scenarios that they can mean."""
    scenarios: dict[str, set[str]] = {}
    for p in reference.benchmark.properties:
        own = {scenario.id for scenario in reference.benchmark.scenarios_of(p.name)}
        scenarios.update({scenario: {scenario} for scenario in own})
        for name in (p.name, *p.aliases):
            scenarios.setdefault(name, set()).update(own)
    return scenarios


def _match_answers(run: Run, reference: Reference, scenarios_by_name: Mapping[str, set[str]]) -> _Matches:
    names = TrialNames(reference.trial_ids)
    matches = _Matches()
    for answer in run.answers:
        found = names.resolve(answer.trial_name)
        if isinstance(found, Ambiguous):
            matches.ambiguous.append(AmbiguousAnswer(answer, found.trial_ids))
        elif isinstance(found, Resolved):
            match = MatchedAnswer(answer, found.trial_id, _scenario_of(found.trial_id, reference))
            if match.scenario in scenarios_by_name.get(answer.scenario_name, {match.scenario}):
                matches.matched.setdefault(found.trial_id, []).append(match)
            else:
                matches.misplaced.append(match)
        else:
            matches.unmatched.append(answer)
    return matches


def _scenario_of(trial_id: str, reference: Reference) -> str:
    index = int(reference.scenarios[reference.trial_index[trial_id]])
    return reference.benchmark.scenarios[index].id


def _find_omitted(reference: Reference, usable: Mapping[str, MatchedAnswer]) -> tuple[OmittedScenario, ...]:
    counts = []
    for scenario in reference.benchmark.scenarios:
        n_trials = int(reference.in_scenario(scenario.id).sum())
        n_answered = sum(match.scenario == scenario.id for match in usable.values())
        counts.append(OmittedScenario(scenario.id, n_answered, n_trials))
    return tuple(count for count in counts if count.n_answered < max(count.n_trials, 1))


def _find_contradicting(written: Sequence[MatchedAnswer], reference: Reference) -> tuple[MatchedAnswer, ...]:
    return tuple(
        match
        for match in written
        if match.answer.outcome != bool(reference.labels[reference.trial_index[match.trial_id]])
    )
