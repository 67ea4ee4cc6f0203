"""The JSON Schema of the files under ``api/``, for programs that read them."""

import json
from importlib.resources import files

from pydantic.json_schema import models_json_schema

from leaderboard.files import canonical_json
from leaderboard.models import Metadata, Source

SCHEMA_PATH = "api/schema.json"


def render_schema() -> bytes:
    """Render the schema: what is written by hand, and of the models of files what they say themselves."""
    schema = json.loads((files("leaderboard.website") / "static/schema.json").read_text("utf-8"))
    _, definitions = models_json_schema(
        [(Metadata, "validation"), (Source, "validation")], ref_template="#/$defs/{model}"
    )
    schema["$defs"] |= definitions["$defs"]
    return canonical_json(schema).encode()
