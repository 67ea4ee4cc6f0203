"""Each test has a GitHub of its own."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from github_double import GitHubDouble
from github_hub import Hub
from github_stage import SECRET, UPSTREAM, Clock, Material, Stage
from leaderboard.reference import load_reference
from reference_folders import ReferenceFolder


@pytest.fixture(autouse=True)
def plain_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither the machine's proxies and certificates nor somebody's tokens."""
    for name in list(os.environ):
        if name.lower().endswith(("_proxy", "_ca_bundle")) or name.startswith(("GH_", "GITHUB_")):
            monkeypatch.delenv(name)


@pytest.fixture(scope="session")
def material(tmp_path_factory: pytest.TempPathFactory) -> Material:
    instance = ReferenceFolder().write(tmp_path_factory.mktemp("material"))
    return Material(instance, load_reference(instance))


@pytest.fixture
def hub(tmp_path: Path, material: Material) -> Hub:
    hub = Hub(tmp_path / "hub")
    hub.add(UPSTREAM, {"README.md": b"x", **material.reference_files()})
    return hub


@pytest.fixture
def stage(hub: Hub, material: Material) -> Iterator[Stage]:
    with GitHubDouble(hub, {SECRET: "someone"}) as github:
        yield Stage(github, material, Clock())
