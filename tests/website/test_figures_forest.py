"""Forest plots: every row with its interval and value where they belong."""

from dataclasses import replace

import pytest

from leaderboard.grading import find_metric
from leaderboard.models import Score
from leaderboard.website.figures import palette
from leaderboard.website.figures.forest import PLOT, Band, Forest, ForestRow, draw_forest, span
from leaderboard.website.figures.marks import WIDTH, Box, Drawing, Line, Point, Text
from leaderboard.website.figures.palette import Ink
from leaderboard.website.figures.scales import Scale
from leaderboard.website.numbers import ABSENT

ACCURACY = find_metric("accuracy")
GOOD = Score(value=0.7, low=0.6, high=0.75)
ROWS = (
    ForestRow("Overall", 0, GOOD),
    ForestRow("Mass", 1, Score(value=0.55, low=0.5, high=0.6)),
    ForestRow("Mass-Dominoes", 2, Score(value=None, why="all labels are equal")),
)
PEOPLE = Band("people", Score(value=0.6, low=0.58, high=0.63))
FOREST = Forest("key", "Accuracy", "Some words.", ACCURACY, ROWS, (PEOPLE,))


def points_of(drawing: Drawing, ink: Ink) -> list[Point]:
    return [point for layer in drawing.layers if layer.ink is ink for point in layer.points]


def boxes_of(drawing: Drawing, ink: Ink) -> list[Box]:
    return [box for layer in drawing.layers if layer.ink is ink for box in layer.boxes]


def lines_of(drawing: Drawing, ink: Ink) -> list[Line]:
    return [line for layer in drawing.layers if layer.ink is ink for line in layer.lines]


def texts_of(drawing: Drawing) -> list[Text]:
    return [text for layer in drawing.layers for text in layer.texts]


def test_points_and_intervals_are_where_the_numbers_say() -> None:
    """Recomputed from the axis, to a tenth of a unit; the value lies on its interval."""
    drawing, scale = draw_forest(FOREST), span(FOREST)
    points, boxes = points_of(drawing, palette.POINT), boxes_of(drawing, palette.INTERVAL)
    for row, point, box in zip(ROWS[:2], points, boxes, strict=True):
        score = row.score
        assert score is not None
        assert None not in (score.value, score.low, score.high)
        for place, value in zip(
            (point.x, box.x, box.x + box.width), (score.value, score.low, score.high), strict=True
        ):
            expected = PLOT[0] + ((value or 0) - scale.low) / (scale.high - scale.low) * (PLOT[1] - PLOT[0])
            assert place == pytest.approx(expected, abs=0.11)
        assert box.y + box.height / 2 == pytest.approx(point.y, abs=0.11)


def test_the_uncertain_is_drawn_first() -> None:
    """Bands lie below intervals, intervals below values, and all below words."""
    depths = [layer.ink.depth for layer in draw_forest(FOREST).layers]
    assert depths == sorted(depths)
    assert palette.PEOPLE_BAND.depth < palette.INTERVAL.depth < palette.POINT.depth < palette.TEXT.depth


def test_numbers_are_printed_as_in_tables() -> None:
    """With one decimal of a percent, the unit above; intervals in the title of the point."""
    drawing = draw_forest(FOREST)
    assert {"70.0", "55.0", "%"} <= {text.text for text in texts_of(drawing)}
    assert points_of(drawing, palette.POINT)[0].title == "Overall: 70.0 %, 95 % interval 60.0–75.0"  # noqa: RUF001


def test_what_is_undefined_is_words_and_no_point() -> None:
    """The reason stands where the value would be, whole in the title if it is cut."""
    drawing = draw_forest(FOREST)
    texts = texts_of(drawing)
    assert len(points_of(drawing, palette.POINT)) == 2
    assert "undefined: all labels are equal" in [text.title or text.text for text in texts]
    assert ABSENT in [text.text for text in texts]
    absent = replace(FOREST, rows=(ForestRow("Mass", 1, None, absent="not covered"),))
    assert "not covered" in [text.text for text in texts_of(draw_forest(absent))]


def test_lines_of_chance_and_people_go_through_all_rows() -> None:
    """Chance is dashed; people have a line in the band of their interval; both are explained below."""
    drawing, scale = draw_forest(FOREST), span(FOREST)
    chance, people = lines_of(drawing, palette.REFERENCE_LINE)[0], lines_of(drawing, palette.PEOPLE_LINE)[0]
    band = boxes_of(drawing, palette.PEOPLE_BAND)[0]
    assert (chance.x1, people.x1) == (scale.place(0.5), scale.place(0.6))
    assert (band.x, band.x + band.width) == pytest.approx((scale.place(0.58), scale.place(0.63)))
    assert chance.y2 > max(point.y for point in points_of(drawing, palette.POINT)[:2])
    words = [text.text for text in texts_of(drawing)]
    assert "people: 60.0 %, 95 % interval 58.0–63.0" in words  # noqa: RUF001
    assert "chance 50 %" in words


def test_a_value_beyond_the_axis_is_an_arrow_at_its_end() -> None:
    """It is never drawn outside; the title tells the value; clipped ends of intervals have arrows too."""
    rows = (
        ForestRow("low", 1, Score(value=0.1, low=0.05, high=0.2)),
        ForestRow("high", 1, Score(value=0.58, low=0.3, high=0.9)),
    )
    narrow = Scale(0.4, 0.6, *PLOT, ticks=(0.4, 0.6))
    drawing = draw_forest(replace(FOREST, rows=rows, bands=(), scale=narrow))
    low, high = points_of(drawing, palette.POINT)
    assert (low.x, low.shape) == (PLOT[0], "left")
    assert low.title == "low: 10.0 %, 95 % interval 5.0–20.0, beyond the axis"  # noqa: RUF001
    assert high.shape == "dot"
    ends = [(point.x, point.shape) for point in points_of(drawing, palette.INTERVAL)]
    assert sorted(ends) == [(PLOT[0], "left"), (PLOT[1], "right")]
    for box in boxes_of(drawing, palette.INTERVAL):
        assert PLOT[0] <= box.x
        assert box.x + box.width <= PLOT[1] + 1


def test_people_stand_beside_a_row() -> None:
    """In another colour and shape, below the row's own value, and both are explained."""
    row = ForestRow("Overall", 0, GOOD, beside=PEOPLE.score)
    drawing = draw_forest(replace(FOREST, rows=(row,), bands=(), series="this one", beside="people"))
    own, people = points_of(drawing, palette.POINT)[0], points_of(drawing, palette.PEOPLE_POINT)[0]
    assert (own.shape, people.shape) == ("dot", "small diamond")
    assert people.y > own.y
    assert people.title == "Overall, people: 60.0 %, 95 % interval 58.0–63.0"  # noqa: RUF001
    assert {"this one", "people"} <= {text.text for text in texts_of(drawing)}


def test_long_names_are_cut_and_told_whole() -> None:
    """What does not fit ends in an ellipsis; the title has it all."""
    name = "A name of a system that goes on for longer than anybody would read"
    drawing = draw_forest(replace(FOREST, rows=(ForestRow(name, 1, GOOD),)))
    (label,) = [text for text in texts_of(drawing) if text.title]
    assert label.title == name
    assert label.text.endswith("…")


def test_the_description_has_the_key_numbers() -> None:
    """Title, bands, the first rows with their intervals, chance, and what must be known of all of it."""
    drawing = draw_forest(replace(FOREST, warning="Synthetic."))
    assert drawing.description == (
        "Accuracy. people: 60.0 %, 95 % interval 58.0–63.0; Overall: 70.0 %, 95 % interval 60.0–75.0; "  # noqa: RUF001
        "Mass: 55.0 %, 95 % interval 50.0–60.0; Mass-Dominoes: undefined, all labels are equal. "  # noqa: RUF001
        "Chance: 50 %. Synthetic."
    )
    assert "Synthetic." in [text.text for text in texts_of(drawing)]
    many = draw_forest(replace(FOREST, rows=ROWS * 20))
    assert "; 49 more." in many.description


def test_a_forest_without_rows_is_a_figure_still() -> None:
    """Nothing fails where there is nothing, and it says so."""
    drawing = draw_forest(replace(FOREST, rows=(), bands=()))
    assert "Nothing to show." in drawing.description
    assert drawing.height > 0


def test_nothing_is_drawn_outside() -> None:
    """Every mark lies within the figure, with sixty rows as with one."""
    for rows in (ROWS[:1], ROWS * 20):
        drawing = draw_forest(replace(FOREST, rows=rows))
        for layer in drawing.layers:
            places: list[Point | Text | Box] = [*layer.points, *layer.texts, *layer.boxes]
            assert all(0 <= place.x <= WIDTH and 0 <= place.y <= drawing.height for place in places)
