"""Pages, figures and data of a small fixed board, byte for byte; tests/golden/README.md explains."""

import re
from pathlib import Path

import pytest

from site_builders import folder_files

GOLDEN = Path(__file__).resolve().parents[1] / "golden"
CHOSEN = (
    "api/submissions/part.json",
    "badge/good.json",
    "compare/good--vs--good-too/index.html",
    "feed.xml",
    "figures/figure/panels.csv",
    "figures/figure/panels.svg",
    "figures/people/people-spread.svg",
    "index.html",
    "leaderboard.csv",
    "people.html",
    "submissions/part/figures/calibration-Beta-label.svg",
    "submissions/part/figures/forest-human-r.svg",
    "submissions/part/figures/pairs-right.svg",
    "submissions/part/figures/scatter.csv",
    "submissions/part/figures/scatter.svg",
    "submissions/part/index.html",
)
HASHED = re.compile(rb"(assets/[\w-]+)\.[0-9a-f]{10}\.")


def mask_hashes(content: bytes) -> bytes:
    """Leave the checksums in names of assets out: a changed style alone changes no golden page."""
    return HASHED.sub(rb"\1.----------.", content)


@pytest.mark.parametrize("path", CHOSEN)
def test_a_file_is_as_it_was_accepted(files: dict[str, bytes], path: str, is_accepting: bool) -> None:
    """Byte for byte; ACCEPT=1 writes it anew, for a person to read the difference."""
    golden, content = GOLDEN / path, mask_hashes(files[path])
    if is_accepting:
        golden.parent.mkdir(parents=True, exist_ok=True)
        golden.write_bytes(content)
    assert golden.is_file(), f"tests/golden/{path} is not there: accept it as tests/golden/README.md says"
    assert golden.read_bytes().decode() == content.decode()


def test_nothing_else_is_kept() -> None:
    """A golden file that no test compares would only look like one."""
    assert folder_files(GOLDEN).keys() - {"README.md"} <= set(CHOSEN)
