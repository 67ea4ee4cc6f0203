"""The seal: checksums, the digest, and what may be sealed."""

import hashlib
import json
from pathlib import Path

import pytest

from leaderboard.errors import BrokenReferenceError
from leaderboard.instance import Instance
from leaderboard.models import Source
from leaderboard.reference import load_reference
from leaderboard.reference.sealing import digest_of, seal_reference
from reference_folders import ReferenceFolder

SOURCE = Source(what="trials", url="https://example.com/trials.zip", sha256="ab" * 32, etag='"1"')


def unsealed(root: Path) -> Instance:
    instance = ReferenceFolder().write(root)
    instance.manifest_file.unlink()
    return instance


def test_the_digest_is_that_of_sorted_lines() -> None:
    """It can be computed with sha256sum and sort, in whatever order the files are listed."""
    checksums = {"b.csv": "0" * 64, "a.csv": "f" * 64}
    text = f"{'0' * 64}  b.csv\n{'f' * 64}  a.csv\n"
    assert digest_of(checksums) == hashlib.sha256(text.encode()).hexdigest()
    assert digest_of(dict(reversed(checksums.items()))) == digest_of(checksums)


def test_sealing_makes_a_reference_usable(tmp_path: Path) -> None:
    """The manifest lists every file with its checksum, by name."""
    instance = unsealed(tmp_path)
    manifest = seal_reference(instance, "synthetic")
    assert list(manifest.files) == [
        "Alpha.csv",
        "Beta.csv",
        "benchmark.toml",
        "human_responses.csv",
        "human_trials.csv",
    ]
    for name, checksum in manifest.files.items():
        assert checksum == hashlib.sha256(instance.reference_file(name).read_bytes()).hexdigest()
    assert manifest.digest == digest_of(manifest.files)
    assert load_reference(instance).manifest == manifest


def test_the_manifest_is_canonical(tmp_path: Path) -> None:
    """Sealing twice gives the same bytes, and nothing that says nothing is written."""
    instance = unsealed(tmp_path)
    seal_reference(instance, "official")
    first = instance.manifest_file.read_bytes()
    seal_reference(instance, "official")
    assert instance.manifest_file.read_bytes() == first
    assert list(json.loads(first)) == ["kind", "files", "digest"]
    assert first.endswith(b"}\n")


def test_the_digest_changes_with_any_file(tmp_path: Path) -> None:
    """A comment in the definition makes another reference, and so another identity in every result."""
    instance = unsealed(tmp_path)
    before = seal_reference(instance, "synthetic").digest
    with instance.benchmark_file.open("a") as stream:
        stream.write("# a comment\n")
    assert seal_reference(instance, "synthetic").digest != before


def test_published_numbers_are_sealed_and_stray_files_are_not(tmp_path: Path) -> None:
    """Only files with a meaning belong to the reference."""
    instance = unsealed(tmp_path)
    for name in ("published.csv", "notes.txt", ".hidden"):
        instance.reference_file(name).write_text("x\n")
    assert seal_reference(instance, "synthetic").files.keys() - {"published.csv"} == {
        "Alpha.csv",
        "Beta.csv",
        "benchmark.toml",
        "human_responses.csv",
        "human_trials.csv",
    }


def test_sources_are_recorded_and_kept(tmp_path: Path) -> None:
    """Sealing again after a correction does not forget where the files came from."""
    instance = unsealed(tmp_path)
    assert seal_reference(instance, "official", sources=[SOURCE]).sources == (SOURCE,)
    assert seal_reference(instance, "official").sources == (SOURCE,)
    assert load_reference(instance).manifest.sources == (SOURCE,)


def test_sources_do_not_outlive_a_change_of_kind(tmp_path: Path) -> None:
    """Simulated data did not come from the official files."""
    instance = unsealed(tmp_path)
    seal_reference(instance, "official", sources=[SOURCE])
    assert seal_reference(instance, "synthetic").sources == ()


@pytest.mark.parametrize("present", [None, b"{}\n"])
def test_what_cannot_be_graded_against_is_not_sealed(tmp_path: Path, present: bytes | None) -> None:
    """The first problem is named, and a manifest that is there stays as it was."""
    folder = ReferenceFolder()
    folder.rows["Alpha.csv"][0][4] = "maybe"
    instance = folder.write(tmp_path)
    instance.manifest_file.unlink()
    if present is not None:
        instance.manifest_file.write_bytes(present)
    with pytest.raises(
        BrokenReferenceError, match=r"^reference/Alpha\.csv:2: label is 'maybe'; it must be 0 or 1$"
    ):
        seal_reference(instance, "synthetic")
    assert (instance.manifest_file.read_bytes() if instance.manifest_file.exists() else None) == present


def test_contradictions_are_not_sealed_either(tmp_path: Path) -> None:
    """What loading would refuse is refused here, so that a sealed reference always loads."""
    folder = ReferenceFolder()
    folder.rows["human_trials.csv"][0][1] = "5"
    with pytest.raises(BrokenReferenceError, match=r"has 5 people, of whom 0 said YES"):
        seal_reference(folder.write(tmp_path), "synthetic")


def test_a_broken_manifest_is_replaced(tmp_path: Path) -> None:
    """Sealing does not need the old seal."""
    instance = ReferenceFolder().write(tmp_path)
    instance.manifest_file.write_text("{")
    seal_reference(instance, "synthetic")
    assert load_reference(instance).n_trials == 12
