"""The page that explains every number."""

import pytest

from builders import build_reference
from leaderboard.grading import METRICS
from leaderboard.website.material import Material
from leaderboard.website.methods import compose_method
from leaderboard.website.numbers import ABSENT, MINUS
from site_builders import build_material, parse_html, text_of


def test_every_metric_is_explained(files: dict[str, bytes]) -> None:
    """Each metric has a row that links can point at, with its meaning."""
    rows = {
        row.get("id"): text_of(row) for row in parse_html(files["method.html"]).iter("tr") if row.get("id")
    }
    assert list(rows) == [metric.name for metric in METRICS]
    for metric in METRICS:
        assert " ".join(metric.meaning.split()) in rows[metric.name]


@pytest.mark.parametrize(
    ("name", "direction", "range_", "chance"),
    [
        ("accuracy", "higher is better", "0 % to 100 %", "50 %"),
        ("human_r", "higher is better", f"{MINUS}1 to 1", "0"),
        ("brier", "lower is better", "0 to 1", "0.25"),
        ("yes_rate", "neither end is better", "0 % to 100 %", "50 %"),
        ("ece", "lower is better", "0 to 1", ABSENT),
    ],
)
def test_direction_range_and_chance(
    material: Material, name: str, direction: str, range_: str, chance: str
) -> None:
    """They are printed in the metric's own unit."""
    (entry,) = [metric for metric in compose_method(material).metrics if metric.name == name]
    assert (entry.direction, entry.range, entry.chance) == (direction, range_, chance)


def test_easy_and_hard_are_explained_only_where_there_are_people(material: Material) -> None:
    """The bounds are those of the benchmark's definition."""
    terms = {term.title: term.text for term in compose_method(material).terms}
    assert terms["Easy"].endswith("by more than 2/3 of the people.")
    assert terms["Hard"].endswith("by fewer than 1/3 of the people.")
    lonely = compose_method(build_material(build_reference(n_people=0), []))
    assert {"Easy", "Hard"}.isdisjoint(term.title for term in lonely.terms)
