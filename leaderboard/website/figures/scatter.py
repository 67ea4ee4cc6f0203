"""Model against people: one point per trial."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from leaderboard.website.describing import count_of
from leaderboard.website.figures import palette
from leaderboard.website.figures.marks import Cloud, Drawing, Line, Point, Shape, Sketch, Text
from leaderboard.website.figures.palette import Ink
from leaderboard.website.figures.squares import draw_square, square_scales

SIDE = (24.0, 300.0)
"""Top and bottom of the diagram; as high as it is wide, so that equal shares lie on its diagonal."""

SERIES: tuple[tuple[int, str, Ink, Shape], ...] = (
    (0, "label NO", palette.NO_POINT, "cross"),
    (1, "label YES", palette.YES_POINT, "speck"),
)


@dataclass(frozen=True)
class Scatter:
    """What a scatter plot is to show, and in which words.

    Attributes
    ----------
    trials, shares, probabilities, labels : (n_trials,)
        Of each trial its number, the share of people who said YES, P(YES) of the submission, and the label.
    statement
        How much they agree.
    """

    key: str
    title: str
    caption: str
    statement: str
    trials: NDArray[np.int64]
    shares: NDArray[np.float64]
    probabilities: NDArray[np.float64]
    labels: NDArray[np.int64]
    warning: str = ""


def draw_scatter(scatter: Scatter) -> Drawing:
    """Compute the place of every trial, in whole units; points of one label are one path, to stay small."""
    sketch = Sketch()
    across, upward = scales = square_scales(*SIDE)
    draw_square(sketch, scales, ("people who said YES, %", "submitted P(YES), %"))
    half = upward.place(0.5)
    sketch.add(palette.REFERENCE_LINE, Line(across.start, half, across.end, half))
    columns = np.rint(across.start + scatter.shares * (across.end - across.start)).astype(int)
    rows = np.rint(upward.start + scatter.probabilities * (upward.end - upward.start)).astype(int)
    counts = []
    for label, name, ink, shape in SERIES:
        chosen = scatter.labels == label
        places = zip(columns[chosen].tolist(), rows[chosen].tolist(), strict=True)
        sketch.add(ink, Cloud(tuple(sorted(places)), shape))
        counts.append(f"{name}: {count_of(int(chosen.sum()), 'trial')}")
    _draw_legend(sketch, counts)
    sketch.warn(scatter.warning)
    words = [f"{scatter.title}. {scatter.statement}", f"{'; '.join(counts)}.", scatter.warning]
    description = " ".join(word for word in words if word)
    return sketch.finish(
        scatter.key,
        scatter.title,
        caption=scatter.caption,
        description=description,
        numbers={
            "trial": scatter.trials,
            "label": scatter.labels,
            "people_yes": scatter.shares,
            "probability": scatter.probabilities,
        },
    )


def _draw_legend(sketch: Sketch, counts: Iterable[str]) -> None:
    """Name the marks, and the line above which a submission says YES."""
    for words, (_, _, ink, shape) in zip(counts, SERIES, strict=True):
        sketch.add(ink, Point(6, sketch.bottom + 6, shape))
        sketch.add(palette.SMALL, Text(16, sketch.bottom + 10, words))
        sketch.bottom += 15
    y = sketch.bottom + 6
    sketch.add(palette.REFERENCE_LINE, Line(0, y, 12, y))
    sketch.add(palette.SMALL, Text(16, y + 4, "says YES above, NO below"))
    sketch.bottom += 15
