"""Each command from the outside: what it prints, what it writes, how it ends."""

import csv
import io
import json
import os
import pty
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

from leaderboard.problems import CODES

Run = Callable[..., Result]

OPTIONS = {
    "name": "My Model",
    "team": "My Lab",
    "date": "2026-11-20",
    "description": "A test.",
    "training": "separate",
    "testing": "with_property",
    "family": "video",
    "inputs": "rgb",
    "github": "someone",
}


def _flags(**changes: str | None) -> list[str]:
    options = {key: value for key, value in (OPTIONS | changes).items() if value is not None}
    return [text for key, value in options.items() for text in (f"--{key}", value)]


def _break(example: Path, old: str, new: str) -> None:
    file = example / "predictions.csv"
    file.write_text(file.read_text().replace(old, new, 1))


def _snapshot(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


class TestValidate:
    """``leaderboard validate``."""

    def test_a_valid_submission_is_said_to_be_so(self, run: Run, example: Path) -> None:
        """One line with what it covers."""
        assert run("validate", example).output == "submissions/example-slots: valid, 768 of 768 trials\n"

    def test_every_problem_is_named_and_the_exit_status_is_1(self, run: Run, example: Path) -> None:
        """Problems of both files come in one run, with file, line, code and hint."""
        _break(example, "\n", "\nnonsense,0.5\n")
        (example / "submission.toml").write_text("[submission]\nnmae = 1\n")
        lines = run("validate", example, exit_code=1).output.splitlines()
        assert (
            "submissions/example-slots/submission.toml:2: unknown-key: submission.nmae is not a known key"
            in lines
        )
        assert "    did you mean name?" in lines
        assert any(
            line.startswith("submissions/example-slots/predictions.csv:2: unknown-trial:") for line in lines
        )
        assert lines[-1].startswith("submissions/example-slots: refused, ")

    def test_json_has_the_shape_of_the_contract(self, run: Run, example: Path) -> None:
        """Valid, errors and warnings; each problem with code, message, file, line and hint."""
        assert json.loads(run("validate", "--json", example).output) == {
            "valid": True,
            "errors": [],
            "warnings": [],
        }
        (example / "extra.txt").touch()
        data = json.loads(run("validate", "--format", "json", example, exit_code=1).output)
        assert data["valid"] is False
        assert data["errors"] == [
            {
                "code": "unexpected-file",
                "message": "'extra.txt' does not belong in a submission",
                "file": "submissions/example-slots/extra.txt",
                "line": None,
                "hint": "keep only submission.toml, predictions.csv, result.json here",
            }
        ]

    def test_github_gets_annotations(self, run: Run, example: Path) -> None:
        """Each problem is a workflow command on the right file and line."""
        _break(example, "\n", "\nnonsense,0.5\n")
        output = run("validate", "--format", "github", example, exit_code=1).output
        assert "::error file=submissions/example-slots/predictions.csv,line=2,title=unknown-trial::" in output

    def test_a_bare_predictions_file_is_judged_alone(self, run: Run, example: Path, tmp_path: Path) -> None:
        """No metadata is asked for, and the file may have any name."""
        bare = tmp_path / "my predictions.txt"
        bare.write_bytes((example / "predictions.csv").read_bytes())
        assert run("validate", bare).output == f"{bare}: valid, 768 of 768 trials\n"

    def test_a_path_that_does_not_exist_is_wrong_usage(self, run: Run) -> None:
        """Exit status 2."""
        assert "does not exist" in run("validate", "nowhere", exit_code=2).output


class TestGrade:
    """``leaderboard grade``."""

    def test_a_result_is_written_and_shown(self, run: Run, example: Path) -> None:
        """The table names the system, the synthetic reference, and people beside the model."""
        committed = (example / "result.json").read_bytes()
        (example / "result.json").unlink()
        output = run("grade", example).output
        assert (example / "result.json").read_bytes() == committed
        assert "Example Slots (simulated)" in output
        assert "SYNTHETIC reference" in output
        assert "people" in output

    def test_check_writes_nothing_and_names_differences(self, run: Run, example: Path) -> None:
        """A forged score is found, the file stays as it is, and the exit status is 1."""
        run("grade", "--check", example)
        forged = (example / "result.json").read_text().replace('"complete": true', '"complete": false')
        (example / "result.json").write_text(forged)
        output = run("grade", "--check", example, exit_code=1).output
        assert "submissions/example-slots/result.json: coverage.complete is false, should be true" in output
        assert (example / "result.json").read_text() == forged

    def test_a_refused_submission_is_not_graded(self, run: Run, example: Path) -> None:
        """Problems are printed, and the old result stays."""
        before = (example / "result.json").read_bytes()
        _break(example, '",0.', '",x.')
        assert "probability-not-a-number" in run("grade", example, exit_code=1).output
        assert (example / "result.json").read_bytes() == before

    def test_a_bare_file_is_written_only_where_output_says(
        self, run: Run, example: Path, tmp_path: Path
    ) -> None:
        """Without --output only the table; with it the result without a slug."""
        bare, output = tmp_path / "bare.csv", tmp_path / "out.json"
        bare.write_bytes((example / "predictions.csv").read_bytes())
        before = sorted(tmp_path.iterdir())
        run("grade", bare)
        assert sorted(tmp_path.iterdir()) == before
        theirs = tmp_path / ".tmp-theirs"
        theirs.mkdir()
        run("grade", bare, "--output", output)
        assert json.loads(output.read_text())["submission"] is None
        assert theirs.is_dir(), "what looks half-written beside it may be anybody's"

    def test_output_to_a_link_is_refused(self, run: Run, example: Path, tmp_path: Path) -> None:
        """A rename would replace the link, or a device, by a file."""
        link = tmp_path / "link.json"
        link.symlink_to("nowhere.json")
        result = run("grade", example, "--output", link, exit_code=1)
        assert f"error: {link}: not a regular file, so it is not replaced" in result.stderr
        assert link.is_symlink()

    def test_json_is_the_result(self, run: Run, example: Path) -> None:
        """One path gives one object, several give a list."""
        committed = json.loads((example / "result.json").read_text())
        assert json.loads(run("grade", "--check", "--json", example).stdout) == committed
        assert json.loads(run("grade", "--check", "--json", example, example).stdout) == [committed] * 2

    @pytest.mark.parametrize("flags", [["--check", "--output", "x"], ["--output", "x", "second"]])
    def test_options_that_contradict_are_wrong_usage(self, run: Run, example: Path, flags: list[str]) -> None:
        """Exit status 2 before anything is done."""
        (example.parent / "second").mkdir()
        flags = [str(example.parent / flag) if flag == "second" else flag for flag in flags]
        run("grade", example, *flags, exit_code=2)

    @pytest.mark.parametrize(
        "settings",
        [
            {"PYTHONHASHSEED": "0"},
            {"PYTHONHASHSEED": "4242"},
            {"OPENBLAS_CORETYPE": "Nehalem", "OPENBLAS_NUM_THREADS": "2"},
            {"OPENBLAS_CORETYPE": "Haswell", "OPENBLAS_NUM_THREADS": "1"},
        ],
        ids=["hash-0", "hash-4242", "old-processor", "newer-processor"],
    )
    def test_the_same_inputs_give_the_same_bytes(
        self, example: Path, root: Path, settings: dict[str, str]
    ) -> None:
        """In fresh processes, whatever the seed of Python's hashes and the kernels that multiply matrices."""
        committed = (example / "result.json").read_bytes()
        command = [sys.executable, "-m", "leaderboard", "--root", str(root), "grade", str(example)]
        subprocess.run(command, env=os.environ | settings, check=True, capture_output=True)
        assert (example / "result.json").read_bytes() == committed


class TestSubmit:
    """``leaderboard submit``."""

    def test_a_folder_is_made_complete_and_graded(self, run: Run, example: Path, root: Path) -> None:
        """Metadata from options, the predictions byte for byte, and a result that verify proves."""
        run("submit", example / "predictions.csv", *_flags())
        folder = root / "submissions/my-model"
        assert (folder / "predictions.csv").read_bytes() == (example / "predictions.csv").read_bytes()
        assert sorted(path.name for path in folder.iterdir()) == [
            "predictions.csv",
            "result.json",
            "submission.toml",
        ]
        run("validate", folder)
        assert "2 of 2 results proven" in run("verify").output

    def test_several_files_are_joined(self, run: Run, example: Path, root: Path, tmp_path: Path) -> None:
        """One file per property gives the same scores as one file."""
        with (example / "predictions.csv").open(newline="") as stream:
            header, *rows = csv.reader(stream)
        parts = [tmp_path / f"{name}.csv" for name in ("mass", "friction", "bouncy", "deform")]
        for part in parts:
            with part.open("w", newline="") as stream:
                csv.writer(stream, lineterminator="\r\n").writerows(
                    [header, *(row for row in rows if row[0].startswith(part.stem))]
                )
        run("submit", *parts, *_flags())
        mine = json.loads((root / "submissions/my-model/result.json").read_text())
        assert mine["scores"] == json.loads((example / "result.json").read_text())["scores"]

    def test_an_invalid_file_leaves_nothing_behind(
        self, run: Run, example: Path, root: Path, tmp_path: Path
    ) -> None:
        """Problems name the participant's own file, and the instance is untouched."""
        bare = tmp_path / "mine.csv"
        bare.write_text((example / "predictions.csv").read_text().replace('",0.', '",7.', 1))
        before = _snapshot(root)
        output = run("submit", bare, *_flags(), exit_code=1).output
        assert f"{bare}:2: probability-out-of-range:" in output
        assert "nothing was written" in output
        assert _snapshot(root) == before

    def test_bad_metadata_leaves_nothing_behind(self, run: Run, example: Path, root: Path) -> None:
        """Options are judged like the file they become."""
        before = _snapshot(root)
        flags = _flags(name="bad\u202ename", date="2199-01-01")
        output = run("submit", example / "predictions.csv", "--slug", "mine", *flags, exit_code=1).output
        assert "metadata: forbidden-character: submission.name has U+202E" in output
        assert _snapshot(root) == before

    def test_a_taken_slug_is_refused(self, run: Run, example: Path, root: Path) -> None:
        """A published submission is never replaced."""
        before = _snapshot(root)
        flags = _flags()
        output = run(
            "submit", example / "predictions.csv", "--slug", "example-slots", *flags, exit_code=1
        ).output
        assert "slug-taken: there is a submission example-slots already" in output
        assert _snapshot(root) == before

    @pytest.mark.parametrize("slug", ["../evil", "a/b", "UPPER", ".tmp-x", "x"])
    def test_a_malformed_slug_cannot_leave_the_instance(
        self, run: Run, example: Path, root: Path, slug: str
    ) -> None:
        """Nothing is written anywhere."""
        before = _snapshot(root.parent)
        output = run("submit", example / "predictions.csv", "--slug", slug, *_flags(), exit_code=1).output
        assert "slug-malformed" in output
        assert _snapshot(root.parent) == before

    def test_what_is_missing_without_a_terminal_is_wrong_usage(self, run: Run, example: Path) -> None:
        """All missing options are named at once."""
        flags = _flags(team=None, github=None)
        output = run("submit", example / "predictions.csv", *flags, exit_code=2).output
        assert "missing --team, --github" in output

    def test_parts_that_share_a_trial_are_refused_with_both_places(
        self, run: Run, example: Path, tmp_path: Path
    ) -> None:
        """The message names both files and lines."""
        lines = (example / "predictions.csv").read_text().splitlines(keepends=True)
        first, second = tmp_path / "a.csv", tmp_path / "b.csv"
        first.write_text("".join(lines))
        second.write_text("".join([lines[0], lines[5]]))
        output = run("submit", first, second, *_flags(), exit_code=1).output
        assert f"{second}:2: duplicate-trial:" in output
        assert f"is also in {first}, line 6" in output

    def test_parts_with_other_columns_are_refused(self, run: Run, example: Path, tmp_path: Path) -> None:
        """Files are joined only if their headers agree."""
        lines = (example / "predictions.csv").read_text().splitlines(keepends=True)
        first, second = tmp_path / "a.csv", tmp_path / "b.csv"
        first.write_text("".join(lines[:-1]))
        second.write_text("trial_id,probability,status\n" + lines[-1].rstrip("\n") + ",\n")
        output = run("submit", first, second, *_flags(), exit_code=1).output
        assert f"{second}:1: wrong-header:" in output

    def test_what_is_missing_is_asked_on_a_terminal(self, example: Path, root: Path) -> None:
        """Each question shows what may be answered; the folder is made from the answers."""
        given = _flags(name=None, training=None, github=None)
        arguments = ["--root", root, "submit", example / "predictions.csv", *given]
        controller, terminal = pty.openpty()
        process = subprocess.Popen(
            [sys.executable, "-m", "leaderboard", *map(str, arguments)],
            stdin=terminal,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        os.write(controller, b"Asked Model\nseparate\nsomeone\n")
        output, _ = process.communicate(timeout=60)
        os.close(controller)
        os.close(terminal)
        assert process.returncode == 0, output
        assert "Training (separate, unified, zero_shot)" in output
        toml = tomllib.loads((root / "submissions/asked-model/submission.toml").read_text())
        assert (toml["submission"]["name"], toml["contact"]["github"]) == ("Asked Model", "someone")


class TestRank:
    """``leaderboard rank``."""

    @pytest.mark.usefixtures("example")
    def test_all_forms_show_the_same_row(self, run: Run) -> None:
        """Table, CSV, LaTeX and JSON agree on the accuracy."""
        value = json.loads(run("rank", "--json").stdout)["rows"][0]["result"]["scores"]["overall"]["all"][
            "accuracy"
        ]
        rows = list(csv.DictReader(io.StringIO(run("rank", "--csv").stdout)))
        assert float(rows[1]["accuracy.overall"]) == value["value"]
        shown = f"{100 * value['value']:.1f}"
        assert shown in run("rank").output
        assert f"& {shown} &" in run("rank", "--latex").output

    @pytest.mark.usefixtures("example")
    def test_another_track_may_be_empty(self, run: Run) -> None:
        """An empty board says so."""
        assert "No submission on this track yet." in run("rank", "--track", "unified-with-property").output

    @pytest.mark.usefixtures("example")
    def test_an_unknown_track_or_metric_is_named_with_what_there_is(self, run: Run) -> None:
        """Exit status 1 and a list to choose from."""
        assert "there is no track 'fast'" in run("rank", "--track", "fast", exit_code=1).output
        assert "cannot rank by 'speed'" in run("rank", "--metric", "speed", exit_code=1).output

    def test_an_ungraded_submission_stops_the_board(self, run: Run, example: Path) -> None:
        """The message says how to go on."""
        (example / "result.json").unlink()
        output = run("rank", exit_code=1).output
        assert "grade it first: leaderboard grade submissions/example-slots" in output


class TestVerify:
    """``leaderboard verify``."""

    @pytest.mark.usefixtures("example")
    def test_every_result_is_proven(self, run: Run) -> None:
        """As committed, all is well."""
        output = run("verify").output
        assert "submissions/example-slots: proven" in output
        assert "1 of 1 results proven" in output

    def test_a_changed_prediction_is_found(self, run: Run, example: Path) -> None:
        """The scores that differ are named."""
        lines = (example / "predictions.csv").read_text().splitlines()
        lines[1] = lines[1].rpartition(",")[0] + ",0.999"
        (example / "predictions.csv").write_text("\n".join(lines) + "\n")
        output = run("verify", exit_code=1).output
        assert "submissions/example-slots: NOT proven" in output
        assert "inputs.predictions_sha256 is" in output

    def test_strays_and_missing_results_are_found(self, run: Run, example: Path) -> None:
        """What belongs to no submission is named too; JSON says the same."""
        (example / "result.json").unlink()
        (example.parent / "notes.txt").touch()
        output = run("verify", exit_code=1).output
        assert "has no result.json" in output
        assert "submissions/notes.txt: does not belong here" in output
        data = json.loads(run("verify", "--json", exit_code=1).output)
        assert (data["proven"], data["strays"]) == (False, ["notes.txt"])

    def test_an_invalid_submission_is_found(self, run: Run, example: Path) -> None:
        """What cannot be graded is not proven."""
        _break(example, '",0.', '",x.')
        assert "is not valid: probability" in run("verify", exit_code=1).output

    @pytest.mark.usefixtures("example")
    def test_a_changed_reference_stops_everything(self, run: Run, root: Path) -> None:
        """Nothing is graded with a reference that differs from its seal."""
        with (root / "reference/Mass.csv").open("a") as stream:
            stream.write("\n")
        output = run("verify", exit_code=1).output
        assert "reference: " in output
        assert "0 of 0 results proven" in output


class TestCompare:
    """``leaderboard compare``."""

    def test_table_and_json_agree(self, run: Run, example: Path, repo_root: Path) -> None:
        """Slugs or paths; the difference is that of the accuracies, with its interval and exact p."""
        particles = repo_root / "submissions/example-particles"
        data = json.loads(run("compare", "example-slots", particles, "--json").output)
        overall = data["scopes"][0]
        expected = overall["accuracy_a"] - overall["accuracy_b"]
        assert overall["difference"]["value"] == pytest.approx(expected, abs=2e-6)
        output = run("compare", example, particles).output
        assert f"{100 * overall['difference']['value']:+.1f}" in output
        assert "SYNTHETIC reference" in output
        assert data["trials"][0]["trial_id"] in output

    @pytest.mark.usefixtures("example")
    def test_an_unknown_name_is_answered_with_the_nearest(self, run: Run) -> None:
        """One line and a hint."""
        output = run("compare", "example-slots", "exmple-slots", exit_code=1).output
        assert "there is no submission 'exmple-slots'" in output
        assert "did you mean example-slots?" in output

    def test_an_invalid_submission_is_not_compared(self, run: Run, example: Path) -> None:
        """The message says where to look."""
        _break(example, '",0.', '",x.')
        output = run("compare", "example-slots", example, exit_code=1).output
        assert "see: leaderboard validate submissions/example-slots" in output


class TestReference:
    """``leaderboard reference``."""

    def test_show_says_what_it_holds(self, run: Run) -> None:
        """Counts by property and scenario, as table and as JSON."""
        assert (
            "768 trials, 384 pairs; 6,400 responses to 768 trials by 200 people with 32 trials each"
            in run("reference", "show").output
        )
        data = json.loads(run("reference", "show", "--json").output)
        assert (data["kind"], data["n_trials"], data["n_people"]) == ("synthetic", 768, 200)

    def test_check_finds_and_seal_mends_a_changed_checksum(self, run: Run, root: Path) -> None:
        """A meant change is sealed again; its digest is another."""
        run("reference", "check")
        toml = root / "reference/benchmark.toml"
        toml.write_text(toml.read_text() + "# a comment\n")
        assert "reference-seal" in run("reference", "check", exit_code=1).output
        before = json.loads((root / "reference/manifest.json").read_text())["digest"]
        run("reference", "seal", "--kind", "synthetic")
        run("reference", "check")
        assert json.loads((root / "reference/manifest.json").read_text())["digest"] != before

    def test_synthesize_reproduces_the_embedded_files(self, run: Run, root: Path) -> None:
        """The committed reference is what the generator writes."""
        before = _snapshot(root / "reference")
        assert "wrote and sealed" in run("reference", "synthesize", "--seed", 20231105).output
        assert _snapshot(root / "reference") == before

    def test_check_prints_json(self, run: Run) -> None:
        """The findings for programs, in the shape of validate's, and the datasheet beside them."""
        data = json.loads(run("reference", "check", "--json").output)
        assert (data["valid"], data["sound"], data["accepted"], data["dropped"]) == (True, True, [], {})
        assert data["datasheet"][1]["rows"][0] == {
            "assumption": "Trials of Mass",
            "expected": "192",
            "found": "192",
            "status": "ok",
            "code": "",
        }

    def test_errata_decide_what_check_accepts(self, run: Run, root: Path) -> None:
        """A departure fails the check until errata accept it, and an entry without effect fails it again."""
        list_file, errata = root / "reference/Mass.csv", root / "reference/errata.toml"
        sound = list_file.read_text()
        list_file.write_text(sound.replace(",mass_dominoes_pp,1,", ",mass_dominoes_pp,0,", 1))
        run("reference", "seal", "--kind", "synthetic")
        assert "warning: reference-copies" in run("reference", "check", exit_code=1).output
        errata.write_text('[[accept]]\ncode = "reference-copies"\nreason = "Released like that."\n')
        run("reference", "seal", "--kind", "synthetic")
        output = run("reference", "check").output
        assert "accepted: reference/Mass.csv:3: reference-copies: " in output
        assert output.endswith("the reference is sound\n")
        list_file.write_text(sound)
        run("reference", "seal", "--kind", "synthetic")
        assert "reference-errata-unused" in run("reference", "check", exit_code=1).output


class TestConvert:
    """``leaderboard convert physopt``; the runs themselves are tested on real data."""

    @pytest.mark.parametrize(
        ("flags", "message"),
        [
            ([], "say where to: -o FILE for one run, or --split-runs DIR for all"),
            (["-o", "x.csv", "--split-runs", "runs"], "say where to"),
            (["--split-runs", "runs", "--readout", "A"], "--split-runs writes all runs"),
        ],
    )
    def test_options_that_contradict_are_wrong_usage(
        self, run: Run, example: Path, flags: list[str], message: str
    ) -> None:
        """The message says which to give."""
        assert message in run("convert", "physopt", example / "predictions.csv", *flags, exit_code=2).output

    def test_another_file_is_refused_by_its_header(self, run: Run, example: Path, tmp_path: Path) -> None:
        """Nothing is written."""
        output = tmp_path / "out.csv"
        result = run("convert", "physopt", example / "predictions.csv", "-o", output, exit_code=1)
        assert "error: " in result.output
        assert not output.exists()


def test_baselines_are_written_anew_with_their_date(run: Run, root: Path) -> None:
    """A second run changes nothing; the date of the first stays."""
    run("baselines", "--date", "2026-11-21")
    before = _snapshot(root / "submissions")
    run("baselines")
    assert _snapshot(root / "submissions") == before
    assert len(before) == 12
    assert "4 of 4 results proven" in run("verify").output


def test_committed_baselines_and_examples_are_what_the_generators_write(
    run: Run, root: Path, repo_root: Path
) -> None:
    """Nothing under submissions/ was typed by hand."""
    run("baselines", "--date", "2026-11-21")
    for folder in (root / "submissions").iterdir():
        assert _snapshot(folder) == _snapshot(repo_root / "submissions" / folder.name)


@pytest.mark.usefixtures("example")
def test_site_is_built_twice_with_the_same_bytes(run: Run, root: Path, tmp_path: Path) -> None:
    """Whatever the order of files on disk."""
    run("site", "build")
    first = _snapshot(root / "site/dist")
    run("site", "build", "--out", tmp_path / "elsewhere")
    assert _snapshot(tmp_path / "elsewhere") == first


@pytest.mark.parametrize("hash_seed", ["0", "4242"])
def test_site_does_not_depend_on_hashes_or_the_order_of_files(
    repo_root: Path, tmp_path: Path, hash_seed: str
) -> None:
    """Copied in another order and built in a fresh process, the site has the same bytes."""
    outputs = []
    for order in (1, -1):
        copy = tmp_path / f"copy{order}"
        shutil.copytree(repo_root / "reference", copy / "reference")
        for slug in ("baseline-chance", "example-pixels", "example-slots")[::order]:
            shutil.copytree(repo_root / "submissions" / slug, copy / "submissions" / slug)
        command = [sys.executable, "-m", "leaderboard", "--root", str(copy), "site", "build"]
        seed = hash_seed if order == 1 else "1"
        subprocess.run(command, env=os.environ | {"PYTHONHASHSEED": seed}, check=True, capture_output=True)
        outputs.append(_snapshot(copy / "site/dist"))
    assert outputs[0] == outputs[1]


def test_every_code_is_in_kebab_case() -> None:
    """Codes are folder names and anchors."""
    assert all(code == code.lower().strip("-") and " " not in code and "_" not in code for code in CODES)
