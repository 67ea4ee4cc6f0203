"""The files in which people keep features, sound and broken."""

import builtins
import pickle
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet

from feature_sets import WRITERS, write_npz
from leaderboard.errors import SourceError
from leaderboard.readout import read_features

ARRAYS: dict[str, Any] = {
    "trial_id": np.array(["wall-copy0/a,b/0001", "wall-copy1/a,b/0001", "x"]),
    "pair_id": np.array(["p", "p", "q"]),
    "label": np.array([0, 1, 1]),
    "features": np.arange(12, dtype=np.float32).reshape(3, 4),
}


@pytest.mark.parametrize("suffix", WRITERS)
def test_every_kind_of_file_gives_the_same(tmp_path: Path, suffix: str) -> None:
    """Ids, pairs, labels and numbers are the same, whatever kind of file they are in."""
    taken = read_features(WRITERS[suffix](tmp_path / f"fit{suffix}", ARRAYS), with_labels=True)
    assert taken.trial_ids == tuple(ARRAYS["trial_id"])
    assert taken.pair_ids == ("p", "p", "q")
    assert taken.labels is not None
    assert taken.labels.tolist() == [0, 1, 1]
    assert taken.values.tolist() == ARRAYS["features"].tolist()


@pytest.mark.parametrize("suffix", WRITERS)
def test_frames_are_pooled(tmp_path: Path, suffix: str) -> None:
    """Every kind of file can hold frames."""
    frames = ARRAYS | {"features": np.arange(12.0).reshape(3, 2, 2)}
    path = WRITERS[suffix](tmp_path / f"fit{suffix}", frames)
    taken = read_features(path, pooling="last", with_labels=False)
    assert taken.values.tolist() == [[2, 3], [6, 7], [10, 11]]


@pytest.mark.parametrize("suffix", WRITERS)
def test_broken_labels_of_test_features_do_not_matter(tmp_path: Path, suffix: str) -> None:
    """Where labels are not asked for, not even nonsense in their column is noticed."""
    nonsense = ARRAYS | {"label": np.array(["?", "!", ""])}
    taken = read_features(WRITERS[suffix](tmp_path / f"test{suffix}", nonsense), with_labels=False)
    assert taken.labels is None


@pytest.mark.parametrize("suffix", [".npz", ".parquet"])
def test_labels_beside_features_are_never_opened(
    tmp_path: Path, suffix: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An array of labels that cannot be opened safely does no harm where labels are not asked for."""
    if suffix == ".npz":
        path = write_npz(
            tmp_path / "test.npz", ARRAYS | {"label": np.array([0, None, 1], object)}, pickles=True
        )
        assert read_features(path, with_labels=False).labels is None
        with pytest.raises(SourceError, match="holds pickled Python objects, which could run programs"):
            read_features(path, with_labels=True)
        return
    from pyarrow import parquet

    path = WRITERS[suffix](tmp_path / "test.parquet", ARRAYS)
    asked: list[str] = []
    read = parquet.ParquetFile.read

    def note(file: Any, *, columns: list[str]) -> Any:
        asked.extend(columns)
        return read(file, columns=columns)

    monkeypatch.setattr(parquet.ParquetFile, "read", note)
    read_features(path, with_labels=False)
    assert asked == ["trial_id", "pair_id", "features"]


def test_features_of_npy_stay_on_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An .npy file is mapped into memory, so that only the block in use takes any."""
    path = WRITERS[".npy"](tmp_path / "fit.npy", ARRAYS)
    seen: list[Any] = []
    load = np.load

    def note(*arguments: Any, **options: Any) -> Any:
        seen.append(options)
        return load(*arguments, **options)

    monkeypatch.setattr(np, "load", note)
    read_features(path, with_labels=False)
    assert seen == [{"mmap_mode": "r", "allow_pickle": False}]


def write_broken(folder: Path) -> Iterator[tuple[Path, str]]:
    yield folder / "a.csv", "is none of the kinds of files that features are read from"
    (folder / "b.npz").write_bytes(b"PK\x03\x04 but not for long")
    yield folder / "b.npz", "is damaged, or no file of NumPy's"
    (folder / "c.npy").write_bytes(b"")
    yield folder / "c.npy", "is damaged, or no file of NumPy's"
    np.save(folder / "d.npy", ARRAYS["features"])
    yield folder / "d.npy", "is missing: the table with the column trial_id, a row for each row of d.npy"
    WRITERS[".npy"](folder / "e.npy", ARRAYS)
    (folder / "e.npy").write_bytes((folder / "e.npy").read_bytes()[:-8])
    yield folder / "e.npy", "is damaged, or no file of NumPy's"
    np.save(folder / "f.npy", np.array([{}]), allow_pickle=True)
    yield folder / "f.npy", "holds pickled Python objects, which could run programs"
    (folder / "g.parquet").write_bytes(b"PAR1 no")
    yield folder / "g.parquet", "cannot be read as Parquet"
    with zipfile.ZipFile(folder / "h.npz", "w") as archive:
        archive.writestr("features.npy", b"nonsense")
    yield folder / "h.npz", "is damaged, or no file of NumPy's|lacks trial_id"
    np.savez(folder / "k.npz", **ARRAYS)
    (folder / "k.npz").rename(folder / "k.npy")
    yield folder / "k.npy", "holds several arrays"
    np.save(folder / "l.npy", ARRAYS["features"])
    (folder / "l.npy").rename(folder / "l.npz")
    yield folder / "l.npz", "is one array"
    np.savez(folder / "i.npz", trial_id=ARRAYS["trial_id"])
    yield folder / "i.npz", "lacks features; found 'trial_id'"
    ragged = {"trial_id": np.array(["a", "b"]), "features": np.array([[1.0], [1.0, 2.0]], object)}
    yield WRITERS[".parquet"](folder / "j.parquet", ragged), "trials have different numbers of values"
    (folder / "m.npz").write_bytes(pickle.dumps({"features": [1.0]}))
    yield (
        folder / "m.npz",
        "is no file of NumPy's, or holds pickled Python objects, which could run programs$",
    )
    with zipfile.ZipFile(folder / "n.npz", "w") as archive, archive.open("features.npy", "w") as stream:
        np.lib.format.write_array_header_1_0(
            stream, {"descr": "<f4", "fortran_order": False, "shape": (10**7, 10**7)}
        )
    yield folder / "n.npz", "is larger than the memory, or damaged: Unable to allocate"
    ids = pa.array(["a-copy0/1"])
    parquet.write_table(pa.table([ids, ids], ["trial_id", "trial_id"]), folder / "o.parquet")
    yield folder / "o.parquet", "has the column 'trial_id' twice"


def test_broken_files_are_refused(tmp_path: Path) -> None:
    """Whatever is wrong with a file, the message names it, and nothing of it is run."""
    for path, message in write_broken(tmp_path):
        with pytest.raises(SourceError, match=message) as found:
            read_features(path, with_labels=True)
        assert path.stem in found.value.message


def test_parquet_without_its_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without pyarrow the message says how to install it, and what else to do."""
    real_import = builtins.__import__

    def refuse(name: str, *arguments: Any, **options: Any) -> Any:
        if name.startswith("pyarrow"):
            raise ImportError(name)
        return real_import(name, *arguments, **options)

    path = WRITERS[".parquet"](tmp_path / "fit.parquet", ARRAYS)
    monkeypatch.setattr(builtins, "__import__", refuse)
    with pytest.raises(SourceError, match="reading Parquet needs pyarrow, which is not installed") as found:
        read_features(path, with_labels=True)
    hint = "install it with pip install pyarrow, or save the features as .npz"
    assert found.value.hint == hint
