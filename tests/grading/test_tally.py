"""From estimates to scores: averages over properties, and how numbers are rounded."""

from collections.abc import Mapping
from math import copysign

import numpy as np
import pytest

from leaderboard.grading.tally import Tally
from leaderboard.metrics.undefined import Estimate, Undefined
from leaderboard.models import Score, SubsetScores

COUNTS = {"n": 8, "n_pairs": 4, "n_rated": 8}
EVENLY = np.linspace(0, 1, 41)


def tally_of(**estimates: Mapping[str, Estimate]) -> Tally:
    """Tally the whole of some properties, every value that is defined with resamples around it."""
    tally = Tally(tuple(estimates))
    for name, of_metrics in estimates.items():
        drawn = {m: v + EVENLY for m, v in of_metrics.items() if not isinstance(v, Undefined)}
        tally.add((name, "all"), COUNTS, of_metrics, drawn)
    return tally


def overall(tally: Tally) -> SubsetScores:
    tally.average()
    return tally.assemble(["overall"])["overall"]["all"]


def score(metric: str, estimate: Estimate, resampled: np.ndarray | None = None) -> Score:
    """Turn one estimate into a score."""
    tally = Tally(("Alpha",))
    drawn = {} if resampled is None else {metric: resampled}
    tally.add(("Alpha", "all"), COUNTS, {metric: estimate}, drawn)
    return tally.assemble(["Alpha"])["Alpha"]["all"].metrics[metric]


@pytest.mark.parametrize("resampled", [None, np.full(41, -1e-9)], ids=["alone", "with an interval"])
def test_no_number_is_minus_zero(resampled: np.ndarray | None) -> None:
    """What is rounded to 0 from below is 0, in values and in the ends of intervals."""
    found = score("human_gap", -1e-9, resampled)
    ends = [end for end in (found.value, found.low, found.high) if end is not None]
    assert ends == [0] * (1 if resampled is None else 3)
    assert [copysign(1, end) for end in ends] == [1] * len(ends)


def test_numbers_have_six_decimals_and_small_p_values_six_digits() -> None:
    """Only a p-value that six decimals would make 0 keeps its digits."""
    assert score("brier", 0.12345649).value == 0.123456
    assert score("brier", 4.9e-7).value == 0
    assert score("accuracy_p", 0.12345649).value == 0.123456
    assert score("accuracy_p", 1.23456789e-7).value == 1.23457e-7
    assert score("accuracy_p", 6e-7).value == 1e-6
    found = score("brier", 0.25, EVENLY / 3)
    assert (found.value, found.low, found.high) == (0.25, 0.008333, 0.325)


def test_resamples_without_a_value_are_told_only_where_there_are_any() -> None:
    """Where no resample has a value, the value stands without an interval."""
    assert score("human_r", 0.5, EVENLY).undefined_resamples is None
    found = score("human_r", 0.5, np.append(EVENLY, [np.nan, np.nan]))
    assert (found.low, found.high, found.undefined_resamples) == (0.025, 0.975, 2)
    alone = score("human_r", 0.5, np.full(3, np.nan))
    assert (alone.value, alone.low, alone.high, alone.undefined_resamples) == (0.5, None, None, None)


def test_overall_averages_values_and_resamples_and_adds_counts() -> None:
    """Of values 0 and 1/2, the resamples between v and v + 1, the mean is 1/4, and so the interval."""
    found = overall(tally_of(Alpha={"brier": 0.0}, Beta={"brier": 0.5}, Gamma={"brier": 0.25}))
    brier = found.metrics["brier"]
    assert (brier.value, brier.low, brier.high) == (0.25, 0.275, 1.225)
    assert (found.n, found.n_pairs, found.n_rated) == (24, 12, 24)


def test_the_average_of_one_property_is_its_own() -> None:
    """A benchmark may have no more than one."""
    brier = overall(tally_of(Alpha={"brier": 0.5})).metrics["brier"]
    assert (brier.value, brier.low, brier.high) == (0.5, 0.525, 1.475)


def test_what_one_property_lacks_is_not_overall() -> None:
    """Neither a metric nor a subset, whichever property lacks it; the rest is."""
    for names in (("Alpha", "Beta"), ("Beta", "Alpha")):
        whole, part = names
        estimates: dict[str, dict[str, Estimate]] = {whole: {"brier": 0.0, "ece": 0.5}, part: {"brier": 0.5}}
        tally = tally_of(**{name: estimates[name] for name in ("Alpha", "Beta")})
        tally.add((whole, "easy"), COUNTS, {"brier": 0.1}, {})
        for name in names:
            tally.add((name, "hard"), COUNTS, {"brier": 0.2}, {})
        tally.average()
        assert list(tally.assemble(["overall"])["overall"]) == ["all", "hard"]
        assert list(tally.estimates["overall"]["all"]) == ["brier"]


def test_an_average_of_what_has_resamples_in_one_property_only_has_no_interval() -> None:
    """The mean over one of two properties would not be that of both."""
    tally = Tally(("Alpha", "Beta"))
    tally.add(("Alpha", "all"), COUNTS, {"brier": 0.0}, {"brier": EVENLY})
    tally.add(("Beta", "all"), COUNTS, {"brier": 0.5}, {})
    brier = overall(tally).metrics["brier"]
    assert (brier.value, brier.low, brier.high) == (0.25, None, None)


@pytest.mark.parametrize(
    ("alpha", "beta", "why"),
    [
        (Undefined("x"), Undefined("x"), "x"),
        (Undefined("x"), Undefined("y"), "Alpha: x"),
        (Undefined("x"), 0.5, "Alpha: x"),
        (0.5, Undefined("y"), "Beta: y"),
    ],
)
def test_an_undefined_average_says_which_property_is_to_blame(
    alpha: Estimate, beta: Estimate, why: str
) -> None:
    """The first; a reason that all share stands alone."""
    found = overall(tally_of(Alpha={"human_r": alpha}, Beta={"human_r": beta})).metrics["human_r"]
    assert (found.value, found.low, found.why) == (None, None, why)


def test_a_tally_that_keeps_no_resamples_gives_the_same_scores() -> None:
    """Adding to the totals leaves the resamples that were given as they are."""
    kept, dropped = (Tally(("Alpha", "Beta"), keeps_resamples=keeps) for keeps in (True, False))
    given = EVENLY.copy()
    for tally in (kept, dropped):
        for name in ("Alpha", "Beta"):
            tally.add((name, "all"), COUNTS, {"brier": 0.5}, {"brier": given})
        tally.average()
    assert given.tolist() == EVENLY.tolist()
    scopes = ["overall", "Beta", "Alpha"]
    assert kept.assemble(scopes) == dropped.assemble(scopes)
    assert list(kept.assemble(scopes)) == scopes
    assert kept.resampled.keys() == {(scope, "all", "brier") for scope in scopes}
    assert not dropped.resampled
