"""The page that explains every number."""

import pytest

from builders import build_reference
from leaderboard.grading import METRICS
from leaderboard.website.material import Material
from leaderboard.website.methods import compose_method
from leaderboard.website.numbers import ABSENT, MINUS
from leaderboard.website.quantities import OF_BOARDS, OF_COMPARISONS, OF_PEOPLE, Described
from site_builders import build_material, parse_html, text_of


def test_every_metric_is_explained(files: dict[str, bytes]) -> None:
    """Each metric, and each number beside them, has a row that links can point at, with its meaning."""
    rows = {
        row.get("id"): text_of(row) for row in parse_html(files["method.html"]).iter("tr") if row.get("id")
    }
    explained: tuple[Described, ...] = (*METRICS, *OF_BOARDS, *OF_COMPARISONS, *OF_PEOPLE)
    assert list(rows) == [quantity.name for quantity in explained]
    for quantity in explained:
        assert " ".join(quantity.meaning.split()) in rows[quantity.name]


@pytest.mark.parametrize(
    ("name", "direction", "range_", "chance"),
    [
        ("accuracy", "higher is better", "0 % to 100 %", "50 %"),
        ("human_r", "higher is better", f"{MINUS}1 to 1", "0"),
        ("brier", "lower is better", "0 to 1", "0.25"),
        ("yes_rate", "neither end is better", "0 % to 100 %", "50 %"),
        ("ece", "lower is better", "0 to 1", ABSENT),
        ("human_r_normalized", "higher is better", "unbounded", "0"),
        ("human_ece", "lower is better", "0 to 1", ABSENT),
        ("best_probability", "higher is better", "0 % to 100 %", ABSENT),
        ("reliability", "neither end is better", "at most 1", "0"),
    ],
)
def test_direction_range_and_chance(
    material: Material, name: str, direction: str, range_: str, chance: str
) -> None:
    """They are printed in the metric's own unit."""
    page = compose_method(material)
    (entry,) = [metric for metric in (*page.metrics, *page.others) if metric.name == name]
    assert (entry.direction, entry.range, entry.chance) == (direction, range_, chance)


def test_easy_and_hard_are_explained_only_where_there_are_people(material: Material) -> None:
    """The bounds are those of the benchmark's definition."""
    terms = {term.title: term.text for term in compose_method(material).terms}
    assert terms["Easy"].endswith("by more than 2/3 of the people.")
    assert terms["Hard"].endswith("by fewer than 1/3 of the people.")
    lonely = compose_method(build_material(build_reference(n_people=0), []))
    assert {"Easy", "Hard"}.isdisjoint(term.title for term in lonely.terms)
    counted = compose_method(build_material(build_reference(responses=False), []))
    assert "Easy, cross-fitted" in terms
    assert "Easy" in [term.title for term in counted.terms]
    assert "Easy, cross-fitted" not in [term.title for term in counted.terms]


def test_terms_say_how_sure_numbers_are(material: Material) -> None:
    """How intervals are made, and that people of cross-fitted subsets are not drawn."""
    terms = {term.title: term.text for term in compose_method(material).terms}
    assert "percentile bootstrap over pairs of trials within scenarios" in terms["Interval"]
    assert terms["Interval"].endswith("nobody may be in both halves.")
    assert {"Rank set", "Among the best"} <= terms.keys()


def test_people_are_explained_only_where_there_are_any() -> None:
    """Without human data nothing is said of how well people agree."""
    lonely = compose_method(build_material(build_reference(n_people=0), []))
    assert "ceiling" not in [entry.name for entry in lonely.others]


def test_nothing_is_promised_for_later(files: dict[str, bytes]) -> None:
    """What is not there is not spoken of; only a board may wait for its first submission."""
    found = {path for path, content in files.items() if path.endswith(".html") and b" yet" in content}
    assert found == set()
