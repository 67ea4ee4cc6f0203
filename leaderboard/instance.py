"""Where the files of a leaderboard instance are; no other module joins their paths."""

from dataclasses import dataclass
from pathlib import Path

from leaderboard.errors import InstanceError

BENCHMARK_FILE = "benchmark.toml"
MANIFEST_FILE = "manifest.json"
HUMAN_TRIALS_FILE = "human_trials.csv"
HUMAN_RESPONSES_FILE = "human_responses.csv"
PUBLISHED_FILE = "published.csv"
ERRATA_FILE = "errata.toml"
SUBMISSION_FILE = "submission.toml"
PREDICTIONS_FILE = "predictions.csv"
RESULT_FILE = "result.json"
LEDGER_FILE = "ledger.csv"
ABOUT_FILE = "about.md"
CITATION_FILE = "citation.bib"
SITE_FILE = "site.toml"


@dataclass(frozen=True)
class Instance:
    """A folder with ``reference/``, ``submissions/`` and ``site/``."""

    root: Path

    @property
    def reference_dir(self) -> Path:
        """The folder of the benchmark's definition, trials and human data."""
        return self.root / "reference"

    @property
    def benchmark_file(self) -> Path:
        """The benchmark's definition."""
        return self.reference_dir / BENCHMARK_FILE

    @property
    def manifest_file(self) -> Path:
        """The reference's checksums and kind."""
        return self.reference_dir / MANIFEST_FILE

    def reference_file(self, name: str) -> Path:
        """A file of the reference."""
        return self.reference_dir / name

    @property
    def submissions_dir(self) -> Path:
        """The folder with one folder per submission."""
        return self.root / "submissions"

    @property
    def ledger_file(self) -> Path:
        """The public record of what was added, regraded or withdrawn."""
        return self.submissions_dir / LEDGER_FILE

    @property
    def site_dir(self) -> Path:
        """The folder of the website's own texts and of its output."""
        return self.root / "site"

    @property
    def site_file(self) -> Path:
        """What the maintainers of the website set for it."""
        return self.site_dir / SITE_FILE

    def content_file(self, name: str) -> Path:
        """A text that the maintainers of the website write."""
        return self.site_dir / "content" / name

    @property
    def dist_dir(self) -> Path:
        """Where the website is built, unless told otherwise."""
        return self.site_dir / "dist"

    def submission_dir(self, slug: str) -> Path:
        """The folder of one submission."""
        return self.submissions_dir / slug

    def submission_dirs(self) -> list[Path]:
        """All submission folders, by slug; hidden ones (half-written) are not submissions."""
        if not self.submissions_dir.is_dir():
            return []
        found = [
            path for path in self.submissions_dir.iterdir() if path.is_dir() and not path.name.startswith(".")
        ]
        return sorted(found, key=lambda path: path.name)

    def display_path(self, path: Path) -> str:
        """Show a path relative to the instance where it lies inside, as a person would write it."""
        try:
            return path.absolute().relative_to(self.root.absolute()).as_posix()
        except ValueError:
            return path.as_posix()


def find_instance(start: Path) -> Instance:
    """Find the nearest folder upward that holds ``reference/benchmark.toml``.

    Raises
    ------
    InstanceError
        If there is none.
    """
    start = start.absolute()
    for folder in (start, *start.parents):
        if Instance(folder).benchmark_file.is_file():
            return Instance(folder)
    raise InstanceError(
        f"no leaderboard here: neither {start} nor a folder above it holds reference/{BENCHMARK_FILE}",
        "go to a leaderboard's folder or name it with --root DIR",
    )
