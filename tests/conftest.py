"""What all tests share: where things are, and how hard hypothesis looks."""

import os
from pathlib import Path

import pytest
from hypothesis import settings

# Tests run in parallel already; NumPy reads this when it is first imported, which is after this.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# CI draws many cases, the same ones each time, so that a red run can be repeated; at the desk a few new ones.
settings.register_profile("ci", max_examples=300, derandomize=True, deadline=None)
settings.register_profile("dev", max_examples=50, deadline=None)
settings.load_profile("ci" if os.environ.get("CI") else "dev")


@pytest.fixture(scope="session")
def repo_root() -> Path:
    """The folder that holds pyproject.toml."""
    return Path(__file__).resolve().parent.parent


@pytest.fixture
def is_accepting() -> bool:
    """Whether ACCEPT=1 asks to write expected files anew, for a person to read the difference."""
    asks = bool(os.environ.get("ACCEPT"))
    if asks and os.environ.get("CI"):
        pytest.fail("ACCEPT=1 writes expected files anew, and CI is set: nobody would read the difference")
    return asks


@pytest.fixture(scope="session")
def shared_dir(repo_root: Path) -> Path:
    """The folder `shared` beside the repository, with the predecessor's real data.

    Without it the test skips; where REQUIRE_SHARED is set, as in .ci/run, it fails.
    """
    folder = repo_root.parent / "shared"
    if folder.is_dir():
        return folder
    reason = "needs the real data in the folder `shared` beside the repository, which is not there"
    if os.environ.get("REQUIRE_SHARED"):
        pytest.fail(f"{reason} (REQUIRE_SHARED is set)")
    pytest.skip(reason)
