"""Whether a reference is what its definition expects: every departure as a finding."""

import re

import numpy as np

from leaderboard.instance import HUMAN_RESPONSES_FILE, HUMAN_TRIALS_FILE, MANIFEST_FILE, Instance
from leaderboard.metrics.pairs import find_pairs
from leaderboard.models import Benchmark, Manifest
from leaderboard.problems import Problem, Problems
from leaderboard.reference.cells import FIRST_LINE, quote
from leaderboard.reference.data import Booleans, Reference, Responses
from leaderboard.reference.definition import read_manifest, sealed_names, shown
from leaderboard.reference.sealing import check_seal, digest_of
from leaderboard.reference.tables import read_tables

SYNTHETIC_WORD = "synthetic"

_OPAQUE = re.compile(r"p[0-9]+")
_N_MEMBERS = 2
# Stands in for a missing manifest, so that content can be checked before it is sealed.
_UNSEALED = Manifest(kind="official", files={}, digest=digest_of({}))


def check_reference(instance: Instance) -> tuple[Problem, ...]:
    """Report everything about a reference that is wrong or not as its definition expects.

    Errors are what `leaderboard.reference.load_reference` refuses; warnings depart from the definition;
    notes are facts that a reader of the scores should know. Where tables cannot be understood, only that is
    reported.
    """
    tables, problems = read_tables(instance)
    manifest = read_manifest(instance, problems)
    if tables is None:
        return tuple(problems)
    if manifest is not None:
        check_seal(tables.contents, manifest, problems)
    _check_strays(instance, tables.benchmark, problems)
    if tables.is_whole:
        reference = tables.bind(manifest or _UNSEALED)
        if manifest is not None:
            _check_kind(reference, problems)
        check_departures(reference, problems)
    return tuple(problems)


def check_departures(reference: Reference, problems: Problems) -> None:
    """Report where the content of a reference that can be used differs from what is expected of one."""
    _check_counts(reference, problems)
    _check_pairs(reference, problems)
    _check_balance(reference, problems)
    _check_ratings(reference, problems)
    if reference.people is not None and reference.people.responses is not None:
        _check_participants(reference.people.responses, problems)
        _check_design(reference, reference.people.responses, problems)


def _check_strays(instance: Instance, benchmark: Benchmark, problems: Problems) -> None:
    known = {*sealed_names(benchmark), MANIFEST_FILE}
    for name in sorted(path.name for path in instance.reference_dir.iterdir()):
        if name not in known and not name.startswith("."):
            message = "is no part of a reference, and is not sealed"
            problems.add("reference-stray-file", message, shown(quote(name)[1:-1]), hint="move it elsewhere")


def _check_kind(reference: Reference, problems: Problems) -> None:
    n_named = sum(SYNTHETIC_WORD in trial_id for trial_id in reference.trial_ids)
    if n_named != (reference.n_trials if reference.is_synthetic else 0):
        named = f"{n_named} of {reference.n_trials} trial ids hold the word {SYNTHETIC_WORD}"
        message = f"the kind is {reference.manifest.kind}, but {named}"
        problems.add("reference-kind", message, shown(MANIFEST_FILE))


def _check_counts(reference: Reference, problems: Problems) -> None:
    benchmark = reference.benchmark
    for property_ in benchmark.properties:
        file = shown(property_.file)
        found = int(reference.in_property(property_.name).sum())
        if found != property_.trials:
            message = f"{property_.name} has {found} trials, not the {property_.trials} expected"
            problems.add("reference-trial-count", message, file)
        for scenario in benchmark.scenarios_of(property_.name):
            found = int(reference.in_scenario(scenario.id).sum())
            expected = scenario.trials if scenario.trials is not None else max(found, 1)
            if found != expected:
                message = f"{scenario.id} has {found} trials, not the {expected} expected"
                problems.add("reference-trial-count", message, file)


def _check_pairs(reference: Reference, problems: Problems) -> None:
    sizes = np.bincount(reference.pairs)
    for index, property_ in enumerate(reference.benchmark.properties):
        own = sizes[reference.pairs[reference.properties == index]]
        if (own == 1).all():
            message = f"{property_.name} has no pairs: each trial has a pair id of its own"
            problems.add("reference-no-pairs", message, shown(property_.file))
            continue
        for trial in np.flatnonzero((sizes[reference.pairs] != _N_MEMBERS) & (reference.properties == index)):
            _report_size(reference, int(trial), int(sizes[reference.pairs[trial]]), problems)
    for first, second in find_pairs(reference.pairs).tolist():
        _check_pair(reference, first, second, problems)


def _report_size(reference: Reference, trial: int, size: int, problems: Problems) -> None:
    """Report a pair of another size than two, once, at its first trial."""
    pair = reference.pairs[trial]
    if trial == int(np.argmax(reference.pairs == pair)):
        message = f"the pair {reference.pair_ids[pair]} has {size} trial{'s' if size > 1 else ''}, not two"
        file, line = _place_of(reference, trial)
        problems.add("reference-incomplete-pair", message, file, line=line)


def _check_pair(reference: Reference, first: int, second: int, problems: Problems) -> None:
    pair_id = reference.pair_ids[reference.pairs[first]]
    file, line = _place_of(reference, second)
    if reference.scenarios[first] != reference.scenarios[second]:
        names = [reference.benchmark.scenarios[reference.scenarios[trial]].id for trial in (first, second)]
        message = f"the trials of the pair {pair_id} are in different scenarios, {names[0]} and {names[1]}"
        problems.add("reference-split-pair", message, file, line=line)
    if reference.labels[first] == reference.labels[second]:
        answer = "YES" if reference.labels[first] else "NO"
        message = f"both trials of the pair {pair_id} end in {answer}; they should end differently"
        problems.add("reference-equal-labels", message, file, line=line)
    if reference.copies[first] == reference.copies[second]:
        copy = reference.copies[first]
        message = f"both trials of the pair {pair_id} are copy {copy}; they should be copy 0 and copy 1"
        problems.add("reference-copies", message, file, line=line)


def _check_balance(reference: Reference, problems: Problems) -> None:
    """Report properties and scenarios with unequal labels; a property with one scenario is reported once."""
    benchmark = reference.benchmark
    for property_ in benchmark.properties:
        scenarios = benchmark.scenarios_of(property_.name)
        parts = {scenario.id: reference.in_scenario(scenario.id) for scenario in scenarios}
        if len(scenarios) > 1:
            parts = {property_.name: reference.in_property(property_.name)} | parts
        for name, mask in parts.items():
            _report_imbalance(reference, name, mask, shown(property_.file), problems)


def _report_imbalance(reference: Reference, name: str, mask: Booleans, file: str, problems: Problems) -> None:
    n_trials, n_yes = int(mask.sum()), int(reference.labels[mask].sum())
    if 2 * n_yes != n_trials:
        message = f"{n_yes} of {n_trials} trials of {name} end in YES, not half of them"
        problems.add("reference-imbalance", message, file)


def _check_ratings(reference: Reference, problems: Problems) -> None:
    file = shown(HUMAN_TRIALS_FILE)
    if reference.people is None:
        problems.add("reference-unrated", "there are no human data", file)
        return
    for property_ in reference.benchmark.properties:
        counts = reference.people.n[reference.in_property(property_.name)]
        unrated = int((counts == 0).sum())
        if unrated:
            message = f"nobody judged {unrated} of the {counts.size} trials of {property_.name}"
            problems.add("reference-unrated", message, file)


def _check_participants(responses: Responses, problems: Problems) -> None:
    telling = [name for name in responses.participant_ids if not _OPAQUE.fullmatch(name)]
    if telling:
        problems.add(
            "reference-participant-id",
            f"{len(telling)} of {len(responses.participant_ids)} participants are not named p and a number, "
            f"for instance {telling[0]}",
            shown(HUMAN_RESPONSES_FILE),
            hint="ids of a recruiting service must not be published: number the participants instead",
        )


def _check_design(reference: Reference, responses: Responses, problems: Problems) -> None:
    """Report people who saw more than one trial of a pair."""
    seen = np.column_stack([responses.participants, reference.pairs[responses.trials]])
    persons_and_pairs, counts = np.unique(seen, axis=0, return_counts=True)
    repeated = persons_and_pairs[counts > 1]
    if len(repeated):
        person, pair = repeated[0]
        n_people = len(np.unique(repeated[:, 0]))
        problems.add(
            "reference-both-members",
            f"{n_people} {'people' if n_people > 1 else 'person'} saw both trials of a pair, "
            f"for instance {responses.participant_ids[person]} of {reference.pair_ids[pair]}",
            shown(HUMAN_RESPONSES_FILE),
        )


def _place_of(reference: Reference, trial: int) -> tuple[str, int]:
    """Tell where a trial is listed: its file, and the line in it."""
    index = reference.properties[trial]
    first = int(np.argmax(reference.properties == index))
    return shown(reference.benchmark.properties[index].file), trial - first + FIRST_LINE
