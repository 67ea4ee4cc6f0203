"""How scores are printed, and where a dash explains itself."""

from dataclasses import replace
from math import inf

import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.grading import METRICS, find_metric
from leaderboard.models import Score
from leaderboard.website.numbers import (
    ABSENT,
    EN_DASH,
    GAPS,
    MINUS,
    SHARES,
    Footnotes,
    printer_of,
    show_bound,
    show_exactly,
    show_interval,
    show_p,
    show_range,
    unit_of,
)
from leaderboard.website.quantities import OF_BOARDS, OF_COMPARISONS, OF_PEOPLE, Described, find_quantity


def test_every_metric_named_here_is_in_the_table_of_metrics() -> None:
    """The lists of shares and gaps do not outlive a metric or another number that is printed."""
    printed: tuple[Described, ...] = (*METRICS, *OF_PEOPLE, *OF_BOARDS, *OF_COMPARISONS)
    assert {*SHARES, *GAPS} <= {quantity.name for quantity in printed}


@pytest.mark.parametrize(
    ("metric", "value", "text"),
    [
        ("accuracy", 0.588542, "58.9"),
        ("accuracy", 1.0, "100.0"),
        ("accuracy", 0.0, "0.0"),
        ("human_gap", -0.0213, f"{MINUS}2.1"),
        ("human_gap", 0.25, "+25.0"),
        ("human_r", -0.12345, f"{MINUS}0.123"),
        ("human_r", -0.0001, "0.000"),
        ("brier", 0.25, "0.250"),
        ("accuracy_p", 0.0401, "0.040"),
        ("accuracy_p", 3.5e-8, "< 0.001"),
    ],
)
def test_a_metric_is_printed_in_its_own_way(metric: str, value: float, text: str) -> None:
    """Shares are percent, gaps are signed points, p-values have a floor, the rest three decimals."""
    assert printer_of(find_metric(metric))(value) == text


@given(st.sampled_from(METRICS), st.floats(-1, 1))
def test_no_value_is_printed_as_negative_zero(metric: object, value: float) -> None:
    """A sign stands only before digits that are not all zero, but for the plus of a gap."""
    text = printer_of(metric)(value)  # type: ignore[arg-type]
    assert not (text.startswith((MINUS, "-")) and not text.strip(f"{MINUS}-0."))


@given(st.floats(0, 1).map(lambda value: round(value, 6)))
def test_exact_text_gives_the_value_back(value: float) -> None:
    """Nothing that a result holds is lost in the attribute of a cell."""
    assert float(show_exactly(value)) == value


def test_exact_text_keeps_small_p_values() -> None:
    """Six decimals would make them zero."""
    assert show_exactly(1.23457e-12) == "1.23457e-12"
    assert show_p(1.23457e-12) == "< 0.001"


def test_bounds_have_a_unit_and_no_zeros() -> None:
    """Chance and ranges read as a person would write them."""
    assert show_bound(find_metric("accuracy"), 0.5) == "50 %"
    assert show_bound(find_metric("human_r"), -1) == f"{MINUS}1"
    assert unit_of(find_metric("human_gap")) == "points"


def test_a_missing_value_gets_the_number_of_its_reason() -> None:
    """The same reason has the same footnote wherever it applies; a value has none."""
    footnotes, metric = Footnotes(), find_metric("human_r")
    undefined = Score(value=None, why="all probabilities are equal")
    first = footnotes.cell(metric, undefined, absent="not covered")
    second = footnotes.cell(metric, None, absent="not covered")
    again = footnotes.cell(metric, undefined, absent="not covered")
    value = footnotes.cell(metric, Score(value=0.5), absent="not covered")
    assert [cell.note for cell in (first, second, again, value)] == [1, 2, 1, 0]
    assert footnotes.texts == ("undefined: all probabilities are equal", "not covered")
    assert (first.text, first.exact) == (ABSENT, "")
    assert (value.text, value.exact, value.why) == ("0.500", "0.500000", "")


@pytest.mark.parametrize(
    ("metric", "low", "high", "text"),
    [
        ("accuracy", 0.613281, 0.671908, f"61.3{EN_DASH}67.2"),
        ("human_gap", 0.009313, 0.072104, "+0.9 to +7.2"),
        ("human_r", 0.213076, 0.369143, f"0.213{EN_DASH}0.369"),
        ("human_r", -0.05, 0.16, f"{MINUS}0.050 to 0.160"),
        ("human_r", -0.0001, 0.16, f"0.000{EN_DASH}0.160"),
    ],
)
def test_an_interval_is_printed_as_its_value_is(metric: str, low: float, high: float, text: str) -> None:
    """A dash joins the ends only where no sign stands before one of them."""
    assert show_interval(find_metric(metric), Score(value=low, low=low, high=high)) == text


def test_what_has_no_interval_shows_none() -> None:
    """A p-value, an undefined score and one that is not there."""
    scores = (Score(value=0.01), Score(value=None, why="no trial"), None)
    assert [show_interval(find_metric("accuracy_p"), score) for score in scores] == ["", "", ""]
    assert Footnotes().cell(find_metric("accuracy_p"), scores[0], absent="").ends == ()


def test_a_cell_tells_its_interval_with_all_digits() -> None:
    """For a pointer that rests on it, and for programs that read the page."""
    score = Score(value=0.643229, low=0.613281, high=0.671908)
    cell = Footnotes().cell(find_metric("accuracy"), score, absent="")
    assert cell.ends == ("0.613281", "0.671908")
    assert cell.title == "0.643229, 95 % interval 0.613281 to 0.671908"
    assert (cell.note, cell.n_undefined) == (0, 0)


def test_one_footnote_tells_of_all_resamples_without_a_value() -> None:
    """It has their largest number; each cell keeps its own."""
    footnotes, metric = Footnotes(), find_metric("human_r")
    cells = [
        footnotes.cell(
            metric, Score(value=0.5, low=0.1, high=0.9, undefined_resamples=n or None), absent="not covered"
        )
        for n in (3, 0, 1200, 40)
    ]
    assert [cell.note for cell in cells] == [1, 0, 1, 1]
    assert footnotes.texts == ("resamples without a value are left out of the interval, 1,200 at most",)
    assert cells[2].title.endswith(", 1,200 resamples without a value")


def test_a_range_without_ends_is_unbounded() -> None:
    """Infinity is no number that a reader would look for."""
    assert show_range(find_metric("human_r_normalized")) == "unbounded"
    assert show_range(find_quantity("reliability")) == "at most 1"
    assert show_range(replace(find_quantity("ceiling"), high=inf)) == "at least 0"
    assert show_range(find_quantity("property_gain")) == f"{MINUS}100 points to 100 points"
