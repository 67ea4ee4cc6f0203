"""What tells two submissions apart, drawn: differences by scope, each with its interval, around 0."""

from collections.abc import Sequence
from dataclasses import replace

from leaderboard.models import Score
from leaderboard.website.describing import warn_of_simulation
from leaderboard.website.figures.forest import PLOT, Forest, ForestRow, draw_forest
from leaderboard.website.figures.marks import Drawing
from leaderboard.website.figures.scales import fit_scale
from leaderboard.website.material import Material
from leaderboard.website.numbers import MINUS
from leaderboard.website.quantities import find_quantity

CAPTION = f"A {MINUS} B overall, by property and by scenario, with 95 % intervals; right of 0 A has more."
TICKS = (-1, -0.5, 0, 0.5, 1)
"""As shares of how far the axis reaches to either side."""


def draw_differences(name: str, rows: Sequence[tuple[str, int, Score]], material: Material) -> Drawing:
    """Draw the differences of one quantity.

    Parameters
    ----------
    name
        The quantity.
    rows
        Title, level and difference of each scope.
    """
    quantity = find_quantity(name)
    ends = [end for *_, s in rows for end in (s.value, s.low, s.high) if end is not None]
    reach = max((abs(end) for end in ends), default=0.0)
    scale = fit_scale((-reach, reach), (quantity.low, quantity.high), *PLOT)
    return draw_forest(
        Forest(
            key=f"forest-{name}".replace("_", "-"),
            title=quantity.title,
            caption=CAPTION,
            quantity=quantity,
            rows=tuple(ForestRow(title, level, score) for title, level, score in rows),
            warning=warn_of_simulation(material),
            scale=replace(scale, ticks=tuple(share * scale.high for share in TICKS)),
        )
    )
