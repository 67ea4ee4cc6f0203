"""Which features belong to which trials: by property, in one order, and never a trial twice."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from leaderboard.errors import SourceError
from leaderboard.readout.features import LABEL, PAIR, PROPERTY, Features, Integers, Reals
from leaderboard.reference import Reference
from leaderboard.reference.cells import quote
from leaderboard.trial_names import Resolved, TrialNames

Scope = Literal["property", "all"]

ALL = "all"
_COPY = re.compile(r"-copy[0-9]+(?=/)")  # in the folder that holds one member of each pair


@dataclass(frozen=True)
class TrialList:
    """What a readout may know of the test trials: everything but how they end.

    Attributes
    ----------
    benchmark
        The benchmark's title.
    trial_ids : n_trials texts
        In the order of the reference.
    properties, scenarios : n_trials texts
        Where each belongs.
    property_names
        Property by every name that it goes by, the ids of its scenarios among them.
    """

    benchmark: str
    trial_ids: tuple[str, ...]
    properties: tuple[str, ...]
    scenarios: tuple[str, ...]
    property_names: Mapping[str, str]


@dataclass(frozen=True)
class FittingSet:
    """What one readout is fitted on, in the order of trial ids.

    Attributes
    ----------
    name
        A property, or ``all``.
    trial_ids, pair_ids : n_trials texts
        As they were given.
    values : (n_trials, n_features)
        Features.
    labels : (n_trials,)
        0 or 1.
    """

    name: str
    trial_ids: tuple[str, ...]
    pair_ids: tuple[str, ...]
    values: Reals
    labels: Integers


@dataclass(frozen=True)
class TargetSet:
    """The test trials that one readout answers, in the order of the reference.

    Attributes
    ----------
    trial_ids : n_trials texts
        Those of the reference.
    values : (n_trials, n_features)
        Features.
    """

    trial_ids: tuple[str, ...]
    values: Reals


@dataclass(frozen=True)
class Coverage:
    """What of the benchmark the test features cover.

    Attributes
    ----------
    scenarios
        Those with features for every trial.
    omitted
        Of the others, how many trials have features, and of how many.
    unmatched
        Names in the files that fit no trial, or several.
    """

    scenarios: tuple[str, ...]
    omitted: Mapping[str, tuple[int, int]]
    unmatched: tuple[str, ...]


class _Row(NamedTuple):
    """A row of one of several files."""

    file: int
    row: int


def list_test_trials(reference: Reference) -> TrialList:
    """Take from a reference what a readout may know of it. The labels stay behind."""
    benchmark = reference.benchmark
    names = {alias: p.name for p in benchmark.properties for alias in p.aliases}
    names |= {scenario.id: scenario.property for scenario in benchmark.scenarios}
    names |= {p.name: p.name for p in benchmark.properties}
    return TrialList(
        benchmark=benchmark.title,
        trial_ids=reference.trial_ids,
        properties=tuple(benchmark.properties[index].name for index in reference.properties.tolist()),
        scenarios=tuple(benchmark.scenarios[index].id for index in reference.scenarios.tolist()),
        property_names=names,
    )


def gather_fitting_sets(files: Sequence[Features], trials: TrialList, scope: Scope) -> dict[str, FittingSet]:
    """Put together the trials to fit on, by property or all in one.

    Raises
    ------
    SourceError
        If a trial lacks its label, pair or property, is there twice, or files have different features.
    """
    rows: dict[str, dict[str, _Row]] = {}
    seen: dict[str, str] = {}
    for number, file in enumerate(files):
        if file.labels is None:
            message = f"lacks {LABEL}, 1 where a trial ends with YES and 0 where with NO"
            raise SourceError(f"{file.origin.name}: {message}", "without labels no readout can be fitted")
        properties = _list_properties(file, trials, scope)
        for row, (trial_id, part) in enumerate(zip(file.trial_ids, properties, strict=True)):
            if trial_id in seen:
                message = f"trial {quote(trial_id)} is in {seen[trial_id]} and in {file.origin.name}"
                raise SourceError(message, "give each trial to fit on once")
            seen[trial_id] = file.origin.name
            rows.setdefault(part, {})[trial_id] = _Row(number, row)
    order = [name for name in dict.fromkeys([ALL, *trials.properties]) if name in rows]
    pairs = [_list_pairs(file) for file in files]
    return {name: _make_fitting_set(name, rows[name], files, pairs) for name in order}


def match_test_sets(
    files: Sequence[Features], trials: TrialList, scope: Scope
) -> tuple[dict[str, TargetSet], Coverage]:
    """Find the features of the test trials, by property or all in one, for whole scenarios.

    Raises
    ------
    SourceError
        If two rows mean one trial, no scenario is whole, or files have different features.
    """
    found, unmatched = _resolve_names(files, trials)
    totals: dict[str, list[int]] = {}
    for trial_id, scenario in zip(trials.trial_ids, trials.scenarios, strict=True):
        count = totals.setdefault(scenario, [0, 0])
        count[0] += trial_id in found
        count[1] += 1
    whole = tuple(scenario for scenario, (n_found, n) in totals.items() if n_found == n)
    if not whole:
        message = _say_what_is_missing(totals, unmatched)
        hint = "are these the features of the test trials, and of all of them?"
        raise SourceError(f"no scenario of {trials.benchmark} has features for every trial; {message}", hint)
    rows: dict[str, dict[str, _Row]] = {}
    places = zip(trials.trial_ids, trials.properties, trials.scenarios, strict=True)
    for trial_id, property_name, scenario in places:
        if scenario in whole:
            part = ALL if scope == ALL else property_name
            rows.setdefault(part, {})[trial_id] = found[trial_id]
    omitted = {s: (n_found, n) for s, (n_found, n) in totals.items() if s not in whole}
    sets = {name: TargetSet(tuple(part), _take_rows(part, files)) for name, part in rows.items()}
    return sets, Coverage(whole, omitted, tuple(unmatched))


def _say_what_is_missing(totals: Mapping[str, Sequence[int]], unmatched: Sequence[str]) -> str:
    if unmatched:
        names = "1 name fits" if len(unmatched) == 1 else f"{len(unmatched):,} names fit"
        return f"{names} no trial or several, such as {quote(unmatched[0])}"
    scenario, (n_found, n) = max(totals.items(), key=lambda total: total[1][0] / total[1][1])
    return f"most are there of {scenario}: {n_found:,} of {n:,}"


def check_separate(fitting: FittingSet, test: TargetSet) -> None:
    """Insist that the trials to fit on are not the test trials. Ids may coincide, as those of the paper do.

    Raises
    ------
    SourceError
        If there are trials of the same id, and all of these have the same features.
    """
    index = {trial_id: row for row, trial_id in enumerate(test.trial_ids)}
    shared = [(row, index[trial_id]) for row, trial_id in enumerate(fitting.trial_ids) if trial_id in index]
    if shared and all(np.array_equal(fitting.values[own], test.values[other]) for own, other in shared):
        message = f"{len(shared):,} trials to fit on have ids and features of test trials"
        hint = "fit on the readout's own trials, never on those of the test"
        raise SourceError(f"{fitting.name}: {message}", hint)


def _list_properties(file: Features, trials: TrialList, scope: Scope) -> Sequence[str]:
    """Name the part that each trial of a file belongs to."""
    if scope == ALL:
        return [ALL] * len(file.trial_ids)
    if file.properties is None:
        names = list(dict.fromkeys(trials.properties))
        if len(names) == 1:
            return names * len(file.trial_ids)
        hint = f"give --fit {names[0]}=FILE, or {PROPERTY} for each trial, or fit one with --scope all"
        raise SourceError(f"{file.origin.name}: does not say which property its trials belong to", hint)
    unknown = sorted(set(file.properties) - trials.property_names.keys())
    if unknown:
        names = list(dict.fromkeys(trials.properties))
        message = f"{PROPERTY} {quote(unknown[0])} is none of {trials.benchmark}"
        raise SourceError(f"{file.origin.name}: {message}", f"write one of {', '.join(names)}")
    own = dict(zip(trials.trial_ids, trials.properties, strict=True))
    parts = [trials.property_names[name] for name in file.properties]
    for trial_id, part in zip(file.trial_ids, parts, strict=True):
        if own.get(trial_id, part) != part:  # ids of the readout's own trials may be those of test trials
            message = f"trial {quote(trial_id)} belongs to {own[trial_id]}, and is given for {part}"
            raise SourceError(f"{file.origin.name}: {message}", "is this the file of another property?")
    return parts


def _list_pairs(file: Features) -> tuple[str, ...]:
    """Name each trial's pair: as given, or its id without the mark of the copy."""
    if file.pair_ids is not None:
        return file.pair_ids
    pairs = tuple(_COPY.sub("", trial_id.replace("\\", "/")) for trial_id in file.trial_ids)
    for trial_id, pair_id in zip(file.trial_ids, pairs, strict=True):
        if pair_id == trial_id.replace("\\", "/"):
            message = f"does not say which trials make a pair, nor does an id such as {quote(trial_id)}"
            hint = f"give {PAIR} for each trial, since pairs must not be split; without pairs, its own id"
            raise SourceError(f"{file.origin.name}: {message}", hint)
    return pairs


def _make_fitting_set(
    name: str, rows: Mapping[str, _Row], files: Sequence[Features], pairs: Sequence[tuple[str, ...]]
) -> FittingSet:
    ordered = dict(sorted(rows.items()))
    labels = [_label_of(files[place.file], place.row) for place in ordered.values()]
    return FittingSet(
        name=name,
        trial_ids=tuple(ordered),
        pair_ids=tuple(pairs[place.file][place.row] for place in ordered.values()),
        values=_take_rows(ordered, files),
        labels=np.array(labels, np.int64),
    )


def _label_of(file: Features, row: int) -> int:
    return int(file.labels[row]) if file.labels is not None else -1


def _take_rows(rows: Mapping[str, _Row], files: Sequence[Features]) -> Reals:
    used = sorted({place.file for place in rows.values()})
    first = files[used[0]]
    for number in used[1:]:
        if files[number].values.shape[1] != first.values.shape[1]:
            widths = f"{first.values.shape[1]:,} and {files[number].values.shape[1]:,}"
            message = f"have {widths} features and would be fitted together"
            raise SourceError(f"{first.origin.name} and {files[number].origin.name} {message}")
    dtype = np.result_type(*(files[number].values.dtype for number in used))
    values = np.empty((len(rows), first.values.shape[1]), dtype)
    for index, place in enumerate(rows.values()):
        values[index] = files[place.file].values[place.row]
    return values


def _resolve_names(files: Sequence[Features], trials: TrialList) -> tuple[dict[str, _Row], list[str]]:
    names = TrialNames(trials.trial_ids)
    found: dict[str, _Row] = {}
    unmatched = []
    for place, name in _list_rows(files):
        resolution = names.resolve(name)
        if not isinstance(resolution, Resolved):
            unmatched.append(name)
        elif (trial_id := resolution.trial_id) in found:
            first = files[found[trial_id].file]
            other = f"{quote(first.trial_ids[found[trial_id].row])} in {first.origin.name}"
            message = (
                f"{other} and {quote(name)} in {files[place.file].origin.name} both mean trial {trial_id}"
            )
            raise SourceError(message, "give its features once")
        else:
            found[trial_id] = place
    return found, unmatched


def _list_rows(files: Sequence[Features]) -> Iterator[tuple[_Row, str]]:
    for number, file in enumerate(files):
        for row, name in enumerate(file.trial_ids):
            yield _Row(number, row), name
