"""From other tools' names to trial ids, and nothing else changed."""

import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from builders import build_reference
from leaderboard.validation.translating import TranslatedName, translate_names

REFERENCE = build_reference()
IDS = REFERENCE.trial_ids
FIRST, SECOND, THIRD = IDS[:3]


def test_a_file_of_ids_is_returned_as_it_is() -> None:
    """Marks, line ends, blanks and quotes stay, whatever validation will say of the numbers."""
    content = f'\ufefftrial_id,probability\r\n"{FIRST}", 0.50 \n"{SECOND}","1e-1"\r\n"{THIRD}",7'.encode()
    assert translate_names(content, REFERENCE) == (content, ())


def test_names_become_ids_and_all_else_keeps_its_bytes() -> None:
    """Only the first cell of a line with another name is written anew."""
    content = (
        "\ufefftrial_id,probability,status\r\n"
        f'"{FIRST}_img.mp4", 0.50 ,\r\n'
        f'"{SECOND}","1e-1",answered\n'
        f'"C:\\my data\\{THIRD}.npy","0.10","answered"\r\n'
        '"what ""is"", this",0.3,\n'
        "nothing,,error"
    ).encode()
    expected = (
        "\ufefftrial_id,probability,status\r\n"
        f'"{FIRST}", 0.50 ,\r\n'
        f'"{SECOND}","1e-1",answered\n'
        f'"{THIRD}","0.10","answered"\r\n'
        '"what ""is"", this",0.3,\n'
        "nothing,,error"
    ).encode()
    names = (
        TranslatedName(f"{FIRST}_img.mp4", FIRST),
        TranslatedName(f"C:\\my data\\{THIRD}.npy", THIRD),
    )
    assert translate_names(content, REFERENCE) == (expected, names)


def test_a_name_may_hold_quotes() -> None:
    """Doubled in the file, they belong to the name; its folder is dropped with them."""
    content = f'trial_id,probability\n"a ""new"" run/{FIRST}_img.mp4",0.5\n'.encode()
    expected = f'trial_id,probability\n"{FIRST}",0.5\n'.encode()
    names = (TranslatedName(f'a "new" run/{FIRST}_img.mp4', FIRST),)
    assert translate_names(content, REFERENCE) == (expected, names)


def test_ambiguous_and_unknown_names_stay() -> None:
    """They are for validation to explain, on their lines."""
    rows = ['"alpha_one/set=a,b/0000_img.mp4",0.5', "stranger_0001,0.5", "ragged.mp4,0.5"]
    content = "\n".join(["trial_id,probability", *rows]).encode()
    assert translate_names(content, REFERENCE) == (content, ())


def test_two_names_of_one_trial_become_the_same_id() -> None:
    """Which of the two counts is not decided here."""
    content = f'trial_id,probability\n"{FIRST}.mp4",0.5\n"{FIRST}",0.6\n"{FIRST}_img",0.7\n'.encode()
    expected = f'trial_id,probability\n"{FIRST}",0.5\n"{FIRST}",0.6\n"{FIRST}",0.7\n'.encode()
    assert translate_names(content, REFERENCE)[0] == expected


ROW = f'"{FIRST}_img.mp4",0.5'


@pytest.mark.parametrize(
    "content",
    [
        b"",
        ROW.encode(),
        f"trial;probability\n{ROW}\n".encode(),
        f"trial_id,probability\n{ROW}\n\n".encode(),
        f"trial_id,probability\n{ROW}\n{ROW},more\n".encode(),
        f'trial_id,probability\n{ROW}\n"open,0.5\n'.encode(),
        f"trial_id,probability\n{ROW}\ntrial_id,probability\n".encode(),
        f"trial_id,probability\n{ROW}\r".encode(),
        f"trial_id,probability\n{ROW}\n\0".encode(),
        f"trial_id,probability\n{ROW}\n".encode("utf-16"),
        f"trial_id,probability\n{ROW}\n".encode() + b"\xff,0.5\n",
        f"trial_id,probability\n{ROW}\n".encode() + b"x,0.5\n" * 11_000,
    ],
)
def test_a_malformed_file_is_not_touched(content: bytes) -> None:
    """One fault in the table and every byte stays for validation to explain."""
    assert translate_names(content, REFERENCE) == (content, ())


CELLS = st.text(alphabet="a0.5,\"' \t=;\u00e9\\/", max_size=8)
NAMES = st.builds(
    lambda folder, trial_id, end: f"{folder}{trial_id}{end}",
    st.sampled_from(["", "/data/", 'a "b", c/', "C:\\my data\\"]),
    st.sampled_from(IDS),
    st.sampled_from(["", "_img.mp4", ".npy", "-redyellow_img", "_unknown"]),
)


@given(
    st.lists(st.tuples(NAMES | CELLS, CELLS), max_size=6),
    st.sampled_from([csv.QUOTE_MINIMAL, csv.QUOTE_ALL]),
    st.sampled_from(["\n", "\r\n"]),
)
def test_no_cell_but_the_first_ever_changes(rows: list[tuple[str, str]], quoting: int, end: str) -> None:
    """Read back, every row has its id or the name it had, and its other cell; once is enough."""
    buffer = io.StringIO()
    writer = csv.writer(buffer, quoting=quoting, lineterminator=end)  # type: ignore[arg-type]
    writer.writerows([("trial_id", "probability"), *rows])
    content, names = translate_names(buffer.getvalue().encode(), REFERENCE)
    meant = {found.name: found.trial_id for found in names}
    assert set(meant.values()) <= set(IDS)
    read = list(csv.reader(io.StringIO(content.decode(), newline=""), strict=True))
    assert read[1:] == [[meant.get(name, name), cell] for name, cell in rows]
    assert translate_names(content, REFERENCE) == (content, ())


@given(st.binary(max_size=200) | st.text(max_size=200).map(str.encode))
def test_any_bytes_are_taken(content: bytes) -> None:
    """Nothing raises, and what is no table stays."""
    assert translate_names(content, REFERENCE) == (content, ())
