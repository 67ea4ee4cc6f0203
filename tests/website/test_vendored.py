"""What the website takes from others is what the lock names, byte by byte."""

import json
from importlib.resources import files as package_files
from pathlib import Path
from typing import Any

from leaderboard.files import canonical_json, sha256_hex

VENDOR = package_files("leaderboard.website") / "static" / "vendor"
MANIFEST = VENDOR / "manifest.json"


def read_manifest() -> dict[str, Any]:
    manifest: dict[str, Any] = json.loads(MANIFEST.read_text(encoding="utf-8"))
    return manifest


def test_files_are_those_of_the_manifest() -> None:
    """Every vendored file has the checksum that was written when it was taken, and there are no others."""
    expected = {file: sha for about in read_manifest().values() for file, sha in about["sha256"].items()}
    found = {
        file.name: sha256_hex(file.read_bytes()) for file in VENDOR.iterdir() if file.name != MANIFEST.name
    }
    assert found == expected
    assert MANIFEST.read_text(encoding="utf-8") == canonical_json(read_manifest())


def test_versions_are_those_of_the_lock(repo_root: Path) -> None:
    """The manifest, the lock and the wish for it name the same exact versions; the lock has checksums."""
    folder = repo_root / "tools" / "vendor"
    wished = json.loads((folder / "package.json").read_text(encoding="utf-8"))["dependencies"]
    lock = json.loads((folder / "package-lock.json").read_text(encoding="utf-8"))["packages"]
    locked = {name.removeprefix("node_modules/"): about for name, about in lock.items() if name}
    assert {name: about["version"] for name, about in read_manifest().items()} == wished
    assert {name: about["version"] for name, about in locked.items()} == wished
    assert all(about["integrity"].startswith("sha512-") for about in locked.values())
    assert not any("resolved" in about for about in locked.values())


def test_licenses_come_along() -> None:
    """Each package is free to use, brings its license, and names itself and its version in its script."""
    for name, about in read_manifest().items():
        assert about["license"] == "MIT", name
        (license_file,) = [file for file in about["sha256"] if file.endswith("-license.txt")]
        assert "Permission is hereby granted, free of charge" in (VENDOR / license_file).read_text("utf-8")
        (script,) = [file for file in about["sha256"] if file.endswith(".js")]
        assert (VENDOR / script).read_text("utf-8").startswith(f"/*! DataTables {about['version']}")
