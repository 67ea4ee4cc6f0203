"""The naive way to read a sound release, to hold the stand-in against its truth."""

import csv
import io
import re

from release_stand_in import Release

Cells = dict[str, str]


def read_rows(content: bytes) -> list[Cells]:
    """Read a table."""
    return list(csv.DictReader(io.StringIO(content.decode("utf-8-sig"))))


def listed(release: Release) -> list[Cells]:
    """Read the rows of the lists."""
    return [row for content in release.list_files.values() for row in read_rows(content)]


def told(release: Release) -> list[Cells]:
    """Read the rows of people's files."""
    return [row for content in release.people_files.values() for row in read_rows(content)]


def trial_of(path: str) -> str:
    return "/".join(path.replace("\\", "/").split("/")[-3:]).split("_img")[0]


def listed_labels(release: Release) -> list[tuple[str, str]]:
    return [(trial_of(row["full_stim_paths"]), row["target_hit_zone_labels"]) for row in listed(release)]


def told_answers(release: Release) -> list[tuple[str, str, bool]]:
    return [(r["prolificIDAnon"], trial_of(r["stim_ID"]), r["response"] == "YES") for r in told(release)]


def pair_of(trial_id: str) -> str:
    return re.sub(r"-copy[01]", "", trial_id)


def contradicts(row: Cells) -> bool:
    is_yes, label = row["response"] == "YES", row["target_hit_zone_label"] == "True"
    return (is_yes == label) != (row["correct"] == "True")
