"""The stand-in of the release is faithful: in every dialect its files tell its truth."""

import pickle
import zipfile
import zlib
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from release_archives import crc_of_zeros
from release_reading import contradicts, listed, listed_labels, pair_of, told, told_answers, trial_of
from release_stand_in import (
    SPARSE_SIZE,
    WINDOWS_ROOT,
    Columns,
    Layout,
    ListNames,
    Release,
    Trap,
    answer_sheets,
    traps_for,
)

SMALL = Release(pairs_per_scenario=4)


@pytest.mark.parametrize("names", ListNames)
@pytest.mark.parametrize("columns", Columns)
@pytest.mark.parametrize("root", [SMALL.root, WINDOWS_ROOT])
@pytest.mark.parametrize("has_index", [False, True])
def test_lists_tell_the_truth_in_every_dialect(
    names: ListNames, columns: Columns, root: str, has_index: bool
) -> None:
    """Read naively by the last three parts of their paths, they give the labels and start frames."""
    release = replace(SMALL, list_names=names, columns=columns, root=root, has_index=has_index)
    found = {name: said == "True" for name, said in listed_labels(release)}
    assert found == release.truth.labels
    frame = columns.value[columns.value.index("target_hit_zone_labels") + 1]
    frames = {trial_of(row["full_stim_paths"]): int(row[frame]) for row in listed(release)}
    assert frames == release.truth.start_frames
    assert list(listed(release)[0]) == [""] * has_index + list(columns.value)


def test_the_official_numbers() -> None:
    """768 trials in opposing pairs; 50 people for each property judged 32 each, half YES, no pair twice."""
    truth = Release().truth
    assert Counter(Counter(map(pair_of, truth.labels)).values()) == {2: 384}
    assert Counter((pair_of(name), label) for name, label in truth.labels.items()).most_common(1)[0][1] == 1
    sheets = answer_sheets(truth.responses)
    assert len(sheets) == 200
    for sheet in sheets:
        assert len({pair_of(trial_id) for trial_id, _ in sheet}) == 32
        assert sum(truth.labels[trial_id] for trial_id, _ in sheet) == 16
    assert len({frozenset(trial_id for trial_id, _ in sheet) for sheet in sheets}) == 4 * 6


def test_long_files_tell_the_truth() -> None:
    """Read naively, they give every person's answers, and correctness that fits."""
    assert answer_sheets(told_answers(SMALL)) == answer_sheets(SMALL.truth.responses)
    assert not any(contradicts(row) for row in told(SMALL))


def test_wide_files_tell_the_truth() -> None:
    """A row for each person and a row for each trial hold the same answers."""
    by_person = [
        (row["prolificIDAnon"], trial_of(name), said == "YES")
        for row in told(replace(SMALL, layout=Layout.BY_PERSON))
        for name, said in row.items()
        if said in {"YES", "NO"}
    ]
    by_trial = [
        (person, trial_of(row["stim_ID"]), said == "YES")
        for row in told(replace(SMALL, layout=Layout.BY_TRIAL, is_one_people_file=True))
        for person, said in row.items()
        if said in {"YES", "NO"}
    ]
    assert sorted(by_person) == sorted(by_trial) == sorted(SMALL.truth.responses)


def test_aggregated_files_tell_the_truth() -> None:
    """Share of right answers and number of answers give back how many said YES."""
    found = {}
    for row in told(replace(SMALL, layout=Layout.AGGREGATED)):
        n, n_right = int(row["c"]), round(float(row["correct"]) * int(row["c"]))
        found[row["stim_ID"]] = (n, n_right if SMALL.truth.labels[row["stim_ID"]] else n - n_right)
    assert found == SMALL.truth.counts


@pytest.mark.parametrize("layout", Layout)
def test_all_traps_of_a_layout_go_together(layout: Layout) -> None:
    """Every layout takes the traps that it can hold, and refuses the others."""
    release = Release(pairs_per_scenario=2, layout=layout, traps=traps_for(layout))
    assert all(release.people_files.values())
    text = b"".join(release.people_files.values()).decode()
    assert [secret for secret in release.truth.secrets if secret not in text] == []
    for trap in set(Trap) - set(traps_for(layout)):
        with pytest.raises(ValueError, match=f"the layout {layout.name} cannot hold {trap.name}$"):
            Release(layout=layout, traps=[trap])


def test_zips_and_folder_hold_the_same(tmp_path: Path) -> None:
    """Unpacking the zips gives the folder, and equal options give equal bytes."""
    zips = SMALL.write_zips(tmp_path / "zips")
    again = replace(SMALL).write_zips(tmp_path / "again")
    assert [path.read_bytes() for path in zips] == [path.read_bytes() for path in again]
    folder = SMALL.write_folder(tmp_path / "folder")
    written = {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}
    assert written == SMALL.test_members.keys() | SMALL.human_members.keys()
    for path in zips:
        with zipfile.ZipFile(path) as archive:
            assert all(archive.read(name) == (folder / name).read_bytes() for name in archive.namelist())


def test_pickles_are_armed() -> None:
    """Whoever loads one of its pickles will notice."""
    armed = next(content for name, content in SMALL.test_members.items() if name.endswith(".pkl"))
    with pytest.raises(SystemExit, match="a pickle of the release was loaded"):
        pickle.loads(armed)  # noqa: S301 - that is the point


def test_the_huge_zip_takes_hardly_any_disk(tmp_path: Path) -> None:
    """It claims more than 4 GB, needs Zip64, and holds the lists at its far end."""
    test_zip, _ = SMALL.write_zips(tmp_path, sparse_size=SPARSE_SIZE)
    status = test_zip.stat()
    assert status.st_size > SPARSE_SIZE > 2**32
    assert status.st_blocks * 512 < 1_000_000
    with zipfile.ZipFile(test_zip) as archive:
        for name, content in SMALL.test_members.items():
            assert archive.getinfo(name).header_offset > 2**32
            assert archive.read(name) == content


def test_a_sparse_zip_is_sound(tmp_path: Path) -> None:
    """Its checksums are right, those of the holes too."""
    test_zip, _ = SMALL.write_zips(tmp_path, sparse_size=3_000_000)
    with zipfile.ZipFile(test_zip) as archive:
        assert archive.testzip() is None


def test_all_media_make_a_long_directory(tmp_path: Path) -> None:
    """Where asked for, every trial has its files."""
    test_zip, _ = replace(SMALL, has_all_media=True).write_zips(tmp_path)
    with zipfile.ZipFile(test_zip) as archive:
        assert sum(name.endswith("_img.mp4") and "_aimg" not in name for name in archive.namelist()) == 80


@given(st.integers(0, 5000))
def test_the_checksum_of_zeros(n: int) -> None:
    """The short way gives what reading every byte gives."""
    assert crc_of_zeros(n) == zlib.crc32(bytes(n))
