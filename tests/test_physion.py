"""The main job from end to end on real data: the predecessor's stimuli, people, and 48 real model runs."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from leaderboard.cli import group

pytestmark = [pytest.mark.shared, pytest.mark.xdist_group("physion")]

Run = Callable[..., Result]

HUMAN_ACCURACY = {
    "Dominoes": 0.689377,
    "Support": 0.763333,
    "Collide": 0.806526,
    "Contain": 0.762980,
    "Drop": 0.744348,
    "Link": 0.644329,
    "Roll": 0.868129,
    "Drape": 0.679394,
}
CSWM_ALL_A = {"Support": 0.813333, "Collide": 0.593333, "Drape": 0.706667, "Roll": 0.600000}
RUNS = [f"cswm-{training}-{readout}" for training in ("all", "same") for readout in "abc"]


@pytest.fixture(scope="module")
def instance(tmp_path_factory: pytest.TempPathFactory, shared_dir: Path) -> Path:
    """Make the instance as the README of a maintainer would: import, baselines, convert, submit."""
    root = tmp_path_factory.mktemp("physion") / "instance"
    data = shared_dir / "data/physion-v1"
    run = _runner(root)
    run("reference", "import", "physion", "--from", data)
    run("baselines", "--date", "2026-11-21")
    runs = root.parent / "runs"
    run("convert", "physopt", data / "models/cswm_physopt_results.csv", "--split-runs", runs)
    for name in RUNS:
        training = "unified" if "-all-" in name else "separate"
        options = {
            "slug": name,
            "name": f"C-SWM, readout {name[-1].upper()}, {name.split('-')[1]} scenarios",
            "system": name.replace("-all", "").replace("-same", ""),
            "team": "Physion",
            "date": "2026-11-21",
            "description": "Real predictions of C-SWM from the predecessor's release.",
            "training": training,
            "testing": "without_property",
            "family": "world-model",
            "inputs": "rgb",
            "github": "cogtoolslab",
        }
        flags = [text for key, value in options.items() for text in (f"--{key}", value)]
        run("submit", runs / name / "predictions.csv", *flags)
    return root


def _runner(root: Path) -> Run:
    def run(*arguments: object, exit_code: int = 0) -> Result:
        result = CliRunner().invoke(group, ["--root", str(root), *map(str, arguments)])
        assert result.exit_code == exit_code, result.output
        return result

    return run


@pytest.fixture
def run(instance: Path) -> Run:
    """Run a command on the instance and check its exit status."""
    return _runner(instance)


def test_people_have_the_published_accuracy(run: Run) -> None:
    """Over the trials with ratings, to six decimals."""
    people = json.loads(run("rank", "--json").stdout)["people"]
    shown = {name: people[name]["all"]["accuracy"]["value"] for name in HUMAN_ACCURACY}
    assert shown == HUMAN_ACCURACY


def test_the_reference_is_sound_and_keeps_unrated_trials(run: Run) -> None:
    """All 1,200 stimuli are there, 1,144 of them rated; what is unusual is noted, not hidden."""
    run("reference", "check")
    description = json.loads(run("reference", "show", "--json").stdout)
    assert (description["kind"], description["n_trials"], description["n_rated"]) == ("official", 1200, 1144)


def test_cswm_has_its_real_accuracy(instance: Path) -> None:
    """Trained on all scenarios with readout A, over all labelled trials, rated or not."""
    result = json.loads((instance / "submissions/cswm-all-a/result.json").read_text())
    shown = {name: result["scores"][name]["all"]["accuracy"]["value"] for name in CSWM_ALL_A}
    assert shown == CSWM_ALL_A
    roll = result["scores"]["Roll"]["all"]
    assert (roll["n"], roll["n_rated"]) == (150, 94)


def test_one_run_is_converted_as_among_all(
    run: Run, instance: Path, shared_dir: Path, tmp_path: Path
) -> None:
    """Choosing a run by its training and readout gives the same file as splitting all."""
    source = shared_dir / "data/physion-v1/models/cswm_physopt_results.csv"
    output = tmp_path / "one.csv"
    result = run("convert", "physopt", source, "--training", "same", "--readout", "B", "-o", output)
    assert output.read_bytes() == (instance / "submissions/cswm-same-b/predictions.csv").read_bytes()
    assert "drape: 72 of 150 trials are answered" in result.output
    assert "rows about trials that Physion does not have: 527 " in result.output


def test_the_six_submissions_validate(run: Run, instance: Path) -> None:
    """Each is valid as it stands in its folder."""
    run("validate", *(instance / "submissions" / name for name in RUNS))


def test_complete_runs_are_ranked_and_partial_ones_listed(run: Run) -> None:
    """The runs trained per scenario lack Drape, so they are partial on their own track."""
    boards = {
        track: [
            (row["slug"], row["kind"])
            for row in json.loads(run("rank", "--track", track, "--json").stdout)["rows"]
        ]
        for track in ("all-scenarios", "same-scenario")
    }
    kinds = {
        track: {kind for slug, kind in rows if slug.startswith("cswm")} for track, rows in boards.items()
    }
    assert kinds == {"all-scenarios": {"ranked"}, "same-scenario": {"partial"}}
    assert sum(slug.startswith("cswm") for rows in boards.values() for slug, _ in rows) == 6


def test_verify_proves_all_results(run: Run) -> None:
    """Every committed result is what grading gives."""
    assert "10 of 10 results proven" in run("verify").stdout


def test_the_site_shows_all_six_and_no_synthetic_banner(run: Run, instance: Path) -> None:
    """The same engine publishes another benchmark, with real data and without the banner."""
    run("site", "build")
    dist = instance / "site/dist"
    pages = {path.parent.name: path.read_text() for path in dist.glob("submissions/*/index.html")}
    assert set(RUNS) <= set(pages)
    assert "SYNTHETIC" not in pages["cswm-all-a"].upper()
    assert "81.3" in pages["cswm-all-a"]
