"""Whether as many trials end in YES as in NO."""

from leaderboard.models.benchmark import Property
from leaderboard.problems import Problems
from leaderboard.reference.checking.datasheet import Row, Section, make_row
from leaderboard.reference.checking.places import file_of
from leaderboard.reference.data import Booleans, Reference


def check_balance(reference: Reference) -> Section:
    """Count YES in properties and scenarios; a property with one scenario is counted once."""
    rows: list[Row] = []
    for property_ in reference.benchmark.properties:
        scenarios = reference.benchmark.scenarios_of(property_.name)
        parts = {scenario.id: reference.in_scenario(scenario.id) for scenario in scenarios}
        if len(scenarios) > 1:
            parts = {property_.name: reference.in_property(property_.name)} | parts
        rows += [_check_part(reference, property_, name, mask) for name, mask in parts.items()]
    return Section("Balance", tuple(rows))


def _check_part(reference: Reference, property_: Property, name: str, mask: Booleans) -> Row:
    n_trials, n_yes = int(mask.sum()), int(reference.labels[mask].sum())
    problems = Problems()
    if 2 * n_yes != n_trials:
        message = f"{n_yes} of {n_trials} trials of {name} end in YES, not half of them"
        problems.add("reference-imbalance", message, file_of(property_))
    found = f"{n_yes} of {n_trials} trials"
    return make_row(f"{name} ends in YES", found, expected="half", problems=problems)
