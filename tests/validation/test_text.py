"""From bytes to text."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.problems import Problems
from leaderboard.validation.text import decode_text


@pytest.mark.parametrize("content", [b"", b"a\nb\n", b"a\r\nb", "\ufeffaé".encode()])
def test_utf8_with_either_line_end_is_text(content: bytes) -> None:
    """LF, CRLF and one byte-order mark are plain text; the mark is taken off."""
    problems = Problems()
    assert decode_text(content, "f", problems) == content.decode("utf-8-sig")
    assert not problems


@pytest.mark.parametrize(
    ("content", "code", "line", "message"),
    [
        (b"\x1f\x8b\x08", "not-text", 1, "is compressed with gzip, not plain text"),
        (b"PK\x03\x04", "not-text", 1, "is a ZIP archive or an Excel file (.xlsx), not plain text"),
        (b"\x89HDF\r\n", "not-text", 1, "is an HDF5 file, not plain text"),
        (b"\xff\xfea\x00", "not-utf8", 1, "is UTF-16 (it starts with FF FE), not UTF-8"),
        (
            b"\xff\xfe\x00\x00a\x00\x00\x00",
            "not-utf8",
            1,
            "is UTF-32 (it starts with FF FE 00 00), not UTF-8",
        ),
        (b"\x80\x05\x95", "not-text", 1, "is a Python pickle, not plain text"),
        (b"a\nb\xe9c\n", "not-utf8", 2, "byte 2 of the line, 0xE9, is not UTF-8"),
        (b"\xed\xa0\x80", "not-utf8", 1, "byte 1 of the line, 0xED, is not UTF-8"),
        (b"a\nb\0", "nul-byte", 2, "holds a NUL byte; the file is damaged or binary"),
        (b"\xef\xbb\xbf\xef\xbb\xbfa", "repeated-bom", 1, "starts with two byte-order marks"),
        (b"a\rb\r", "line-ends", None, "ends its lines with CR alone, as old Macs did"),
        (b"a\r\r\nb\r\r\n", "line-ends", None, "ends its lines with CR CR LF"),
        (
            b"a\nb\rc\n",
            "line-ends",
            2,
            "has a carriage return that is no line end; lines end in LF or CRLF",
        ),
    ],
)
def test_anything_else_is_named(content: bytes, code: str, line: int | None, message: str) -> None:
    """What is not plain text is refused in words that say what it is, and where."""
    problems = Problems()
    assert decode_text(content, "f", problems) is None
    assert [(p.code, p.line, p.message) for p in problems] == [(code, line, message)]


@pytest.mark.parametrize("content", [b"\xff\xfea\x00", b"\xe9"])
def test_another_encoding_is_mended_in_any_editor(content: bytes) -> None:
    """The advice fits a text editor as well as a spreadsheet, since submission.toml comes from the former."""
    problems = Problems()
    assert decode_text(content, "submission.toml", problems) is None
    assert problems.found[0].hint == 'save it as UTF-8 (in a spreadsheet: "CSV UTF-8")'


@given(st.lists(st.sampled_from([b"a", b"\r", b"\n", b"\r\n", b"\0", b"\xef\xbb\xbf", b"\xc3\xa9", b"\xe9"])))
def test_text_is_what_python_decodes_or_one_problem(pieces: list[bytes]) -> None:
    """Nothing is dropped or replaced; every refusal is a single problem whose line is in the file."""
    content, problems = b"".join(pieces), Problems()
    text = decode_text(content, "f", problems)
    if text is not None:
        assert (text, len(problems)) == (content.decode("utf-8-sig"), 0)
        assert "\0" not in text
        assert "\r" not in text.replace("\r\n", "")
    else:
        assert len(problems) == 1
        assert 1 <= (problems.found[0].line or 1) <= content.count(b"\n") + 1
