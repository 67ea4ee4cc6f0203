"""What an unknown id was meant to be."""

import pytest

from builders import build_reference
from leaderboard.validation.suggestions import Suggestions

IDS = build_reference(32).trial_ids
SUGGESTIONS = Suggestions(IDS)


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("beta_one-copy1/set=a,b/0012 ", "remove the blanks around it"),
        ("\u00a0beta_one-copy1/set=a,b/0012", "remove the blanks around it"),
        (
            "Beta_one-copy1/set=a,b/0012",
            "write beta_one-copy1/set=a,b/0012: capitals and small letters differ",
        ),
        (
            "b\u0435ta_one-copy1/set=a,b/0012",
            (
                "character 2 is U+0435 CYRILLIC SMALL LETTER IE; ids are plain ASCII: "
                "did you mean beta_one-copy1/set=a,b/0012?"
            ),
        ),
        ("\ue000", "character 1 is U+E000 without a name; ids are plain ASCII"),
        ("beta_one-copy1/set=a,b/0012_img.mp4", "write its id, beta_one-copy1/set=a,b/0012"),
        ("bta_one-copy1/set=a,b/0012", "did you mean beta_one-copy1/set=a,b/0012?"),
        ("beta_one-copy1/set=a.b/0012", "did you mean beta_one-copy1/set=a,b/0012?"),
        ("0012", ""),
        ("", ""),
    ],
)
def test_an_unknown_id_is_explained(text: str, hint: str) -> None:
    """Blanks, capitals, look-alikes, decorations and slips of the finger each have their words."""
    assert SUGGESTIONS.explain(text) == hint


def test_a_name_that_fits_two_trials_is_not_guessed() -> None:
    """Both are named."""
    suggestions = Suggestions(("ramp_0001", "ramp-redyellow_0001"))
    assert suggestions.explain("ramp_0001_img") == (
        "it could be ramp-redyellow_0001 or ramp_0001; write one of these"
    )


@pytest.mark.parametrize("position", range(len(IDS[40])))
def test_one_wrong_character_never_hides_the_trial(position: int) -> None:
    """Wherever a letter is missing, the nearest id is still found or one equally near."""
    wrong = IDS[40][:position] + IDS[40][position + 1 :]
    assert SUGGESTIONS.explain(wrong).startswith(("did you mean ", "write alpha_one-copy0/set=a,b/00"))


def test_lost_leading_zeros_are_recognised() -> None:
    """A spreadsheet that turned 0002 into 2 is seen through."""
    assert SUGGESTIONS.explain("alpha_one-copy0/set=a,b/2") == (
        "write alpha_one-copy0/set=a,b/0002: leading zeros matter"
    )
