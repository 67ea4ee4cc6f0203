"""Run the campaigns of docs/security.md, one after the other, and print their tables.

Run: make campaign, or python -m benchmarks.campaigns [CAMPAIGN ...]

Each is a program of its own, `python -m benchmarks.campaigns.CAMPAIGN`, with its own options. A tool that is
not there fails its campaign and does not stop the others. Together they take hours.
"""

import subprocess
import sys

CAMPAIGNS = {
    "branches": "Branches of the validator that its tests do not take",
    "mutations": "Mutated submissions",
    "failing_calls": "System calls that fail",
    "kills": "Commands that are killed",
    "concurrent_writers": "Many writers at once",
    "fuzzing": "Parsers fuzzed with atheris",
    "mutants": "Mutants of the program",
}


def main() -> None:
    """Run those that are named, or all; exit status 1 if one of them did not hold."""
    names = sys.argv[1:] or list(CAMPAIGNS)
    unknown = [name for name in names if name not in CAMPAIGNS]
    if unknown:
        sys.exit(f"there is no campaign {unknown[0]}; there are {', '.join(CAMPAIGNS)}")
    failed = []
    for name in names:
        print(f"\n## {CAMPAIGNS[name]}\n", flush=True)
        command = [sys.executable, "-m", f"benchmarks.campaigns.{name}"]
        if subprocess.run(command, check=False).returncode:
            failed.append(name)
    print(f"\ncampaigns that held: {len(names) - len(failed)} of {len(names)}")
    sys.exit(f"did not hold, or could not run: {', '.join(failed)}" if failed else 0)


if __name__ == "__main__":
    main()
