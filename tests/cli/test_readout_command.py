"""``leaderboard readout``: from files of features to a submission on the board."""

import json
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from feature_sets import WRITERS, simulate_files
from leaderboard.files import csv_text
from leaderboard.instance import Instance
from leaderboard.readout import logistic, mlp
from leaderboard.reference import load_reference
from reference_folders import HEADERS, ReferenceFolder, sound_rows

Run = Callable[..., Result]

SUBMIT = [
    *("--name=My Model", "--team=My Lab", "--date=2026-11-20", "--description=A test.", "--github=someone"),
    *("--training=separate", "--testing=with_property", "--family=video", "--inputs=rgb"),
]


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """An instance of twelve trials in three scenarios."""
    ReferenceFolder().write(tmp_path / "instance")
    return tmp_path / "instance"


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Fewer strengths to choose from, so that a test takes no more than a moment."""
    monkeypatch.setattr(logistic, "EXPONENTS", (-1, 1))
    monkeypatch.setattr(mlp, "MAX_EPOCHS", 3)


def write_features(root: Path, folder: Path, suffix: str = ".npz", **options: Any) -> list[str]:
    """Write a file to fit on for each property and one of test trials; give them as options."""
    fitting, test = simulate_files(load_reference(Instance(root)), **options)
    arguments = []
    for name, arrays in fitting.items():
        arguments.append(f"--fit={name}={WRITERS[suffix](folder / f'{name}{suffix}', arrays)}")
    return [*arguments, f"--test={WRITERS[suffix](folder / f'test{suffix}', test)}", "--seeds=1"]


def read_contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}


@pytest.mark.parametrize("suffix", WRITERS)
def test_features_reach_the_board(run: Run, root: Path, tmp_path: Path, suffix: str) -> None:
    """Features of every kind of file go through readout, submit and grade; the metadata say how."""
    arguments = write_features(root, tmp_path, suffix, signal=30.0, n_features=2)
    out = tmp_path / "my out"
    done = run("readout", "fit", *arguments, "-o", out)
    assert done.stdout.splitlines() == [
        f"wrote {out}/{name}"
        for name in ("predictions.csv", "metadata.toml", "report.json", "reliability.svg")
    ]
    assert "Tiny: logistic regression, one per property, 1 seed" in done.stderr
    files = [out / "predictions.csv", "--metadata", out / "metadata.toml"]
    names = f"'{out}/predictions.csv' --metadata '{out}/metadata.toml'"
    assert f"next: leaderboard submit {names} ...\n" in done.stderr
    run("submit", *files, *SUBMIT)
    assert 'selection = "readout"' in (root / "submissions/my-model/submission.toml").read_text()
    result = json.loads(run("grade", "--json", "--check", root / "submissions/my-model").stdout)
    assert result["scores"]["overall"]["all"]["accuracy"]["value"] > 0.9


def test_labels_of_the_reference_change_nothing(run: Run, root: Path, tmp_path: Path) -> None:
    """With every label of the reference turned, each of the four files is the same to the byte."""
    arguments = write_features(root, tmp_path)
    run("readout", "fit", *arguments, "-o", tmp_path / "plain")
    rows = sound_rows()
    place = HEADERS["Alpha.csv"].index("label")
    for row in (*rows["Alpha.csv"], *rows["Beta.csv"]):
        row[place] = str(1 - int(row[place]))
    for file in root.rglob("*"):
        if file.is_file():
            file.unlink()
    (root / "reference").rmdir()
    turned = ReferenceFolder(rows=rows).write(root)
    assert csv_text(HEADERS["Alpha.csv"], rows["Alpha.csv"]) == turned.reference_file("Alpha.csv").read_text()
    run("readout", "fit", *arguments, "-o", tmp_path / "turned")
    assert read_contents(tmp_path / "plain") == read_contents(tmp_path / "turned")


def test_same_features_give_the_same_bytes(run: Run, root: Path, tmp_path: Path) -> None:
    """A second run writes the same bytes, into a folder of its own."""
    arguments = write_features(root, tmp_path)
    for name in ("first", "second"):
        run("readout", "fit", *arguments, "-o", tmp_path / name)
    assert read_contents(tmp_path / "first") == read_contents(tmp_path / "second")


def test_distances(run: Run, root: Path, tmp_path: Path) -> None:
    """Distances over the frames of a rollout become probabilities, or with --hard answers."""
    fitting, test = simulate_files(load_reference(Instance(root)), n_features=5)
    paths = []
    for name, arrays in {**fitting, "test": test}.items():
        features = 20 - arrays["features"][:, :1] + abs(arrays["features"])
        paths.append(WRITERS[".npz"](tmp_path / f"{name}.npz", arrays | {"features": features}))
    arguments = [f"--fit=Alpha={paths[0]}", f"--fit=Beta={paths[1]}", f"--test={paths[2]}", "--seeds=1"]
    soft = run("readout", "distance", *arguments, "-o", tmp_path / "soft")
    assert "Tiny: logistic regression on the smallest distance, one per property, 1 seed" in soft.stderr
    hard = run("readout", "distance", *arguments, "--hard", "-o", tmp_path / "hard")
    assert re.search(r"Alpha .* 20 trials, 1 feature; threshold [0-9.]+\n", hard.stderr)
    table = (tmp_path / "hard/predictions.csv").read_text().splitlines()[1:]
    assert {row.rpartition(",")[2] for row in table} <= {"0.0", "1.0"}
    run("validate", tmp_path / "hard/predictions.csv")


def test_mlp_pooling_and_scope(run: Run, root: Path, tmp_path: Path) -> None:
    """Frames are pooled as stated, and one perceptron may serve all properties."""
    fitting, test = simulate_files(load_reference(Instance(root)), n_features=6)
    paths = []
    for name, arrays in {**fitting, "test": test}.items():
        frames = arrays | {"features": arrays["features"].reshape(-1, 3, 2)}
        paths.append(WRITERS[".npz"](tmp_path / f"{name}.npz", frames))
    arguments = [f"--fit={paths[0]}", f"--fit={paths[1]}", f"--test={paths[2]}", "--seeds=1"]
    refused = run("readout", "fit", *arguments, "-o", tmp_path / "out", exit_code=1)
    assert "features have frames, their shape is (20, 3, 2)" in refused.stderr
    assert "say what becomes of the frames: --pooling mean, max, last or flatten" in refused.stderr
    options = ["--pooling=mean", "--model=mlp", "--scope=all"]
    done = run("readout", "fit", *arguments, *options, "-o", tmp_path / "out")
    assert "Tiny: multilayer perceptron, one per benchmark, 1 seed" in done.stderr
    report = json.loads((tmp_path / "out/report.json").read_text())
    assert report["features"]["test"][0]["pooling"] == "mean"
    assert report["parts"][0]["seeds"][0]["epochs"] >= 1


def test_nothing_is_overwritten(run: Run, root: Path, tmp_path: Path) -> None:
    """A folder that is there stays as it is, and that is said before anything is fitted."""
    (tmp_path / "out").mkdir()
    refused = run("readout", "fit", *write_features(root, tmp_path), "-o", tmp_path / "out", exit_code=1)
    assert refused.stderr == (
        f"error: {tmp_path}/out exists\n  choose another folder; nothing is overwritten\n"
    )
    assert list((tmp_path / "out").iterdir()) == []


def test_nothing_half_written_is_left(
    run: Run, root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """If writing fails, there is no folder, nor anything beside it."""
    arguments = write_features(root, tmp_path)
    before = sorted(tmp_path.iterdir())

    def fail(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", fail)
    refused = run("readout", "fit", *arguments, "-o", tmp_path / "out", exit_code=1)
    assert "No space left on device" in refused.stderr
    assert sorted(tmp_path.iterdir()) == before


def test_files_may_have_any_name(run: Run, root: Path, tmp_path: Path) -> None:
    """A file whose name holds an equals sign is a file, and a missing one is named."""
    arguments = write_features(root, tmp_path, n_features=2)
    path = (tmp_path / "test.npz").rename(tmp_path / "zone=far.npz")
    arguments[-2] = f"--test={path}"
    run("readout", "fit", *arguments, "-o", tmp_path / "out")
    wrong = run("readout", "fit", "--fit=Gamma=x.npz", f"--test={path}", "-o", tmp_path / "o", exit_code=2)
    message = "Error: Gamma=x.npz does not exist; before an equals sign stands Alpha or Beta\n"
    assert wrong.stderr.endswith(message)
    wrong = run("readout", "fit", "--fit=Alpha=x.npz", f"--test={path}", "-o", tmp_path / "o", exit_code=2)
    assert wrong.stderr.endswith("Error: x.npz does not exist\n")
    wrong = run("readout", "fit", arguments[0], f"--test={root}", "-o", tmp_path / "o", exit_code=2)
    assert wrong.stderr.endswith(f"Error: {root} is no file; give the file itself\n")
