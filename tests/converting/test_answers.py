"""The one reader of YES and NO."""

import json
from collections import Counter
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.converting.answers import READER_VERSION, Reading, parse_answer
from leaderboard.submission import Status

LABELLED = Path(__file__).with_name("labelled_answers.jsonl")
N_RIGHT, N_WRONG_SIDE = 415, 2  # of 424, as docs/converting.md says


def load_labelled() -> list[dict[str, str]]:
    return [json.loads(line) for line in LABELLED.read_text(encoding="utf-8").splitlines()]


def test_accuracy_is_what_the_docs_say(repo_root: Path) -> None:
    """So many of the labelled answers are read right, so few on the wrong side, and the docs say it."""
    labelled = load_labelled()
    found = Counter((case["label"], parse_answer(case["text"]).value) for case in labelled)
    right = sum(n for (label, reading), n in found.items() if label == reading)
    wrong = sum(n for (label, reading), n in found.items() if label != reading and reading in ("yes", "no"))
    assert (len(labelled), right, wrong) == (424, N_RIGHT, N_WRONG_SIDE)
    docs = (repo_root / "docs/converting.md").read_text(encoding="utf-8")
    assert f"version {READER_VERSION} reads {N_RIGHT} of the {len(labelled)} as a person does" in docs
    assert f"On {N_WRONG_SIDE} it finds an answer where there is none" in docs
    assert f"the other {len(labelled) - right - wrong} it leaves unread" in docs


def test_labels_are_fair() -> None:
    """The set has at least 200 answers of many kinds, none twice, and no YES of it is ever read as NO."""
    labelled = load_labelled()
    assert len({case["text"] for case in labelled}) == len(labelled) >= 200
    assert len({case["kind"] for case in labelled}) >= 15
    opposite = {"yes": "no", "no": "yes"}
    assert [c for c in labelled if parse_answer(c["text"]).value == opposite.get(c["label"])] == []


@pytest.mark.parametrize("case", [c for c in load_labelled() if c["kind"] in ("tag", "thought", "language")])
def test_tags_thoughts_and_languages_are_read_without_fault(case: dict[str, str]) -> None:
    """These kinds have no known exceptions."""
    assert parse_answer(case["text"]).value == case["label"]


@pytest.mark.parametrize("thought", ["Yes.", "No.", "Is it yes? No, or yes.", "no no no", "Answer: yes"])
@pytest.mark.parametrize("answer", ["yes", "no"])
def test_first_match_is_never_taken(thought: str, answer: str) -> None:
    """Whatever is said before, the tag decides, and without a tag the final line."""
    assert parse_answer(f"{thought} <answer>{answer}</answer> {thought}").value == answer
    assert parse_answer(f"{thought}\n{thought}\nSo: {answer.upper()}.").value == answer
    assert parse_answer(f"<think>{thought}</think>{answer}").value == answer


@pytest.mark.parametrize("text", ["No yes", "Yes, or rather no, or maybe", "No or maybe. Yes and so on."])
def test_no_counts_before_another_answer(text: str) -> None:
    """NO is not overlooked because words follow it, so that the YES beside it would be all there is."""
    assert parse_answer(text) is Reading.UNPARSABLE


@pytest.mark.parametrize(
    ("reading", "status", "probability", "outcome"),
    [
        (Reading.YES, Status.ANSWERED, "1", True),
        (Reading.NO, Status.ANSWERED, "0", False),
        (Reading.REFUSED, Status.REFUSED, "", None),
        (Reading.UNPARSABLE, Status.UNPARSABLE, "", None),
        (Reading.ERROR, Status.ERROR, "", None),
    ],
)
def test_readings_become_lines_of_predictions(
    reading: Reading, status: Status, probability: str, outcome: bool | None
) -> None:
    """A side is a probability; anything else is a status."""
    assert (reading.status, reading.probability, reading.outcome) == (status, probability, outcome)


def test_version_is_a_number() -> None:
    """It goes up whenever a text could be read differently."""
    assert READER_VERSION == 1


@given(st.text(max_size=200))
def test_any_text_has_a_reading(text: str) -> None:
    """No text breaks the reader, and blanks around it never matter."""
    assert parse_answer(f" \n{text}\n ") == parse_answer(text)


@given(
    st.lists(
        st.sampled_from(["yes", "no", " or ", "/", ".", "\n", "not ", "answer is ", "<answer>"]), max_size=12
    )
)
def test_both_sides_are_never_told_apart_by_order_alone(parts: list[str]) -> None:
    """Exchanging the words YES and NO everywhere never gives the same side."""
    text = "".join(parts)
    exchanged = "".join({"yes": "no", "no": "yes"}.get(part, part) for part in parts)
    sides = {parse_answer(text).outcome, parse_answer(exchanged).outcome}
    assert sides not in ({True}, {False})


@pytest.mark.parametrize(
    "part",
    ["yes or ", "not ", "<answer>", r"\boxed{", "answer is ", '"answer":', "_", " ", "can't ", "no ", "\n"],
)
def test_hostile_text_takes_no_more_than_its_length(part: str) -> None:
    """A long text made for patterns to search in vain is read: in quadratic time it would take hours."""
    assert parse_answer(part * (200_000 // len(part))) in Reading
