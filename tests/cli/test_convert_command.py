"""``leaderboard convert``: from a tool's log to a submission on the board, and the traps on the way."""

import csv
import json
import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

from leaderboard.converting import FORMATS, READER_VERSION
from leaderboard.instance import Instance
from leaderboard.reference import Reference, load_reference
from model_logs import (
    WITH_ERRORS,
    WITH_REPEATS,
    WRITERS,
    Said,
    write_answers,
    write_csv,
    write_lines,
    write_physmind,
    write_probabilities,
)
from reference_folders import ReferenceFolder, pair_name, trial_name

Run = Callable[..., Result]

SUBMIT = [
    text
    for option in (
        "--name=My Model",
        "--team=My Lab",
        "--date=2026-11-20",
        "--description=A test.",
        "--training=zero_shot",
        "--testing=with_property",
        "--family=vlm",
        "--inputs=rgb",
        "--github=someone",
    )
    for text in option.split("=", 1)
]


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """An instance of twelve trials in three scenarios."""
    ReferenceFolder().write(tmp_path / "instance")
    return tmp_path / "instance"


@pytest.fixture
def reference(root: Path) -> Reference:
    return load_reference(Instance(root))


def say(reference: Reference, *, repeats: int = 1, swap: bool = False) -> list[Said]:
    """Right answers to every trial, as often as asked, or those of the other copy."""
    labels = [bool(label) != swap for label in reference.labels]
    return [
        Said(trial_id, bool(label), ("yes" if answer else "no",) * repeats)
        for trial_id, label, answer in zip(reference.trial_ids, reference.labels, labels, strict=True)
    ]


def read_rows(file: Path) -> dict[str, dict[str, str]]:
    with file.open(encoding="utf-8", newline="") as stream:
        return {row["trial_id"]: row for row in csv.DictReader(stream)}


@pytest.mark.parametrize("name", WRITERS)
def test_every_format_reaches_the_board(
    run: Run, reference: Reference, root: Path, tmp_path: Path, name: str
) -> None:
    """A log goes through convert, submit and grade, and its right answers are found right."""
    file = WRITERS[name](tmp_path, say(reference))
    output = tmp_path / "predictions.csv"
    report = run("convert", name, file, "-o", output).output
    assert "12 rows give 12 predictions, for 3 of the 3 scenarios of Tiny" in report
    assert "trials: 12 of 12 matched, 0 missing, 0 duplicated; rows ambiguous: 0" in report
    submitted = run("submit", output, *SUBMIT)
    assert "wrote submissions/my-model/" in submitted.output
    result = json.loads(run("grade", "--json", "--check", root / "submissions/my-model").stdout)
    assert result["scores"]["overall"]["all"]["accuracy"]["value"] == 1.0


def test_reader_reaches_the_metadata(run: Run, reference: Reference, root: Path, tmp_path: Path) -> None:
    """The report says with which option to submit, and submission.toml then names the reader's version."""
    output = tmp_path / "predictions.csv"
    report = run("convert", "answers", write_answers(tmp_path, say(reference)), "-o", output).output
    option = f"--answer-reader {READER_VERSION}"
    assert f"texts were read by version {READER_VERSION} of the reader: submit with {option}\n" in report
    run("submit", output, *SUBMIT, *option.split())
    toml = (root / "submissions/my-model/submission.toml").read_text("utf-8")
    assert f"\nanswer_reader = {READER_VERSION}\n" in toml
    report = run(
        "convert", "probabilities", write_probabilities(tmp_path, say(reference)), "-o", output
    ).output
    assert "--answer-reader" not in report


@pytest.mark.parametrize("name", WITH_ERRORS)
def test_failed_request_is_an_error_not_a_gap(
    run: Run, reference: Reference, tmp_path: Path, name: str
) -> None:
    """A request that failed gets the status error and no probability; the scenario stays whole."""
    first, *others = say(reference)
    file = WRITERS[name](tmp_path, [Said(first.trial_id, first.label, (None,)), *others])
    output = tmp_path / "predictions.csv"
    report = run("convert", name, file, "-o", output).output
    assert "statuses: answered 11, error 1" in report
    assert read_rows(output)[first.trial_id] == {
        "trial_id": first.trial_id,
        "probability": "",
        "status": "error",
    }
    assert "valid, 12 of 12 trials, 1 of them unanswered" in run("validate", output).output


@pytest.mark.parametrize("name", WITH_REPEATS)
def test_repeats_become_the_share_of_yes(run: Run, reference: Reference, tmp_path: Path, name: str) -> None:
    """Four answers to a trial, one of them NO and one unclear, give 2 of 3, and the report counts them."""
    first, *others = say(reference, repeats=4)
    file = WRITERS[name](tmp_path, [Said(first.trial_id, first.label, ("yes", "no", "Yes.", "hm")), *others])
    output = tmp_path / "predictions.csv"
    report = run("convert", name, file, "-o", output).output
    assert (
        "repeats, of which the mean is written: 12 trials 4 times; 1 of 48 answers say neither YES nor NO"
        in report
    )
    assert read_rows(output)[first.trial_id]["probability"] == "0.6666666667"


@pytest.mark.parametrize("name", [name for name in FORMATS if name != "physopt"])
def test_broken_file_is_refused(run: Run, reference: Reference, tmp_path: Path, name: str) -> None:
    """A log that was cut off gives one line with its name and what is wrong; nothing is written over."""
    file = WRITERS[name](tmp_path, say(reference))
    file.write_bytes(file.read_bytes()[:-30])
    output = tmp_path / "predictions.csv"
    output.write_text("older", encoding="utf-8")
    result = run("convert", name, file, "-o", output, exit_code=1)
    line, *hint = result.stderr.splitlines()
    found = r"is no JSON: .+ at column [0-9]+|malformed CSV: .+|has . cells? .+"
    assert re.fullmatch(rf"error: {re.escape(str(file))}:[0-9]+: ({found})", line)
    assert [part.strip() for part in hint] in ([], ["was the file cut off while it was written?"])
    assert (result.stdout, output.read_text("utf-8")) == ("", "older")


def test_report_ends_with_what_gives_mistakes_away(run: Run, reference: Reference, tmp_path: Path) -> None:
    """Trials, statuses, share of YES, pairs alike and the version of the reader are always told."""
    said = say(reference)
    said[0] = Said(said[0].trial_id, said[0].label, ("Sorry, I can't help with that.",))
    said[2] = Said(said[2].trial_id, said[2].label, ("Yes and no.",))
    said[4] = Said(said[4].trial_id, said[4].label, ("yes",))
    said[5] = Said(said[5].trial_id, said[5].label, ("yes",))
    output = tmp_path / "predictions.csv"
    report = run("convert", "answers", write_answers(tmp_path, said), "-o", output).output
    assert report.replace(str(tmp_path), "TMP") == (
        "my-model: 12 rows give 12 predictions, for 3 of the 3 scenarios of Tiny\n"
        "  before you send it:\n"
        "    trials: 12 of 12 matched, 0 missing, 0 duplicated; rows ambiguous: 0\n"
        "    statuses: answered 10, refused 1, unparsable 1\n"
        "    YES: 6 of 10 (60.0 %) of the answered trials\n"
        "    pairs with the same answer to both members: 1 of 4 (25.0 %)\n"
        "    texts were read by version 1 of the reader: submit with --answer-reader 1\n"
        "\n"
        "wrote TMP/predictions.csv\n"
    )


def test_swapped_copies_are_seen(run: Run, root: Path, tmp_path: Path) -> None:
    """Answers with the two copies in each other's place draw the warning before anything is sent."""
    shutil.rmtree(root)
    folder = ReferenceFolder()
    folder.definition = folder.definition.replace("trials = 8\n", "trials = 40\n")
    folder.definition = folder.definition.replace('property = "Alpha"\ntrials = 4\n', 'property = "Alpha"\n')
    run_reference = grow(folder, 16, root)
    file = write_physmind(tmp_path, say(run_reference, swap=True))
    report = run("convert", "physmind", file, "-o", tmp_path / "predictions.csv").output
    assert (
        "warning: swapped-copies: 22 of 22 pairs get different answers, 22 of them the wrong way round"
        in report
    )
    assert "did the two copies change places, or YES and NO?" in report


def grow(folder: ReferenceFolder, n_more: int, root: Path) -> Reference:
    """Add pairs to the first scenario, so that there are enough to be sure of."""
    for number in range(2, 2 + n_more):
        for copy in (0, 1):
            row = [trial_name("alpha_one", copy, number), pair_name("alpha_one", number), "alpha_one"]
            folder.rows["Alpha.csv"].append([*row, str(copy), str(copy), "90"])
    folder.rows["Alpha.csv"].sort(key=lambda row: row[2])
    return load_reference(folder.write(root))


def test_shifted_index_is_seen_by_the_labels_in_the_log(
    run: Run, reference: Reference, tmp_path: Path
) -> None:
    """Where a map is off by one, the log's true outcomes contradict the labels, trial by trial."""
    said = say(reference)
    records = [
        {"index": str(k), "question": "?", "answer": "yes" if s.label else "no", "prediction": s.texts[0]}
        for k, s in enumerate(said)
    ]
    file = write_csv(tmp_path / "model_Physics.csv", records)
    shifted = [s.trial_id for s in (*said[1:], said[0])]
    id_map = write_csv(tmp_path / "map.csv", [{"log_id": k, "trial_id": t} for k, t in enumerate(shifted)])
    output = tmp_path / "predictions.csv"
    report = run("convert", "vlmevalkit", file, "--id-map", id_map, "-o", output).output
    assert "trials that end differently in the log than by their label: 6 of 12" in report


def test_lost_copies_are_not_guessed(run: Run, reference: Reference, tmp_path: Path) -> None:
    """Names without the copy fit two trials each: the report says so, and there is nothing to write."""
    records = [
        {"id": s.trial_id.replace("-copy0", "").replace("-copy1", ""), "answer": s.texts[0]}
        for s in say(reference)
    ]
    file = write_lines(tmp_path / "log.jsonl", records)
    result = run("convert", "answers", file, "-o", tmp_path / "predictions.csv", exit_code=1)
    assert "rows whose name fits several trials: 12\n" in result.output
    assert "rows ambiguous: 12" in result.output
    assert "nothing to write, because no scenario of Tiny is covered whole" in result.output


def test_account_can_be_had_as_json(run: Run, reference: Reference, tmp_path: Path) -> None:
    """For programs: every count of the report, the version of the reader, and the warnings."""
    file = write_answers(tmp_path, say(reference)[:4])
    output = tmp_path / "predictions.csv"
    account = json.loads(run("convert", "answers", file, "-o", output, "--json").stdout)
    assert account["files"] == [str(output)]
    (found,) = account["runs"]
    assert found.pop("validation")["warnings"][0]["code"] == "equal-to-labels"
    assert found == {
        "run": "my-model",
        "answer_reader": 1,
        "rows": 4,
        "predictions": 4,
        "scenarios": ["alpha_one"],
        "left_out": {"alpha_two": [0, 4], "beta_one": [0, 4]},
        "rows_unmatched": 0,
        "rows_ambiguous": 0,
        "rows_misplaced": 0,
        "trials": 12,
        "trials_matched": 4,
        "trials_missing": 8,
        "trials_duplicated": 0,
        "trials_contradicted": 0,
        "labels_contradicted": 0,
        "statuses": {"answered": 4},
        "yes": 2,
        "ties": 0,
        "pairs": 2,
        "pairs_alike": 0,
        "repeats": {"1": 4},
        "answers": 4,
        "answers_unread": 0,
    }


def test_logits_need_their_option(run: Run, reference: Reference, tmp_path: Path) -> None:
    """A logit is no probability; with --logit it becomes one."""
    rows = [{"id": s.trial_id, "logit": -2 if s.texts[0] == "no" else 2} for s in say(reference)]
    file = write_csv(tmp_path / "logits.csv", rows)
    output = tmp_path / "predictions.csv"
    arguments = ["convert", "probabilities", file, "--probability-field", "logit", "-o", output]
    assert "logits.csv:2: logit is '" in run(*arguments, exit_code=1).output
    run(*arguments, "--logit")
    assert {row["probability"] for row in read_rows(output).values()} == {
        "0.8807970779778823",
        "0.11920292202211755",
    }


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        ([], "say where to: -o FILE for one run, or --split-runs DIR for all"),
        (["-o", "x.csv", "--split-runs", "runs"], "say where to"),
        (["--split-runs", "runs", "--run", "a"], "--split-runs writes all runs"),
    ],
)
def test_options_that_contradict_are_wrong_usage(
    run: Run, reference: Reference, tmp_path: Path, flags: list[str], message: str
) -> None:
    """The message says which to give."""
    file = write_probabilities(tmp_path, say(reference))
    assert message in run("convert", "probabilities", file, *flags, exit_code=2).output


def test_the_log_itself_is_never_written_over(run: Run, reference: Reference, tmp_path: Path) -> None:
    """By whatever name the log is given for the output, it stays as it is."""
    file = write_probabilities(tmp_path, say(reference))
    before = file.read_bytes()
    other = tmp_path / "link.csv"
    other.symlink_to(file)
    for output in (file, other):
        refused = run("convert", "probabilities", file, "-o", output, exit_code=2)
        assert f"-o {output} would write over the log itself: name another file" in refused.output
    runs = tmp_path / "runs"
    (runs / "predictions").mkdir(parents=True)
    earlier = file.rename(runs / "predictions" / "predictions.csv")
    refused = run("convert", "probabilities", earlier, "--split-runs", runs, exit_code=2)
    assert f"{earlier} is the log itself: name another folder with --split-runs" in refused.output
    file = earlier
    assert file.read_bytes() == before


def test_run_is_chosen_among_several(run: Run, reference: Reference, tmp_path: Path) -> None:
    """A log of two models makes two runs: one is written by name, or each to a folder of its own."""
    said = say(reference)
    files = [write_lines(tmp_path / model / "s.jsonl", []) for model in ("a", "b")]
    for file in files:
        file.unlink()
        written = WRITERS["lmms-eval"](file.parent, said)
        written.rename(file)
    output = tmp_path / "predictions.csv"
    refused = run("convert", "lmms-eval", *files, "-o", output, exit_code=1).output
    assert "2 runs are there where one is needed: a, b" in refused
    assert (
        "there is no run c; there are a, b"
        in run("convert", "lmms-eval", *files, "-o", output, "--run", "c", exit_code=1).output
    )
    run("convert", "lmms-eval", *files, "-o", output, "--run", "b")
    run("convert", "lmms-eval", *files, "--split-runs", tmp_path / "runs")
    assert (tmp_path / "runs/a/predictions.csv").read_bytes() == output.read_bytes()
