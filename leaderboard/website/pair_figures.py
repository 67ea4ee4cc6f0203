"""Pairs of a submission, drawn: how many of the two trials are right, and whether they are told apart."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from leaderboard.metrics.accuracy import Booleans
from leaderboard.metrics.pairs import find_opposite_pairs, find_pairs
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Entry
from leaderboard.reference import Reference
from leaderboard.website.describing import answers_of, count_of, warn_of_simulation
from leaderboard.website.figures.marks import Drawing
from leaderboard.website.figures.stacks import Stack, StackRow, draw_stack
from leaderboard.website.material import Material
from leaderboard.website.score_tables import list_scopes

RIGHT = "How many of the two trials of a pair were answered rightly."
APART = "Of the two trials of a pair that end differently: whether YES has the higher probability."
RIGHTS = ("both", "one", "none", "at 0.5")
ORDERS = ("right", "equal", "wrong")
HALF_CREDIT = 0.5

Masked = Sequence[tuple[str, int, Booleans]]


def draw_pairs(entry: Entry, material: Material) -> Iterator[Drawing]:
    """Draw pairs, if there are any, by how many of the two are right and by whether they are told apart."""
    reference = material.reference
    scopes = list(_list_masks(entry, reference))
    right = Stack("pairs-right", "Pairs", RIGHT, "pairs", RIGHTS, _count_right(entry, reference, scopes))
    apart = Stack(
        "pairs-apart", "Told apart", APART, "pairs", ORDERS, _count_orders(entry, reference, scopes)
    )
    for stack in (_leave_out_halves(right), apart):
        if stack.rows and any(stack.rows[0].sizes):
            first = stack.rows[0]
            caption = f"{stack.caption} {first.title}: {count_of(sum(first.sizes), 'pair')}."
            yield draw_stack(replace(stack, caption=caption, warning=warn_of_simulation(material)))


def _list_masks(entry: Entry, reference: Reference) -> Iterator[tuple[str, int, Booleans]]:
    """List overall and the properties that were graded, or the scenarios of one that was not as a whole."""
    benchmark = reference.benchmark
    properties = {scenario.id: scenario.property for scenario in benchmark.scenarios}
    for scope, title, level in list_scopes(entry, benchmark, "all"):
        if scope not in entry.result.scores or properties.get(scope) in entry.result.scores:
            continue
        yield title, min(level, 1), mask_of(reference, scope)


def mask_of(reference: Reference, scope: str) -> Booleans:
    """Find the trials of overall, a property or a scenario; (n_trials,)."""
    if scope == OVERALL:
        return np.ones(reference.n_trials, bool)
    is_scenario = any(scenario.id == scope for scenario in reference.benchmark.scenarios)
    return reference.in_scenario(scope) if is_scenario else reference.in_property(scope)


def _count_right(entry: Entry, reference: Reference, scopes: Masked) -> tuple[StackRow, ...]:
    rows = []
    for title, level, mask in scopes:
        credits = np.sort(entry.credits[mask][find_pairs(reference.pairs[mask])], axis=1)
        sizes = [int((credits == wanted).all(axis=1).sum()) for wanted in ([1, 1], [0, 1], [0, 0])]
        halves = int((credits == HALF_CREDIT).any(axis=1).sum())
        rows.append(StackRow(title, level, (*sizes, halves)))
    return tuple(rows)


def _leave_out_halves(stack: Stack) -> Stack:
    """Leave out the column of undecided pairs where there are none, as in most submissions."""
    if any(row.sizes[-1] for row in stack.rows):
        return stack
    rows = tuple(replace(row, sizes=row.sizes[:-1]) for row in stack.rows)
    return replace(stack, parts=stack.parts[:-1], rows=rows)


def _count_orders(entry: Entry, reference: Reference, scopes: Masked) -> tuple[StackRow, ...]:
    answers, rows = answers_of(entry), []
    for title, level, mask in scopes:
        members = answers[mask][find_opposite_pairs(reference.pairs[mask], reference.labels[mask])]
        order = np.sign(members[:, 0] - members[:, 1])
        rows.append(StackRow(title, level, tuple(int((order == sign).sum()) for sign in (1, 0, -1))))
    return tuple(rows)
