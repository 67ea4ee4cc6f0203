"""How many trials there are, and what their lists say of each."""

import numpy as np

from leaderboard.models.benchmark import Property, Scenario
from leaderboard.problems import Problems
from leaderboard.reference.checking.datasheet import Row, Section, make_row
from leaderboard.reference.checking.places import count_dropped, file_of, mention_dropped
from leaderboard.reference.data import Reference


def check_counts(reference: Reference) -> Section:
    """Compare the numbers of trials with those of the definition; trials that errata drop count as there."""
    rows = []
    for property_ in reference.benchmark.properties:
        rows.append(_check_property(reference, property_))
        own = reference.benchmark.scenarios_of(property_.name)
        rows += [_check_scenario(reference, property_, scenario) for scenario in own]
    # A list that holds a trial twice cannot be loaded at all, so there is nothing left to find.
    rows.append(make_row("Trials listed twice", "none", expected="none"))
    rows.append(make_row("Start frames", _describe_frames(reference)))
    return Section("Trials", tuple(rows))


def _check_property(reference: Reference, property_: Property) -> Row:
    n_dropped = count_dropped(reference, property_=property_.name)
    n_listed = int(reference.in_property(property_.name).sum()) + n_dropped
    return _compare(property_.name, (n_listed, n_dropped), property_.trials, str(property_.trials), property_)


def _check_scenario(reference: Reference, property_: Property, scenario: Scenario) -> Row:
    n_dropped = count_dropped(reference, scenario=scenario.id)
    n_listed = int(reference.in_scenario(scenario.id).sum()) + n_dropped
    expected = scenario.trials if scenario.trials is not None else max(n_listed, 1)
    stated = "at least 1" if scenario.trials is None else str(expected)
    return _compare(scenario.id, (n_listed, n_dropped), expected, stated, property_)


def _compare(name: str, counts: tuple[int, int], expected: int, stated: str, property_: Property) -> Row:
    n_listed, n_dropped = counts
    problems = Problems()
    if n_listed != expected:
        message = f"{name} has {n_listed} trials, not the {expected} expected"
        problems.add("reference-trial-count", message, file_of(property_))
    found = f"{n_listed}{mention_dropped(n_dropped)}"
    return make_row(f"Trials of {name}", found, expected=stated, problems=problems)


def _describe_frames(reference: Reference) -> str:
    if reference.start_frames is None:
        return "not read"
    given = reference.start_frames[reference.start_frames >= 0]
    if not given.size:
        return "not given"
    share = "all" if given.size == reference.n_trials else f"{given.size} of"
    frames = " to ".join(str(frame) for frame in np.unique([given.min(), given.max()]))
    return f"given for {share} {reference.n_trials} trials: {frames}"
