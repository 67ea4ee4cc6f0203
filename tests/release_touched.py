"""Whom or what each trap befell, so that a test can ask for the finding that names it."""

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass

from release_lists import (
    ListDialect,
    contradicted_trial,
    readout_trials,
    repeated_trial,
    unknown_trials,
)
from release_people import (
    PeopleDialect,
    befallen,
    game_of,
    practice_names,
    practised_trials,
    private_columns,
    service_columns,
    unknown_name,
)
from release_traps import Layout, Trap
from release_trials import Answer, Sitting, Trial, missing_trial, pairs_of


@dataclass(frozen=True)
class Making:
    """Everything that a release is made of."""

    trials: Sequence[Trial]
    sittings: Sequence[Sitting]
    lists: ListDialect
    people: PeopleDialect
    pairs_per_scenario: int | None

    @property
    def properties(self) -> list[str]:
        """The properties in their order."""
        return list(dict.fromkeys(trial.property_name for trial in self.trials))

    def person(self, index: int) -> list[str]:
        """Name the person with this number of each property."""
        return [
            [sitting.person for sitting in self.sittings if sitting.property_name == property_][index]
            for property_ in self.properties
        ]

    def of_property(self, property_: str) -> list[Trial]:
        """List the trials of a property."""
        return [trial for trial in self.trials if trial.property_name == property_]


def lost_answers(sittings: Sequence[Sitting], traps: Collection[Trap]) -> set[Answer]:
    """Return the answers that no file tells."""
    return set(befallen(sittings, Trap.EMPTY_RESPONSES)) if Trap.EMPTY_RESPONSES in traps else set()


def touched_by(making: Making) -> dict[Trap, tuple[str, ...]]:
    """Name what each trap befell, in the terms that the trap's comment says."""
    return {
        trap: tuple(_TOUCHED[trap](making)) if trap in _TOUCHED else ()
        for trap in Trap
        if trap in making.people.traps
    }


def secrets_of(making: Making) -> frozenset[str]:
    """Return the texts about people that stand in the files and must stay there."""
    if making.people.layout is Layout.AGGREGATED:
        return frozenset()
    secrets: set[str] = set()
    for person, _, _ in making.sittings:
        secrets.add(person)
        if making.people.layout is Layout.LONG:
            secrets.add(game_of(person, making.people.seed))
        if Trap.SERVICE_IDS in making.people.traps and making.people.layout is not Layout.BY_TRIAL:
            secrets |= set(service_columns(person, making.people.seed).values())
        if Trap.PRIVATE_COLUMNS in making.people.traps:
            private = private_columns(person, making.people.seed)
            secrets |= {private["comments"], private["ip_address"]}
    return frozenset(secrets)


def _same_label_pairs(making: Making) -> list[str]:
    pairs = [pair for pair in pairs_of(making.trials) if len(pair) == 2]
    return [pair[0].pair_id for pair in pairs if pair[0].label == pair[1].label]


def _readout_ids(making: Making) -> list[str]:
    own = (readout_trials(making.of_property(name), making.people.seed) for name in making.properties)
    return [trial.trial_id for trials in own for trial in trials]


def _answers(trap: Trap) -> Callable[[Making], list[str]]:
    return lambda making: [f"{person} {trial_id}" for person, trial_id, _ in befallen(making.sittings, trap)]


def _names_used(making: Making) -> list[str]:
    return list(dict.fromkeys(trial.pair_id for trial in making.trials))


_TOUCHED: dict[Trap, Callable[[Making], Sequence[str]]] = {
    Trap.SAME_LABEL_PAIRS: _same_label_pairs,
    Trap.REPEATED_ROW: lambda m: [repeated_trial(m.trials).trial_id],
    Trap.CONTRADICTORY_ROW: lambda m: [contradicted_trial(m.trials).trial_id],
    Trap.SPLIT_LIST: lambda m: m.lists.split_names(),
    Trap.READOUT_LIST: _readout_ids,
    Trap.MISSING_TRIAL: lambda m: [missing_trial(m.people.seed, m.pairs_per_scenario, m.people.traps)],
    Trap.UNKNOWN_SCENARIO: lambda m: [trial.trial_id for trial in unknown_trials(m.trials)],
    Trap.PRACTICE_TRIALS: lambda m: [name for each in m.properties for name in practice_names(each)],
    Trap.PRACTICE_ON_TEST_TRIALS: lambda m: [t.trial_id for t in practised_trials(m.sittings, m.trials)],
    Trap.EMPTY_RESPONSES: _answers(Trap.EMPTY_RESPONSES),
    Trap.CONTRADICTED_RESPONSES: _answers(Trap.CONTRADICTED_RESPONSES),
    Trap.DISAGREEING_LABELS: lambda m: [a.trial_id for a in befallen(m.sittings, Trap.DISAGREEING_LABELS)],
    Trap.DUPLICATE_ANSWERS: _answers(Trap.DUPLICATE_ANSWERS),
    Trap.CHANGED_ANSWERS: _answers(Trap.CHANGED_ANSWERS),
    Trap.UNKNOWN_TRIALS: lambda m: [unknown_name(a) for a in befallen(m.sittings, Trap.UNKNOWN_TRIALS)],
    Trap.NAMES_WITHOUT_COPY: _names_used,
    Trap.STREAK_RATERS: lambda m: m.person(0),
    Trap.ALTERNATING_RATERS: lambda m: m.person(1),
    Trap.BOTH_MEMBERS: lambda m: m.person(2),
}
