"""The habits of the house that no linter holds."""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

MAX_FUNCTION_LINES = 40
MAX_MODULE_LINES = 300

# Written in pieces, so that this file does not hold what it looks for.
REGISTRY_HOSTS = [name + ".org" for name in ("pypi", "pythonhosted", "npmjs", "debian")] + ["npmjs" + ".com"]
MACHINE_PATH = re.compile(r"(?<![\w.~-])/(?:home|root|work|Users)/\w")

PINNED = re.compile(r"^(?P<name>[a-z0-9][a-z0-9._-]*)==(?P<version>[^\s;]+)(?: ;[^\\]+)? \\$")
HASH = re.compile(r"^    --hash=sha256:[0-9a-f]{64}(?: \\)?$")

Definition = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef


def python_files(folder: Path) -> list[Path]:
    return sorted(path for path in folder.rglob("*.py") if "corpus" not in path.parts)


def definitions(tree: ast.AST, *, inside: str = "") -> Iterator[tuple[str, Definition]]:
    """Every function and class with its dotted name, those inside classes and functions too."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, Definition):
            name = f"{inside}{node.name}"
            yield name, node
            yield from definitions(node, inside=f"{name}.")
        else:
            yield from definitions(node, inside=inside)


def definitions_under(folder: Path) -> Iterator[tuple[str, Definition]]:
    for path in python_files(folder):
        for name, node in definitions(ast.parse(path.read_text(encoding="utf-8"))):
            yield f"{path.relative_to(folder)}: {name}", node


def body_lines(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    body = function.body[1:] if ast.get_docstring(function) else function.body
    return (function.end_lineno or 0) - body[0].lineno + 1 if body else 0


def committed_files(root: Path) -> list[Path]:
    """What git tracks or would: ignored files aside."""
    listing = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],  # noqa: S607 - git is where PATH says
        cwd=root,
        capture_output=True,
        check=True,
    )
    paths = {root / name.decode() for name in listing.stdout.split(b"\0") if name}
    return sorted(path for path in paths if path.is_file() and not path.is_symlink())


def locked_versions(lock: Path) -> dict[str, str]:
    found = (PINNED.match(line) for line in lock.read_text(encoding="utf-8").splitlines())
    return {match["name"]: match["version"] for match in found if match}


def test_floors_hold(repo_root: Path) -> None:
    """No module imports from its own floor or above, and the forbidden libraries stay out."""
    run = subprocess.run(
        [Path(sys.executable).with_name("lint-imports"), "--no-cache"],
        cwd=repo_root,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stdout + run.stderr


def test_functions_are_short(repo_root: Path) -> None:
    """No function body is longer than the budget, its docstring aside."""
    functions = (
        (name, node)
        for name, node in definitions_under(repo_root / "leaderboard")
        if not isinstance(node, ast.ClassDef)
    )
    lengths = {name: body_lines(node) for name, node in functions}
    assert {name: n_lines for name, n_lines in lengths.items() if n_lines > MAX_FUNCTION_LINES} == {}


def test_modules_are_short(repo_root: Path) -> None:
    """No module is longer than the budget."""
    lengths = {
        path.relative_to(repo_root).as_posix(): len(path.read_text(encoding="utf-8").splitlines())
        for path in python_files(repo_root / "leaderboard")
    }
    assert {path: n_lines for path, n_lines in lengths.items() if n_lines > MAX_MODULE_LINES} == {}


def test_public_names_have_docstrings(repo_root: Path) -> None:
    """Every public function, class and method of the package says what it does."""
    silent = [
        name
        for name, node in definitions_under(repo_root / "leaderboard")
        if not any(part.startswith("_") for part in name.split(": ")[1].split("."))
        and ast.get_docstring(node) is None
    ]
    assert silent == []


def test_tests_say_what_holds(repo_root: Path) -> None:
    """Every test has a sentence saying what holds."""
    silent = [
        name
        for name, node in definitions_under(repo_root / "tests")
        if node.name.startswith("test_") and not ast.get_docstring(node)
    ]
    assert silent == []


def test_importing_the_package_is_free() -> None:
    """`import leaderboard` brings in no library, so that --version and tools that only look are quick."""
    code = (
        "import sys, leaderboard;"
        "print(*sorted({'click', 'jinja2', 'numpy', 'pydantic', 'rich'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.split() == []


def test_no_file_names_a_machine_or_registry(repo_root: Path) -> None:
    """No committed file holds a path of somebody's machine or the address of a package registry."""
    found = []
    for path in committed_files(repo_root):
        text = path.read_text(encoding="utf-8", errors="replace")
        hits = [host for host in REGISTRY_HOSTS if host in text] + MACHINE_PATH.findall(text)
        found += [f"{path.relative_to(repo_root)}: {hit}" for hit in hits]
    assert found == []


@pytest.mark.parametrize("name", ["requirements.lock", "requirements-dev.lock"])
def test_lock_holds_versions_and_hashes(repo_root: Path, name: str) -> None:
    """A lock consists of exact versions, each with its hashes, and names no address or option."""
    lines = (repo_root / name).read_text(encoding="utf-8").splitlines()
    meaningful = [line for line in lines if line.strip() and not line.lstrip().startswith("#")]
    stray = [line for line in meaningful if not PINNED.match(line) and not HASH.match(line)]
    assert stray == []
    following = zip(meaningful, [*meaningful[1:], ""], strict=True)
    assert [line for line, after in following if PINNED.match(line) and not HASH.match(after)] == []
    assert not any("://" in line for line in lines)


def test_locks_agree(repo_root: Path) -> None:
    """Developers and users run the same versions: the users' lock is part of the developers'."""
    runtime = locked_versions(repo_root / "requirements.lock")
    development = locked_versions(repo_root / "requirements-dev.lock")
    assert {"click", "hatchling", "jinja2", "numpy", "pydantic", "rich"} <= runtime.keys()
    assert runtime.items() <= development.items()
