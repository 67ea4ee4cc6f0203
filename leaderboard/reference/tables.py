"""Reading the reference's tables: the definition, the trial lists and human data, with all their problems."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from leaderboard.ids import find_nearest
from leaderboard.instance import (
    BENCHMARK_FILE,
    ERRATA_FILE,
    HUMAN_RESPONSES_FILE,
    HUMAN_TRIALS_FILE,
    PUBLISHED_FILE,
    Instance,
)
from leaderboard.models import Benchmark, Errata, Manifest, Property
from leaderboard.problems import Problems
from leaderboard.reference.cells import (
    FIRST_LINE,
    Table,
    parse_binary,
    parse_counts,
    parse_ids,
    parse_table,
    quote,
)
from leaderboard.reference.data import Integers, People, Reference
from leaderboard.reference.definition import parse_errata, read_benchmark, read_reference_file, shown
from leaderboard.reference.dropping import drop_trials
from leaderboard.reference.people import RATING_HEADER, RESPONSE_HEADER, parse_people

TRIAL_HEADER = ("trial_id", "pair_id", "scenario", "copy", "label", "start_frame")
OPTIONAL_FILES = (HUMAN_TRIALS_FILE, HUMAN_RESPONSES_FILE, PUBLISHED_FILE, ERRATA_FILE)


@dataclass(frozen=True)
class TrialList:
    """Trials in the order of their files; the fields are those of `Reference`, pairs as texts."""

    trial_ids: tuple[str, ...]
    pair_ids: tuple[str, ...]
    scenarios: Integers
    copies: Integers
    labels: Integers
    start_frames: Integers


@dataclass(frozen=True)
class Tables:
    """All of a reference but its seal.

    Attributes
    ----------
    contents
        The bytes of each file, by name.
    trial_lists
        One for each property; None if any of them cannot be understood.
    people
        None if there are no human data or they cannot be understood.
    errata
        None if they cannot be understood; empty if there are none.
    is_whole
        Whether everything that is there was understood.
    """

    benchmark: Benchmark
    contents: Mapping[str, bytes]
    trial_lists: tuple[TrialList, ...] | None
    people: People | None
    errata: Errata | None
    is_whole: bool

    def bind(self, manifest: Manifest) -> Reference:
        """Put tables and seal together, and drop what errata say; only where everything was understood."""
        if not self.is_whole or self.trial_lists is None or self.errata is None:
            raise ValueError("a reference with unreadable tables cannot be put together")
        lists = self.trial_lists
        pair_names = [pair_id for trials in lists for pair_id in trials.pair_ids]
        pair_index = {pair_id: index for index, pair_id in enumerate(dict.fromkeys(pair_names))}
        listed = Reference(
            benchmark=self.benchmark,
            manifest=manifest,
            trial_ids=tuple(trial_id for trials in lists for trial_id in trials.trial_ids),
            pair_ids=tuple(pair_index),
            properties=np.repeat(np.arange(len(lists)), [len(trials.trial_ids) for trials in lists]),
            scenarios=np.concatenate([trials.scenarios for trials in lists]),
            pairs=np.array([pair_index[pair_id] for pair_id in pair_names]),
            copies=np.concatenate([trials.copies for trials in lists]),
            labels=np.concatenate([trials.labels for trials in lists]),
            people=self.people,
            start_frames=np.concatenate([trials.start_frames for trials in lists]),
            errata=self.errata,
        )
        return drop_trials(listed, self.errata.reasons)


def read_tables(instance: Instance, *, with_responses: bool = True) -> tuple[Tables | None, Problems]:
    """Read all of a reference but its seal, and collect every problem.

    ``with_responses=False`` reads the file of single responses without understanding it.

    Returns
    -------
    Tables or None
        None if the definition itself cannot be used.
    Problems
        Each is an error that makes grading impossible or untrue.
    """
    problems = Problems()
    definition = read_benchmark(instance, problems)
    if definition is None:
        return None, problems
    content, benchmark = definition
    contents = {BENCHMARK_FILE: content} | _read_contents(instance, benchmark, problems)
    return parse_tables(benchmark, contents, problems, with_responses=with_responses), problems


def parse_tables(
    benchmark: Benchmark,
    contents: Mapping[str, bytes],
    problems: Problems,
    *,
    with_responses: bool = True,
) -> Tables:
    """Understand the files of a reference; ``problems`` says what could not be."""
    headers: dict[str, tuple[str, ...]] = {property_.file: TRIAL_HEADER for property_ in benchmark.properties}
    headers[HUMAN_TRIALS_FILE] = RATING_HEADER
    if with_responses:
        headers[HUMAN_RESPONSES_FILE] = RESPONSE_HEADER
    tables = {
        name: parse_table(contents[name], header, shown(name), problems)
        for name, header in headers.items()
        if name in contents
    }
    trial_lists = _parse_trial_lists(benchmark, tables, problems)
    people = None
    if trial_lists is not None:
        trial_ids = (trial_id for trials in trial_lists for trial_id in trials.trial_ids)
        trial_index = {trial_id: index for index, trial_id in enumerate(trial_ids)}
        people = parse_people(
            tables.get(HUMAN_TRIALS_FILE), tables.get(HUMAN_RESPONSES_FILE), trial_index, problems
        )
    has_people = HUMAN_TRIALS_FILE in contents or HUMAN_RESPONSES_FILE in contents
    errata = _parse_errata(benchmark, contents, trial_lists, problems)
    is_whole = trial_lists is not None and (people is not None or not has_people) and errata is not None
    return Tables(benchmark, contents, trial_lists, people, errata, is_whole)


def _parse_errata(
    benchmark: Benchmark,
    contents: Mapping[str, bytes],
    trial_lists: Sequence[TrialList] | None,
    problems: Problems,
) -> Errata | None:
    """Understand the errata if there are any; they may not leave a property without trials."""
    errata = parse_errata(contents.get(ERRATA_FILE, b""), problems)
    if errata is None or trial_lists is None:
        return errata
    emptied = [
        property_.name
        for property_, trials in zip(benchmark.properties, trial_lists, strict=True)
        if errata.reasons.keys() >= set(trials.trial_ids)
    ]
    for name in emptied:
        problems.add("reference-errata", f"drops every trial of {name}", shown(ERRATA_FILE))
    return None if emptied else errata


def _read_contents(instance: Instance, benchmark: Benchmark, problems: Problems) -> dict[str, bytes]:
    names = [property_.file for property_ in benchmark.properties]
    names += [name for name in OPTIONAL_FILES if os.path.lexists(instance.reference_file(name))]
    if HUMAN_RESPONSES_FILE in names and HUMAN_TRIALS_FILE not in names:
        names.append(HUMAN_TRIALS_FILE)
    contents = {name: read_reference_file(instance, name, problems) for name in names}
    return {name: content for name, content in contents.items() if content is not None}


def _parse_trial_lists(
    benchmark: Benchmark, tables: Mapping[str, Table | None], problems: Problems
) -> tuple[TrialList, ...] | None:
    lists = []
    lines: dict[str, str] = {}
    for property_ in benchmark.properties:
        table = tables.get(property_.file)
        if table is None:
            continue
        trials = _parse_trial_list(table, property_, benchmark, problems)
        if _are_new(table, lines, problems) and trials is not None:
            lists.append(trials)
    return tuple(lists) if len(lists) == len(benchmark.properties) else None


def _parse_trial_list(
    table: Table, property_: Property, benchmark: Benchmark, problems: Problems
) -> TrialList | None:
    trial_ids = parse_ids(table, "trial_id", problems)
    pair_ids = parse_ids(table, "pair_id", problems)
    scenarios = _parse_scenarios(table, property_, benchmark, problems)
    copies = parse_binary(table, "copy", problems)
    labels = parse_binary(table, "label", problems)
    start_frames = parse_counts(table, "start_frame", problems, may_be_empty=True)
    if trial_ids is None or pair_ids is None or scenarios is None:
        return None
    if copies is None or labels is None or start_frames is None:
        return None
    return TrialList(trial_ids, pair_ids, scenarios, copies, labels, start_frames)


def _parse_scenarios(
    table: Table, property_: Property, benchmark: Benchmark, problems: Problems
) -> Integers | None:
    own = {s.id: index for index, s in enumerate(benchmark.scenarios) if s.property == property_.name}
    cells = table["scenario"]
    if not set(cells) <= own.keys():
        others = {scenario.id: scenario.property for scenario in benchmark.scenarios}
        for line, cell in enumerate(cells, FIRST_LINE):
            if cell not in own:
                message = f"scenario is {quote(cell)}; {_say_foreign(cell, property_, own, others)}"
                problems.add("reference-scenario", message, table.file, line=line)
        return None
    return np.array([own[cell] for cell in cells])


def _say_foreign(cell: str, property_: Property, own: Mapping[str, int], others: Mapping[str, str]) -> str:
    if cell in others:
        return f"that belongs to {others[cell]}, and this file is {property_.name}'s"
    nearest = find_nearest(cell, own)
    rule = f"{BENCHMARK_FILE} defines no such scenario"
    return f"{rule}, the nearest is {nearest}" if nearest else rule


def _are_new(table: Table, lines: dict[str, str], problems: Problems) -> bool:
    """Tell whether no trial was listed before, and remember where these are."""
    are_new = True
    for line, trial_id in enumerate(table["trial_id"], FIRST_LINE):
        earlier = lines.setdefault(trial_id, f"{table.file}:{line}")
        if earlier != f"{table.file}:{line}":
            are_new = False
            message = f"the trial {quote(trial_id)} is listed already in {earlier}"
            problems.add("reference-duplicate", message, table.file, line=line)
    return are_new
