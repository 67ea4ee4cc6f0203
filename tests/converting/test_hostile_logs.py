"""Files that are broken, or made to break a reader: each gets one clear line, and nothing else happens."""

import copy
import csv
import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from builders import build_reference
from leaderboard.converting import FORMATS, Options
from leaderboard.errors import SourceError
from leaderboard.report.conversion import render_conversion
from model_logs import WRITERS, Said

REFERENCE = build_reference(2)
SAID = [
    Said(trial_id, bool(label), ("yes", "no") if label else ("no",))
    for trial_id, label in zip(REFERENCE.trial_ids, REFERENCE.labels, strict=True)
]
OF_JSON = [name for name in WRITERS if name not in ("probabilities", "vlmevalkit")]
JUNK: st.SearchStrategy[object] = st.sampled_from(
    [None, True, -1, 0.5, 10**40, 1e308, "", "yes", "\ud800", "\x1b[2J", [], [[]], ["yes"], {}, {"a": 1}]
) | st.lists(st.sampled_from([["nan", "True"], ["-1", "False"], "no", None]), max_size=3)

Place = tuple[str | int, ...]


def read(name: str, *files: Path, **options: Any) -> None:
    for conversion in FORMATS[name].split_runs(files, REFERENCE, Options(**options)).values():
        render_conversion(conversion).encode()


def refuse(name: str, *files: Path, **options: Any) -> str:
    with pytest.raises(SourceError) as caught:
        read(name, *files, **options)
    return caught.value.message.replace(f"{files[0].parent}/", "")


def list_places(value: object, place: Place = ()) -> Iterator[Place]:
    """Where a JSON value has values: their keys and indices."""
    yield place
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, part in inner:
        yield from list_places(part, (*place, key))


def put(value: Any, place: Place, junk: object) -> Any:
    """A copy of a JSON value with something else in one place."""
    if not place:
        return junk
    changed = copy.deepcopy(value)
    inner = changed
    for key in place[:-1]:
        inner = inner[key]
    inner[place[-1]] = junk
    return changed


@dataclass(frozen=True)
class Log:
    """A file of a format, and its content: an object, or one for each line."""

    name: str
    file: Path
    value: Any

    @property
    def is_lines(self) -> bool:
        return self.file.suffix == ".jsonl"

    def write(self, value: Any) -> None:
        text = "\n".join(map(json.dumps, value)) if self.is_lines else json.dumps(value)
        self.file.write_text(text, encoding="utf-8")


def load(name: str, folder: Path) -> Log:
    file = WRITERS[name](folder, SAID)
    text = file.read_text("utf-8")
    is_lines = file.suffix == ".jsonl"
    return Log(name, file, [json.loads(line) for line in text.splitlines()] if is_lines else json.loads(text))


@pytest.fixture
def log(request: pytest.FixtureRequest, tmp_path: Path) -> Log:
    """The log of a format that the test is run for."""
    return load(request.param, tmp_path)


@pytest.mark.parametrize("log", OF_JSON, indirect=True)
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_any_value_in_any_place_is_read_or_refused(log: Log, data: st.DataObject) -> None:
    """Whatever stands in place of a value, the log is converted and reported, or refused in one line."""
    place = data.draw(st.sampled_from([place for place in list_places(log.value) if place]))
    log.write(put(log.value, place, data.draw(JUNK)))
    message = ""
    try:
        read(log.name, log.file)
    except SourceError as error:
        message = error.message
    assert b"\n" not in message.encode()


@pytest.mark.parametrize("name", OF_JSON)
def test_file_that_was_cut_off_is_refused(tmp_path: Path, name: str) -> None:
    """A log that was not written to its end is no shorter log."""
    file = WRITERS[name](tmp_path, SAID)
    content = file.read_bytes().rstrip()
    file.write_bytes(content[:-9])
    with pytest.raises(SourceError, match=r": is no JSON: .* at column [0-9]+$") as caught:
        read(name, file)
    assert caught.value.hint == "was the file cut off while it was written?"


@pytest.mark.parametrize("name", ["probabilities", "vlmevalkit"])
def test_table_that_was_cut_off_is_refused(tmp_path: Path, name: str) -> None:
    """A row with fewer cells than the header is none."""
    file = WRITERS[name](tmp_path, SAID)
    rows = file.read_text("utf-8").splitlines()
    separator = "\t" if file.suffix == ".tsv" else ","
    file.write_text("\n".join([*rows[:-1], rows[-1].rpartition(separator)[0]]), encoding="utf-8")
    assert refuse(name, file).startswith(f"{file.name}:{len(rows)}: has ")


@pytest.mark.parametrize(
    ("name", "field"),
    [
        ("answers", "response"),
        ("eureka", "model_output"),
        ("evalscope", "sample_score.score.prediction"),
        ("inspect", "samples.0.output.completion"),
        ("physmind", "0.questions.0.normalized_prediction"),
        ("lmms-eval", "filtered_resps"),
        ("lm-eval", "resps"),
    ],
)
def test_answer_that_is_missing_is_not_taken_for_an_empty_one(tmp_path: Path, name: str, field: str) -> None:
    """Where the field with the answer is not there, the log is of another version or kind."""
    log = load(name, tmp_path)
    inner = log.value[-1] if log.is_lines else log.value
    *folders, key = field.split(".")
    for folder in folders:
        inner = inner[int(folder)] if isinstance(inner, list) else inner[folder]
    del inner[key]
    log.write(log.value)
    lacking = field.removeprefix("samples.0.").removeprefix("0.questions.0.")
    assert f": lacks {lacking}" in refuse(name, log.file)


@pytest.mark.parametrize(
    ("name", "number"), [("lmms-eval", "doc_id"), ("evalscope", "index"), ("vlmevalkit", "index")]
)
def test_one_map_does_not_serve_several_files(tmp_path: Path, name: str, number: str) -> None:
    """Each task counts from 0, so a map of numbers would name other trials than were asked about."""
    first = WRITERS[name](tmp_path, SAID)
    second = first.with_name(f"b{first.suffix}")
    second.write_bytes(first.read_bytes())
    assert refuse(name, first, second, id_map={"0": "x"}) == (
        f"{second.name}: may count {number} anew from where {first.name} does, so one map cannot name both"
    )


def test_cells_may_be_long(tmp_path: Path) -> None:
    """A chain of thought longer than the csv module's own limit is read, and the limit is as before."""
    thought = "no, " * 50_000
    file = tmp_path / "log.csv"
    file.write_text(f'id,answer\n"{REFERENCE.trial_ids[0]}","{thought}\nyes"\n', encoding="utf-8")
    (run,) = FORMATS["answers"].read_runs([file], Options())
    assert run.answers[0].probability == "1"
    assert csv.field_size_limit() == 131_072


def test_repeated_key_among_many_is_found_at_once(tmp_path: Path) -> None:
    """In quadratic time this would take an hour."""
    keys = ", ".join(f'"{number}": 0' for number in range(200_000))
    file = tmp_path / "log.jsonl"
    file.write_text(f'{{{keys}, "199999": 1}}', encoding="utf-8")
    assert refuse("answers", file) == "log.jsonl:1: has the key '199999' twice in an object"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ('{"id": "a"}'.encode("utf-16"), "is not UTF-8 text (byte 0xff)"),
        ('{"id": "ä"}'.encode("latin-1"), "is not UTF-8 text (byte 0xe4)"),
        (b'{"id": 1' + b"0" * 5_000 + b"}", "Exceeds the limit (4300 digits) for integer string conversion"),
        (b'{"id": "a\0b", "answer": "yes"}', "is no JSON: Invalid control character at column 10"),
        (b'{"id": -Infinity}', "holds -Infinity, which is no number of JSON"),
        (b'\xef\xbb\xbf\xef\xbb\xbf{"id": "a"}', "is no JSON: Expecting value at column 1"),
        (b'{"a":' * 2_000, "is nested too deeply to be a log"),
    ],
)
def test_bytes_that_are_no_text_are_refused(tmp_path: Path, content: bytes, message: str) -> None:
    """Other encodings, endless numbers and depths get one line."""
    file = tmp_path / "log.jsonl"
    file.write_bytes(content)
    assert refuse("answers", file).startswith(f"log.jsonl:1: {message}")


def test_only_plain_files_are_read(tmp_path: Path) -> None:
    """A folder is none; neither is a link that leads to itself."""
    folder = tmp_path / "log.jsonl"
    folder.mkdir()
    assert refuse("answers", folder) == "log.jsonl: cannot be read: Is a directory"
    link = tmp_path / "link.jsonl"
    link.symlink_to(link)
    assert refuse("answers", link).startswith("link.jsonl: cannot be read: ")
