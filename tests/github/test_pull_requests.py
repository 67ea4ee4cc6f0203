"""The text of a pull request has a part of the program's and a part of people's."""

from hypothesis import given
from hypothesis import strategies as st

from leaderboard.github.pull_requests import merge_body
from leaderboard.report.proposal import BEGIN_LINE, END_LINE

TEXT = st.text(st.characters(exclude_categories=("Cs", "Cc")) | st.just("\n"), max_size=60)


def own_part(text: str) -> str:
    return f"{BEGIN_LINE}\n\n{text}\n\n{END_LINE}"


@given(before=TEXT, after=TEXT, old=TEXT, new=TEXT)
def test_only_the_own_part_changes(before: str, after: str, old: str, new: str) -> None:
    """Whatever people write before and after it stays, and a second time changes nothing."""
    body = f"{before}\n{own_part(old)}\n{after}"
    merged = merge_body(body, f"{own_part(new)}\n\nchecklist")
    assert merged == f"{before}\n{own_part(new)}\n{after}"
    assert merge_body(merged, own_part(new)) == merged


@given(body=TEXT, new=TEXT)
def test_a_text_without_the_part_gets_it(body: str, new: str) -> None:
    """Somebody removed it: theirs stays, and the part comes below, once."""
    merged = merge_body(body, own_part(new))
    assert merged.startswith(body.strip("\n").rstrip())
    assert merge_body(merged, own_part(new)) == merged


def test_a_text_of_another_kind_is_left_alone() -> None:
    """Without an own part there is nothing to put in."""
    assert merge_body("text", "other") == "text"
