"""Forest plots: a row for each score, its interval as a bar, its value as a point on it."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import inf

from leaderboard.models import Score
from leaderboard.website.figures import palette
from leaderboard.website.figures.lettering import cut
from leaderboard.website.figures.marks import WIDTH, Box, Drawing, Line, Point, Shape, Sketch, Text, tidy
from leaderboard.website.figures.palette import SMALL_SIZE, TEXT_SIZE, Ink
from leaderboard.website.figures.readings import ScoreLine, describe_readings, list_scores, read_score
from leaderboard.website.figures.scales import Scale, fit_scale
from leaderboard.website.numbers import ABSENT, printer_of, show_bound, unit_of
from leaderboard.website.quantities import Described

PLOT = (122.0, 272.0)
TICKS_ABOVE = 14
LEGEND_LINE = 15
INDENT = 8.0
GAP = 8.0
LIFT = 3.0
"""How far a value is moved up to make room for the one beside it."""

ARROWS: dict[int, Shape] = {-1: "left", 1: "right"}


@dataclass(frozen=True)
class ForestRow:
    """A score with a name; ``beside`` is people's, or their ceiling.

    Attributes
    ----------
    level
        0 for what stands out, 1 for most, 2 for what belongs to the row above.
    absent
        Why there is no score; one that is undefined tells its own reason.
    is_people
        Whether it is a score of people.
    """

    title: str
    level: int
    score: Score | None
    beside: Score | None = None
    absent: str = ""
    is_people: bool = False


@dataclass(frozen=True)
class Band:
    """A value of people that holds for all rows, drawn as a line through its interval."""

    title: str
    score: Score


@dataclass(frozen=True)
class Forest:
    """What a forest plot is to show.

    Attributes
    ----------
    quantity
        What all values are of.
    series, beside
        What the rows' values are, and what stands beside them; without the latter neither is explained.
    warning
        What must be said in the figure itself.
    scale
        The axis; by default one that holds everything.
    """

    key: str
    title: str
    caption: str
    quantity: Described
    rows: tuple[ForestRow, ...]
    bands: tuple[Band, ...] = ()
    series: str = ""
    beside: str = ""
    beside_shape: Shape = "small diamond"
    warning: str = ""
    scale: Scale | None = None


@dataclass(frozen=True)
class _Look:
    """How high a row is, and what it is drawn with; ``bar`` is how thick its interval is."""

    height: float
    label: Ink
    value: Ink
    size: float
    bar: float
    shape: Shape
    point: Ink = palette.POINT
    interval: Ink = palette.INTERVAL


LOOKS = (
    _Look(23, palette.BOLD, palette.BOLD_VALUE, TEXT_SIZE, 8, "dot"),
    _Look(20, palette.TEXT, palette.VALUE, TEXT_SIZE, 7, "dot"),
    _Look(15, palette.SMALL, palette.SMALL_VALUE, SMALL_SIZE, 5, "small dot"),
)
BESIDE_LOOK = replace(
    LOOKS[2], shape="small diamond", point=palette.PEOPLE_POINT, interval=palette.PEOPLE_INTERVAL
)
PEOPLE_LOOKS = tuple(
    replace(
        look,
        shape="diamond" if look.shape == "dot" else "small diamond",
        point=palette.PEOPLE_POINT,
        interval=palette.PEOPLE_INTERVAL,
        label=palette.PEOPLE_TEXT if number == 0 else look.label,
        value=palette.PEOPLE_VALUE if number == 0 else look.value,
    )
    for number, look in enumerate(LOOKS)
)


def draw_forest(forest: Forest) -> Drawing:
    """Compute where everything of a forest plot is."""
    sketch = Sketch(bottom=TICKS_ABOVE)
    scale = forest.scale or span(forest)
    for row in forest.rows:
        _draw_row(sketch, forest, scale, row)
    _draw_axis(sketch, forest, scale)
    _draw_legend(sketch, forest)
    sketch.warn(forest.warning)
    readings = [(row.title, row.score, row.absent) for row in forest.rows]
    bands = [(band.title, band.score, "") for band in forest.bands]
    words = describe_readings(forest.quantity, [*bands, *readings])
    return sketch.finish(
        forest.key,
        forest.title,
        caption=forest.caption,
        description=f"{forest.title}. {words} {_read_chance(forest.quantity)} {forest.warning}".strip(),
        numbers=list_scores(forest.quantity, tuple(_list_lines(forest))),
    )


def _list_lines(forest: Forest) -> Iterator[ScoreLine]:
    """List all scores; one of level 2 belongs to the group of the row above."""
    for band in forest.bands:
        yield "", band.title, band.title, band.score, ""
    above = ""
    for row in forest.rows:
        above = above if row.level > 1 else row.title
        group = above if row.level > 1 else ""
        series = "people" if row.is_people else forest.series or "submission"
        yield group, row.title, series, row.score, row.absent
        if row.beside:
            yield group, row.title, forest.beside, row.beside, ""


def _read_chance(quantity: Described) -> str:
    return "" if quantity.chance is None else f"Chance: {show_bound(quantity, quantity.chance)}."


def span(*forests: Forest) -> Scale:
    """Choose an axis that holds every value, interval and line of some forests of one quantity."""
    quantity = forests[0].quantity
    values = [value for forest in forests for value in _list_values(forest)]
    return fit_scale(values, (quantity.low, quantity.high), *PLOT)


def _list_values(forest: Forest) -> Iterator[float]:
    if forest.quantity.chance is not None:
        yield forest.quantity.chance
    scores = [row.score for row in forest.rows] + [row.beside for row in forest.rows]
    for score in (*scores, *(band.score for band in forest.bands)):
        if score:
            yield from (end for end in (score.value, score.low, score.high) if end is not None)


def _draw_row(sketch: Sketch, forest: Forest, scale: Scale, row: ForestRow) -> None:
    look = (PEOPLE_LOOKS if row.is_people else LOOKS)[row.level]
    y = tidy(sketch.bottom + look.height / 2)
    indent = INDENT if row.level > 1 else 0.0
    label = cut(row.title, PLOT[0] - GAP - indent, look.size)
    sketch.add(look.label, Text(indent, tidy(y + 4), label, row.title if label != row.title else ""))
    lift = LIFT if forest.beside else 0
    if row.score is None or row.score.value is None:
        _draw_absent(sketch, row, y, lift)
    else:
        sketch.add(look.value, Text(WIDTH, tidy(y + 4), printer_of(forest.quantity)(row.score.value)))
        title = read_score(forest.quantity, row.title, row.score)
        _draw_score(sketch, scale, row.score, (tidy(y - lift), look, title))
    if row.beside and row.beside.value is not None:
        title = read_score(forest.quantity, f"{row.title}, {forest.beside}", row.beside)
        beside = replace(BESIDE_LOOK, bar=look.bar - 3, shape=forest.beside_shape)
        _draw_score(sketch, scale, row.beside, (tidy(y + look.bar - lift + 1), beside, title))
    sketch.bottom += look.height + lift


def _draw_absent(sketch: Sketch, row: ForestRow, y: float, lift: float) -> None:
    """Write why there is no value, where it would be; never a point."""
    score = row.score
    why = row.absent if score is None else f"undefined: {score.why}"
    shown = cut(why, WIDTH - PLOT[0] - 3 * GAP, SMALL_SIZE)
    sketch.add(
        palette.REASON, Text(PLOT[0] + GAP, tidy(y + 4 - 2 * lift), shown, why if shown != why else "")
    )
    sketch.add(palette.SMALL_VALUE, Text(WIDTH, tidy(y + 4), ABSENT))


def _draw_score(sketch: Sketch, scale: Scale, score: Score, place: tuple[float, _Look, str]) -> None:
    """Draw the interval and the value on it; arrows at the ends of the axis for what lies beyond."""
    y, look, title = place
    value = score.value or 0
    for box in _bar_of(score, scale, y, look.bar):
        sketch.add(look.interval, box)
    beyond = scale.beyond(value)
    for end in {scale.beyond(end) for end in (score.low, score.high) if end is not None} - {beyond, 0}:
        sketch.add(look.interval, Point(scale.place(end * inf), y, ARROWS[end]))
    words = f"{title}, beyond the axis" if beyond else title
    sketch.add(look.point, Point(scale.place(value), y, ARROWS.get(beyond, look.shape), words))


def _bar_of(score: Score, scale: Scale, y: float, height: float) -> Iterator[Box]:
    if score.low is not None and score.high is not None:
        low, high = scale.place(score.low), scale.place(score.high)
        yield Box(low, tidy(y - height / 2), tidy(max(high - low, 1)), height)


def _draw_axis(sketch: Sketch, forest: Forest, scale: Scale) -> None:
    """Draw grid, chance and people's bands behind the rows; numbers above them, since rows may be many."""
    top, bottom = TICKS_ABOVE, tidy(sketch.bottom)
    for tick in scale.ticks:
        x = scale.place(tick)
        sketch.add(palette.GRID, Line(x, top, x, bottom))
        sketch.add(palette.TICK, Text(x, top - 4, show_bound(forest.quantity, tick).partition(" ")[0]))
    sketch.add(palette.SMALL_VALUE, Text(WIDTH, top - 4, unit_of(forest.quantity)))
    for band in forest.bands:
        for box in _bar_of(band.score, scale, (top + bottom) / 2, bottom - top):
            sketch.add(palette.PEOPLE_BAND, box)
        if band.score.value is not None:
            x = scale.place(band.score.value)
            sketch.add(palette.PEOPLE_LINE, Line(x, top, x, bottom))
    if forest.quantity.chance is not None:
        x = scale.place(forest.quantity.chance)
        sketch.add(palette.REFERENCE_LINE, Line(x, top, x, bottom))


def _draw_legend(sketch: Sketch, forest: Forest) -> None:
    """Say below the rows what marks and lines are, one a line so that nothing runs into another."""
    quantity = forest.quantity
    sketch.bottom += 4
    if forest.beside:
        own = (PEOPLE_LOOKS if any(row.is_people for row in forest.rows) else LOOKS)[1]
        for words, look in (
            (forest.series, own),
            (forest.beside, replace(BESIDE_LOOK, shape=forest.beside_shape)),
        ):
            y = _next_line(sketch, words)
            sketch.add(look.interval, Box(0, tidy(y - look.bar / 2), 16, look.bar))
            sketch.add(look.point, Point(8, y, look.shape))
    for band in forest.bands:
        y = _next_line(sketch, read_score(quantity, band.title, band.score))
        sketch.add(palette.PEOPLE_BAND, Box(2, y - 6, 12, 12))
        sketch.add(palette.PEOPLE_LINE, Line(8, y - 6, 8, y + 6))
    if quantity.chance is not None:
        y = _next_line(sketch, f"chance {show_bound(quantity, quantity.chance)}")
        sketch.add(palette.REFERENCE_LINE, Line(8, y - 6, 8, y + 6))


def _next_line(sketch: Sketch, words: str) -> float:
    """Write a line of the legend and give the height at which its mark belongs."""
    y = tidy(sketch.bottom + LEGEND_LINE / 2)
    sketch.bottom += LEGEND_LINE
    shown = cut(words, WIDTH - 22, SMALL_SIZE)
    sketch.add(palette.SMALL, Text(22, y + 4, shown, words if shown != words else ""))
    return y
