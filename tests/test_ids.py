"""The rules for ids and slugs."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.ids import find_nearest, is_id, is_slug


@pytest.mark.parametrize("slug", ["abc", "slot-former-2", "0x1", "a" * 64])
def test_slugs_that_may_name_a_folder(slug: str) -> None:
    """Letters, digits and inner hyphens, 3 to 64 of them."""
    assert is_slug(slug)


@pytest.mark.parametrize(
    "slug", ["", "ab", "-abc", "abc-", "Abc", "a_b", "a b", "a/b", "..", "a" * 65, "abc\n", "\u0430bc"]
)
def test_slugs_that_may_not(slug: str) -> None:
    """Everything that could leave the folder, hide, or look like another is refused."""
    assert not is_slug(slug)


@given(st.text(max_size=300))
def test_ids_are_printable_ascii_without_blanks_and_quotes(text: str) -> None:
    """The rule equals its plain description."""
    expected = 1 <= len(text) <= 200 and all("!" <= c <= "~" and c not in "\"'" for c in text)
    assert is_id(text) == expected


def test_nothing_near_is_nothing() -> None:
    """A name unlike all known ones gets no suggestion."""
    assert find_nearest("zzzzzz", ["Mass", "Friction"]) is None
