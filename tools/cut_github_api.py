"""Cut GitHub's description of its API to what sending a submission uses, for tests/github.

    npm pack @octokit/openapi && tar -xzf octokit-openapi-*.tgz
    python -m tools.cut_github_api package

takes the unpacked package, which is under the MIT licence, and writes ``tests/github/api.json``. What only
describes, such as texts and examples, is left out; what is asked of requests and answers is not, but for
discriminators: GitHub gives one to a choice between lists and objects, and a list has no property to look at.
"""

import json
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

TARGET = Path(__file__).resolve().parent.parent / "tests/github/api.json"
OPERATIONS = {
    "/user": ["get"],
    "/repos/{owner}/{repo}": ["get"],
    "/repos/{owner}/{repo}/forks": ["post"],
    "/repos/{owner}/{repo}/merge-upstream": ["post"],
    "/repos/{owner}/{repo}/contents/{path}": ["get"],
    "/repos/{owner}/{repo}/compare/{basehead}": ["get"],
    "/repos/{owner}/{repo}/git/blobs": ["post"],
    "/repos/{owner}/{repo}/git/trees": ["post"],
    "/repos/{owner}/{repo}/git/commits": ["post"],
    "/repos/{owner}/{repo}/git/commits/{commit_sha}": ["get"],
    "/repos/{owner}/{repo}/git/ref/{ref}": ["get"],
    "/repos/{owner}/{repo}/git/refs": ["post"],
    "/repos/{owner}/{repo}/git/refs/{ref}": ["patch"],
    "/repos/{owner}/{repo}/pulls": ["get", "post"],
    "/repos/{owner}/{repo}/pulls/{pull_number}": ["patch"],
}
SILENT = frozenset({"discriminator", "example", "examples", "externalDocs"})
TEXTS = frozenset(
    {"description", "summary", "tags"}
)  # as keys of texts and lists; properties are called so, too


def cut_description(whole: Mapping[str, Any], origin: str) -> dict[str, Any]:
    """Keep the operations and what they refer to, and say where they come from."""
    paths: dict[str, Any] = {}
    for path, methods in OPERATIONS.items():
        shared = (
            {"parameters": whole["paths"][path]["parameters"]} if "parameters" in whole["paths"][path] else {}
        )
        paths[path] = shared | {method: _strip(whole["paths"][path][method]) for method in methods}
    components: dict[str, dict[str, Any]] = {}
    waiting = list(_find_pointers(paths))
    while waiting:
        kind, name = waiting.pop().removeprefix("#/components/").split("/")
        if name not in components.setdefault(kind, {}):
            components[kind][name] = _strip(whole["components"][kind][name])
            waiting += _find_pointers(components[kind][name])
    info = {"title": whole["info"]["title"], "version": whole["info"]["version"], "description": origin}
    return {
        "openapi": whole["openapi"],
        "info": info | {"license": whole["info"]["license"]},
        "servers": whole["servers"],
        "paths": paths,
        "components": components,
    }


def _strip(value: Any) -> Any:  # noqa: ANN401  (any JSON)
    """Leave out what only describes, but for the empty texts that a response must have."""
    if isinstance(value, list):
        return [_strip(element) for element in value]
    if not isinstance(value, dict):
        return value
    kept = {key: _strip(inner) for key, inner in value.items() if not _is_silent(key, inner)}
    is_response = (
        "description" in value and not {"type", "in", "$ref"} & value.keys() and "description" not in kept
    )
    return kept | {"description": ""} if is_response else kept


def _is_silent(key: str, value: object) -> bool:
    return key in SILENT or key.startswith("x-") or (key in TEXTS and not isinstance(value, dict))


def _find_pointers(value: object) -> Iterator[str]:
    if isinstance(value, dict):
        pointer = value.get("$ref")
        if isinstance(pointer, str):
            yield pointer
        value = list(value.values())
    if isinstance(value, list):
        for inner in value:
            yield from _find_pointers(inner)


def main() -> None:
    """Write the cut of the package that the command line names."""
    package = Path(sys.argv[1])
    about = json.loads((package / "package.json").read_text(encoding="utf-8"))
    whole = json.loads((package / "generated/api.github.com.json").read_text(encoding="utf-8"))
    origin = f"cut from {about['name']} {about['version']} ({about['license']}) by tools/cut_github_api.py"
    cut = cut_description(whole, origin)
    TARGET.write_text(json.dumps(cut, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    print(f"wrote {TARGET.name}: {len(cut['paths'])} paths, {TARGET.stat().st_size:,} bytes")


if __name__ == "__main__":
    main()
