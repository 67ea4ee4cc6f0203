"""The recipe for Physion, the predecessor: no pairs, no single responses, names that differ between files."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from leaderboard.errors import SourceError
from leaderboard.files import csv_text
from leaderboard.ids import is_id
from leaderboard.instance import BENCHMARK_FILE, HUMAN_TRIALS_FILE
from leaderboard.models import Benchmark, Source
from leaderboard.problems import Problems
from leaderboard.reference.cells import ID_RULE, quote
from leaderboard.reference.fetching import Remote, RemoteFile
from leaderboard.reference.people import RATING_HEADER
from leaderboard.reference.recipes.physion_definition import (
    OFFICIAL_SOURCES,
    PROPERTIES,
    STIMULI_FILE,
    OfficialProperty,
)
from leaderboard.reference.recipes.recipe import Draft, ImportedProperty, ImportOptions
from leaderboard.reference.source_files import SourceFile
from leaderboard.reference.source_tables import SourceRow, SourceTable, parse_source_table
from leaderboard.reference.tables import TRIAL_HEADER
from leaderboard.trial_names import Ambiguous, TrialNames, Unknown

STIMULI_COLUMNS = ("stim_ID", "scenario", "correct", "label")
HUMAN_COLUMNS = ("stim_ID", "correct", "c")
LABELS = {"False": False, "True": True}

# Human accuracy is printed with 16 digits: times the number of people it is this close to a whole number.
TOLERANCE = Fraction(1, 1_000_000)

_SHARE = re.compile(r"[01](?:\.[0-9]{1,30})?")
_COUNT = re.compile(r"[1-9][0-9]{0,5}")


@dataclass(frozen=True)
class _Trial:
    """One row of the table of stimuli; ``accuracy`` is of people, of whom the table does not say how many."""

    trial_id: str
    scenario: str
    label: bool
    accuracy: Fraction


@dataclass(frozen=True)
class _Judgement:
    """How many people judged a trial, and how many of them rightly."""

    trial: _Trial
    n: int
    n_right: int

    @property
    def n_yes(self) -> int:
        """How many said YES: those who were right if the label is YES, the others if it is NO."""
        return self.n_right if self.trial.label else self.n - self.n_right

    @property
    def accuracy(self) -> Fraction:
        """Share of people who were right."""
        return Fraction(self.n_right, self.n)


def is_physion_file(name: str) -> bool:
    """Tell whether a path ends in the name of one of the official files."""
    return name.rpartition("/")[2] in {STIMULI_FILE, *(p.human_file for p in PROPERTIES)}


def list_physion_remotes(benchmark: Benchmark) -> tuple[Remote, ...]:
    """List the official files, each taken whole and known by its checksum."""
    return tuple(RemoteFile(source.what, source.url, source.sha256) for source in benchmark.sources)


def draft_physion(
    files: Sequence[SourceFile], definition: bytes, options: ImportOptions, problems: Problems
) -> Draft:
    """Make a reference of Physion from its official files.

    Parameters
    ----------
    files
        Among them ``stimulus_names_and_labels.csv`` and one file of human accuracy for each property.
    definition
        The content of ``benchmark.toml``.
    options
        Nothing is open here, so they change nothing.
    problems
        Receives every name that does not match and every number that cannot be.

    Raises
    ------
    SourceError
        If an official file is missing or malformed.
    """
    del options
    stimuli = _parse_official(files, STIMULI_FILE, STIMULI_COLUMNS)
    human_tables = [_parse_official(files, p.human_file, HUMAN_COLUMNS) for p in PROPERTIES]
    sources = _lock_sources([stimuli, *human_tables], problems)
    trials = _parse_trials(stimuli)
    judgements = {
        p.name: _match_people(p, table, trials, problems)
        for p, table in zip(PROPERTIES, human_tables, strict=True)
    }
    properties = tuple(_summarize(p, trials, judgements[p.name]) for p in PROPERTIES)
    return Draft(_render_reference(definition, trials, judgements), properties, sources)


def _parse_official(files: Sequence[SourceFile], name: str, columns: Sequence[str]) -> SourceTable:
    found = [file for file in files if file.name.rpartition("/")[2] == name]
    if not found:
        raise SourceError(f"{name} is not among the official files", "is the folder complete?")
    if len({file.sha256 for file in found}) > 1:
        raise SourceError(f"{found[0].origin} and {found[1].origin} differ", f"keep one {name}")
    return parse_source_table(found[0], columns)


def _lock_sources(tables: Iterable[SourceTable], problems: Problems) -> tuple[Source, ...]:
    """Record what was read, and report files that are not the expected version."""
    locked = []
    for official, table in zip(OFFICIAL_SOURCES, tables, strict=True):
        if table.sha256 != official.sha256:
            message = f"is another version than the one known: sha256 {table.sha256}, not {official.sha256}"
            problems.add("import-version", message, table.file, hint=f"compare with {official.url}")
        locked.append(official.model_copy(update={"sha256": table.sha256}))
    return tuple(locked)


def _parse_trials(table: SourceTable) -> dict[str, _Trial]:
    """Parse the table of stimuli into trials by id, in alphabetical order."""
    scenario_of = {name: p.scenario for p in PROPERTIES for name in p.names}
    trials: dict[str, _Trial] = {}
    lines: dict[str, int] = {}
    for row in table.rows:
        trial = _parse_trial(row, scenario_of)
        if trial.trial_id in trials:
            raise row.error(f"repeats the trial {trial.trial_id} of line {lines[trial.trial_id]}")
        trials[trial.trial_id], lines[trial.trial_id] = trial, row.line
    present = {trial.scenario for trial in trials.values()}
    for p in PROPERTIES:
        if p.scenario not in present:
            raise SourceError(f"{table.file}: holds no trial of {p.name}", "is the file complete?")
    return dict(sorted(trials.items()))


def _parse_trial(row: SourceRow, scenario_of: Mapping[str, str]) -> _Trial:
    if not is_id(row["stim_ID"]):
        raise row.error(f"stim_ID {quote(row['stim_ID'])} cannot be a trial id: {ID_RULE}")
    if row["scenario"] not in scenario_of:
        raise row.error(f"scenario {quote(row['scenario'])} is none of {', '.join(scenario_of)}")
    if row["label"] not in LABELS:
        raise row.error(f"label {quote(row['label'])} is neither True nor False")
    accuracy = _parse_share(row)
    return _Trial(row["stim_ID"], scenario_of[row["scenario"]], LABELS[row["label"]], accuracy)


def _parse_share(row: SourceRow) -> Fraction:
    text = row["correct"]
    if not _SHARE.fullmatch(text) or Fraction(text) > 1:
        raise row.error(f"correct {quote(text)} is no number from 0 to 1 in plain decimal notation")
    return Fraction(text)


def _match_people(
    official: OfficialProperty, table: SourceTable, trials: Mapping[str, _Trial], problems: Problems
) -> dict[str, _Judgement]:
    """Turn the human file of one property into counts by trial id, and report what does not fit."""
    names = TrialNames(trials)
    rows: dict[str, list[SourceRow]] = {}
    for row in table.rows:
        trial_id = _resolve(row, names, problems)
        if trial_id is None:
            continue
        found = trials[trial_id].scenario
        if found != official.scenario:
            message = f"{trial_id} is in the human file of {official.scenario} but is a trial of {found}"
            problems.add("import-scenario", message, row.file, line=row.line)
            continue
        rows.setdefault(trial_id, []).append(row)
    judgements = _count_people(rows, trials, problems)
    n_trials = sum(trial.scenario == official.scenario for trial in trials.values())
    if len(judgements) < n_trials:
        n_unrated = n_trials - len(judgements)
        message = (
            f"{n_unrated} of {n_trials} trials of {official.name} have no usable row; they stay all the same"
        )
        problems.add("import-unrated", message, table.file)
    _compare_accuracy(judgements.values(), table.file, problems)
    return judgements


def _resolve(row: SourceRow, names: TrialNames, problems: Problems) -> str | None:
    found = names.resolve(row["stim_ID"])
    if isinstance(found, Unknown):
        hint = f"the most similar trial is {found.nearest}" if found.nearest else ""
        problems.add(
            "import-unmatched", f"{quote(found.name)} fits no trial", row.file, line=row.line, hint=hint
        )
        return None
    if isinstance(found, Ambiguous):
        message = f"{quote(found.name)} fits several trials: {', '.join(found.trial_ids)}"
        problems.add("import-ambiguous", message, row.file, line=row.line)
        return None
    return found.trial_id


def _count_people(
    rows: Mapping[str, Sequence[SourceRow]], trials: Mapping[str, _Trial], problems: Problems
) -> dict[str, _Judgement]:
    judgements = {}
    for trial_id, (first, *others) in rows.items():
        judgement = _parse_judgement(first, trials[trial_id], problems)
        for other in others:
            message = f"{trial_id} is judged in line {first.line} already; neither row is used"
            problems.add("import-repeated", message, other.file, line=other.line)
        if judgement is not None and not others:
            judgements[trial_id] = judgement
    return judgements


def _parse_judgement(row: SourceRow, trial: _Trial, problems: Problems) -> _Judgement | None:
    """Recover the count of people who were right from their share."""
    share = _parse_share(row)
    if not _COUNT.fullmatch(row["c"]):
        raise row.error(f"c {quote(row['c'])} is no number of people")
    n = int(row["c"])
    n_right = round(share * n)
    if abs(share * n - n_right) > TOLERANCE:
        message = f"{row['correct']} of {n} people is {float(share * n):.4f}, not a whole number of people"
        problems.add("import-count", message, row.file, line=row.line)
        return None
    return _Judgement(trial, n, n_right)


def _compare_accuracy(judgements: Iterable[_Judgement], file: str, problems: Problems) -> None:
    """Hold the human accuracy of the table of stimuli against that of the human file."""
    pairs = [(j.accuracy, j.trial.accuracy) for j in judgements]
    differences = [abs(counted - stated) for counted, stated in pairs]
    n_different = sum(difference > TOLERANCE for difference in differences)
    if n_different:
        counted, stated = (float(sum(column) / len(pairs)) for column in zip(*pairs, strict=True))
        problems.add(
            "import-accuracy",
            f"{STIMULI_FILE} gives another human accuracy for {n_different} of these {len(pairs)} trials "
            f"(mean {stated:.3f} instead of {counted:.3f}, at most {float(max(differences)):.3f} apart); "
            "this file's is used, because only it says how many people it is of",
            file,
        )


def _render_reference(
    definition: bytes,
    trials: Mapping[str, _Trial],
    judgements: Mapping[str, Mapping[str, _Judgement]],
) -> dict[str, bytes]:
    """Write the definition, the trials of each property and the human counts as files."""
    files: dict[str, str] = {}
    human_rows = []
    for p in PROPERTIES:
        own = [trial for trial in trials.values() if trial.scenario == p.scenario]
        rows = [(t.trial_id, t.trial_id, t.scenario, 0, int(t.label), "") for t in own]
        files[p.file] = csv_text(TRIAL_HEADER, rows)
        judged = [judgements[p.name][t.trial_id] for t in own if t.trial_id in judgements[p.name]]
        human_rows += [(j.trial.trial_id, j.n, j.n_yes) for j in judged]
    if human_rows:
        files[HUMAN_TRIALS_FILE] = csv_text(RATING_HEADER, human_rows)
    return {BENCHMARK_FILE: definition} | {name: text.encode() for name, text in files.items()}


def _summarize(
    official: OfficialProperty, trials: Mapping[str, _Trial], judgements: Mapping[str, _Judgement]
) -> ImportedProperty:
    n_trials = sum(trial.scenario == official.scenario for trial in trials.values())
    accuracies = [judgement.accuracy for judgement in judgements.values()]
    mean = float(sum(accuracies, Fraction(0)) / len(accuracies)) if accuracies else None
    return ImportedProperty(official.name, n_trials, len(judgements), mean)
