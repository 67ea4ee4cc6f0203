"""GitHub's own description of its API, to hold requests and answers against, and to fill answers in.

``github/api.json`` is cut from npm's @octokit/openapi (MIT) by tools/cut_github_api.py, as it says itself.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any
from urllib.parse import quote

from openapi_core import OpenAPI
from openapi_core.exceptions import OpenAPIError
from openapi_core.testing import MockRequest, MockResponse

DESCRIPTION_FILE = Path(__file__).parent / "github/api.json"
PLACEHOLDERS = {
    "uri": "https://github.example/placeholder",
    "date-time": "2026-06-01T00:00:00Z",
    "email": "a@github.example",
}
GREEDY = ("/git/ref/", "/git/refs/", "/contents/")  # what follows is one parameter, slashes and all


@dataclass(frozen=True)
class Call:
    """A request to the API, its path without that of the server."""

    method: str
    path: str
    query: Mapping[str, str]
    content: bytes

    def __str__(self) -> str:
        return f"{self.method} {self.path}"


@cache
def load_description() -> dict[str, Any]:
    description: dict[str, Any] = json.loads(DESCRIPTION_FILE.read_text(encoding="utf-8"))
    return description


@cache
def _load_api() -> OpenAPI:
    return OpenAPI.from_dict(load_description())


def find_violation(call: Call, answer: tuple[int, object] | None = None) -> str:
    """Say what is wrong with a request, or with an answer to it, by the description; empty if nothing is."""
    request = MockRequest(
        "https://api.github.com",
        call.method.lower(),
        _close_parameter(call.path),
        args=dict(call.query),
        data=call.content,
        content_type="application/json",
    )
    try:
        if answer is None:
            _load_api().validate_request(request)
        else:
            status, content = answer
            response = MockResponse(
                json.dumps(content).encode(), status, {"Content-Type": "application/json"}
            )
            _load_api().validate_response(request, response)
    except OpenAPIError as error:
        causes = getattr(error.__cause__, "schema_errors", ()) or (error.__cause__,)
        return f"{call}: {error}: {'; '.join(str(cause)[:500] for cause in causes)}"
    return ""


def fill(schema: str, content: Mapping[str, Any]) -> dict[str, Any]:
    """Make an answer of a kind from what matters in it; what it must have besides is filled in.

    Raises
    ------
    KeyError
        If the kind does not know a key.
    """
    filled = _fill({"$ref": f"#/components/schemas/{schema}"}, content)
    assert isinstance(filled, dict)
    return filled


def _fill(schema: Mapping[str, Any], content: Any = None) -> Any:
    schema = _resolve(schema)
    if content is not None and not isinstance(content, Mapping):
        return content
    if content is None and schema.get("nullable"):
        return None
    properties = schema.get("properties", {})
    if properties:
        unknown = set(content or {}) - set(properties)
        if unknown:
            raise KeyError(f"GitHub's {schema.get('title')} has no {sorted(unknown)}")
        names = [name for name in properties if name in schema.get("required", ()) or name in (content or {})]
        return {name: _fill_property(properties[name], name, content or {}) for name in names}
    return content if content is not None else _placeholder(schema)


def _fill_property(schema: Mapping[str, Any], name: str, content: Mapping[str, Any]) -> Any:
    if name in content and content[name] is None:
        return None
    return _fill(schema, content.get(name))


def _placeholder(schema: Mapping[str, Any]) -> Any:
    if "enum" in schema:
        return schema["enum"][0]
    match schema.get("type"):
        case "string":
            return PLACEHOLDERS.get(schema.get("format", ""), "0" * max(schema.get("minLength", 1), 1))
        case "integer" | "number":
            return 1
        case "boolean":
            return False
        case "array":
            return []
    return {}


def _resolve(schema: Mapping[str, Any]) -> Mapping[str, Any]:
    """Follow a pointer, merge what must hold together, and take the first of several forms."""
    if "$ref" in schema:
        _, _, kind, name = schema["$ref"].split("/")
        return _resolve(load_description()["components"][kind][name])
    if "allOf" in schema:
        merged: dict[str, Any] = {"properties": {}, "required": []}
        for part in map(_resolve, schema["allOf"]):
            merged["properties"] |= part.get("properties", {})
            merged["required"] += part.get("required", [])
        return {**schema, **merged}
    for key in ("anyOf", "oneOf"):
        if key in schema and "properties" not in schema:
            return _resolve(schema[key][0])  # "nullable" beside these has no effect without a type
    return schema


def _close_parameter(path: str) -> str:
    for mark in GREEDY:
        before, found, rest = path.partition(mark)
        if found:
            return f"{before}{mark}{quote(rest, safe='')}"
    return path
