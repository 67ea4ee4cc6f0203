"""Where a submission stands, in sentences: rank, how sure it is, and what inferring properties gains."""

from leaderboard.models import Score
from leaderboard.ranking import Entry, Standing
from leaderboard.website.describing import describe_coverage, submission_path
from leaderboard.website.material import Material
from leaderboard.website.numbers import name_p, show_interval, show_points, show_probability
from leaderboard.website.pages import GainLine, Link
from leaderboard.website.quantities import find_quantity

PROPERTY_GAIN = find_quantity("property_gain")


def describe_standing(entry: Entry, material: Material) -> str:
    """Say which rank a submission has and how sure that is, or why it has none."""
    if entry.is_baseline:
        return "A baseline: shown on every board for reference, not ranked."
    if entry.slug not in material.standings:
        return "On no board, because no track has its protocol."
    board, row = material.standings[entry.slug]
    if not entry.is_complete:
        return f"Not ranked, because it is partial: {describe_coverage(entry, material)}."
    if row.rank is None:
        return "Not ranked, because its overall accuracy is undefined."
    place = f"Rank {row.rank} of {len(board.ranked)} by overall accuracy"
    if row.standing is None or len(board.ranked) == 1:
        return f"{place}."
    standings = [other.standing for other in board.ranked if other.standing]
    n_best = sum(standing.is_among_best for standing in standings)
    return f"{place}, {_judge(row.standing, n_best)}"


def _judge(standing: Standing, n_best: int) -> str:
    ranks = f"{standing.low} to {standing.high}" if standing.low < standing.high else f"{standing.low} only"
    place = "distinguishable from the best"
    if standing.is_among_best:
        place = f"one of {n_best} not {place}" if n_best > 1 else "distinguishable from all others"
    probability = show_probability(standing.best_probability)
    return f"95 % rank set {ranks}; {place}; probability of being the best {probability}."


def describe_gain(entry: Entry, material: Material) -> GainLine | None:
    """Say what the system gains from inferring properties, if it was tested both with and without."""
    _, row = material.standings.get(entry.slug, (None, None))
    if row is None or row.gain is None:
        return None
    gain = row.gain
    names = {p.entry.slug: p.entry.metadata.submission.name for p in material.publications}
    interval = show_interval(PROPERTY_GAIN, Score(value=gain.value, low=gain.low, high=gain.high))
    return GainLine(
        before=f"{show_points(gain.value)} points over",
        without=Link(names[gain.without], submission_path(gain.without)),
        after=f"without property inference: 95 % interval {interval}, exact {name_p(gain.p)}.",
    )
