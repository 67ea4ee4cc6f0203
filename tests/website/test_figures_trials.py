"""What is drawn trial by trial: calibration, model against people, pairs, and people themselves."""

import re
from dataclasses import replace

import numpy as np
import pytest

from builders import build_entry, build_reference
from leaderboard.models import Bin
from leaderboard.ranking import Entry
from leaderboard.website.figures import palette
from leaderboard.website.figures.calibration import SIDE, Diagram, draw_diagram
from leaderboard.website.figures.marks import Box, Cloud, Drawing, Point, Text
from leaderboard.website.figures.squares import AXIS_LEFT, AXIS_RIGHT
from leaderboard.website.figures.stacks import Stack, StackRow, draw_stack
from leaderboard.website.material import Material
from leaderboard.website.pair_figures import draw_pairs
from leaderboard.website.people_pages import NO_PEOPLE, compose_people
from leaderboard.website.trial_figures import draw_agreement, draw_calibrations
from site_builders import build_material


def marks_of(drawing: Drawing) -> tuple[list[Point], list[Box], list[Text], list[Cloud]]:
    layers = drawing.layers
    return (
        [point for layer in layers for point in layer.points],
        [box for layer in layers for box in layer.boxes],
        [text for layer in layers for text in layer.texts],
        [path for layer in layers for path in layer.paths if isinstance(path, Cloud)],
    )


def entry_of(material: Material, slug: str) -> Entry:
    return next(p.entry for p in material.publications if p.entry.slug == slug)


BINS = (
    Bin(upto=0.5, n=10, predicted=0.25, observed=0.5),
    Bin(upto=1.0, n=0, predicted=None, observed=None),
)


def test_bins_are_points_with_counts_below() -> None:
    """A point at both means with its interval; an empty bin has no point and the count 0."""
    drawing = draw_diagram(Diagram("key", "Title", "", BINS, [(0.25, 0.75), None], "YES was right"))
    points, boxes, texts, _ = marks_of(drawing)
    (point,) = points
    assert point.x == pytest.approx(AXIS_LEFT + 0.25 * (AXIS_RIGHT - AXIS_LEFT), abs=0.1)
    assert point.y == pytest.approx((SIDE[0] + SIDE[1]) / 2)
    assert point.title == "25.0 % submitted, 50.0 % observed (95 % interval 25.0–75.0), 10 trials"  # noqa: RUF001
    assert boxes[0].height == pytest.approx((SIDE[1] - SIDE[0]) / 2)
    assert {"10", "0"} <= {text.text for text in texts}
    assert point.title in drawing.description


def test_a_submission_has_both_diagrams(material: Material) -> None:
    """Toward the label and toward people, from the bins of its result, overall."""
    label, people = draw_calibrations(entry_of(material, "hostile"), material)
    bins = entry_of(material, "hostile").result.calibration["overall"].label
    filled = sum(bin_.n > 0 for bin_ in bins)
    assert [len(marks_of(drawing)[0]) for drawing in (label, people)] == [filled, filled]
    assert (label.title, people.title) == ("Toward the label", "Toward people")


def test_a_partial_submission_has_diagrams_of_what_it_covers(material: Material) -> None:
    """By property, or none at all where no property is whole."""
    titles = [drawing.title for drawing in draw_calibrations(entry_of(material, "part"), material)]
    assert titles == ["Toward the label, Beta", "Toward people, Beta"]
    assert draw_calibrations(entry_of(material, "sliver"), material) == ()


def test_every_trial_is_a_point_of_its_label(material: Material) -> None:
    """One cloud per label, in whole units, as many points as judged and answered trials."""
    entry = entry_of(material, "hostile")
    (drawing,) = draw_agreement(entry, material)
    no, yes = marks_of(drawing)[3]
    labels, people = material.reference.labels, material.reference.people
    assert people is not None
    assert (len(no.places), len(yes.places)) == ((labels == 0).sum(), (labels == 1).sum())
    assert (no.shape, yes.shape) == ("cross", "speck")
    first = int(np.flatnonzero(labels == 1)[0])
    x = round(AXIS_LEFT + people.n_yes[first] / people.n[first] * (AXIS_RIGHT - AXIS_LEFT))
    assert x in [place[0] for place in yes.places]


def test_agreement_is_said_in_words(material: Material) -> None:
    """Human r, its interval and its ceiling stand in caption and description; undefined with its reason."""
    (drawing,) = draw_agreement(entry_of(material, "hostile"), material)
    pattern = r"Human r: .?0\.\d{3}, 95 % interval .*; ceiling: 0\.\d{3}, 95 % interval"
    assert re.search(pattern, drawing.caption)
    assert re.search(pattern, drawing.description)
    (flat,) = draw_agreement(entry_of(material, "flat"), material)
    assert "Human r: undefined" in flat.description


def test_without_people_there_is_nothing_to_agree_with() -> None:
    """No scatter plot, and no diagram toward people."""
    reference = build_reference(n_people=0)
    entry = build_entry(reference, "one", [0.7] * reference.n_trials)
    material = build_material(reference, [entry])
    assert list(draw_agreement(entry, material)) == []
    assert [drawing.title for drawing in draw_calibrations(entry, material)] == ["Toward the label"]


def test_unanswered_trials_are_no_points() -> None:
    """A trial without an answer has no probability to show."""
    reference = build_reference()
    covered = (reference.properties == 1).tolist()
    entry = build_entry(reference, "part", [0.7] * reference.n_trials, covered=covered)
    (drawing,) = draw_agreement(entry, build_material(reference, [entry]))
    assert sum(len(cloud.places) for cloud in marks_of(drawing)[3]) == sum(covered)


def test_pairs_are_counted_like_their_metrics(material: Material) -> None:
    """Both right is the pair accuracy, right order the pair order, in every row."""
    reference = material.reference
    entry = entry_of(material, "hostile")
    right, apart = draw_pairs(entry, material)
    for drawing, metric in ((right, "pair_accuracy"), (apart, "pair_order")):
        found = re.findall(r"(\w+): (\d+) (?:both|right), (\d+) \w+, (\d+) \w+", drawing.description)
        assert [row[0] for row in found] == ["Overall", "Alpha", "Beta"]
        for title, *sizes in found:
            score = entry.score(metric, "overall" if title == "Overall" else title)
            assert score is not None
            if title != "Overall":  # the mean of the properties, not of their pairs
                first, total = int(sizes[0]), sum(int(size) for size in sizes)
                assert first / total == pytest.approx(score.value, abs=1e-6)
    assert len(reference.pair_ids) == sum(int(n) for n in re.findall(r"Overall: (\d+) pairs", right.caption))


def test_undecided_pairs_have_a_column_only_where_there_are_any(material: Material) -> None:
    """A submission that says 0.5 is neither right nor wrong."""
    (flat, _), (hostile, _) = (draw_pairs(entry_of(material, slug), material) for slug in ("flat", "hostile"))
    assert "0 both, 0 one, 0 none, 12 at 0.5" in flat.description
    assert "at 0.5" not in hostile.description


def test_a_partial_submission_has_pairs_of_what_it_covers(material: Material) -> None:
    """Of its properties, or of scenarios where no property is whole."""
    (part, _), (sliver, _) = (draw_pairs(entry_of(material, slug), material) for slug in ("part", "sliver"))
    assert part.description.startswith("Pairs. Beta: ")
    assert sliver.description.startswith("Pairs. alpha one: ")


def test_trials_without_partners_have_no_pairs() -> None:
    """Where no trial has a twin, nothing is drawn of pairs."""
    reference = build_reference()
    lone = replace(reference, pair_ids=reference.trial_ids, pairs=np.arange(reference.n_trials))
    entry = build_entry(lone, "one", [0.7] * lone.n_trials)
    assert list(draw_pairs(entry, build_material(lone, [entry]))) == []


def test_parts_of_a_bar_are_as_long_as_they_are_many() -> None:
    """Side by side and in proportion; an empty part has its number and no box."""
    stack = Stack("key", "Title", "", "pairs", ("a", "b", "c"), (StackRow("Mass", 1, (3, 0, 1)),))
    _, boxes, texts, _ = marks_of(draw_stack(stack))
    first, last = sorted((box for box in boxes if box.title), key=lambda box: box.x)
    assert first.width == pytest.approx(3 * last.width, abs=0.3)
    assert last.x == pytest.approx(first.x + first.width, abs=0.1)
    assert first.title == "Mass: 3 of 4 pairs a"
    assert [text.text for text in texts if text.text in "301"] == ["3", "0", "1"]


def test_people_are_counted_at_the_thresholds(material: Material) -> None:
    """As many trials above and below as the rule counts exactly; the lines stand at the rule's shares."""
    drawing = compose_people(material).drawings[0]
    reference, people = material.reference, material.reference.people
    assert people is not None
    right = np.where(reference.labels == 1, people.n_yes, people.n - people.n_yes)
    above, below = int((3 * right > 2 * people.n).sum()), int((3 * right < people.n).sum())
    words = [text.text for text in marks_of(drawing)[2]]
    assert {f"above 2/3: {above}", f"below 1/3: {below}"} <= set(words)
    points = [
        point for layer in drawing.layers if layer.ink is palette.PEOPLE_POINT for point in layer.points
    ]
    places = [AXIS_LEFT + share * (AXIS_RIGHT - AXIS_LEFT) for share in (1 / 3, 2 / 3)]
    assert [point.x for point in points] == pytest.approx(places, abs=0.1)


def test_the_page_of_people_says_how_many_there_were(material: Material) -> None:
    """People per trial, and the sizes of easy and hard, in words."""
    facts = {fact.title: fact.text for fact in compose_people(material).facts}
    assert facts["People per trial"] == "6 to 6, median 6; 24 judged trials"
    assert re.search(r"by more than 2/3 of the people\. \d+ trials in \d+ pairs\.$", facts["Easy"])


def test_people_have_a_table_of_their_own(material: Material) -> None:
    """How often they are right on each subset, and how well they agree, with intervals, by property."""
    table = compose_people(material).table
    assert table is not None
    assert [row.title for row in table.rows] == ["Overall", "Alpha", "Beta"]
    assert [column.title for column in table.columns] == [
        *("Accuracy", "Easy", "Hard", "Easy, cross-fitted", "Hard, cross-fitted", "YES rate"),
        *("Split-half r", "Reliability", "Reliability from counts", "Ceiling of human r"),
    ]
    ceiling = material.people_score("ceiling", "Beta", "all")
    assert ceiling is not None
    cell = table.rows[2].cells[-1]
    assert [float(number) for number in (cell.exact, *cell.ends)] == [
        ceiling.value,
        ceiling.low,
        ceiling.high,
    ]


def test_people_have_only_what_is_known_of_them() -> None:
    """Without single responses there are no halves; without human data there is no table."""
    counted = compose_people(build_material(build_reference(responses=False), [])).table
    assert counted is not None
    assert [column.title for column in counted.columns] == [
        *("Accuracy", "Easy", "Hard", "YES rate", "Reliability", "Ceiling of human r"),
    ]
    lonely = compose_people(build_material(build_reference(n_people=0), []))
    assert (lonely.summary, lonely.facts, lonely.drawings, lonely.table) == (NO_PEOPLE, (), (), None)
