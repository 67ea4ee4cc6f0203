"""What errata may say."""

from typing import Any

import pytest
from pydantic import ValidationError

from leaderboard.models import Errata
from leaderboard.models.metadata import MAX_TEXT_LENGTH

ACCEPT = {"code": "reference-equal-labels", "reason": "Kept as released."}
DROP = {"trial_id": "a/0001", "reason": "The video is empty."}


def test_errata_may_be_empty() -> None:
    """A file without entries accepts and drops nothing."""
    assert Errata.model_validate({}) == Errata()


def test_reasons_are_found_by_trial() -> None:
    """Each dropped trial has its reason, and `where` may be left out."""
    errata = Errata.model_validate({"accept": [ACCEPT], "drop": [DROP]})
    assert errata.reasons == {"a/0001": "The video is empty."}
    assert errata.accept[0].where == ""


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ({"accept": [{"code": "reference-copies"}]}, "accept.0.reason\n  Field required"),
        ({"drop": [{"trial_id": "a/0001"}]}, "drop.0.reason\n  Field required"),
        ({"drop": [DROP | {"reason": ""}]}, "must not be empty, nor start or end with a blank"),
        ({"drop": [DROP | {"reason": " because"}]}, "must not be empty, nor start or end with a blank"),
        ({"drop": [DROP | {"reason": "a\u202eb"}]}, "has U\\+202E RIGHT-TO-LEFT OVERRIDE at position 2"),
        ({"drop": [DROP | {"reason": "a\nb"}]}, "has U\\+000A control character at position 2"),
        ({"drop": [DROP | {"reason": "x" * (MAX_TEXT_LENGTH + 1)}]}, "at most 1000 characters"),
        ({"drop": [DROP, DROP]}, "the trial a/0001 is dropped twice"),
        ({"drop": [DROP | {"label": 1}]}, "Extra inputs are not permitted"),
        ({"accept": [ACCEPT | {"where": 3}]}, "Input should be a valid string"),
        ({"rename": []}, "Extra inputs are not permitted"),
    ],
)
def test_errata_are_strict(content: dict[str, Any], message: str) -> None:
    """An entry needs a reason in plain text, and nothing is said that means nothing."""
    with pytest.raises(ValidationError, match=message):
        Errata.model_validate(content)
