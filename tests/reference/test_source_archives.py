"""Archives by strangers: what is read of them, and what is refused with a reason."""

import io
import pickle
import stat
import struct
import sys
import zipfile
import zlib
from random import Random
from typing import cast

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from leaderboard.errors import SourceError
from leaderboard.reference import source_archives
from leaderboard.reference.source_archives import (
    AGAIN_HINT,
    LIMITS,
    UNPACK_HINT,
    Limits,
    is_junk,
    open_archive,
    say_odd_name,
)
from leaderboard.reference.source_files import SourceFile, read_members
from source_zips import LISTED, Change, falsify, is_csv, repeated_names, zip_bytes


class Watched(io.BytesIO):
    """Remembers which bytes were read."""

    def __init__(self, content: bytes) -> None:
        super().__init__(content)
        self.spans: list[tuple[int, int]] = []

    def read(self, size: int | None = -1, /) -> bytes:
        start = self.tell()
        content = super().read(size)
        self.spans.append((start, start + len(content)))
        return content


def read(content: bytes, limits: Limits = LIMITS) -> tuple[SourceFile, ...]:
    raw = cast("io.RawIOBase", io.BytesIO(content))  # it has all that is needed
    with open_archive(raw, "a.zip") as archive:
        return read_members(archive, "a.zip", is_csv, limits=limits)


def refusal(content: bytes, limits: Limits = LIMITS) -> tuple[str, str]:
    with pytest.raises(SourceError) as caught:
        read(content, limits)
    return caught.value.message, caught.value.hint


def test_wanted_members_are_read_by_name() -> None:
    """Each has its path in the archive, an origin that names the archive too, and its bytes."""
    files = read(zip_bytes(LISTED | {"data/a.txt": b"x", "data/": b""}))
    assert files == (
        SourceFile("data/Friction.csv", "a.zip/data/Friction.csv", LISTED["data/Friction.csv"]),
        SourceFile("data/Mass.csv", "a.zip/data/Mass.csv", LISTED["data/Mass.csv"]),
    )


def test_empty_and_stored_members_are_read() -> None:
    """A member without content is a file all the same, and packing is optional."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_STORED) as archive:
        archive.writestr("empty.csv", b"")
        archive.writestr("full.csv", b"1")
    assert [file.content for file in read(buffer.getvalue())] == [b"", b"1"]


def test_nothing_but_wanted_members_is_read() -> None:
    """After the directory is known, only their bytes are asked for, from the front to the back."""
    noise = Random(0).randbytes(10_000)
    content = zip_bytes({"z.csv": b"1", "1.bin": noise, "a.csv": b"2", "2.bin": noise, "m.csv": b"3"})
    stream = Watched(content)
    with zipfile.ZipFile(stream) as archive:
        stream.spans.clear()
        names = [file.name for file in read_members(archive, "a.zip", is_csv)]
        chosen = [info for info in archive.infolist() if is_csv(info.filename)]
        ends = [info.header_offset + 30 + len(info.filename) + info.compress_size for info in chosen]
    assert names == ["a.csv", "m.csv", "z.csv"]
    assert [start for start, _ in stream.spans] == sorted(start for start, _ in stream.spans)
    allowed = [(info.header_offset, end) for info, end in zip(chosen, ends, strict=True)]
    assert all(any(low <= start <= end <= high for low, high in allowed) for start, end in stream.spans)


class Bomb:
    """Ends the test run if it is ever unpickled."""

    def __reduce__(self) -> tuple[object, tuple[int]]:
        return sys.exit, (1,)


def test_pickles_are_not_even_read(monkeypatch: pytest.MonkeyPatch) -> None:
    """A pickle beside the lists is nobody's business."""
    opened: list[str] = []
    read_member = source_archives.read_member

    def watch(archive: zipfile.ZipFile, member: zipfile.ZipInfo, origin: str) -> bytes:
        opened.append(member.filename)
        return read_member(archive, member, origin)

    monkeypatch.setattr("leaderboard.reference.source_files.read_member", watch)
    read(zip_bytes({"data/states.pkl": pickle.dumps(Bomb())} | LISTED))
    assert opened == list(LISTED)


@pytest.mark.parametrize(
    "name", ["__MACOSX/data/Mass.csv", "data/._Mass.csv", ".DS_Store", "a/Thumbs.db", "desktop.ini"]
)
def test_junk_is_never_wanted(name: str) -> None:
    """What operating systems leave behind counts for nothing."""
    assert is_junk(name)
    assert [file.name for file in read(zip_bytes(LISTED | {name: b"junk"}))] == sorted(LISTED)


@pytest.mark.parametrize(
    ("name", "saying"),
    [
        ("../Mass.csv", "has a part '..'"),
        ("data/../../Mass.csv", "has a part '..'"),
        ("./Mass.csv", "has a part '.'"),
        ("data//Mass.csv", "has a part ''"),
        ("/etc/Mass.csv", "starts at the root of a disk"),
        ("C:/Mass.csv", "starts at the root of a disk"),
        ("c:Mass.csv", "starts at the root of a disk"),
        ("data\\Mass.csv", "holds backslashes"),
        ("..\\Mass.csv", "holds backslashes"),
        ("\\\\server\\Mass.csv", "holds backslashes"),
        ("data/Ma\nss.csv", "holds characters that cannot be shown"),
        ("data/\u202evsc.csv", "holds characters that cannot be shown"),
        ("d" * 497 + ".csv", "has more than 500 characters"),
    ],
)
def test_odd_names_are_refused(name: str, saying: str) -> None:
    """A name that leads elsewhere, or is not what it looks like, is refused before anything is read."""
    assert say_odd_name(name) == saying
    message, hint = refusal(zip_bytes(LISTED | {name: b"x"}))
    assert message.startswith("a.zip: the member '")
    assert message.endswith(f"is not plainly a file: its name {saying}")
    assert hint == UNPACK_HINT


def test_a_name_with_a_nul_is_refused() -> None:
    """Tools differ on where such a name ends."""
    content = zip_bytes({"Mass.csv_.exe": b"x"}).replace(b"Mass.csv_.exe", b"Mass.csv\0.exe")
    assert refusal(content)[0] == (
        "a.zip: the member 'Mass.csv\\x00.exe' is not plainly a file: "
        "its name holds characters that cannot be shown"
    )


@pytest.mark.parametrize("name", ["../a.txt", "/etc/passwd", "a\\b.txt", "bad\nname", "x" * 9999])
def test_odd_members_that_nobody_wants_do_no_harm(name: str) -> None:
    """Nothing is unpacked, so only what is read is judged."""
    change = falsify(external_attr=(stat.S_IFLNK | 0o777) << 16, flag_bits=1, compress_type=99)
    assert len(read(zip_bytes({name: b"x"} | LISTED, change))) == 2


@pytest.mark.parametrize(
    ("change", "message", "hint"),
    [
        (
            falsify(external_attr=(stat.S_IFLNK | 0o777) << 16),
            "is a symbolic link",
            UNPACK_HINT,
        ),
        (falsify(external_attr=(stat.S_IFIFO | 0o644) << 16), "is a special file", UNPACK_HINT),
        (falsify(external_attr=(stat.S_IFDIR | 0o755) << 16), "is a special file", UNPACK_HINT),
        (falsify(flag_bits=1), "is encrypted", "unpack it with its password, and name the folder instead"),
        (falsify(flag_bits=64), "is encrypted", "unpack it with its password, and name the folder instead"),
        (falsify(compress_type=9), "is packed by method 9; only deflate (8) is read", UNPACK_HINT),
        (
            falsify(file_size=100_000_001),
            "has 100,000,001 bytes; at most 100,000,000 are read",
            UNPACK_HINT,
        ),
        (
            falsify(file_size=3_000_000, compress_size=14_999),
            "has 3,000,000 bytes packed into 14,999; more than 200 to one is not read",
            UNPACK_HINT,
        ),
    ],
)
def test_members_that_are_no_plain_files_are_refused(change: Change, message: str, hint: str) -> None:
    """The directory tells, before a byte is read."""
    said = f"a.zip: the member 'data/Mass.csv' {message}"
    assert refusal(zip_bytes(LISTED, change)) == (said, hint)


def test_patched_data_are_refused() -> None:
    """What zipfile does not know it says so, and that is passed on."""
    message, hint = refusal(zip_bytes(LISTED, falsify(flag_bits=32)))
    assert message == "a.zip/data/Mass.csv: is damaged (compressed patched data (flag bit 5))"
    assert hint == AGAIN_HINT


@pytest.mark.parametrize(
    ("first", "second", "said"),
    [
        ("Mass.csv", "Mass.csv", "'Mass.csv'"),
        ("Mass.csv", "mass.csv", "'Mass.csv' and 'mass.csv'"),
    ],
)
def test_two_members_of_one_name_are_refused(first: str, second: str, said: str) -> None:
    """Which of them counts is not for a program to choose, also where only the case tells them apart."""
    assert refusal(repeated_names(first, second)) == (
        f"a.zip: several members are called {said}",
        UNPACK_HINT,
    )


def test_repeated_names_that_nobody_wants_do_no_harm() -> None:
    """Two notes of one name are read as little as one."""
    content = repeated_names("notes.txt", "notes.txt")
    assert (
        refusal(content)[0] == "a.zip: holds no official file; among its files are 'notes.txt', 'notes.txt'"
    )


def test_a_bomb_that_lies_about_its_size_is_stopped() -> None:
    """A member that unpacks to more than it declares is read no further than a chunk beyond that."""
    content = zip_bytes({"Mass.csv": bytes(30_000_000)}, falsify(file_size=100))
    said = "a.zip/Mass.csv: unpacks to more than the 100 bytes that its archive declares"
    assert refusal(content) == (said, AGAIN_HINT)


def test_a_member_is_not_cut_silently() -> None:
    """A declared size that cuts the content is refused even if the checksum is that of the cut content."""
    cut = falsify(file_size=4, CRC=zlib.crc32(b"1234"))
    content = zip_bytes({"Mass.csv": b"12345678"}, cut)
    assert refusal(content)[0].startswith("a.zip/Mass.csv: is damaged (Bad CRC-32 for file 'Mass.csv'")
    content = zip_bytes({"Mass.csv": b"12345678"}, falsify(file_size=4))
    assert refusal(content)[0] == "a.zip/Mass.csv: unpacks to more than the 4 bytes that its archive declares"


def test_a_member_that_is_too_short_is_refused() -> None:
    """Less than declared is damage, too."""
    content = zip_bytes({"Mass.csv": b"1234"}, falsify(file_size=8))
    assert refusal(content)[0] == "a.zip/Mass.csv: unpacks to less than the 8 bytes that its archive declares"


def test_text_that_packs_well_is_read() -> None:
    """A table of zeros and ones packs at more than twenty to one, which is no bomb."""
    bits = Random(0).choices("01", k=500_000)
    content = "".join(f"{bit},{bit},{bit},{bit}\n" for bit in bits).encode()
    packed = zip_bytes({"Mass.csv": content})
    assert len(content) > 20 * len(packed)
    assert read(packed)[0].content == content


def test_real_bombs_are_refused_by_their_ratio() -> None:
    """Megabytes of nothing pack at a thousand to one."""
    message, _ = refusal(zip_bytes({"Mass.csv": bytes(3_000_000)}))
    assert message.endswith("; more than 200 to one is not read")


def test_all_members_together_have_a_limit() -> None:
    """Many files of allowed size are too much in the end, and none of them is read."""
    message, hint = refusal(zip_bytes(LISTED), Limits(total_size=31))
    assert message == "a.zip: 2 wanted members have more than 31 bytes unpacked"
    assert hint == UNPACK_HINT
    assert len(read(zip_bytes(LISTED), Limits(total_size=32))) == 2


def test_the_directory_has_a_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither its number of members nor its size in bytes may be without bounds."""
    content = zip_bytes(LISTED)
    message, hint = refusal(content, Limits(n_names=1))
    assert (message, hint) == ("a.zip: lists 2 members; at most 1 are looked at", UNPACK_HINT)
    monkeypatch.setattr(source_archives, "DIRECTORY_SIZE", 100)
    message, hint = refusal(content)
    size = struct.unpack("<L", content[-10:-6])[0]
    said = f"a.zip: is no zip archive, or a damaged one (the directory is said to have {size} bytes)"
    assert (message, hint) == (said, AGAIN_HINT)


def test_members_that_share_bytes_are_refused() -> None:
    """Many names for the same bytes are how the largest bombs are built."""

    def overlap(archive: zipfile.ZipFile) -> None:
        archive.filelist[1].header_offset = archive.filelist[0].header_offset

    assert refusal(zip_bytes(LISTED, overlap)) == (
        "a.zip: the member 'data/Friction.csv' shares bytes with another",
        AGAIN_HINT,
    )


@pytest.mark.parametrize("name", ["notes.txt", "Mass.csv"])
def test_members_that_reach_into_the_next_are_refused(name: str) -> None:
    """It does not matter which of the two is wanted."""
    members = {name: b"12345678", "Next.csv": b"1"}
    message, _ = refusal(zip_bytes(members, falsify(compress_size=40)))
    assert message == "a.zip: the member 'Next.csv' shares bytes with another"


def test_members_that_reach_into_the_directory_are_refused() -> None:
    """The last member ends where the directory begins."""
    message, _ = refusal(zip_bytes({"Mass.csv": b"1"}, falsify(compress_size=40)))
    assert message == "a.zip: the member 'Mass.csv' runs into the directory"


def test_unwanted_members_may_overlap() -> None:
    """As long as no wanted member is part of it."""

    def overlap(archive: zipfile.ZipFile) -> None:
        archive.filelist[1].header_offset = archive.filelist[0].header_offset

    assert len(read(zip_bytes({"a.txt": b"1", "b.txt": b"2"} | LISTED, overlap))) == 2


def flip(content: bytes, position: int) -> bytes:
    return content[:position] + bytes([content[position] ^ 0xFF]) + content[position + 1 :]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "a.zip: is no zip archive, or a damaged one (File is not a zip file)"),
        (b"not a zip", "a.zip: is no zip archive, or a damaged one (File is not a zip file)"),
        (zip_bytes()[:-30], "a.zip: is no zip archive, or a damaged one (File is not a zip file)"),
        (
            zip_bytes().replace(b"PK\1\2", b"PK\1\3"),
            "a.zip: is no zip archive, or a damaged one (Bad magic number for central directory)",
        ),
        (
            zip_bytes().replace(b"PK\3\4", b"PK\3\5"),
            "a.zip/data/Mass.csv: is damaged (Bad magic number for file header)",
        ),
        (
            zip_bytes(LISTED, falsify(CRC=0)),
            "a.zip/data/Mass.csv: is damaged (Bad CRC-32 for file 'data/Mass.csv')",
        ),
        (zip_bytes({}), "a.zip: holds no official file; it is empty"),
        (
            zip_bytes({f"{number}.mp4": b"" for number in range(1234)}),
            "a.zip: holds no official file; among its files are '0.mp4', '1.mp4', '2.mp4' and 1,231 more",
        ),
    ],
)
def test_broken_archives_are_refused(content: bytes, message: str) -> None:
    """The message says what is wrong with which archive or member."""
    assert refusal(content)[0] == message


def test_corrupt_packing_is_refused() -> None:
    """What zlib cannot unpack is damage."""
    message, hint = refusal(flip(zip_bytes({"Mass.csv": b"x" * 99}), 38))
    assert message.startswith("a.zip/Mass.csv: is damaged (Error -3 while decompressing data")
    assert hint == AGAIN_HINT


def test_errors_of_the_network_pass_through() -> None:
    """Whoever reads an archive piece by piece can tell a lost connection from damage, and try again."""

    class Lost(io.BytesIO):
        is_lost = False

        def read(self, size: int | None = -1, /) -> bytes:
            if self.is_lost:
                raise ConnectionResetError("lost")
            return super().read(size)

    stream = Lost(zip_bytes())
    with zipfile.ZipFile(stream) as archive:
        stream.is_lost = True
        with pytest.raises(ConnectionResetError, match="lost"):
            read_members(archive, "a.zip", is_csv)


SMALL = zip_bytes(LISTED | {"notes.txt": b"nothing", "empty.csv": b""})
POSITIONS = st.integers(0, len(SMALL) - 1)


def read_or_refuse(content: bytes) -> tuple[tuple[SourceFile, ...], SourceError | None]:
    try:
        return read(content), None
    except SourceError as error:
        return (), error


@given(st.lists(st.tuples(POSITIONS, st.integers(1, 255)), max_size=8), st.integers(0, len(SMALL)))
@example([], len(SMALL))
def test_whatever_happens_to_an_archive_it_is_read_or_refused(
    flips: list[tuple[int, int]], length: int
) -> None:
    """Flipped and missing bytes give the files or a refusal, and never wrong content under a known name."""
    content = bytearray(SMALL)
    for position, mask in flips:
        content[position] ^= mask
    files, refused = read_or_refuse(bytes(content[:length]))
    known = LISTED | {"empty.csv": b""}
    assert all(known.get(file.name, file.content) == file.content for file in files)
    assert (refused is None) == bool(files)
    if refused is not None:
        assert refused.message.startswith("a.zip")
        assert refused.message.isprintable()
        assert refused.hint


@given(st.binary(max_size=200))
def test_any_bytes_are_refused(content: bytes) -> None:
    """What is no archive is never taken for one."""
    with pytest.raises(SourceError, match=r"^a\.zip: "):
        read(content)


def test_every_single_flipped_byte_is_read_or_refused() -> None:
    """All of them, one after the other."""
    outcomes = [read_or_refuse(flip(SMALL, position)) for position in range(len(SMALL))]
    assert any(files for files, _ in outcomes)
    assert any(refused for _, refused in outcomes)
