"""Places, inks and letters of figures."""

from dataclasses import fields
from math import inf

import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.website.figures import palette
from leaderboard.website.figures.lettering import ELLIPSIS, cut, estimate_width
from leaderboard.website.figures.marks import Box, Cloud, Line, Point, Sketch, Steps, Text
from leaderboard.website.figures.palette import ON_PAGES, Ink, Palette
from leaderboard.website.figures.scales import MAX_STEPS, SMALLEST_STEP, Scale, fit_scale

shares = st.floats(0, 1)


@given(st.lists(shares, max_size=5))
def test_an_axis_holds_what_it_is_made_for(values: list[float]) -> None:
    """Every value lies on it, its ends are ticks, and it has few of them."""
    scale = fit_scale(values, (0, 1), 10, 110)
    assert all(scale.low - 1e-9 <= value <= scale.high + 1e-9 for value in values)
    assert (scale.ticks[0], scale.ticks[-1]) == (scale.low, scale.high)
    assert len(scale.ticks) <= MAX_STEPS + 1
    assert scale.ticks[1] - scale.ticks[0] >= SMALLEST_STEP - 1e-9
    assert (scale.place(scale.low), scale.place(scale.high)) == (10, 110)


def test_an_axis_without_values_shows_the_range() -> None:
    """Finite limits are shown as they are, infinite ones as 0 and 1."""
    assert fit_scale([], (-1, 1), 0, 1).ticks == (-1, -0.5, 0, 0.5, 1)
    assert fit_scale([], (-inf, inf), 0, 1).ticks == (0, 0.2, 0.4, 0.6, 0.8, 1)


def test_one_value_is_not_blown_up() -> None:
    """Around a single value there is room, and values beyond the limits do not widen the axis."""
    assert fit_scale([0.5], (0, 1), 0, 1).ticks == (0.45, 0.5, 0.55)
    assert fit_scale([0.2, 7.0], (0, 1), 0, 1).high == 1


@given(st.floats(-10, 10))
def test_what_lies_beyond_an_axis_is_placed_at_its_end(value: float) -> None:
    """Nothing is ever drawn outside, and the scale tells on which side a value would be."""
    scale = Scale(0, 1, 100, 200)
    assert 100 <= scale.place(value) <= 200
    assert scale.beyond(value) == (1 if value > 1 else -1 if value < 0 else 0)


def test_layers_lie_by_depth() -> None:
    """What is drawn later can lie below; marks of one ink stay together, by kind."""
    sketch = Sketch(bottom=20)
    point, line, box, words = Point(1, 2, "dot"), Line(0, 0, 1, 1), Box(0, 0, 1, 1), Text(0, 0, "a")
    cloud, steps = Cloud(((1, 2), (3, 4)), "speck"), Steps(((0, 1), (2, 3)))
    sketch.add(palette.TEXT, words)
    sketch.add(palette.POINT, point, cloud, steps)
    sketch.add(palette.GRID, line, box)
    layers = sketch.finish("key", "title", caption="", description="", numbers={}).layers
    assert [layer.ink for layer in layers] == [palette.GRID, palette.POINT, palette.TEXT]
    assert (layers[0].lines, layers[0].boxes) == ((line,), (box,))
    assert (layers[1].points, layers[1].paths) == ((point,), (cloud, steps))
    assert layers[2].texts == (words,)


def test_outlines_are_svg_paths() -> None:
    """Each shape begins at its place."""
    assert Cloud(((1, 2), (3, 4)), "speck").outline == "M1 2h0M3 4h0"
    assert Steps(((0, 1), (2, 3))).outline == "M0 1H2V3"
    assert Point(5, 6.5, "diamond").outline.startswith("M5 6.5m0-4.4")


def test_what_has_no_title_is_one_path() -> None:
    """Lines and boxes of one ink; a box with a title stays an element of its own, which can be pointed at."""
    sketch = Sketch()
    sketch.add(palette.BAR, Line(0, 1, 2, 1), Box(1, 2, 3.5, 4), Box(5, 6, 7, 8, title="words"))
    (layer,) = sketch.finish("key", "Title", caption="", description="", numbers={}).layers
    assert layer.outline == "M0 1L2 1M1 2h3.5v4h-3.5z"


def test_an_ink_takes_its_colours_from_the_palette() -> None:
    """The same figure can be printed in other colours; what is as usual is not said."""
    ink = Ink(1, fill="model", stroke="paper", thickness=2, dash="3 3", opacity=0.5)
    ink_of_words = Ink(1, size=12, anchor="end", is_bold=True)
    literal = Palette(**{field.name: f"#{field.name}" for field in fields(Palette)})
    assert dict(ink.attributes(literal)) == {
        "fill": "#model",
        "stroke": "#paper",
        "stroke-width": "2",
        "stroke-dasharray": "3 3",
        "fill-opacity": "0.5",
        "stroke-opacity": "0.5",
    }
    assert dict(ink_of_words.attributes(literal)) == {
        "font-size": "12",
        "font-weight": "bold",
        "text-anchor": "end",
    }
    assert Ink(1, stroke="line").attributes(ON_PAGES) == (("stroke", "var(--line)"),)


@given(st.text(), st.floats(20, 300))
def test_what_is_cut_fits(text: str, width: float) -> None:
    """A text is shown whole or as its beginning and an ellipsis, never wider than there is room."""
    shown = cut(text, width, 12)
    assert shown == text or (shown.endswith(ELLIPSIS) and text.startswith(shown[:-1]))
    assert estimate_width(shown, 12) <= width


@pytest.mark.parametrize(("wide", "narrow"), [("WWW", "iii"), ("\u6f22\u5b57", "ab"), ("ABC", "abc")])
def test_wide_letters_take_more_room(wide: str, narrow: str) -> None:
    """Capitals, and letters of scripts that fill a square, are wider than others; accents take none."""
    assert estimate_width(wide, 10) > estimate_width(narrow, 10)
    assert estimate_width("e\u0301", 10) == estimate_width("e", 10)
