"""Which submissions are compared beforehand: at the top of each board, neighbours, and each with the best."""

from collections.abc import Iterator, Sequence

import numpy as np

from leaderboard.comparing import Comparison, Contender, compare_contenders
from leaderboard.grading import Yardstick
from leaderboard.ranking import Board, Entry
from leaderboard.submission import Submission

N_TOP = 10


def compare_neighbours(boards: Sequence[Board], yardstick: Yardstick) -> Iterator[Comparison]:
    """Compare each of the first ten of each board with the next one, and with the best; A is the better."""
    for board in boards:
        ranked = [row.entry for row in board.ranked if row.rank is not None]
        chosen = _choose_pairs(len(ranked))
        places = sorted({place for pair in chosen for place in pair})
        contenders = {place: _take_up(ranked[place], yardstick) for place in places}
        for a, b in chosen:
            yield compare_contenders(contenders[a], contenders[b], reference=yardstick.reference)


def _choose_pairs(n: int) -> list[tuple[int, int]]:
    neighbours = {(place, place + 1) for place in range(min(N_TOP, n - 1))}
    return sorted(neighbours | {(0, place) for place in range(1, min(N_TOP, n))})


def _take_up(entry: Entry, yardstick: Yardstick) -> Contender:
    """See a complete entry as the submission that was graded."""
    answered = ~np.isnan(entry.probabilities)
    submission = Submission(
        slug=entry.slug,
        metadata=entry.metadata,
        predictions_sha256=entry.result.inputs.predictions_sha256,
        probabilities=np.where(answered, entry.probabilities, 0.5),
        answered=answered,
        covered=np.ones(answered.size, bool),
    )
    return Contender.of(submission, submission.covered, yardstick)
