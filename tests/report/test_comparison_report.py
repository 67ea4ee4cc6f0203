"""Two submissions side by side, as text and as JSON."""

import json
from dataclasses import replace

import numpy as np
import pytest

from builders import build_metadata, build_reference, build_submission
from leaderboard.comparing import Comparison, compare
from leaderboard.metrics.resampling import Interval
from leaderboard.report.comparison import render_comparison, render_comparison_json

REFERENCE = build_reference(8)
NAMES = {"with-it": "With", "without-it": "Without"}


def _compare(*, order: int = 1, testing: str = "without_property") -> Comparison:
    """Compare one system tested with property inference and, unless said otherwise, without."""
    rng = np.random.default_rng(1)
    protocols = {"with-it": "with_property", "without-it": testing}
    two = [
        replace(
            build_submission(REFERENCE, rng.random(REFERENCE.n_trials).round(2).tolist()),
            slug=slug,
            metadata=build_metadata(testing=protocol),
        )
        for slug, protocol in protocols.items()
    ]
    a, b = two[::order]
    return compare(a, b, REFERENCE)


def test_the_table_has_the_numbers_of_the_comparison() -> None:
    """Accuracies, difference with its interval, p and pairs of overall, in one line."""
    comparison = _compare()
    text = render_comparison(comparison, REFERENCE, NAMES)
    scope = comparison.scopes[0]
    line = next(line for line in text.splitlines() if line.startswith(" overall"))
    d, o = scope.difference, scope.overlap
    assert line.split() == [
        *("overall", f"{100 * scope.accuracy_a:.1f}", f"{100 * scope.accuracy_b:.1f}"),
        *(f"{100 * d.value:+.1f}", f"{100 * d.low:+.1f}", "to", f"{100 * d.high:+.1f}", f"{scope.p:.3f}"),
        *f"{o.n_pairs_a} / {o.n_pairs_b} / {o.n_pairs_equal}".split(),
    ]
    assert text.startswith("A  With  with-it\nB  Without  without-it\n")
    assert "SYNTHETIC reference" in text


def test_noise_behind_six_decimals_decides_no_digit() -> None:
    """As in JSON and on the website: rounded first, half to even then, and no negative zero."""
    comparison = _compare()
    scope = replace(
        comparison.scopes[0],
        difference=Interval(-1e-9, -0.012500000000000011, 0.002500000000000001),
        human_r_difference=Interval(-1e-9, -0.06250000000000025, 0.06250000000000025),
        kappa=0.06250000000000025,
    )
    text = render_comparison(replace(comparison, scopes=(scope,)), REFERENCE, NAMES)
    accuracy, agreement = (line.split() for line in text.splitlines() if line.startswith(" overall"))
    assert accuracy[3:7] == ["+0.0", "-1.2", "to", "+0.2"]
    assert agreement[1:] == ["+0.000", "-0.062", "to", "+0.062", "0.062"]


@pytest.mark.parametrize(("order", "difference"), [(1, "A-B"), (-1, "B-A")])
def test_one_system_with_and_without_inference_is_told_to_be_its_gain(order: int, difference: str) -> None:
    """Whichever is named first."""
    comparison = _compare(order=order)
    text = render_comparison(comparison, REFERENCE, NAMES)
    assert comparison.property_gain == difference
    assert f"{difference} is the property gain: one system, with and without inference." in text


def test_two_of_one_protocol_have_no_gain() -> None:
    """Neither in text nor in JSON."""
    comparison = _compare(testing="with_property")
    assert "property gain" not in render_comparison(comparison, REFERENCE, NAMES)
    assert json.loads(render_comparison_json(comparison))["property_gain"] is None


def test_json_has_six_decimals_and_all_scopes() -> None:
    """The same numbers for programs."""
    comparison = _compare()
    data = json.loads(render_comparison_json(comparison))
    assert data["property_gain"] == "A-B"
    assert [scope["name"] for scope in data["scopes"]] == [scope.name for scope in comparison.scopes]
    for laid_out, scope in zip(data["scopes"], comparison.scopes, strict=True):
        assert laid_out["difference"]["low"] == round(scope.difference.low, 6)
        assert laid_out["p"] == scope.p
