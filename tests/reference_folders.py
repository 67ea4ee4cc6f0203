"""A small sound reference on disk that a test can break in exactly one way."""

from dataclasses import dataclass, field
from pathlib import Path

from leaderboard.files import canonical_json, csv_text, sha256_hex
from leaderboard.instance import (
    BENCHMARK_FILE,
    ERRATA_FILE,
    HUMAN_RESPONSES_FILE,
    HUMAN_TRIALS_FILE,
    Instance,
)
from leaderboard.reference.sealing import digest_of

Rows = list[list[str]]

DEFINITION = """\
name = "tiny"
title = "Tiny"
version = "1"
question = "Will it?"

[grading]
easy = "2/3"
hard = "1/3"
resamples = 200
seed = 7

[[properties]]
name = "Alpha"
file = "Alpha.csv"
trials = 8

[[properties]]
name = "Beta"
file = "Beta.csv"
trials = 4

[[scenarios]]
id = "alpha_one"
title = "Alpha one"
property = "Alpha"
trials = 4

[[scenarios]]
id = "alpha_two"
title = "Alpha two"
property = "Alpha"

[[scenarios]]
id = "beta_one"
title = "Beta one"
property = "Beta"
trials = 4

[[tracks]]
id = "all"
title = "All"
default = true
"""

HEADERS = {
    "Alpha.csv": ["trial_id", "pair_id", "scenario", "copy", "label", "start_frame"],
    "Beta.csv": ["trial_id", "pair_id", "scenario", "copy", "label", "start_frame"],
    HUMAN_TRIALS_FILE: ["trial_id", "n", "n_yes"],
    HUMAN_RESPONSES_FILE: ["participant_id", "trial_id", "response"],
}
CONFIG = "synthetic-size=1,2"


def trial_name(scenario: str, copy: int, number: int) -> str:
    return f"{scenario}-copy{copy}/{CONFIG}/{number:04d}"


def pair_name(scenario: str, number: int) -> str:
    return f"{scenario}/{CONFIG}/{number:04d}"


def sound_rows() -> dict[str, Rows]:
    """Two pairs in each of three scenarios; p1 judged every copy 0 right, p2 every copy 1 wrong."""
    rows: dict[str, Rows] = {name: [] for name in HEADERS}
    for scenario in ("alpha_one", "alpha_two", "beta_one"):
        for number in (0, 1):
            for copy in (0, 1):
                trial_id, label = trial_name(scenario, copy, number), copy ^ number
                answer = str(label if copy == 0 else 1 - label)
                file = "Alpha.csv" if scenario.startswith("alpha") else "Beta.csv"
                pair_id = pair_name(scenario, number)
                rows[file].append([trial_id, pair_id, scenario, str(copy), str(label), "90"])
                rows[HUMAN_TRIALS_FILE].append([trial_id, "1", answer])
                rows[HUMAN_RESPONSES_FILE].append([f"p{copy + 1}", trial_id, answer])
    return rows


@dataclass
class ReferenceFolder:
    """What will be written; a test changes it first.

    ``raw`` replaces the content of files, or leaves them out where it is None.
    """

    definition: str = DEFINITION
    rows: dict[str, Rows] = field(default_factory=sound_rows)
    raw: dict[str, bytes | None] = field(default_factory=dict)
    kind: str = "synthetic"

    def write(self, root: Path) -> Instance:
        """Write the reference and seal it whatever is in it."""
        instance = Instance(root)
        instance.reference_dir.mkdir(parents=True)
        contents: dict[str, bytes | None] = {BENCHMARK_FILE: self.definition.encode()}
        contents |= {name: csv_text(HEADERS[name], rows).encode() for name, rows in self.rows.items()}
        contents |= self.raw
        for name, content in contents.items():
            if content is not None:
                instance.reference_file(name).write_bytes(content)
        seal_blindly(instance, self.kind)
        return instance


def seal_blindly(instance: Instance, kind: str = "synthetic") -> None:
    """Write a manifest for whatever is there, as somebody would who does not look."""
    names = [BENCHMARK_FILE, ERRATA_FILE, *HEADERS]
    files = {name: instance.reference_file(name) for name in names}
    checksums = {name: sha256_hex(file.read_bytes()) for name, file in files.items() if file.exists()}
    manifest = {"kind": kind, "files": checksums, "digest": digest_of(checksums)}
    instance.manifest_file.write_text(canonical_json(manifest))
