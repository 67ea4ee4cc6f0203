"""Judging ``submission.toml``: pydantic finds the faults, this module puts them into words and lines."""

import datetime as dt
import re
import tomllib
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from leaderboard.ids import find_nearest
from leaderboard.models import Benchmark, Metadata, Protocol
from leaderboard.problems import Problems
from leaderboard.validation.quoting import quote_briefly
from leaderboard.validation.text import decode_text

_EXPECTED = {
    "string_type": "a text in double quotes",
    "int_type": "a whole number",
    "date_type": "a date such as 2026-11-21, without quotes",
    "model_type": "[{name}] on a line of its own, and its keys below",
}
_FOUND = {
    str: "a text",
    bool: "true or false",
    int: "a whole number",
    float: "a number with a point",
    dt.datetime: "a date with a time",
    dt.date: "a date",
    dt.time: "a time",
    list: "a list",
    dict: "a section",
}
_BOUNDS = {"greater_than_equal": ("at least", "ge"), "less_than_equal": ("at most", "le")}
_MAX_SHOWN_NUMBER = 10**15
_MAX_DOTS = (
    1000  # in a line: no valid one has more, and the parser takes seconds for a key a.a.a. ... of thousands
)
_TOML_PLACE = re.compile(r" \(at (?:line ([0-9]+), column [0-9]+|end of document)\)$")
_SECRET = re.compile("[:/][^/@]+@")  # as in https://user:password@host
_NFC_HINT = "type the accented letters anew, each as one character"
_TOML_HINT = "see docs/submitting.md for an example of the whole file"
_TOML_TEXTS = 'texts stand in double quotes, key = "text"; dates read 2026-11-21'
_NEITHER = ("a line is neither a section nor a key with a value", 'write key = "text"')
_CONTROL = ("a control character stands in the file", "remove it, or type the line anew")
_OPEN = ("a bracket does not close", "close it with ] or }")
_TOML_FAULTS = {  # how the parser's message starts: our words, and what to do
    "Invalid value": ("a value cannot be read", 'texts stand in double quotes: key = "text"'),
    "Invalid date": ("a date does not exist", "write a date such as 2026-11-21"),
    "Expected newline or end of document": ("something follows where a value has ended", _TOML_TEXTS),
    "Unescaped '\\'": (
        "a backslash stands alone in a text",
        r"write it twice, \\, or put the text in single quotes",
    ),
    "Expected '=' after a key": _NEITHER,
    "Invalid statement": _NEITHER,
    "Expected ']' at the end of a table": ("a section's name does not end", "close it with ]"),
    "Invalid initial character for a key": (
        "a key or section has no plain name",
        'write [section] or key = "text"',
    ),
    "Unclosed": _OPEN,
    "Duplicate inline table key": ("a key is given twice", "give each key once"),
    "Cannot overwrite a value": ("a key is given twice", "give each key once"),
    "Cannot declare": ("a section is given twice", "give each section once"),
    "Illegal character '\\n'": ("a text does not end on its line", "close it with a double quote"),
    "Illegal character": _CONTROL,
    "Found invalid character": _CONTROL,
    "Unterminated string": ("a text does not end", "close it with a double quote"),
    "Exceeds the limit": ("a number has thousands of digits", "write a number that can be meant"),
}


def judge_metadata(
    content: bytes, benchmark: Benchmark, file: str, today: dt.date, problems: Problems
) -> Metadata | None:
    """Judge what a submission says of itself; None, and problems by line, if it is not valid."""
    text = decode_text(content, file, problems)
    data = None if text is None else _parse_toml(text, file, problems)
    if text is None or data is None:
        return None
    lines, found, metadata = _locate_keys(text), Problems(), None
    try:
        metadata = Metadata.model_validate(data)
    except ValidationError as error:
        for details in error.errors(include_url=False):
            _report_fault(details, lines, file, found)
    _judge_date(data, lines, file, today, found)
    _judge_track(data, benchmark, lines, file, found)
    problems.extend_by_line(found)
    return None if found else metadata


def _parse_toml(text: str, file: str, problems: Problems) -> dict[str, Any] | None:
    hint = "sections hold plain values only"
    lines = text.replace("\r\n", "\n").split("\n")
    deep = next((number for number, line in enumerate(lines, 1) if line.count(".") > _MAX_DOTS), None)
    if deep is not None:
        problems.add("toml-syntax", "is nested too deeply", file, line=deep, hint=hint)
        return None
    try:
        return tomllib.loads("\n".join(lines))
    except RecursionError:
        problems.add("toml-syntax", "is nested too deeply", file, hint=hint)
    except ValueError as error:  # a TOMLDecodeError, or Python's refusal of numbers of thousands of digits
        place = _TOML_PLACE.search(str(error))
        line = int(place[1]) if place and place[1] else None
        what, hint = _describe_syntax(_TOML_PLACE.sub("", str(error)))
        problems.add("toml-syntax", f"is not TOML: {what}", file, line=line, hint=hint)
    return None


def _describe_syntax(what: str) -> tuple[str, str]:
    """Put the parser's message into our words; one that is not foreseen into printable ASCII at least."""
    for start, (ours, hint) in _TOML_FAULTS.items():
        if what.startswith(start):
            return ours, hint
    return (what if what.isascii() and what.isprintable() else ascii(what)[1:-1]), _TOML_HINT


def _locate_keys(text: str) -> dict[tuple[str, ...], int]:
    """Find the line of each section and key, as far as they are written plainly."""
    lines: dict[tuple[str, ...], int] = {}
    section: tuple[str, ...] = ()
    for number, line in enumerate(text.split("\n"), 1):
        if head := re.match(r"\s*\[\[?([^\[\]]+)\]", line):
            section = tuple(part.strip().strip("\"'") for part in head[1].split("."))
            lines.setdefault(section, number)
        elif key := re.match(r"""\s*["']?([^\s"'=#]+)["']?\s*=""", line):
            lines.setdefault((*section, *key[1].split(".")), number)
    return lines


def _report_fault(
    details: ErrorDetails, lines: dict[tuple[str, ...], int], file: str, problems: Problems
) -> None:
    path = tuple(str(part) for part in details["loc"])
    line = next((lines[path[:n]] for n in range(len(path), 0, -1) if path[:n] in lines), None)
    code, message, hint = _describe_fault(details, path)
    problems.add(code, message, file, line=line, hint=hint)


def _describe_fault(details: ErrorDetails, path: tuple[str, ...]) -> tuple[str, str, str]:
    """Turn pydantic's fault into a code, a message and a hint."""
    name, kind = _dotted(path), details["type"]
    found = details["input"]
    if kind == "missing":
        what = "section" if len(path) == 1 else "key"
        return "missing-key", f"{what} {name} is missing", "see docs/submitting.md for what each means"
    if kind == "extra_forbidden":
        return "unknown-key", f"{name} is not a known key", _hint_key(path)
    if kind == "literal_error" and not isinstance(found, str):
        return "wrong-type", f"{name} is {_name_type(found)}", f"write one of {details['ctx']['expected']}"
    if kind in _EXPECTED:
        hint = f"write {_EXPECTED[kind].format(name=name)}"
        return "wrong-type", f"{name} is {_name_type(found)}", hint
    if kind == "value_error":
        return _describe_refusal(name, path, str(details["ctx"]["error"]), found)
    return _describe_value(details, path)


def _describe_value(details: ErrorDetails, path: tuple[str, ...]) -> tuple[str, str, str]:
    """Describe a value of the right type that its key does not allow."""
    name, found, context = _dotted(path), details["input"], details.get("ctx", {})
    if details["type"] == "literal_error":
        return "unknown-value", f"{name} is {_show(found)}", f"write one of {context['expected']}"
    if details["type"] == "string_too_long":
        limit = context["max_length"]
        return "text-too-long", f"{name} has {len(found)} characters; the limit is {limit}", "shorten it"
    if details["type"] == "string_pattern_mismatch":
        return "malformed-value", f"{name} is {_show(found)}", _hint_pattern(path)
    bound, key = _BOUNDS[details["type"]]
    return "malformed-value", f"{name} is {_show(found)}", f"it must be {bound} {context[key]:,}"


def _describe_refusal(name: str, path: tuple[str, ...], reason: str, found: object) -> tuple[str, str, str]:
    """Describe what the models' own rules refuse."""
    if path[0] == "links":
        return _describe_link(name, reason, found)
    if reason.startswith(("has U+0009 ", "has U+000A ")):
        return "forbidden-character", f"{name} {reason}", "write it on one line, without tabs"
    if reason.startswith("has U+"):
        return "forbidden-character", f"{name} {reason}", "remove it: it is invisible or turns text around"
    if reason.startswith("stacks"):
        return "forbidden-character", f"{name} {reason}", "write letters with at most a few marks"
    is_blank = reason.startswith("must not be empty")
    hint = "write the text without blanks around it" if is_blank else _NFC_HINT
    return "malformed-value", f"{name} is {_show(found)}; it {reason}", hint


def _describe_link(name: str, reason: str, found: object) -> tuple[str, str, str]:
    """Describe a refused link; one that may hold a password is not repeated."""
    shown = "" if _SECRET.search(str(found)) else f" {_show(found)}"
    hint = "write the whole link, starting with https://"
    if "password" in reason:
        hint = "take them out of the link, and change the password if it was real"
    elif not found:
        hint = "write the whole link, or leave the key out"
    elif "%XX" in reason:
        hint = "copy the link from the browser's address line: a blank is %20 there"
    return "link-refused", f"{name}{shown} {reason}", hint


def _hint_key(path: tuple[str, ...]) -> str:
    fields: Any = Metadata
    for part in path[:-1]:
        fields = fields.model_fields[part].annotation
    owner = _find_section(path[-1])
    if owner:
        return f"it belongs in the section [{owner}]"
    near = find_nearest(path[-1], fields.model_fields)
    known = ", ".join(fields.model_fields)
    return f"did you mean {near}?" if near else f"known here: {known}"


def _find_section(key: str) -> str | None:
    """Find the section that has a key of this name."""
    sections: Any = {name: field.annotation for name, field in Metadata.model_fields.items()}
    return next((name for name, section in sections.items() if key in section.model_fields), None)


def _hint_pattern(path: tuple[str, ...]) -> str:
    if path[-1] == "github":
        return "write the account's name: letters, digits and single hyphens, at most 39"
    return "write 2 to 64 of a-z, 0-9 and -, starting and ending with a letter or digit"


def _judge_date(
    data: dict[str, Any],
    lines: dict[tuple[str, ...], int],
    file: str,
    today: dt.date,
    problems: Problems,
) -> None:
    date = _section(data, "submission").get("date")
    if type(date) is dt.date and date > today + dt.timedelta(days=1):
        message = f"submission.date {date} is in the future; today is {today} (UTC)"
        line = lines.get(("submission", "date"))
        problems.add("date-in-future", message, file, line=line, hint="give the day of submitting")


def _judge_track(
    data: dict[str, Any],
    benchmark: Benchmark,
    lines: dict[tuple[str, ...], int],
    file: str,
    problems: Problems,
) -> None:
    """Report a protocol that fits no track; baselines are on all of them."""
    try:
        protocol = Protocol.model_validate(_section(data, "protocol"))
    except ValidationError:
        return
    is_baseline = _section(data, "model").get("family") == "baseline"
    if is_baseline or benchmark.find_track(protocol) is not None:
        return
    tracks = "; ".join(
        f"{track.id} ({', '.join(f'{k} {v}' for k, v in track.conditions.items())})"
        for track in benchmark.tracks
    )
    message = f"no track takes training {protocol.training} with testing {protocol.testing}"
    problems.add("no-track", message, file, line=lines.get(("protocol",)), hint=f"the tracks are {tracks}")


def _section(data: dict[str, Any], name: str) -> dict[str, Any]:
    section = data.get(name)
    return section if isinstance(section, dict) else {}


def _dotted(path: tuple[str, ...]) -> str:
    text = ".".join(path)
    return text if text.isascii() and text.isprintable() and len(text) <= 80 else quote_briefly(text)  # noqa: PLR2004


def _show(value: object) -> str:
    """Show a text or a whole number; values of other kinds are refused for their kind."""
    if isinstance(value, str):
        return quote_briefly(value)
    is_short = isinstance(value, int) and abs(value) < _MAX_SHOWN_NUMBER
    return str(value) if is_short else "a whole number of more than 15 digits"


def _name_type(value: object) -> str:
    return next((name for type_, name in _FOUND.items() if isinstance(value, type_)), "something else")
