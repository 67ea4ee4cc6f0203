"""Reading logs in JSON strictly: no key twice, no NaN unless the tool writes it, no endless nesting."""

import json
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from leaderboard.converting.records import Record
from leaderboard.errors import SourceError
from leaderboard.files import read_regular
from leaderboard.reference.cells import quote

SIZE_LIMIT = 500_000_000
_BOM = b"\xef\xbb\xbf"


def read_json(path: Path, *, may_hold_nan: bool = False) -> object:
    """Read a file that is one JSON value.

    Parameters
    ----------
    path
        Where it is; a symbolic link is followed, since the file is the caller's own.
    may_hold_nan
        Some tools write NaN and infinities for scores that they could not compute; these become None.

    Raises
    ------
    SourceError
        If it cannot be read, is too large, is no UTF-8, or for what `parse_json` refuses.
    """
    return parse_json(_read_bytes(path), str(path), 1, may_hold_nan=may_hold_nan)


def read_json_lines(path: Path, *, may_hold_nan: bool = False) -> Iterator[Record]:
    """Read a file with one JSON object on each line; blank lines at its end are none.

    Raises
    ------
    SourceError
        Likewise, and if a line is blank or no object, or there is none.
    """
    lines = _read_bytes(path).rstrip().split(b"\n")
    if lines == [b""]:
        raise SourceError(f"{path}: is empty")
    for number, line in enumerate(lines, 1):
        if not line.strip():
            raise SourceError(f"{path}:{number}: the line is blank")
        value = parse_json(line, str(path), number, may_hold_nan=may_hold_nan)
        yield as_record(value, str(path), number)


def parse_json(content: bytes, file: str, line: int, *, may_hold_nan: bool = False) -> object:
    """Parse JSON that starts on a line of a file.

    Raises
    ------
    SourceError
        If it is malformed, repeats a key in an object, is nested too deeply, or holds NaN.
    """
    try:
        return (_LENIENT if may_hold_nan else _STRICT).decode(content.decode())
    except UnicodeDecodeError as error:
        line += content.count(b"\n", 0, error.start)
        raise SourceError(f"{file}:{line}: is not UTF-8 text (byte 0x{content[error.start]:02x})") from None
    except json.JSONDecodeError as error:
        where = f"{file}:{line + error.lineno - 1}"
        message = error.msg.removesuffix(" at")
        was_cut = error.pos >= len(error.doc.rstrip()) or message == "Unterminated string starting"
        hint = "was the file cut off while it was written?" if was_cut else ""
        raise SourceError(f"{where}: is no JSON: {message} at column {error.colno}", hint) from None
    except RecursionError:
        raise SourceError(f"{file}:{line}: is nested too deeply to be a log") from None
    except ValueError as error:  # a repeated key, NaN, or a number of thousands of digits
        raise SourceError(f"{file}:{line}: {error}") from None


def as_record(value: object, file: str, line: int, *, unit: str = "") -> Record:
    """Take a value of JSON for a record.

    Raises
    ------
    SourceError
        If it is no object.
    """
    if not isinstance(value, dict):
        where = f"{file}, {unit} {line}" if unit else f"{file}:{line}"
        raise SourceError(f"{where}: is {type_name(value)}, not an object")
    return Record(file, line, value, unit)


def type_name(value: object) -> str:
    """Name the type of a JSON value.

    >>> type_name(None), type_name([]), type_name(0.5)
    ('null', 'a list', 'a number')
    """
    if value is None:
        return "null"
    names: dict[type, str] = {bool: "true or false", str: "a text", list: "a list", dict: "an object"}
    return names.get(type(value), "a number")


def _read_bytes(path: Path) -> bytes:
    try:
        content = read_regular(path.resolve(), SIZE_LIMIT)
    except (OSError, RuntimeError) as error:  # RuntimeError: links that run in a circle
        reason = getattr(error, "strerror", None) or str(error)
        raise SourceError(f"{path}: cannot be read: {reason}") from None
    if content is None:
        raise SourceError(f"{path}: is larger than {SIZE_LIMIT:,} bytes", "is it the right file?")
    return content.removeprefix(_BOM)


def _refuse_repeated_keys(pairs: list[tuple[str, object]]) -> dict[str, object]:
    found = dict(pairs)
    if len(found) != len(pairs):
        counts = Counter(key for key, _ in pairs)
        repeated = next(key for key, count in counts.items() if count > 1)
        raise ValueError(f"has the key {quote(repeated)} twice in an object")
    return found


def _refuse_constant(name: str) -> object:
    raise ValueError(f"holds {name}, which is no number of JSON")


def _forget(name: str) -> None:
    del name  # NaN or an infinity: a score that could not be computed


_STRICT = json.JSONDecoder(object_pairs_hook=_refuse_repeated_keys, parse_constant=_refuse_constant)
_LENIENT = json.JSONDecoder(object_pairs_hook=_refuse_repeated_keys, parse_constant=_forget)
