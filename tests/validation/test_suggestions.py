"""What an unknown id was meant to be."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

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
        (
            "beta_one-\u0441opy1/set=a,b/0012",
            (
                "character 10 is U+0441 CYRILLIC SMALL LETTER ES; ids are plain ASCII: it could be "
                "beta_one-copy0/set=a,b/0012, beta_one-copy1/set=a,b/0012 or one of 4 others; "
                "write one of these"
            ),
        ),
        ("\ue000", "character 1 is U+E000 without a name; ids are plain ASCII"),
        ("beta_one-copy1/set=a,b/0012_img.mp4", "write its id, beta_one-copy1/set=a,b/0012"),
        ("beta_one-copy1_mp4/set=a,b/0012_cue.webm", "write its id, beta_one-copy1/set=a,b/0012"),
        ("D:\\my data\\beta_one-copy1\\set=a,b\\0012.npy", "write its id, beta_one-copy1/set=a,b/0012"),
        (
            "https://example.com/beta_one-copy1/set%3Da%2Cb/0012_img.mp4",
            "write its id, beta_one-copy1/set=a,b/0012",
        ),
        (
            "beta_one/set=a,b/0012_img.mp4",
            "it could be beta_one-copy0/set=a,b/0012 or beta_one-copy1/set=a,b/0012; write one of these",
        ),
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


def test_of_many_trials_the_most_similar_are_named() -> None:
    """The others are counted, so that the hint stays short."""
    assert SUGGESTIONS.explain("set=a,b/0012_img.mp4") == (
        "it could be alpha_one-copy0/set=a,b/0012, alpha_one-copy1/set=a,b/0012 or one of 4 others; "
        "write one of these"
    )
    three = Suggestions(("ramp_0001", "ramp-redyellow_0001", "ramp_0001_map"))
    assert three.explain("ramp_0001_img") == (
        "it could be ramp_0001, ramp_0001_map or ramp-redyellow_0001; write one of these"
    )


@pytest.mark.parametrize("position", range(len(IDS[40])))
def test_one_wrong_character_never_hides_the_trial(position: int) -> None:
    """Wherever a letter is missing, the nearest id is still found or one equally near."""
    wrong = IDS[40][:position] + IDS[40][position + 1 :]
    known = ("did you mean ", "write alpha_one-copy0/set=a,b/00", "it could be alpha_one-copy0/set=a,b/0020")
    assert SUGGESTIONS.explain(wrong).startswith(known)


def test_lost_leading_zeros_are_recognised() -> None:
    """A spreadsheet that turned 0002 into 2 is seen through."""
    assert SUGGESTIONS.explain("alpha_one-copy0/set=a,b/2") == (
        "write alpha_one-copy0/set=a,b/0002: leading zeros matter"
    )


ALPHABET = "abcdefghijklmnopqrstuvwxyz0123456789=,/-_ \u0430\u200b"


@given(
    st.sampled_from(IDS),
    st.integers(0, 30),
    st.sampled_from(ALPHABET),
    st.sampled_from(["insert", "replace"]),
)
def test_one_slip_is_always_explained(trial_id: str, place: int, character: str, how: str) -> None:
    """Whichever character is put in or changed, the hint names a trial or says what to take away."""
    place = min(place, len(trial_id) - 1)
    wrong = trial_id[:place] + character + trial_id[place + (how == "replace") :]
    if wrong in IDS:
        return
    hint = SUGGESTIONS.explain(wrong)
    assert hint == "remove the blanks around it" or any(known in hint for known in IDS)
    if not character.isascii():
        assert f"character {place + 1} is U+{ord(character):04X}" in hint
        assert "ids are plain ASCII" in hint


@given(st.text(max_size=300))
def test_any_text_has_a_printable_explanation_or_none(text: str) -> None:
    """Nothing of what was written comes back unescaped; only real ids are named."""
    hint = SUGGESTIONS.explain(text)
    assert hint.isprintable()
    assert hint.isascii()
    assert len(hint) <= 400


def test_an_enormous_id_is_no_harder_than_a_long_one() -> None:
    """Millions of characters are looked at once, and compared as their beginning only."""
    for unit in ("0", "a", "/", "_img", "-redyellow", "\u0430", "1/0"):
        hint = SUGGESTIONS.explain(unit * (4_000_000 // len(unit)))
        assert len(hint) <= 400


def test_a_lost_zero_that_fits_two_trials_is_not_guessed() -> None:
    """0001 and 001 are both trials; 1 may be either."""
    suggestions = Suggestions(("a/0001", "a/001", "a/0002"))
    assert suggestions.explain("a/2") == "write a/0002: leading zeros matter"
    assert suggestions.explain("a/1").startswith("did you mean a/")


def test_capitals_that_fit_two_trials_are_not_guessed() -> None:
    """Ids that differ in capitals only are both real."""
    suggestions = Suggestions(("RAMp/1", "ramp/1", "ramp/2"))
    assert suggestions.explain("RAMP/1") == "did you mean RAMp/1?"
    assert suggestions.explain("RAMP/2") == "write ramp/2: capitals and small letters differ"
