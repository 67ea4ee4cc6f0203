"""A published number: its columns, and the unit of what is printed."""

from fractions import Fraction
from typing import Any

import pytest
from pydantic import ValidationError

from leaderboard.metrics.published import Figure
from leaderboard.models.published import PublishedNumber, parse_figure


def make(**changes: Any) -> PublishedNumber:
    """A number with the least that it needs."""
    needed: dict[str, Any] = {
        "source": "A paper",
        "system": "A",
        "scope": "overall",
        "metric": "accuracy",
        "printed": "52.6",
    }
    return PublishedNumber(**(needed | changes))


@pytest.mark.parametrize(
    ("printed", "value", "step"),
    [
        ("52.6", Fraction(526, 1000), Fraction(1, 1000)),
        ("52.60", Fraction(526, 1000), Fraction(1, 10000)),
        ("60%", Fraction(6, 10), Fraction(1, 100)),
        ("60 %", Fraction(6, 10), Fraction(1, 100)),
        ("0.5%", Fraction(5, 1000), Fraction(1, 1000)),
        ("100", Fraction(1), Fraction(1, 100)),
        ("1.0", Fraction(1), Fraction(1, 10)),
        ("0.526", Fraction(526, 1000), Fraction(1, 1000)),
        ("0.12", Fraction(12, 100), Fraction(1, 100)),
        ("-0.12", Fraction(-12, 100), Fraction(1, 100)),
        ("-5", Fraction(-5, 100), Fraction(1, 100)),
        ("229/384", Fraction(229, 384), Fraction(0)),
    ],
)
def test_the_unit_follows_one_rule(printed: str, value: Fraction, step: Fraction) -> None:
    """A share k/n is exact; the sign or a value above 1 makes a percentage; anything else is as it stands."""
    assert parse_figure(printed) == Figure(value, step)


@pytest.mark.parametrize(
    "printed", ["", "about 60", "52,6", "1e2", "nan", "52.", ".5", "1/0", "+5", " 5", "\u0665"]
)
def test_what_is_no_figure_is_refused(printed: str) -> None:
    """The message says what a figure looks like."""
    with pytest.raises(ValueError, match=r"must be a number such as 52\.6, 60% or 0\.12, or a share such as"):
        parse_figure(printed)


@pytest.mark.parametrize("printed", ["100.1", "385/384", "526", "-101"])
def test_more_than_the_whole_is_refused(printed: str) -> None:
    """Nothing here can be above 100 %."""
    with pytest.raises(ValueError, match="is more than the whole"):
        parse_figure(printed)


def test_what_is_unknown_is_none() -> None:
    """Only source, system, scope, metric and the figure are needed."""
    number = make()
    assert (number.url, number.training, number.testing, number.n, number.note) == (
        None,
        None,
        None,
        None,
        "",
    )


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"printed": "-0.1"}, "printed is -0.1: an accuracy is not negative"),
        ({"printed": "1/200000"}, "printed is 1/200000: more than 100,000 trials"),
        ({"printed": "229/384", "n": 192}, "printed is 229/384, but n is 192"),
        ({"n": 0}, "greater than or equal to 1"),
        ({"n": 100_001}, "less than or equal to 100000"),
        ({"training": "supervised"}, "'separate', 'unified' or 'zero_shot'"),
        ({"metric": "Accuracy"}, "should match pattern"),
        ({"url": "ftp://x"}, "must start with https:// or http://"),
        ({"system": ""}, "must not be empty"),
        ({"rank": 1}, "Extra inputs are not permitted"),
    ],
)
def test_what_breaks_a_rule_is_refused(changes: dict[str, Any], message: str) -> None:
    """Each field keeps to its rule, and the figure to what is said beside it."""
    with pytest.raises(ValidationError, match=message):
        make(**changes)


def test_trials_are_those_of_the_printed_share() -> None:
    """198/384 speaks of 384 trials, although it is 33/64."""
    assert make(printed="198/384").n_trials == 384
    assert make(n=192).n_trials == 192
    assert make().n_trials is None
