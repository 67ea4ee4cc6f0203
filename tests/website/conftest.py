"""One website of every sort of submission, rendered once for all tests that only look at it."""

import pytest

from leaderboard.website.material import Material
from site_builders import build_material, render_files


@pytest.fixture(scope="session")
def material() -> Material:
    return build_material()


@pytest.fixture(scope="session")
def files(material: Material) -> dict[str, bytes]:
    return render_files(material)
