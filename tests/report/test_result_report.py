"""One submission's result as a terminal table."""

import re

import numpy as np
import pytest

from builders import build_metadata, build_reference, build_submission
from leaderboard.grading import grade, grade_people
from leaderboard.models import Check
from leaderboard.reference import Reference
from leaderboard.report.result import render_result
from leaderboard.report.terminal import ABSENT, Terminal


@pytest.fixture(scope="module")
def reference() -> Reference:
    """Build a small reference with people."""
    return build_reference()


def _render(reference: Reference, probabilities: list[float], **arguments: object) -> str:
    covered = arguments.pop("covered", None)
    checks = arguments.pop("checks", ())
    submission = build_submission(reference, probabilities, answered=covered, covered=covered)  # type: ignore[arg-type]
    result = grade(submission, reference, checks=checks)  # type: ignore[arg-type]
    return render_result(result, reference, grade_people(reference), **arguments)  # type: ignore[arg-type]


def test_people_stand_beside_the_model(reference: Reference) -> None:
    """Each row has the model's accuracy, people's on the same trials, and the gap between them."""
    text = _render(reference, np.where(reference.labels == 1, 0.9, 0.1).tolist())
    people = grade_people(reference)["overall"]["all"].metrics["accuracy"]
    assert people.value is not None
    assert people.low is not None
    assert people.high is not None
    row = next(line for line in text.splitlines() if line.strip().startswith("overall"))
    assert row.split()[:10] == [
        *("overall", "24", "100.0*", "100.0", "to", "100.0", f"{100 * people.value:.1f}"),
        *(f"{100 * people.low:.1f}", "to", f"{100 * people.high:.1f}"),
    ]
    assert f"{100 * (1 - people.value):+.1f} ▲" in row
    assert "▲" in row


def test_a_partial_submission_says_what_is_missing(reference: Reference) -> None:
    """No overall row, and the reason in the heading."""
    covered = reference.in_property("Beta").tolist()
    text = _render(reference, [0.9] * reference.n_trials, covered=covered)
    assert "8 of 24 trials, 8 answered; 1 of 2 properties complete" in text
    assert "Partial: without all properties there is no overall score and no rank." in text
    assert "overall" not in text.replace("no overall score", "")


def test_undefined_values_are_dashes_with_their_reason(reference: Reference) -> None:
    """Constant predictions have no correlation, and the legend says so."""
    text = _render(reference, [0.5] * reference.n_trials)
    assert "undefined: all probabilities are equal" in text
    assert "nan" not in text.lower()


def test_without_people_there_are_no_human_columns() -> None:
    """Neither easy nor hard nor agreement."""
    bare = build_reference(n_people=0)
    text = _render(bare, [0.9] * bare.n_trials)
    assert "agreement with people" not in text
    assert "easy" not in text


def test_checks_and_names_are_shown(reference: Reference) -> None:
    """The system's name and protocol head the table, warnings end it."""
    check = Check(code="swapped-copies", message="the wrong way round")
    text = _render(
        reference, [0.9] * reference.n_trials, checks=[check], metadata=build_metadata("[b]Bold[/b]")
    )
    assert text.startswith("[b]Bold[/b]  Team; training separate, testing with_property")
    assert "warning: swapped-copies: the wrong way round" in text


def test_numbers_are_never_cut(reference: Reference) -> None:
    """However narrow the terminal, every number of the wide table is there."""
    probabilities = np.random.default_rng(0).random(reference.n_trials).tolist()
    wide = _render(reference, probabilities, terminal=Terminal(200))
    narrow = _render(reference, probabilities, terminal=Terminal(40))
    numbers = re.compile(r"[-+]?[0-9]+\.[0-9]+")
    assert sorted(numbers.findall(narrow)) == sorted(numbers.findall(wide))


def test_intervals_ceiling_and_cross_fitted_trials_are_shown(reference: Reference) -> None:
    """Beside r its interval, the ceiling and the share of it; easy and hard a second time, cross-fitted."""
    probabilities = np.random.default_rng(4).random(reference.n_trials).tolist()
    lines = _render(reference, probabilities, terminal=Terminal(200)).splitlines()
    result = grade(build_submission(reference, probabilities), reference)
    ceiling = grade_people(reference)["Alpha"]["all"].metrics["ceiling"].value
    r = result.scores["Alpha"]["all"].metrics["human_r"]
    place = next(i for i, line in enumerate(lines) if "agreement with people" in line)
    alpha = next(line.split() for line in lines[place:] if line.startswith(" Alpha"))
    assert alpha[1:6] == [
        f"{r.value:.3f}",
        f"{r.low:.3f}",
        "to",
        f"{r.high:.3f}",
        f"{ceiling:.3f}" if ceiling else ABSENT,
    ]
    place = next(i for i, line in enumerate(lines) if "the same, cross-fitted" in line)
    alpha = next(line.split() for line in lines[place:] if line.startswith(" Alpha"))
    easy = result.scores["Alpha"]["easy_crossfit"]
    assert easy.metrics["accuracy"].value is not None
    assert alpha[1:3] == [f"{easy.n:.0f}", f"{100 * easy.metrics['accuracy'].value:.1f}"]
    assert (
        "95 %: bootstrap over pairs within scenarios and people, 200 resamples; for all numbers: --json."
        in lines
    )
