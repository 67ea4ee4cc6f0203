"""Understanding human data: counts for each trial, and single responses that must add up to them."""

from collections.abc import Mapping, Sequence

import numpy as np

from leaderboard.ids import find_nearest
from leaderboard.instance import HUMAN_RESPONSES_FILE, HUMAN_TRIALS_FILE
from leaderboard.problems import Problems
from leaderboard.reference.cells import FIRST_LINE, Table, parse_binary, parse_counts, parse_ids, quote
from leaderboard.reference.data import Integers, People, Responses
from leaderboard.reference.definition import shown

RATING_HEADER = ("trial_id", "n", "n_yes")
RESPONSE_HEADER = ("participant_id", "trial_id", "response")

_MAX_SUGGESTIONS = 3  # comparing a long name with hundreds of others takes a while


def parse_people(
    ratings: Table | None, responses: Table | None, trial_index: Mapping[str, int], problems: Problems
) -> People | None:
    """Understand the human data.

    Parameters
    ----------
    ratings, responses
        ``human_trials.csv`` and ``human_responses.csv``, as far as they are there.
    trial_index
        Position of each trial id.
    problems
        Receives what is wrong with them.

    Returns
    -------
    People or None
        None if there are none or they cannot be understood.
    """
    counts = None if ratings is None else _parse_ratings(ratings, trial_index, problems)
    single = None if responses is None else _parse_responses(responses, trial_index, problems)
    if ratings is None or counts is None or (responses is not None and single is None):
        return None
    people = People(*counts, single)
    if single is not None:
        _compare_counts(people, single, ratings, trial_index, problems)
    return people


def _parse_ratings(
    table: Table, trial_index: Mapping[str, int], problems: Problems
) -> tuple[Integers, Integers] | None:
    trials = _find_trials(table, trial_index, problems)
    n = parse_counts(table, "n", problems)
    n_yes = parse_counts(table, "n_yes", problems)
    if trials is None or n is None or n_yes is None or _has_repeated(table, trials, problems):
        return None
    for row in np.flatnonzero(n_yes > n).tolist():
        message = f"{n_yes[row]} of {n[row]} people said YES"
        problems.add("reference-yes-count", message, table.file, line=row + FIRST_LINE)
    spread = np.zeros((2, len(trial_index)), np.int64)
    spread[:, trials] = n, n_yes
    return spread[0], spread[1]


def _parse_responses(table: Table, trial_index: Mapping[str, int], problems: Problems) -> Responses | None:
    names = parse_ids(table, "participant_id", problems)
    trials = _find_trials(table, trial_index, problems)
    answers = parse_binary(table, "response", problems)
    if names is None or trials is None or answers is None:
        return None
    participant_ids = tuple(sorted(set(names)))
    index = {name: position for position, name in enumerate(participant_ids)}
    participants = np.array([index[name] for name in names])
    order = np.lexsort((trials, participants))
    responses = Responses(participant_ids, participants[order], trials[order], answers[order], order)
    _report_repeated(table, responses, order, problems)
    return responses


def _find_trials(table: Table, trial_index: Mapping[str, int], problems: Problems) -> Integers | None:
    """Find the trial of each row, shape (n_rows,); None and problems if one is unknown."""
    found = [trial_index.get(trial_id, -1) for trial_id in table["trial_id"]]
    unknown = [row for row, trial in enumerate(found) if trial < 0]
    for count, row in enumerate(unknown):
        trial_id = table["trial_id"][row]
        nearest = find_nearest(trial_id, trial_index) if count < _MAX_SUGGESTIONS else None
        message = f"no trial list has {quote(trial_id)}" + (f"; the nearest is {nearest}" if nearest else "")
        problems.add("reference-unknown-trial", message, table.file, line=row + FIRST_LINE)
    return None if unknown else np.array(found)


def _has_repeated(table: Table, trials: Integers, problems: Problems) -> bool:
    if len(set(trials.tolist())) == trials.size:
        return False
    lines: dict[int, int] = {}
    for line, trial in enumerate(trials.tolist(), FIRST_LINE):
        earlier = lines.setdefault(trial, line)
        if earlier != line:
            message = f"the trial {quote(table['trial_id'][line - FIRST_LINE])} is on line {earlier} already"
            problems.add("reference-duplicate", message, table.file, line=line)
    return True


def _report_repeated(
    table: Table, responses: Responses, order: Sequence[int] | Integers, problems: Problems
) -> None:
    """Report people who judged a trial twice; responses are sorted, so the two stand side by side."""
    is_same = (np.diff(responses.participants) == 0) & (np.diff(responses.trials) == 0)
    for first in np.flatnonzero(is_same).tolist():
        earlier, later = sorted((int(order[first]), int(order[first + 1])))
        name, trial_id = table["participant_id"][later], table["trial_id"][later]
        message = f"{name} judged {trial_id} on line {earlier + FIRST_LINE} already"
        problems.add("reference-repeated-response", message, table.file, line=later + FIRST_LINE)


def _compare_counts(
    people: People, responses: Responses, ratings: Table, trial_index: Mapping[str, int], problems: Problems
) -> None:
    """Report every trial whose counts are not those of the single responses."""
    n = np.bincount(responses.trials, minlength=len(trial_index))
    n_yes = np.bincount(responses.trials[responses.answers == 1], minlength=len(trial_index))
    differing = np.flatnonzero((n != people.n) | (n_yes != people.n_yes)).tolist()
    if not differing:
        return
    trial_ids = tuple(trial_index)
    lines = {trial_id: line for line, trial_id in enumerate(ratings["trial_id"], FIRST_LINE)}
    for trial in differing:
        problems.add(
            "reference-aggregate",
            f"{trial_ids[trial]} has {people.n[trial]} people, of whom {people.n_yes[trial]} said YES; "
            f"{HUMAN_RESPONSES_FILE} has {n[trial]}, of whom {n_yes[trial]} said YES",
            shown(HUMAN_TRIALS_FILE),
            line=lines.get(trial_ids[trial]),
        )
