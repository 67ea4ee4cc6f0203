"""Zip archives as the release has them, and a huge one that takes hardly any disk."""

import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path

SPARSE_SIZE = 4_400_000_000  # beyond 2**32, where Zip64 begins
_MODIFIED = (2023, 11, 1, 10, 0, 0)
_ALL_ONES = 0xFFFFFFFF


def write_zip(path: Path, members: Mapping[str, bytes]) -> None:
    """Write members in their order, compressed, with a fixed date; equal members give equal bytes."""
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in members.items():
            archive.writestr(_member(name, zipfile.ZIP_DEFLATED), content)


def write_sparse_zip(path: Path, members: Mapping[str, bytes], folder: str, size: int) -> None:
    """Write members between two stored videos of zeros, which are holes in the file.

    The first takes nearly all of the size, so that the members and the directory lie at its far end; the
    second is small.
    """
    second = size // 100
    with zipfile.ZipFile(path, "w", allowZip64=True) as archive:
        _leave_hole(archive, f"{folder}/all_videos.tar", size - second)
        for name, content in members.items():
            archive.writestr(_member(name, zipfile.ZIP_DEFLATED), content)
        _leave_hole(archive, f"{folder}/all_videos_redyellow.tar", second)


def crc_of_zeros(n: int) -> int:
    """Compute the CRC-32 of ``n`` zero bytes in about log(n) steps.

    A zero byte changes the register linearly, so by a matrix over the two-element field; squaring it doubles
    the number of bytes.
    """
    matrix = [zlib.crc32(b"\0", 1 << bit ^ _ALL_ONES) ^ _ALL_ONES for bit in range(32)]
    register = _ALL_ONES
    while n:
        if n & 1:
            register = _times(matrix, register)
        matrix = [_times(matrix, column) for column in matrix]
        n >>= 1
    return register ^ _ALL_ONES


def _times(matrix: list[int], vector: int) -> int:
    product = 0
    for bit, column in enumerate(matrix):
        if vector >> bit & 1:
            product ^= column
    return product


def _member(name: str, compression: int) -> zipfile.ZipInfo:
    member = zipfile.ZipInfo(name, _MODIFIED)
    member.compress_type = compression
    member.external_attr = 0o100644 << 16
    member.create_system = 3  # Unix, wherever the tests run
    return member


def _leave_hole(archive: zipfile.ZipFile, name: str, size: int) -> None:
    """Add a stored member of zeros by seeking over its content, as `ZipFile.writestr` would by writing."""
    member = _member(name, zipfile.ZIP_STORED)
    stream = archive.fp
    assert stream is not None
    stream.seek(archive.start_dir)
    member.header_offset = stream.tell()
    member.file_size = member.compress_size = size
    member.CRC = crc_of_zeros(size)
    stream.write(member.FileHeader())
    stream.seek(size, 1)
    archive.start_dir = stream.tell()
    archive.filelist.append(member)
    archive.NameToInfo[name] = member
