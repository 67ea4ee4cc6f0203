"""What a submission may say of itself."""

import datetime as dt
from copy import deepcopy
from typing import Any

import pytest
from pydantic import ValidationError

from leaderboard.models import Metadata

VALID: dict[str, dict[str, Any]] = {
    "submission": {
        "name": "SlotFormer",
        "system": "slotformer",
        "team": "Example Lab",
        "date": dt.date(2026, 11, 21),
        "description": "",
    },
    "protocol": {"training": "separate", "testing": "with_property"},
    "model": {"family": "object-centric", "inputs": "rgb"},
    "links": {"paper": "https://example.org/a?b=c"},
    "contact": {"github": "some-one"},
}


def test_the_smallest_metadata_is_accepted() -> None:
    """Only what SPEC calls optional may be left out."""
    metadata = Metadata.model_validate({key: value for key, value in VALID.items() if key != "links"})
    assert not metadata.is_baseline


@pytest.mark.parametrize(
    ("section", "key", "value", "message"),
    [
        ("submission", "name", " ", "must not be empty"),
        ("submission", "name", "a\u202eb", "U\\+202E RIGHT-TO-LEFT OVERRIDE at position 2"),
        ("submission", "name", "a\x1b[31m", "U\\+001B control character at position 2"),
        ("submission", "name", "e\u0301", "composed form"),
        ("submission", "name", "a\u3164", "U\\+3164 HANGUL FILLER at position 2"),
        ("submission", "name", "a\ufe0f", "U\\+FE0F VARIATION SELECTOR-16 at position 2"),
        ("submission", "name", "a\uffff", "U\\+FFFF character that shows nothing at position 2"),
        ("submission", "name", "x" + "\u0336" * 5, "stacks more than 4 marks at position 6"),
        ("submission", "name", "x" * 81, "at most 80 characters"),
        ("submission", "description", "x" * 1001, "at most 1000 characters"),
        ("submission", "system", "Slot Former", "should match pattern"),
        ("submission", "date", "2026-11-21", "valid date"),
        ("protocol", "training_trials", -1, "greater than or equal to 0"),
        ("protocol", "training", "few-shot", "'separate', 'unified' or 'zero_shot'"),
        ("links", "paper", "javascript:alert(1)", "must start with https"),
        ("links", "paper", "https://user:word@example.org", "user name or password"),
        ("links", "paper", 'https://example.org/"><script>', "characters that a link must write as %XX"),
        ("links", "paper", "https://[", "is not a link"),
        ("contact", "github", "-x", "should match pattern"),
        ("contact", "github", "a--b", "should match pattern"),
    ],
)
def test_values_that_no_page_should_show(section: str, key: str, value: object, message: str) -> None:
    """Hostile or mistaken values are refused with a reason."""
    content = deepcopy(VALID)
    content[section][key] = value
    with pytest.raises(ValidationError, match=message):
        Metadata.model_validate(content)
