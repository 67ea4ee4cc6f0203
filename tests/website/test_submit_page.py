"""The page that says how to submit: its example is valid, its answers are the validator's."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from builders import build_reference
from leaderboard.problems import CODES as KNOWN
from leaderboard.reference import Reference
from leaderboard.submission import RawFile, RawSubmission
from leaderboard.validation import validate
from leaderboard.website.submit_pages import EVER, SubmitPage, compose_submit
from site_builders import build_material, parse_html, text_of

CODES = {
    "Columns separated by semicolons": "wrong-separator",
    "A decimal comma": "probability-decimal-comma",
    "A percentage": "probability-percent",
    "A score instead of a probability": "probability-out-of-range",
    "No number": "probability-missing",
    "A letter too many in an id": "unknown-trial",
    "A trial left out": "missing-trials",
    "A trial given twice": "duplicate-trial",
}


@pytest.fixture(scope="module")
def reference() -> Reference:
    return build_reference()


@pytest.fixture(scope="module")
def page(reference: Reference) -> SubmitPage:
    return compose_submit(build_material(reference))


def test_every_mistake_gets_its_answer(page: SubmitPage) -> None:
    """The code, the place and what would be right, as on a terminal; one answer each."""
    assert {mistake.title: mistake.answer.split(": ")[1] for mistake in page.mistakes} == CODES
    assert set(CODES.values()) <= set(KNOWN)
    for mistake in page.mistakes:
        said, hint = mistake.answer.splitlines()
        assert said.startswith("predictions.csv:")
        assert hint.startswith("    ")


def test_the_line_that_is_shown_is_the_one_that_is_wrong(page: SubmitPage, reference: Reference) -> None:
    """Of a file that is otherwise valid, with the ids of this reference in quotes where they need them."""
    lines = {mistake.title: mistake.line for mistake in page.mistakes}
    quoted = f'"{reference.trial_ids[0]}"'
    assert lines["Columns separated by semicolons"] == f"{reference.trial_ids[0]};0.5"
    assert lines["A decimal comma"] == f'{quoted},"0,73"'
    assert lines["A letter too many in an id"] == f'"{reference.trial_ids[0]}x",0.5'
    assert lines["A trial left out"] == f'"{reference.trial_ids[1]}",0.6'


def test_the_example_is_the_beginning_of_a_valid_file(page: SubmitPage, reference: Reference) -> None:
    """Whoever goes on like this has nothing to mend."""
    more = [f'"{trial_id}",0.25' for trial_id in reference.trial_ids[3:]]
    content = "\n".join([*page.example.splitlines(), *more, ""]).encode()
    file = RawFile("predictions.csv", "file", len(content), content)
    found = validate(RawSubmission("predictions.csv", None, (file,)), reference, today=EVER)
    assert found.submission is not None
    assert found.submission.covered.all()
    assert [problem for problem in found.problems if problem.is_error] == []


def test_it_says_how_much_is_asked_and_for_which_board(page: SubmitPage) -> None:
    """Each property with its file, each track with the protocol that leads there."""
    assert [(fact.title, fact.text) for fact in page.sizes] == [
        ("Alpha", "16 trials in 2 scenarios: reference/Alpha.csv"),
        ("Beta", "8 trials in 1 scenario: reference/Beta.csv"),
    ]
    assert [(fact.title, fact.text) for fact in page.tracks] == [
        ("With", 'testing = "with_property"'),
        ("Without", 'testing = "without_property"'),
    ]
    assert "for each of 24 trials," in page.summary


def test_a_track_for_all_says_so(reference: Reference) -> None:
    """No protocol is asked for where a track asks for none."""
    track = reference.benchmark.tracks[0].model_copy(update={"testing": None})
    open_to_all = reference.benchmark.model_copy(update={"tracks": (track,)})
    page = compose_submit(build_material(replace(reference, benchmark=open_to_all), []))
    assert [fact.text for fact in page.tracks] == ["any protocol"]


def test_everything_is_on_the_page(files: dict[str, bytes], page: SubmitPage) -> None:
    """Answers keep their lines, and commands can be copied."""
    shown = parse_html(files["submit.html"])
    blocks = ["".join(block.itertext()) for block in shown.iter("pre")]
    assert blocks == [f"{page.example}…", *(mistake.answer for mistake in page.mistakes)]
    commands = {text_of(code) for code in shown.iter("code")}
    assert {step.text for step in page.steps} <= commands
    assert b'href="submit.html"' in files["index.html"]


def test_what_is_no_mistake_is_not_shown_as_one() -> None:
    """Where a scenario has one trial, leaving it out leaves all of the scenario out, which is allowed."""
    whole = build_reference(1, n_people=0)
    kept = np.flatnonzero((whole.copies == 0) | (whole.scenarios > 0))
    names = ("properties", "scenarios", "pairs", "copies", "labels")
    arrays: dict[str, Any] = {name: getattr(whole, name)[kept] for name in names}
    reference = replace(whole, trial_ids=tuple(whole.trial_ids[index] for index in kept), **arrays)
    titles = {mistake.title for mistake in compose_submit(build_material(reference, [])).mistakes}
    assert titles == CODES.keys() - {"A trial left out"}
