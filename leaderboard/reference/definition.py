"""Reading what defines, mends and seals a reference: benchmark.toml, errata.toml and manifest.json."""

import json
import re
import tomllib
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ValidationError

from leaderboard.files import read_regular
from leaderboard.instance import (
    BENCHMARK_FILE,
    ERRATA_FILE,
    HUMAN_RESPONSES_FILE,
    HUMAN_TRIALS_FILE,
    MANIFEST_FILE,
    PUBLISHED_FILE,
    Instance,
)
from leaderboard.models import Benchmark, Errata, Manifest
from leaderboard.models.faults import describe_faults
from leaderboard.problems import Problems

SIZE_LIMIT = 200_000_000
CHECK_HINT = "leaderboard reference check"
SEAL_HINT = "if the change is meant: leaderboard reference seal --kind official|synthetic"

_HUMAN_FILES = (HUMAN_TRIALS_FILE, HUMAN_RESPONSES_FILE)

Model = TypeVar("Model", bound=BaseModel)


def shown(name: str) -> str:
    """Return how messages name a file of the reference."""
    return f"reference/{name}"


def sealed_names(benchmark: Benchmark) -> tuple[str, ...]:
    """Name every file that a reference of this definition may consist of, the manifest aside."""
    trial_lists = (property_.file for property_ in benchmark.properties)
    return (BENCHMARK_FILE, *trial_lists, *_HUMAN_FILES, PUBLISHED_FILE, ERRATA_FILE)


def read_reference_file(instance: Instance, name: str, problems: Problems) -> bytes | None:
    """Read one file of the reference; None and a problem if that is not possible."""
    path = instance.reference_file(name)
    try:
        content = read_regular(path, SIZE_LIMIT)
    except FileNotFoundError:
        problems.add("reference-file-missing", "is not there", shown(name), hint=_missing_hint(name))
        return None
    except OSError as error:
        problems.add("reference-unreadable", _say_unreadable(path, error), shown(name))
        return None
    if content is None:
        problems.add("reference-unreadable", f"is larger than {SIZE_LIMIT:,} bytes", shown(name))
    return content


def read_benchmark(instance: Instance, problems: Problems) -> tuple[bytes, Benchmark] | None:
    """Read the benchmark's definition; None and problems if it does not define one."""
    content = read_reference_file(instance, BENCHMARK_FILE, problems)
    if content is None:
        return None
    benchmark = parse_benchmark(content, problems)
    return None if benchmark is None else (content, benchmark)


def parse_benchmark(content: bytes, problems: Problems) -> Benchmark | None:
    """Understand the bytes of ``benchmark.toml``; None and problems if they do not define a benchmark."""
    benchmark = _parse_toml(content, Benchmark, "reference-definition", BENCHMARK_FILE, problems)
    return None if benchmark is None or _has_clashing_files(benchmark, problems) else benchmark


def parse_errata(content: bytes, problems: Problems) -> Errata | None:
    """Understand the bytes of ``errata.toml``; None and problems if they are no errata."""
    return _parse_toml(content, Errata, "reference-errata", ERRATA_FILE, problems)


def read_manifest(instance: Instance, problems: Problems) -> Manifest | None:
    """Read the reference's seal; None and problems if there is no valid one."""
    content = read_reference_file(instance, MANIFEST_FILE, problems)
    if content is None:
        return None
    try:
        seal = json.loads(content.decode(), object_pairs_hook=_refuse_repeated_keys)
    except (ValueError, RecursionError) as error:
        problems.add(
            "reference-manifest", f"is not JSON: {_shorten(str(error))}", shown(MANIFEST_FILE), hint=SEAL_HINT
        )
        return None
    return _validate(Manifest, seal, "reference-manifest", MANIFEST_FILE, problems)


def _parse_toml(content: bytes, model: type[Model], code: str, name: str, problems: Problems) -> Model | None:
    try:
        values = tomllib.loads(content.decode())
    except (ValueError, RecursionError) as error:
        line = re.search(r"at line (\d+)", str(error))
        problems.add(
            code,
            f"is not TOML: {_shorten(str(error))}",
            shown(name),
            line=int(line[1]) if line else None,
        )
        return None
    return _validate(model, values, code, name, problems)


def _validate(model: type[Model], value: object, code: str, name: str, problems: Problems) -> Model | None:
    try:
        return model.model_validate(value)
    except ValidationError as error:
        for fault in describe_faults(error):
            problems.add(code, _shorten(fault), shown(name))
        return None


def _has_clashing_files(benchmark: Benchmark, problems: Problems) -> bool:
    clashing = {property_.file for property_ in benchmark.properties} & {*_HUMAN_FILES, PUBLISHED_FILE}
    for name in sorted(clashing):
        message = f"a property cannot have the file {name}, which holds something else"
        problems.add("reference-definition", message, shown(BENCHMARK_FILE))
    return bool(clashing)


def _refuse_repeated_keys(pairs: list[tuple[str, object]]) -> dict[str, object]:
    found = dict(pairs)
    if len(found) != len(pairs):
        raise ValueError("a key appears twice")
    return found


def _missing_hint(name: str) -> str:
    if name == MANIFEST_FILE:
        return "seal the reference: leaderboard reference seal --kind official|synthetic"
    return f"restore it from version control, or change {BENCHMARK_FILE} if it is not meant to be there"


def _say_unreadable(path: Path, error: OSError) -> str:
    if path.is_symlink():
        return "is a symbolic link; the reference must hold the file itself"
    if path.is_dir():
        return "is a folder, not a file"
    return f"cannot be read: {error.strerror}"


def _shorten(text: str, limit: int = 300) -> str:
    plain = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return plain if len(plain) <= limit else plain[: limit - 3] + "..."
