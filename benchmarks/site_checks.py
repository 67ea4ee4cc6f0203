"""Build the site of a simulated board and hold it against the standards, links and sizes.

Run: python -m benchmarks.site_checks [SUBMISSIONS]

The board has many complete submissions on this repository's reference, 300 without an argument. Every page
and figure goes through the HTML checker (`make checker` installs it) and the link checker. Exit status 1 if
either finds something, or if a page is heavier than it may be.
"""

import argparse
import gzip
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from benchmarks.scoring import describe_system, simulate_submissions
from leaderboard.files import csv_text
from leaderboard.grading import Yardstick, grade
from leaderboard.instance import PREDICTIONS_FILE, SUBMISSION_FILE, Instance
from leaderboard.metrics.accuracy import credits_of
from leaderboard.ranking import Entry
from leaderboard.reference import Reference, load_reference
from leaderboard.website.building import compose_pages, render_site
from leaderboard.website.material import Publication, gather
from tools.check_html import find_errors, name_missing
from tools.check_links import find_faults

ROOT = Path(__file__).resolve().parent.parent
SUBMISSIONS = 300
MAX_SHOWN = 20

# Bytes, compressed; scripts and styles not counted.
LIMITS = {"index.html": 60_000, "compare/index.html": 100_000, "trials/index.html": 100_000}


def main() -> int:
    """Build, check and print what was found."""
    parser = argparse.ArgumentParser(description="Build a simulated board's site and check all of it.")
    parser.add_argument("submissions", type=int, nargs="?", default=SUBMISSIONS)
    n_submissions = parser.parse_args().submissions
    missing = name_missing()
    if missing:
        sys.exit(missing)
    reference = load_reference(Instance(ROOT))
    publications = list(simulate_publications(reference, n_submissions))
    start = time.process_time()
    material = gather(reference, publications)
    files = dict(render_site(material, compose_pages(material)))
    seconds = time.process_time() - start
    n_pages = sum(path.endswith(".html") for path in files)
    size = sum(map(len, files.values())) / 1e6
    print(f"{n_submissions:,} submissions: {n_pages:,} pages, {len(files):,} files, {size:,.0f} MB")
    print(f"ranked, composed and rendered in {seconds:.1f} s of processor time")
    faults = [*find_faults(files), *check_html(files), *find_heavy(files)]
    print(*faults[:MAX_SHOWN], f"{len(faults):,} faults", sep="\n")
    return 1 if faults else 0


def simulate_publications(reference: Reference, n: int) -> Iterator[Publication]:
    """Simulate graded submissions of evenly spread skill, with files as large as real ones are."""
    yardstick = Yardstick.of(reference)
    for index, submission in enumerate(simulate_submissions(reference, n)):
        slug = f"system-{index:04d}"
        credits = credits_of(submission.probabilities, reference.labels, submission.answered)
        given = np.where(submission.answered, submission.probabilities, np.nan)
        result = grade(submission, reference, yardstick=yardstick)
        rows = zip(reference.trial_ids, submission.probabilities, strict=True)
        files = {
            PREDICTIONS_FILE: csv_text(["trial_id", "probability"], rows).encode(),
            SUBMISSION_FILE: b"",
        }
        yield Publication(Entry(slug, describe_system(slug, reference), result, credits, given), files)


def check_html(files: dict[str, bytes]) -> list[str]:
    """Put pages and figures into a folder that goes away and let the HTML checker read them."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        for path, content in files.items():
            if path.endswith((".html", ".svg")):
                (folder / path).parent.mkdir(parents=True, exist_ok=True)
                (folder / path).write_bytes(content)
        return find_errors(folder)


def find_heavy(files: dict[str, bytes]) -> Iterator[str]:
    """Print how large the pages with a limit are, and name those above it."""
    for path, limit in LIMITS.items():
        size = len(gzip.compress(files[path])) if path in files else 0
        print(f"{path}: {size:,} bytes compressed, at most {limit:,}")
        if size > limit:
            yield f"{path}: {size:,} bytes compressed, more than {limit:,}"


if __name__ == "__main__":
    sys.exit(main())
