"""Other people's CSV files: read whole or refused with file and line."""

import contextlib
import hashlib
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from leaderboard.errors import SourceError
from leaderboard.reference.source_tables import read_source_table


def write(folder: Path, content: bytes) -> Path:
    file = folder / "table.csv"
    file.write_bytes(content)
    return file


def test_rows_know_their_lines(tmp_path: Path) -> None:
    """Cells go by column, a cell may span lines, and further columns are kept."""
    file = write(tmp_path, b'a,b,more\n1,"x\ny",z\n2,"p, q",\n')
    table = read_source_table(file, ["b", "a"])
    assert [(row.line, row.cells) for row in table.rows] == [
        (3, {"a": "1", "b": "x\ny", "more": "z"}),
        (4, {"a": "2", "b": "p, q", "more": ""}),
    ]
    assert table.rows[1]["b"] == "p, q"
    assert table.file == table.rows[0].file == str(file)


@pytest.mark.parametrize("content", [b"a\r\n01\r\n", b"\xef\xbb\xbfa\n01\n", b"a\n01"])
def test_line_ends_and_byte_order_mark_do_not_matter(tmp_path: Path, content: bytes) -> None:
    """CRLF, a byte-order mark and a missing last line end give the same cells, with zeros kept."""
    table = read_source_table(write(tmp_path, content), ["a"])
    assert [row.cells for row in table.rows] == [{"a": "01"}]
    assert table.sha256 == hashlib.sha256(content).hexdigest()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", ":1: lacks the columns a, b; found nothing"),
        (b"a,c\n1,2\n", ":1: lacks the column b; found a, c"),
        (b"a,b,a\n1,2,3\n", ":1: columns 1 and 3 have the same name"),
        (b"a,b\n", ": holds a header but no rows"),
        (b"a,b\n1,2\n1\n", ":3: has 1 cell where the header has 2"),
        (b"a,b\n1,2,3\n", ":2: has 3 cells where the header has 2"),
        (b"a,b\n1,2\n\n3,4\n", ":3: the line is blank"),
        (b'a,b\n1,"2\n', ":2: malformed CSV: unexpected end of data"),
        (b'a,b\n1,"2"3\n', ":2: malformed CSV: ',' expected after '\"'"),
        (b"a,b\n1,\xff\n", ":2: is not UTF-8 text (byte 0xff)"),
        (b"a,b\n1,\x00\n", ":2: holds a NUL byte, so it is not a CSV file"),
    ],
)
def test_malformed_files_are_refused(tmp_path: Path, content: bytes, message: str) -> None:
    """Each fault is refused with the file, the line where there is one, and what was found."""
    file = write(tmp_path, content)
    with pytest.raises(SourceError) as caught:
        read_source_table(file, ["a", "b"])
    assert caught.value.message == f"{file}{message}"


def test_missing_file_is_named(tmp_path: Path) -> None:
    """A file that is not there, or is a folder, is refused by its path."""
    with pytest.raises(SourceError, match=r"none\.csv: cannot be read: No such file or directory"):
        read_source_table(tmp_path / "none.csv", ["a"])
    with pytest.raises(SourceError, match="cannot be read: Is a directory"):
        read_source_table(tmp_path, ["a"])


def test_links_are_followed_unless_they_circle(tmp_path: Path) -> None:
    """A symbolic link to a table is read; one to itself is refused."""
    (tmp_path / "link.csv").symlink_to(write(tmp_path, b"a\n1\n"))
    assert len(read_source_table(tmp_path / "link.csv", ["a"]).rows) == 1
    (tmp_path / "circle.csv").symlink_to(tmp_path / "circle.csv")
    with pytest.raises(SourceError, match=r"circle\.csv: cannot be read"):
        read_source_table(tmp_path / "circle.csv", ["a"])


def test_size_is_limited(tmp_path: Path) -> None:
    """A file beyond the limit is refused without being parsed."""
    with pytest.raises(SourceError, match="is larger than 5 bytes"):
        read_source_table(write(tmp_path, b"a\n1\n2\n"), ["a"], limit=5)


def test_rows_make_errors_that_name_them(tmp_path: Path) -> None:
    """A row's complaint begins with its file and line."""
    file = write(tmp_path, b"a\n1\n")
    error = read_source_table(file, ["a"]).rows[0].error("is odd", "look again")
    assert (error.message, error.hint) == (f"{file}:2: is odd", "look again")


@given(st.binary(max_size=60))
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_any_bytes_give_rows_or_a_refusal(tmp_path: Path, noise: bytes) -> None:
    """Whatever follows the header, the outcome is a table or a SourceError."""
    with contextlib.suppress(SourceError):
        table = read_source_table(write(tmp_path, b"a,b\n" + noise), ["a", "b"])
        assert all(len(row.cells) == 2 for row in table.rows)
