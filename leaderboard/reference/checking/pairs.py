"""Whether pairs are pairs: two trials of one scenario, copies 0 and 1, that end differently."""

from collections import Counter
from collections.abc import Callable

import numpy as np

from leaderboard.metrics.pairs import find_pairs
from leaderboard.models.benchmark import Property
from leaderboard.problems import Problems
from leaderboard.reference.checking.datasheet import Row, Section, make_row
from leaderboard.reference.checking.places import file_of, place_of
from leaderboard.reference.data import Integers, Reference

EVERY_PAIR = "every pair"
_N_MEMBERS = 2

Judge = Callable[[Reference, int, int], str]


def check_pairs(reference: Reference) -> Section:
    """Judge all pairs; the partner of a dropped trial stands alone, and nothing is wrong with that."""
    rules: tuple[tuple[str, str, Judge], ...] = (
        ("Both trials are in one scenario", "reference-split-pair", _judge_scenarios),
        ("Both trials end differently", "reference-equal-labels", _judge_labels),
        ("One trial is copy 0, one copy 1", "reference-copies", _judge_copies),
    )
    members = find_pairs(reference.pairs).tolist()
    rows = [_check_sizes(reference), *(_check_rule(reference, members, *rule) for rule in rules)]
    return Section("Pairs", tuple(rows))


def _check_sizes(reference: Reference) -> Row:
    sizes = _listed_sizes(reference)
    problems = Problems()
    paired: set[int] = set()
    for index, property_ in enumerate(reference.benchmark.properties):
        own = np.unique(reference.pairs[reference.properties == index])
        if (sizes[own] == 1).all():
            _report_unpaired(property_, problems)
            continue
        paired.update(own.tolist())
        for pair in own[sizes[own] != _N_MEMBERS].tolist():
            _report_size(reference, pair, int(sizes[pair]), index, problems)
    n_right = sum(int(sizes[pair] == _N_MEMBERS) for pair in paired)
    found = f"{n_right} of {len(paired)} pairs" if paired else "no pairs"
    found += _mention_lone(reference, sizes)
    return make_row("A pair has two trials", found, expected=EVERY_PAIR, problems=problems)


def _listed_sizes(reference: Reference) -> Integers:
    """Count the trials of each pair, dropped ones too."""
    dropped = Counter(trial.pair_id for trial in reference.dropped_trials)
    sizes = np.bincount(reference.pairs, minlength=len(reference.pair_ids))
    return sizes + np.array([dropped[pair_id] for pair_id in reference.pair_ids], np.int64)


def _mention_lone(reference: Reference, sizes: Integers) -> str:
    """Say how many pairs of two have lost a trial."""
    n_lone = int(((np.bincount(reference.pairs) == 1) & (sizes == _N_MEMBERS)).sum())
    return f", {n_lone} of them less a dropped trial" if n_lone else ""


def _report_unpaired(property_: Property, problems: Problems) -> None:
    message = f"{property_.name} has no pairs: each trial has a pair id of its own"
    problems.add("reference-no-pairs", message, file_of(property_))


def _report_size(reference: Reference, pair: int, size: int, index: int, problems: Problems) -> None:
    """Report a pair of another size than two, once, at its first trial."""
    trial = int(np.argmax(reference.pairs == pair))
    if reference.properties[trial] == index:
        message = f"the pair {reference.pair_ids[pair]} has {size} trial{'s' if size > 1 else ''}, not two"
        file, line = place_of(reference, trial)
        problems.add("reference-incomplete-pair", message, file, line=line)


def _check_rule(
    reference: Reference, members: list[list[int]], assumption: str, code: str, judge: Judge
) -> Row:
    problems = Problems()
    for first, second in members:
        message = judge(reference, first, second)
        if message:
            file, line = place_of(reference, second)
            problems.add(code, message, file, line=line)
    found = f"{len(members) - len(problems)} of {len(members)} pairs" if members else "no pairs"
    return make_row(assumption, found, expected=EVERY_PAIR, problems=problems)


def _judge_scenarios(reference: Reference, first: int, second: int) -> str:
    if reference.scenarios[first] == reference.scenarios[second]:
        return ""
    names = [reference.benchmark.scenarios[reference.scenarios[trial]].id for trial in (first, second)]
    pair_id = _pair_of(reference, first)
    return f"the trials of the pair {pair_id} are in different scenarios, {names[0]} and {names[1]}"


def _judge_labels(reference: Reference, first: int, second: int) -> str:
    if reference.labels[first] != reference.labels[second]:
        return ""
    answer = "YES" if reference.labels[first] else "NO"
    return (
        f"both trials of the pair {_pair_of(reference, first)} end in {answer}; they should end differently"
    )


def _judge_copies(reference: Reference, first: int, second: int) -> str:
    copy = reference.copies[first]
    if copy != reference.copies[second]:
        return ""
    pair_id = _pair_of(reference, first)
    return f"both trials of the pair {pair_id} are copy {copy}; they should be copy 0 and copy 1"


def _pair_of(reference: Reference, trial: int) -> str:
    return reference.pair_ids[int(reference.pairs[trial])]
