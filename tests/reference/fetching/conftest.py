"""Fetching from a server on this machine: whatever proxies and certificates the machine has set."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from leaderboard.reference.fetching import Fetched, Remote
from leaderboard.reference.fetching.fetcher import fetch_source_files
from leaderboard.reference.fetching.sessions import Patience

Fetch = Callable[..., Fetched]


@pytest.fixture(autouse=True)
def plain_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in list(os.environ):
        if name.lower().endswith(("_proxy", "_ca_bundle")):
            monkeypatch.delenv(name)


@pytest.fixture
def patience() -> Patience:
    """Try again as often as ever, without waiting."""
    return Patience(connect=5, read=5, longest_wait=0)


@pytest.fixture
def fetch(tmp_path: Path, patience: Patience) -> Fetch:
    """Fetch with a cache that is empty at first."""

    def run(*remotes: Remote, **options: object) -> Fetched:
        settings = {"cache": tmp_path / "cache", "patience": patience, **options}
        return fetch_source_files(remotes, **settings)  # type: ignore[arg-type]

    return run
