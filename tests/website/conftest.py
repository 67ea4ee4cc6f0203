"""Websites built once for all tests that only look at them: of every sort of submission, and the demo."""

from pathlib import Path

import pytest

from leaderboard.instance import Instance
from leaderboard.website import build_site
from leaderboard.website.material import Material
from site_builders import build_material, render_files


@pytest.fixture(scope="session")
def material() -> Material:
    return build_material()


@pytest.fixture(scope="session")
def files(material: Material) -> dict[str, bytes]:
    return render_files(material)


@pytest.fixture(scope="session")
def demo_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the site of this repository's own submissions."""
    repository = Path(__file__).resolve().parents[2]
    return build_site(Instance(repository), tmp_path_factory.mktemp("demo") / "site").path
