"""Reading files of records, whether they are JSON lines, a JSON list or a table, and maps of names."""

import csv
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from leaderboard.converting.json_logs import SIZE_LIMIT, as_record, read_json, read_json_lines, type_name
from leaderboard.converting.records import Options, Record
from leaderboard.errors import SourceError
from leaderboard.reference.cells import quote
from leaderboard.reference.source_tables import read_source_table

MAP_COLUMNS = ("log_id", "trial_id")

_LINES, _TABLES = (".jsonl", ".ndjson"), (".csv", ".tsv")


def read_records(path: Path) -> Iterator[Record]:
    """Read a file of records by the end of its name: .jsonl, .ndjson, .json, .csv or .tsv.

    Raises
    ------
    SourceError
        If it has another ending, or is not what that says.
    """
    suffix = path.suffix.lower()
    if suffix in _LINES:
        return read_json_lines(path)
    if suffix in _TABLES:
        return read_table(path)
    if suffix == ".json":
        return read_list(path)
    hint = "save the sheet as CSV" if suffix in (".xlsx", ".xls", ".ods") else ""
    endings = ", ".join((*_LINES, ".json", *_TABLES))
    raise SourceError(f"{path}: is none of {endings}, to judge by its name", hint)


def read_table(path: Path) -> Iterator[Record]:
    """Read a table with a header, as CSV or separated by tabs.

    Raises
    ------
    SourceError
        If it is malformed.
    """
    with _long_cells():
        rows = read_source_table(path, (), limit=SIZE_LIMIT).rows
    for row in rows:
        yield Record(row.file, row.line, row.cells)


def read_list(path: Path) -> Iterator[Record]:
    """Read a file that is one JSON list of objects.

    Raises
    ------
    SourceError
        If it is something else.
    """
    yield from list_records(read_json(path), str(path), unit="record")


def list_records(values: object, file: str, *, unit: str) -> Iterator[Record]:
    """Take the objects in a JSON list for records, numbered from 1.

    Raises
    ------
    SourceError
        If it is no list, is empty, or holds something else.
    """
    if not isinstance(values, list):
        raise SourceError(f"{file}: holds {type_name(values)} where a list of {unit}s should be")
    if not values:
        raise SourceError(f"{file}: has no {unit}s")
    for number, value in enumerate(values, 1):
        yield as_record(value, file, number, unit=unit)


def read_id_map(path: Path) -> Mapping[str, str]:
    """Read which trials a log's own ids mean: a CSV file with the columns log_id and trial_id.

    Raises
    ------
    SourceError
        If it is malformed, or gives an id twice.
    """
    trials: dict[str, str] = {}
    for row in read_source_table(path, MAP_COLUMNS).rows:
        if row["log_id"] in trials:
            raise row.error(f"log_id {quote(row['log_id'])} is given twice")
        trials[row["log_id"]] = row["trial_id"]
    return trials


def group_by_model(files: Sequence[Path], options: Options, number: str) -> dict[str, list[Path]]:
    """Sort files by the folder that some tools make for each model.

    Raises
    ------
    SourceError
        For what `require_own_map` refuses.
    """
    groups: dict[str, list[Path]] = {}
    for file in files:
        groups.setdefault(file.absolute().parent.name, []).append(file)
    for group in groups.values():
        require_own_map(group, options, number)
    return groups


def require_own_map(files: Sequence[Path], options: Options, number: str) -> None:
    """Refuse one map for several files of a model, where each counts its trials anew in the field ``number``.

    Raises
    ------
    SourceError
        If there is such a map.
    """
    if len(files) > 1 and options.id_map and options.id_field is None:
        raise SourceError(
            f"{files[1]}: may count {number} anew from where {files[0]} does, so one map cannot name both",
            "convert them one by one, each with its map, and give all predictions to leaderboard submit",
        )


def read_all(files: Sequence[Path]) -> Iterator[Record]:
    """Read several files of records as one."""
    for file in files:
        yield from read_records(file)


@contextmanager
def _long_cells() -> Iterator[None]:
    """Let cells be as long as files: a chain of thought may exceed the csv module's 131,072 characters."""
    limit = csv.field_size_limit(SIZE_LIMIT)
    try:
        yield
    finally:
        csv.field_size_limit(limit)
