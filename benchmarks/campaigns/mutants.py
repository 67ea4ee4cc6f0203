"""Change the program in small ways and see whether its tests notice.

Run: python -m benchmarks.campaigns.mutants [PACKAGE ...] [--digits DIGITS]

It needs mutmut, which turns `<` into `<=`, drops arguments, changes texts and so on, one at a time, and runs
the tests that reach the place until one fails. It works on a copy of the repository. `--digits 37` tries only
the mutants whose numbers end in 3 or 7, a fifth of them from all places. What ran out of time, as it may on a
busy machine, is tried once more. Survivors are named.
"""

import argparse
import importlib.util
import json
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TESTS = {
    "validation": ("tests/validation", "tests/test_corpus.py", "tests/test_submission.py"),
    "grading": ("tests/grading", "tests/oracles"),
    "metrics": ("tests/metrics", "tests/oracles"),
}
COPIED = (
    "reference",
    "submissions",
    "site",
    "docs",
    "tools",
    "benchmarks",
    ".github",
    "README.md",
    "LICENSE",
)
LEFT_OUT = (".git", ".venv", "__pycache__", "dist", "mutants", ".*_cache", ".hypothesis", "node_modules")
LEAST_SHARE = 0.9

# All runs happen in one process, which Hypothesis would complain about; a few cases of each property do.
PROFILE = """
from hypothesis import HealthCheck

settings.register_profile(
    "mutants", max_examples=20, deadline=None, database=None, suppress_health_check=list(HealthCheck)
)
settings.load_profile("mutants")
"""


@dataclass(frozen=True)
class Outcome:
    """What became of a package's mutants; those that hang the tests, ``n_hanging``, are killed too."""

    n_mutants: int
    n_killed: int
    n_hanging: int
    survivors: tuple[str, ...]

    @property
    def share(self) -> float:
        """The share of those that were tried which the tests noticed."""
        return self.n_killed / max(self.n_killed + len(self.survivors), 1)


def configure(folder: Path, package: str) -> None:
    """Tell mutmut, in the copy's own settings, what to change and which tests to run."""
    settings = {
        "source_paths": ["leaderboard"],
        "only_mutate": [f"leaderboard/{package}/*.py"],
        "pytest_add_cli_args_test_selection": list(TESTS[package]),
        "pytest_add_cli_args": ["-n0", "--no-cov", "-p", "no:cacheprovider", "--dist=no"],
        "also_copy": list(COPIED),
    }
    lines = [f"{key} = {json.dumps(value)}\n" for key, value in settings.items()]
    with (folder / "pyproject.toml").open("a") as stream:
        stream.write("".join(["\n[tool.mutmut]\n", *lines]))
    with (folder / "tests/conftest.py").open("a") as stream:
        stream.write(PROFILE)


def run(package: str, digits: str) -> Outcome:
    """Try a package's mutants in a copy of the repository."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "copy"
        shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(*LEFT_OUT))
        configure(folder, package)
        found = try_mutants(folder, [f"leaderboard.{package}.*__mutmut_*{digit}" for digit in digits])
        late = [name for name, status in found.items() if status == "timeout"]
        return count(try_mutants(folder, late) if late else found)


def try_mutants(folder: Path, patterns: list[str]) -> dict[str, str]:
    """Run some mutants, and say what became of all that were run so far."""
    mutmut = [sys.executable, "-m", "mutmut"]
    if subprocess.run([*mutmut, "run", "--max-children", "1", *patterns], cwd=folder, check=False).returncode:
        sys.exit("mutmut broke off")
    listed = subprocess.run(
        [*mutmut, "results", "--all", "true"], cwd=folder, capture_output=True, text=True, check=True
    )
    return dict(re.findall(r"^\s*(\S+__mutmut_\d+): (.+)$", listed.stdout, re.MULTILINE))


def count(found: dict[str, str]) -> Outcome:
    """Count what mutmut says of each mutant."""
    hanging = [name for name, status in found.items() if status == "timeout"]
    killed = [name for name, status in found.items() if status in {"killed", "timeout", "segfault"}]
    survivors = [name for name, status in found.items() if status in {"survived", "no tests", "suspicious"}]
    return Outcome(len(found), len(killed), len(hanging), tuple(sorted(survivors)))


def main() -> None:
    """Try them all and print the table; exit status 1 if too few were noticed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("packages", nargs="*", metavar="PACKAGE", help=f"of {', '.join(TESTS)}")
    parser.add_argument("--digits", default="0123456789")
    options = parser.parse_args()
    if importlib.util.find_spec("mutmut") is None:
        sys.exit("mutmut is not installed, so no mutant was tried: pip install -e '.[campaign]'")
    outcomes = {package: run(package, options.digits) for package in options.packages or TESTS}
    print("| package | mutants | tried | killed | hanging | survived |\n|---|---:|---:|---:|---:|---:|")
    for package, found in outcomes.items():
        n_tried = found.n_killed + len(found.survivors)
        share = f"{found.n_killed:,} ({found.share:.1%})"
        hanging, survived = f"{found.n_hanging:,}", f"{len(found.survivors):,}"
        print(f"| `{package}` | {found.n_mutants:,} | {n_tried:,} | {share} | {hanging} | {survived} |")
    for found in outcomes.values():
        print("".join(f"survived: {name}\n" for name in found.survivors), end="")
    sys.exit(0 if all(found.share >= LEAST_SHARE for found in outcomes.values()) else 1)


if __name__ == "__main__":
    main()
