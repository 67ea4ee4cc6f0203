"""How people were asked, read off their answers: who saw which trials, and whether that was to be."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from leaderboard.instance import HUMAN_RESPONSES_FILE
from leaderboard.problems import Problems
from leaderboard.reference.checking.datasheet import Row, Section, make_row
from leaderboard.reference.checking.ratings import describe_spread
from leaderboard.reference.data import Reference, Responses
from leaderboard.reference.definition import shown

FILE = shown(HUMAN_RESPONSES_FILE)

Sittings = Mapping[str, frozenset[str]]


@dataclass(frozen=True)
class TrialSets:
    """The different sets of trials that people saw.

    Attributes
    ----------
    n_trials, n_people
        Of each set.
    n_shared
        Trials that are in more than one of them.
    """

    n_trials: tuple[int, ...]
    n_people: tuple[int, ...]
    n_shared: int

    def __len__(self) -> int:
        """Count the sets."""
        return len(self.n_trials)


def check_design(reference: Reference, responses: Responses) -> Section:
    """Compare with the definition who saw what; trials that errata drop count as seen."""
    rows = []
    everybody = [_find_sittings(reference, responses, i) for i in range(len(reference.benchmark.properties))]
    for property_, sittings in zip(reference.benchmark.properties, everybody, strict=True):
        rows.append(_check_people(reference, property_.name, sittings))
        if sittings:
            rows.append(_check_sizes(reference, property_.name, sittings))
            rows.append(_check_sets(reference, property_.name, sittings))
    rows.append(_check_pairs(reference, responses))
    rows.append(make_row("People who judged several properties", _count_wanderers(everybody)))
    return Section("Design", tuple(rows))


def find_trial_sets(sittings: Sittings) -> TrialSets:
    """Tell the different sets of trials apart, in the order of their first person."""
    n_people: dict[frozenset[str], int] = {}
    for seen in sittings.values():
        n_people[seen] = n_people.get(seen, 0) + 1
    n_trials = tuple(len(seen) for seen in n_people)
    union = frozenset().union(*n_people)
    n_shared = sum(sum(trial_id in seen for seen in n_people) > 1 for trial_id in union)
    return TrialSets(n_trials, tuple(n_people.values()), n_shared)


def _find_sittings(reference: Reference, responses: Responses, index: int) -> Sittings:
    """Which trials of a property each person judged who judged any."""
    seen: dict[str, set[str]] = {}
    chosen = reference.properties[responses.trials] == index
    pairs = zip(responses.participants[chosen].tolist(), responses.trials[chosen].tolist(), strict=True)
    for person, trial in pairs:
        seen.setdefault(responses.participant_ids[person], set()).add(reference.trial_ids[trial])
    for dropped in reference.dropped_trials:
        if dropped.property_index == index:
            for name in dropped.participant_ids:
                seen.setdefault(name, set()).add(dropped.trial_id)
    return {name: frozenset(seen[name]) for name in sorted(seen)}


def _check_people(reference: Reference, name: str, sittings: Sittings) -> Row:
    expected = reference.benchmark.people.per_property
    problems = Problems()
    if expected is not None and len(sittings) != expected:
        message = f"{len(sittings)} people judged trials of {name}, not the {expected} expected"
        problems.add("reference-people-count", message, FILE)
    return make_row(f"People of {name}", str(len(sittings)), expected=_state(expected), problems=problems)


def _check_sizes(reference: Reference, name: str, sittings: Sittings) -> Row:
    expected = reference.benchmark.people.trials_per_person
    problems = Problems()
    others = {} if expected is None else {p: len(s) for p, s in sittings.items() if len(s) != expected}
    if others:
        person, count = next(iter(others.items()))
        message = (
            f"{len(others)} of the {len(sittings)} people of {name} judged another number of trials than the "
            f"{expected} expected, for instance {person}: {count}"
        )
        problems.add("reference-trials-per-person", message, FILE)
    found = describe_spread(np.array([len(seen) for seen in sittings.values()]))
    return make_row(f"Trials per person of {name}", found, expected=_state(expected), problems=problems)


def _check_sets(reference: Reference, name: str, sittings: Sittings) -> Row:
    expected = reference.benchmark.people.sets
    sets = find_trial_sets(sittings)
    problems = Problems()
    if expected is not None and len(sets) != expected:
        message = (
            f"the people of {name} saw {len(sets)} different sets of trials, not the {expected} expected"
        )
        problems.add("reference-sets", message, FILE)
    elif expected is not None and sets.n_shared:
        message = f"the sets of trials of {name} overlap (trials in several: {sets.n_shared})"
        problems.add("reference-sets", message, FILE)
    stated = "" if expected is None else f"{expected} disjoint"
    return make_row(f"Sets of trials of {name}", _describe_sets(sets), expected=stated, problems=problems)


def _describe_sets(sets: TrialSets) -> str:
    overlap = f"overlapping (trials in several: {sets.n_shared})" if sets.n_shared else "disjoint"
    trials, people = describe_spread(np.array(sets.n_trials)), describe_spread(np.array(sets.n_people))
    return f"{len(sets)}, {overlap}; trials in each: {trials}; people for each: {people}"


def _check_pairs(reference: Reference, responses: Responses) -> Row:
    """Report people who saw more than one trial of a pair."""
    seen = np.column_stack([responses.participants, reference.pairs[responses.trials]])
    persons_and_pairs, counts = np.unique(seen, axis=0, return_counts=True)
    repeated = persons_and_pairs[counts > 1]
    n_people = len(np.unique(repeated[:, 0]))
    problems = Problems()
    if n_people:
        person, pair = repeated[0]
        message = (
            f"{_count_people(n_people)} saw both trials of a pair, "
            f"for instance {responses.participant_ids[person]} of {reference.pair_ids[pair]}"
        )
        problems.add("reference-both-members", message, FILE)
    found = _count_people(n_people) if n_people else "nobody"
    return make_row("Who saw both trials of a pair", found, expected="nobody", problems=problems)


def _count_wanderers(everybody: Sequence[Sittings]) -> str:
    names = [name for sittings in everybody for name in sittings]
    return str(len({name for name in names if names.count(name) > 1}))


def _count_people(count: int) -> str:
    return f"{count} {'person' if count == 1 else 'people'}"


def _state(expected: int | None) -> str:
    return "" if expected is None else str(expected)
