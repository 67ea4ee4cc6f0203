"""Making people anonymous."""

from hypothesis import given
from hypothesis import strategies as st

from leaderboard.reference.judgements.participants import Discretion, rename_participants

RAW_IDS = st.sets(st.text(min_size=1), max_size=30)


@given(RAW_IDS, st.randoms(use_true_random=False))
def test_names_depend_on_the_set_of_people_alone(raw_ids: set[str], random: object) -> None:
    """Order and repetition of the raw ids change nothing, and everybody gets a name of their own."""
    shuffled = [*raw_ids, *raw_ids]
    random.shuffle(shuffled)  # type: ignore[attr-defined]
    names = rename_participants(shuffled)
    assert names == rename_participants(sorted(raw_ids))
    assert names.keys() == raw_ids
    assert sorted(names.values()) == [f"p{number:03d}" for number in range(1, len(raw_ids) + 1)]


def test_order_tells_nothing_about_raw_ids() -> None:
    """People who came one after the other are not numbered so."""
    names = rename_participants(f"{number:04d}" for number in range(50))
    assert list(names.values()) == [f"p{number:03d}" for number in range(1, 51)]
    assert list(names) != sorted(names)


def test_names_are_equally_long() -> None:
    """With a thousand people all names have four digits, so that they sort as texts."""
    names = rename_participants(str(number) for number in range(1000))
    assert min(names.values()) == "p0001"
    assert {len(name) for name in names.values()} == {5}


def test_messages_never_quote_a_person() -> None:
    """What is or holds an id is not quoted; short ids, which are parts of any word, only hide themselves."""
    discretion = Discretion([" 5f1c8a0b77aa", "7", ""])
    assert discretion.quote_name("5f1c8a0b77aa") is None
    assert discretion.quote_name("videos/5f1c8a0b77aa/ramp_0001") is None
    assert discretion.quote_name("7") is None
    assert discretion.quote_name("ramp_0007") == "'ramp_0007'"


def test_answers_are_quoted_only_if_they_are_plain() -> None:
    """A word or a small number says what went wrong; anything else might say who it was."""
    discretion = Discretion(["anna"])
    assert discretion.quote_word("maybe") == "'maybe'"
    assert discretion.quote_word("73") == "'73'"
    for text in ("anna", "write to me@example.com", "5f1c8a0b77aa", "x" * 30):
        assert discretion.quote_word(text) is None
