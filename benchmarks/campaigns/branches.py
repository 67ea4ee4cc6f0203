"""See that the tests of validation take every branch of the validator, by themselves.

Run: python -m benchmarks.campaigns.branches

Nothing but the validator's own tests and the corpus counts. `make test` runs it too.
"""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TESTS = ("tests/validation", "tests/test_corpus.py", "tests/test_submission.py")
MEASURED = ("leaderboard.validation", "leaderboard.submission")


def main() -> None:
    """Run the tests and print what they leave out; exit status 1 if that is anything."""
    covered = [f"--cov={name}" for name in MEASURED]
    options = ["-q", "-n0", "--cov-branch", "--cov-fail-under=100", "--cov-report=term-missing"]
    command = [sys.executable, "-m", "pytest", *options, "-p", "no:cacheprovider", *covered, *TESTS]
    sys.exit(subprocess.run(command, cwd=ROOT, check=False).returncode)


if __name__ == "__main__":
    main()
