"""Valid predictions that a reader should look at twice."""

from collections.abc import Sequence

import numpy as np

from leaderboard.metrics.accuracy import Floats, credits_of
from leaderboard.metrics.exact_tests import accuracy_p
from leaderboard.metrics.pairs import find_opposite_pairs
from leaderboard.metrics.undefined import Undefined
from leaderboard.problems import Problems
from leaderboard.reference import Reference
from leaderboard.submission import Submission

COPY_CODE = "copy-of-another"
MIN_SHARED = 50
SAME_DECISIONS = 0.99
SAME_ORDER = 0.999
SWAP_ALPHA = 0.01
MIN_DIFFERING = 0.5


def find_suspicions(
    submission: Submission,
    reference: Reference,
    others: Sequence[Submission],
    file: str,
    problems: Problems,
) -> None:
    """Warn of constants, of copies of labels, people or others, and of swapped members."""
    covered = submission.covered & submission.answered
    probabilities = submission.probabilities[covered]
    if probabilities.size and np.ptp(probabilities) == 0:
        constant = repr(float(probabilities[0])).removesuffix(".0")
        message = f"all {probabilities.size} probabilities are {constant}"
        problems.add("constant-probabilities", message, file, hint="ranks and correlations say nothing then")
    if probabilities.size and np.array_equal(probabilities, reference.labels[covered]):
        message = "the probabilities equal the labels"
        problems.add("equal-to-labels", message, file, hint="did the model see the outcome?")
    if _equals_people(submission, reference):
        message = "the probabilities equal the share of people who said YES"
        problems.add("equal-to-human-means", message, file, hint="were human data used as predictions?")
    _find_copies(submission, others, file, problems)
    _find_swapped(submission, reference, file, problems)


def _equals_people(submission: Submission, reference: Reference) -> bool:
    people = reference.people
    if people is None:
        return False
    compared = submission.answered & (people.n > 0)
    means = people.n_yes[compared] / people.n[compared]
    given = submission.probabilities[compared]
    # Half a unit of the fourth decimal: human means are often written with four.
    return bool(given.size and np.ptp(given) > 0 and np.abs(given - means).max() <= 0.5e-4)  # noqa: PLR2004


def _find_copies(submission: Submission, others: Sequence[Submission], file: str, problems: Problems) -> None:
    for other in others:
        if other.slug == submission.slug or _owner(other) == _owner(submission):
            continue
        shared = submission.answered & other.answered
        mine, theirs = submission.probabilities[shared], other.probabilities[shared]
        if mine.size < MIN_SHARED or np.ptp(mine) == 0:
            continue
        is_same = np.array_equal(mine, theirs)
        if is_same or _is_near(mine, theirs):
            how = "equal" if is_same else "nearly equal"
            message = f"the probabilities {how} those of {other.slug} on {mine.size} trials"
            problems.add(COPY_CODE, message, file, hint="say in the description what differs")


def _is_near(mine: Floats, theirs: Floats) -> bool:
    same_side = np.mean(np.sign(mine - 0.5) == np.sign(theirs - 0.5))
    if same_side < SAME_DECISIONS or np.ptp(theirs) == 0:
        return False
    return bool(np.corrcoef(_ranks(mine), _ranks(theirs))[0, 1] >= SAME_ORDER)


def _ranks(values: Floats) -> Floats:
    _, inverse, counts = np.unique(values, return_inverse=True, return_counts=True)
    ranks: Floats = (np.cumsum(counts) - (counts - 1) / 2)[inverse]
    return ranks


def _owner(submission: Submission) -> tuple[str, str] | None:
    return None if submission.metadata is None else submission.metadata.owner


def _find_swapped(submission: Submission, reference: Reference, file: str, problems: Problems) -> None:
    """Warn where pairs are told apart but the wrong way round, more than chance would have it.

    Half of the opposite-label pairs or more get different answers, and turning all answers round would be
    better than chance with an exact p below 0.01.
    """
    answered = submission.answered
    members = find_opposite_pairs(reference.pairs, reference.labels)
    members = members[answered[members].all(axis=1)]
    sides = np.sign(submission.probabilities - 0.5)[members]
    differing = sides[:, 0] * sides[:, 1] < 0
    if not len(members) or differing.mean() < MIN_DIFFERING:
        return
    turned = credits_of(1 - submission.probabilities, reference.labels, answered)[answered]
    labels, pairs = reference.labels[answered], reference.pairs[answered]
    p = accuracy_p(turned, labels, pairs, np.ones(labels.size, bool))
    if not isinstance(p, Undefined) and p < SWAP_ALPHA:
        n_wrong = int((differing & (sides[:, 0] < 0)).sum())
        message = (
            f"{differing.sum()} of {len(members)} pairs get different answers, "
            f"{n_wrong} of them the wrong way round"
        )
        problems.add("swapped-copies", message, file, hint="did the two copies change places, or YES and NO?")


def judge_inputs(submission: Submission, reference: Reference, file: str, problems: Problems) -> None:
    """Warn where the model saw the simulator's state and its track does not say so; baselines may."""
    metadata = submission.metadata
    if metadata is None or metadata.is_baseline or metadata.model.inputs != "state":
        return
    track = reference.benchmark.find_track(metadata.protocol)
    if track is not None and metadata.protocol.testing != "fully_observed":
        message = f"the ground-truth state is more than the track {track.id} shows"
        problems.add("beyond-track", message, file, hint="the board marks it")
