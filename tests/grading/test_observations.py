"""Lining up a submission with the reference, and keeping part of the trials."""

from dataclasses import replace

import numpy as np
import pytest

from builders import build_reference, build_submission
from leaderboard.grading.observations import Observations
from leaderboard.metrics.undefined import Undefined

REFERENCE = build_reference(3)
RNG = np.random.default_rng(1)
PROBABILITIES = RNG.random(REFERENCE.n_trials)
WHOLE = Observations.of(build_submission(REFERENCE, PROBABILITIES.tolist()), REFERENCE)
MASK = RNG.random(REFERENCE.n_trials) < 0.4
KEPT = np.flatnonzero(MASK)


def test_arrays_follow_the_trials_that_are_kept() -> None:
    """Each is the whole's at the kept positions."""
    part = WHOLE.select(MASK)
    for name in ("probabilities", "credits", "answered", "labels", "pairs", "n", "n_yes"):
        assert getattr(part, name).tolist() == getattr(WHOLE, name)[KEPT].tolist()


def test_responses_follow_their_trials() -> None:
    """Those to kept trials stay, pointing to where the trial now is."""
    part = WHOLE.select(MASK)
    assert WHOLE.responses is not None
    assert part.responses is not None
    trials, persons, answers = WHOLE.responses
    expected = [(t, p, a) for t, p, a in zip(trials, persons, answers, strict=True) if MASK[t]]
    found = [(KEPT[t], p, a) for t, p, a in zip(*part.responses, strict=True)]
    assert found == expected


def test_counts_and_responses_agree_in_every_selection() -> None:
    """The responses to a kept trial are as many as its count says."""
    part = WHOLE.select(MASK)
    assert part.responses is not None
    assert part.n is not None
    assert np.bincount(part.responses[0], minlength=KEPT.size).tolist() == part.n.tolist()


def test_selecting_twice_is_selecting_what_both_keep() -> None:
    """Positions are renumbered each time."""
    again = WHOLE.select(MASK).select(np.arange(KEPT.size) % 2 == 0)
    both = np.zeros(REFERENCE.n_trials, bool)
    both[KEPT[::2]] = True
    at_once = WHOLE.select(both)
    assert again.probabilities.tolist() == at_once.probabilities.tolist()
    assert again.responses is not None
    assert at_once.responses is not None
    assert [a.tolist() for a in again.responses] == [a.tolist() for a in at_once.responses]


def test_human_means_are_those_of_rated_trials() -> None:
    """As many as there are rated trials, none missing and none made up."""
    assert WHOLE.n is not None
    assert WHOLE.n_yes is not None
    rated = WHOLE.n > 0
    assert WHOLE.rated.tolist() == rated.tolist()
    assert WHOLE.human_means == pytest.approx(WHOLE.n_yes[rated] / WHOLE.n[rated])


def test_values_are_centred_on_rated_trials_and_scaled_to_one() -> None:
    """By hand: of 0.2, 0.8 and 0.5 the mean is 0.5 and the largest distance 0.3; unrated trials are 0."""
    o = replace(
        WHOLE.select(np.arange(REFERENCE.n_trials) < 4),
        n=np.array([3, 0, 1, 2]),
        n_yes=np.array([3, 0, 0, 1]),
    )
    assert o.standardize(np.array([0.2, 0.9, 0.8, 0.5])) == pytest.approx([-1, 0, 1, 0], abs=1e-12)
    assert o.standardize(np.full(4, 0.3)).tolist() == [0, 0, 0, 0]
    assert o.gridded_means.tolist() == [1, 0, 0, 0.5]
    assert o.scaled_means.tolist() == [1, 0, -1, 0]
    unrated = replace(o, n=np.zeros(4, np.int64))
    assert unrated.standardize(np.array([0.2, 0.9, 0.8, 0.5])).tolist() == [0, 0, 0, 0]


def test_a_part_of_a_property_has_no_reliability() -> None:
    """What was estimated for the whole is not true of some of its trials."""
    whole = replace(WHOLE, reliability=0.9)
    assert whole.select(MASK).reliability == Undefined(
        "people's reliability is estimated for whole properties"
    )


def test_without_people_nothing_is_rated() -> None:
    """No counts, no responses, no means, in the whole and in part."""
    bare = build_reference(3, n_people=0)
    whole = Observations.of(build_submission(bare, PROBABILITIES.tolist()), bare)
    for observations in (whole, whole.select(MASK)):
        assert (observations.n, observations.n_yes, observations.responses) == (None, None, None)
        assert not observations.rated.any()
        assert observations.human_means.size == 0
