"""From bytes to text: UTF-8 with LF or CRLF, and a helpful word where it is something else."""

from leaderboard.problems import Problems

BOM = b"\xef\xbb\xbf"

# What people upload by mistake: first bytes, and what they are.
_FORMATS = (
    (b"PK\x03\x04", "a ZIP archive or an Excel file (.xlsx)"),
    (b"\x1f\x8b", "compressed with gzip"),
    (b"BZh", "compressed with bzip2"),
    (b"\xfd7zXZ", "compressed with xz"),
    (b"\x28\xb5\x2f\xfd", "compressed with zstd"),
    (b"\xd0\xcf\x11\xe0", "an old Excel file (.xls)"),
    (b"\x89HDF", "an HDF5 file"),
    (b"\x93NUMPY", "a NumPy array"),
    (b"\x80\x04", "a Python pickle"),
    (b"\x80\x05", "a Python pickle"),
    (b"PAR1", "a Parquet file"),
    (b"version https://git-lfs", "a Git LFS pointer, not the file itself"),
)
_WIDE_BOMS = (  # the longer before the shorter that it starts with
    (b"\xff\xfe\x00\x00", "UTF-32"),
    (b"\x00\x00\xfe\xff", "UTF-32"),
    (b"\xff\xfe", "UTF-16"),
    (b"\xfe\xff", "UTF-16"),
)
_UTF8_HINT = 'save it as UTF-8 (in a spreadsheet: "CSV UTF-8")'


def decode_text(content: bytes, file: str, problems: Problems) -> str | None:
    """Decode a text file, or say what it is instead.

    One byte-order mark is taken off. CRLF stays, so that lines count as in an editor.

    Returns
    -------
    str or None
        None, and a problem, if it is not plain text.
    """
    if _report_format(content, file, problems):
        return None
    body = content.removeprefix(BOM)
    if body.startswith(BOM):
        hint = "save it again as UTF-8 with one mark or none"
        problems.add("repeated-bom", "starts with two byte-order marks", file, line=1, hint=hint)
        return None
    nul = body.find(b"\0")
    if nul >= 0:
        line = body.count(b"\n", 0, nul) + 1
        hint = "save it again as plain UTF-8 text; NULs come from a damaged copy or from UTF-16"
        message = "holds a NUL byte; the file is damaged or binary"
        problems.add("nul-byte", message, file, line=line, hint=hint)
        return None
    text = _decode_utf8(body, file, problems)
    return None if text is None or _report_line_ends(text, file, problems) else text


def _report_format(content: bytes, file: str, problems: Problems) -> bool:
    for start, encoding in _WIDE_BOMS:
        if content.startswith(start):
            shown = " ".join(f"{byte:02X}" for byte in start)
            message = f"is {encoding} (it starts with {shown}), not UTF-8"
            problems.add("not-utf8", message, file, line=1, hint=_UTF8_HINT)
            return True
    for start, what in _FORMATS:
        if content.startswith(start):
            hint = "send the plain text itself"
            problems.add("not-text", f"is {what}, not plain text", file, line=1, hint=hint)
            return True
    return False


def _decode_utf8(body: bytes, file: str, problems: Problems) -> str | None:
    try:
        return body.decode("utf-8")
    except UnicodeDecodeError as error:
        line = body.count(b"\n", 0, error.start) + 1
        position = error.start - (body.rfind(b"\n", 0, error.start) + 1) + 1
        message = f"byte {position} of the line, 0x{body[error.start]:02X}, is not UTF-8"
        problems.add("not-utf8", message, file, line=line, hint=_UTF8_HINT)
        return None


def _report_line_ends(text: str, file: str, problems: Problems) -> bool:
    position = text.replace("\r\n", "\n\n").find("\r")
    if position < 0:
        return False
    hint = "save it with Unix or Windows line ends"
    if "\n" not in text:
        problems.add("line-ends", "ends its lines with CR alone, as old Macs did", file, hint=hint)
    elif "\r\r\n" in text:
        hint = 'its lines were converted twice; in Python, open the file with newline=""'
        problems.add("line-ends", "ends its lines with CR CR LF", file, hint=hint)
    else:
        line = text.count("\n", 0, position) + 1
        message = "has a carriage return that is no line end; lines end in LF or CRLF"
        problems.add("line-ends", message, file, line=line, hint=hint)
    return True
