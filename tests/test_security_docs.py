"""docs/security.md promises nothing without a test that exists."""

import ast
import re
from pathlib import Path

PROOF = re.compile(r"`(tests/[\w/]+\.py)(?:::(test_\w+))?`")


def test_every_defence_has_its_test(repo_root: Path) -> None:
    """Each row of each table of threats names at least one test, and each test named is there."""
    page = (repo_root / "docs/security.md").read_text(encoding="utf-8")
    rows = [line for line in page.splitlines() if re.match(r"\| (?!threat |-)", line)]
    assert len(rows) >= 30
    assert [row for row in rows if not PROOF.search(row.rsplit(" | ", 1)[1])] == []
    missing = []
    for file, name in PROOF.findall(page):
        tree = ast.parse((repo_root / file).read_text(encoding="utf-8"))
        known = {node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)}
        if name and name not in known:
            missing.append(f"{file}::{name}")
    assert missing == []
