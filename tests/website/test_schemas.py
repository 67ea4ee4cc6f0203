"""The schema of the files for programs: they keep it, and it notices what does not."""

import copy
import json
from collections.abc import Callable
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from builders import build_reference
from leaderboard.models import Metadata
from leaderboard.website.schemas import SCHEMA_PATH
from site_builders import build_material, render_files

Json = dict[str, Any]


def kind_of(path: str) -> str:
    """Which definition describes a file."""
    if path.startswith("api/submissions/"):
        return "submission"
    return path.removeprefix("api/").removesuffix(".json")


@pytest.fixture(scope="module")
def schema(files: dict[str, bytes]) -> Json:
    found: Json = json.loads(files[SCHEMA_PATH])
    return found


@pytest.fixture(scope="module")
def documents(files: dict[str, bytes]) -> dict[str, Json]:
    paths = [path for path in files if path.startswith("api/") and path != SCHEMA_PATH]
    return {path: json.loads(files[path]) for path in paths}


def find_errors(document: Json, kind: str, schema: Json) -> list[str]:
    """Name what is wrong with a document, by its place."""
    validator = Draft202012Validator({"$ref": f"#/$defs/{kind}", "$defs": schema["$defs"]})
    return sorted(f"{error.json_path}: {error.message}" for error in validator.iter_errors(document))


def test_it_is_a_schema(schema: Json) -> None:
    """By the rules of its own draft, and no reference leads nowhere."""
    Draft202012Validator.check_schema(schema)
    text = json.dumps(schema)
    used = {part.partition('"')[0] for part in text.split('"$ref": "#/$defs/')[1:]}
    assert used | {"leaderboard", "submission", "reference"} == set(schema["$defs"])


def test_every_file_keeps_it(documents: dict[str, Json], schema: Json) -> None:
    """Boards, the reference and each submission, by their own definitions."""
    assert {kind_of(path) for path in documents} == {"leaderboard", "reference", "submission"}
    assert {path: find_errors(document, kind_of(path), schema) for path, document in documents.items()} == {
        path: [] for path in documents
    }


@pytest.mark.parametrize("reference", [build_reference(n_people=0), build_reference(responses=False)])
def test_files_keep_it_whatever_is_known_of_people(reference: Any, schema: Json) -> None:
    """Without human data, and with counts alone."""
    for path, content in render_files(build_material(reference)).items():
        if path.startswith("api/") and path != SCHEMA_PATH:
            assert find_errors(json.loads(content), kind_of(path), schema) == [], path


def drop(*keys: str | int) -> Callable[[Json], None]:
    def change(document: Any) -> None:
        for key in keys[:-1]:
            document = document[key]
        del document[keys[-1]]

    return change


def put(value: object, *keys: str | int) -> Callable[[Json], None]:
    def change(document: Any) -> None:
        for key in keys[:-1]:
            document = document[key]
        document[keys[-1]] = value

    return change


OVERALL = ("result", "scores", "overall", "all")


@pytest.mark.parametrize(
    "change",
    [
        drop("schema"),
        put(2, "schema"),
        put("x", "unknown"),
        put("x", "result", "unknown"),
        put("x", "metadata", "submission", "unknown"),
        put("vlms", "metadata", "model", "family"),
        drop("metadata", "protocol", "training"),
        put("first", "rank"),
        put("ranked!", "kind"),
        put([1], "rank_set"),
        put("Good", "slug"),
        put("abc", "reference", "digest"),
        put(None, *OVERALL, "n"),
        put({"value": None}, *OVERALL, "accuracy"),
        put({"value": 0.5, "why": "no reason"}, *OVERALL, "accuracy"),
        put({"value": 0.5, "low": 0.4}, *OVERALL, "accuracy"),
        put(0.5, *OVERALL, "accuracy"),
        put("0.5", *OVERALL, "accuracy", "value"),
        drop("result", "calibration", "overall", "label", 0, "upto"),
    ],
)
def test_it_notices_what_is_not_so(
    documents: dict[str, Json], schema: Json, change: Callable[[Json], None]
) -> None:
    """A key too many or too few, and a value of another kind, at any depth."""
    document = copy.deepcopy(documents["api/submissions/good.json"])
    change(document)
    assert find_errors(document, "submission", schema)


def test_metadata_are_described_by_their_model(schema: Json) -> None:
    """As files of submissions are: what validation asks for, the schema asks for."""
    assert set(schema["$defs"]["Metadata"]["properties"]) == set(Metadata.model_fields)
    assert schema["$defs"]["About"]["properties"]["date"]["format"] == "date"


def test_descriptions_are_for_readers(schema: Json) -> None:
    """Everything that is not plain from its name says what it is."""
    for name in (
        "leaderboard",
        "submission",
        "reference",
        "board",
        "row",
        "entry",
        "scores",
        "score",
        "subset",
    ):
        assert schema["$defs"][name]["description"].endswith("."), name
