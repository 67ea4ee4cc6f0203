"""Taking trials out of a reference, with their ratings and their part in pairs."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from leaderboard.reference.data import Booleans, DroppedTrial, Integers, People, Reference, Responses


def drop_trials(reference: Reference, reasons: Mapping[str, str]) -> Reference:
    """Take trials out of a reference; what is left keeps its order, and ids that are no trials do nothing.

    Parameters
    ----------
    reference
        With all trials of its lists.
    reasons
        Why each trial is dropped, by its id.
    """
    is_kept = np.array([trial_id not in reasons for trial_id in reference.trial_ids], bool)
    if is_kept.all():
        return reference
    pair_ids, pairs = _renumber_pairs(reference, is_kept)
    frames = reference.start_frames
    return replace(
        reference,
        trial_ids=tuple(trial_id for trial_id in reference.trial_ids if trial_id not in reasons),
        pair_ids=pair_ids,
        properties=reference.properties[is_kept],
        scenarios=reference.scenarios[is_kept],
        pairs=pairs,
        copies=reference.copies[is_kept],
        labels=reference.labels[is_kept],
        people=None if reference.people is None else _keep_ratings(reference.people, is_kept),
        start_frames=None if frames is None else frames[is_kept],
        dropped_trials=tuple(
            _describe_trial(reference, position, reasons) for position in np.flatnonzero(~is_kept).tolist()
        ),
    )


def _renumber_pairs(reference: Reference, is_kept: Booleans) -> tuple[tuple[str, ...], Integers]:
    """Number the pairs that are left by their first trial."""
    left = reference.pairs[is_kept].tolist()
    numbers = {pair: number for number, pair in enumerate(dict.fromkeys(left))}
    return tuple(reference.pair_ids[pair] for pair in numbers), np.array([numbers[pair] for pair in left])


def _keep_ratings(people: People, is_kept: Booleans) -> People:
    responses = None if people.responses is None else _keep_responses(people.responses, is_kept)
    return People(people.n[is_kept], people.n_yes[is_kept], responses)


def _keep_responses(responses: Responses, is_kept: Booleans) -> Responses | None:
    """Leave out answers to dropped trials, and people who gave no other; None if no answer is left."""
    mask = is_kept[responses.trials]
    if not mask.any():
        return None
    left, participants = np.unique(responses.participants[mask], return_inverse=True)
    positions = np.cumsum(is_kept) - 1
    return Responses(
        participant_ids=tuple(responses.participant_ids[person] for person in left.tolist()),
        participants=participants,
        trials=positions[responses.trials[mask]],
        answers=responses.answers[mask],
        rows=None if responses.rows is None else responses.rows[mask],
    )


def _describe_trial(reference: Reference, position: int, reasons: Mapping[str, str]) -> DroppedTrial:
    trial_id = reference.trial_ids[position]
    responses = reference.people.responses if reference.people else None
    persons = [] if responses is None else responses.participants[responses.trials == position].tolist()
    return DroppedTrial(
        trial_id=trial_id,
        pair_id=reference.pair_ids[reference.pairs[position]],
        property_index=int(reference.properties[position]),
        scenario_index=int(reference.scenarios[position]),
        position=position,
        participant_ids=tuple(responses.participant_ids[person] for person in persons) if responses else (),
        reason=reasons[trial_id],
    )
