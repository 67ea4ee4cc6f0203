"""Faults of ``submission.toml`` in words, with the advice that fits each."""

import datetime as dt
from collections.abc import Mapping

import pytest
from hypothesis import given
from hypothesis import strategies as st

from builders import build_benchmark
from leaderboard.models import Metadata
from leaderboard.problems import CODES, Problem, Problems
from leaderboard.validation.metadata import judge_metadata
from raw_submissions import SUBMISSION_TOML, TODAY

LINKS = "\n[links]\n"


def judge(toml: str | bytes) -> tuple[Metadata | None, list[Problem]]:
    problems = Problems()
    content = toml.encode() if isinstance(toml, str) else toml
    return judge_metadata(content, build_benchmark(), "f", TODAY, problems), problems.found


def only_problem(toml: str) -> tuple[str, int | None, str, str]:
    metadata, found = judge(toml)
    assert metadata is None
    assert len(found) == 1
    return found[0].code, found[0].line, found[0].message, found[0].hint


def with_value(key: str, value: str) -> str:
    """The valid file with another value for one of its keys."""
    lines = SUBMISSION_TOML.splitlines()
    place = next(n for n, line in enumerate(lines) if line.startswith(f"{key} ="))
    return "\n".join([*lines[:place], f"{key} = {value}", *lines[place + 1 :]])


@pytest.mark.parametrize(
    ("link", "message", "hint"),
    [
        (
            "example.org/a",
            "links.paper 'example.org/a' must start with https:// or http:// and name a host",
            "write the whole link, starting with https://",
        ),
        (
            "",
            "links.paper '' must start with https:// or http:// and name a host",
            "write the whole link, or leave the key out",
        ),
        (
            "https://a b.org",
            "links.paper 'https://a b.org' has characters that a link must write as %XX",
            "copy the link from the browser's address line: a blank is %20 there",
        ),
        (
            "https://[::1",
            "links.paper 'https://[::1' is not a link",
            "write the whole link, starting with https://",
        ),
        (
            "https://me:secret@example.org/",
            "links.paper must not hold a user name or password",
            "take them out of the link, and change the password if it was real",
        ),
        (
            "ssh://me:secret@example.org/",
            "links.paper must start with https:// or http:// and name a host",
            "write the whole link, starting with https://",
        ),
        (
            "git@example.org:me/code",
            "links.paper 'git@example.org:me/code' must start with https:// or http:// and name a host",
            "write the whole link, starting with https://",
        ),
        (
            "https://secret-token@example.org/",
            "links.paper must not hold a user name or password",
            "take them out of the link, and change the password if it was real",
        ),
    ],
)
def test_a_refused_link_gets_fitting_advice(link: str, message: str, hint: str) -> None:
    """What is missing differs; a password is not repeated in a log that everybody can read."""
    problem = only_problem(f'{SUBMISSION_TOML}{LINKS}paper = "{link}"\n')
    assert problem == ("link-refused", 20, message, hint)


@pytest.mark.parametrize(
    ("value", "message", "hint"),
    [
        (
            '"""\nTwo\nlines."""',
            "submission.description has U+000A control character at position 4",
            "write it on one line, without tabs",
        ),
        (
            '"a\\tb"',
            "submission.description has U+0009 control character at position 2",
            "write it on one line, without tabs",
        ),
        (
            '"a\\u200bb"',
            "submission.description has U+200B ZERO WIDTH SPACE at position 2",
            "remove it: it is invisible or turns text around",
        ),
        (
            '"e\\u0301"',
            "submission.description is 'e\\u0301'; it is not in Unicode's composed form (NFC)",
            "type the accented letters anew, each as one character",
        ),
    ],
)
def test_characters_get_fitting_advice(value: str, message: str, hint: str) -> None:
    """Several lines, an invisible character and a decomposed letter are mended in different ways."""
    _, _, found, advice = only_problem(with_value("description", value))
    assert (found, advice) == (message, hint)


def test_a_blank_name_is_refused() -> None:
    """Blanks around a text would show."""
    code, line, message, hint = only_problem(with_value("team", '" Lab"'))
    assert (code, line, hint) == ("malformed-value", 4, "write the text without blanks around it")
    assert message == "submission.team is ' Lab'; it must not be empty, nor start or end with a blank"


@pytest.mark.parametrize(
    ("section", "key", "hint"),
    [
        ("contact", "team", "it belongs in the section [submission]"),
        ("submission", "github", "it belongs in the section [contact]"),
        ("links", "training", "it belongs in the section [protocol]"),
        ("model", "inptus", "did you mean inputs?"),
        ("contact", "mail", "known here: github"),
    ],
)
def test_an_unknown_key_is_shown_its_place(section: str, key: str, hint: str) -> None:
    """A key of another section is sent there; others get the nearest name, or all names."""
    toml = f"{SUBMISSION_TOML}{LINKS}".replace(f"[{section}]", f'[{section}]\n{key} = "x"')
    assert only_problem(toml)[0::2] == ("unknown-key", f"{section}.{key} is not a known key")
    assert only_problem(toml)[3] == hint


@pytest.mark.parametrize(
    ("line", "message", "hint"),
    [
        ("date = 2026-02-30", "a date does not exist", "write a date such as 2026-11-21"),
        (
            r'code = "C:\quick"',
            "a backslash stands alone in a text",
            r"write it twice, \\, or put the text in single quotes",
        ),
        (
            "date = 21.11.2026",
            "something follows where a value has ended",
            'texts stand in double quotes, key = "text"; dates read 2026-11-21',
        ),
        ("[model", "a section's name does not end", "close it with ]"),
        ("[]", "a key or section has no plain name", 'write [section] or key = "text"'),
        ("a = [1, 2", "a bracket does not close", "close it with ] or }"),
        ("a = {b = 1", "a bracket does not close", "close it with ] or }"),
        ("a = {b = 1, b = 2}", "a key is given twice", "give each key once"),
        ("= 3", "a line is neither a section nor a key with a value", 'write key = "text"'),
        ("{", "a line is neither a section nor a key with a value", 'write key = "text"'),
        ('a = "x\x7f"', "a control character stands in the file", "remove it, or type the line anew"),
        ("# \x01", "a control character stands in the file", "remove it, or type the line anew"),
        ('a = """x', "a text does not end", "close it with a double quote"),
        (
            r'a = "\ud800"',
            "Escaped character is not a Unicode scalar value",
            "see docs/submitting.md for an example of the whole file",
        ),
    ],
)
def test_what_is_not_toml_is_said_in_plain_words(line: str, message: str, hint: str) -> None:
    """The parser's messages are for those who know its grammar; ours are for participants."""
    code, _, found, advice = only_problem(line)
    assert (code, found, advice) == ("toml-syntax", f"is not TOML: {message}", hint)


def test_a_number_too_long_to_show_is_described() -> None:
    """What is wrong with it is its size."""
    message = "protocol.training_trials is a whole number of more than 15 digits"
    for number in ("1" * 16, "-" + "1" * 16, "0x" + "f" * 9000):
        toml = SUBMISSION_TOML.replace("[protocol]", f"[protocol]\ntraining_trials = {number}")
        code, line, found, _ = only_problem(toml)
        assert (code, line, found) == ("malformed-value", 9, message)


def test_doubled_brackets_of_a_section_are_found() -> None:
    """[[contact]] would be a list of sections."""
    problem = only_problem(SUBMISSION_TOML.replace("[contact]", "[[contact]]"))
    assert problem == (
        "wrong-type",
        16,
        "contact is a list",
        "write [contact] on a line of its own, and its keys below",
    )


def test_a_protocol_without_track_is_told_the_tracks() -> None:
    """With the conditions of each."""
    hint = "the tracks are with (testing with_property); without (testing without_property)"
    assert only_problem(with_value("testing", '"fully_observed"'))[3] == hint


def test_windows_files_are_judged_alike() -> None:
    """A byte-order mark and CRLF change neither the verdict nor the lines of its problems."""
    for toml in (SUBMISSION_TOML, with_value("inputs", '"sound"'), with_value("date", "2026-02-30"), "[a\n"):
        assert judge("\ufeff" + toml.replace("\n", "\r\n")) == judge(toml)


SCALARS = (
    st.text(max_size=12)
    | st.integers()
    | st.booleans()
    | st.floats()
    | st.dates()
    | st.datetimes()
    | st.times()
)
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=6,
)
SECTIONS = {
    "submission": "date",
    "protocol": "training_trials",
    "model": "inputs",
    "links": "paper",
    "contact": "github",
}
KEYS = st.sampled_from(sorted(SECTIONS.values())) | st.text(max_size=6)


def to_toml(value: object) -> str:
    """Write a value as TOML does."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return '"' + "".join(f"\\U{ord(character):08x}" for character in value) + '"'
    if isinstance(value, list):
        return f"[{', '.join(map(to_toml, value))}]"
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{to_toml(key)} = {to_toml(inner)}' for key, inner in value.items())}}}"
    return value.isoformat() if isinstance(value, dt.date | dt.time) else str(value)


@given(st.sampled_from(sorted(SECTIONS)), KEYS, VALUES, st.booleans())
def test_any_value_of_any_key_is_judged(section: str, key: str, value: object, is_whole: bool) -> None:
    """Whatever stands for a value or a whole section gives metadata, or problems that can be shown."""
    text = f"{SUBMISSION_TOML}{LINKS}"
    if is_whole:
        toml = f"{section} = {to_toml(value)}\n{text.replace(f'[{section}]', '[other]')}"
    else:
        toml = text.replace(f"[{section}]", f"[{section}]\n{to_toml(key)} = {to_toml(value)}")
    metadata, found = judge(toml)
    assert (metadata is None) == bool(found)
    for problem in found:
        assert problem.code in CODES
        assert problem.hint
        assert len(problem.message) <= 400
        assert (problem.message + problem.hint).isprintable()
        assert problem.line is None or 1 <= problem.line <= toml.count("\n") + 1


@given(st.binary(max_size=200) | st.text(alphabet="[]{}=\"'\\#.\n\r,0ae-", max_size=60).map(str.encode))
def test_any_bytes_are_judged(content: bytes) -> None:
    """Bytes at random, and characters that mean something to TOML, give problems and never an exception."""
    metadata, found = judge(content)
    assert metadata is None
    assert found
    assert all(problem.message.isprintable() and len(problem.message) <= 400 for problem in found)


@pytest.mark.parametrize(
    "piece", ["[", "{a=", "a.", '"', "'''", "a=1\n", "[a]\n", "#", "\\", "[a.", "x=[\n", "\x00"]
)
def test_sixty_kilobytes_of_anything_are_one_verdict(piece: str) -> None:
    """Neither deep nesting nor repetition breaks the parser, and the number of problems stays small."""
    metadata, found = judge(piece * (60_000 // len(piece)))
    assert metadata is None
    assert 1 <= len(found) <= 10
