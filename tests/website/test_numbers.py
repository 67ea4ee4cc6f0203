"""How scores are printed, and where a dash explains itself."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.grading import METRICS, find_metric
from leaderboard.models import Score
from leaderboard.website.numbers import (
    ABSENT,
    GAPS,
    MINUS,
    SHARES,
    Footnotes,
    printer_of,
    show_bound,
    show_exactly,
    show_p,
    unit_of,
)


def test_every_metric_named_here_is_in_the_table_of_metrics() -> None:
    """The lists of shares and gaps do not outlive a metric."""
    assert {*SHARES, *GAPS} <= {metric.name for metric in METRICS}


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
