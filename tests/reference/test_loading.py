"""Which references can be graded against, and what is said of those that cannot."""

import os
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from leaderboard.errors import BrokenReferenceError
from leaderboard.instance import Instance
from leaderboard.problems import Problem
from leaderboard.reference import Reference, load_reference
from leaderboard.reference.definition import SEAL_HINT
from leaderboard.reference.sealing import seal_reference
from leaderboard.reference.tables import read_tables
from reference_folders import CONFIG, DEFINITION, ReferenceFolder, pair_name, trial_name

Change = Callable[[ReferenceFolder], object]


def load(root: Path, **changes: object) -> Reference:
    folder = ReferenceFolder()
    for name, value in changes.items():
        setattr(folder, name, value)
    return load_reference(folder.write(root))


def problems_of(root: Path, change: Change) -> list[Problem]:
    """All problems of the tables of a sound reference after one change."""
    folder = ReferenceFolder()
    change(folder)
    _, problems = read_tables(folder.write(root))
    return list(problems)


def set_cell(file: str, row: int, column: int, text: str) -> Change:
    def change(folder: ReferenceFolder) -> None:
        folder.rows[file][row][column] = text

    return change


def set_content(file: str, content: bytes) -> Change:
    return lambda folder: folder.raw.update({file: content})


def replace_definition(old: str, new: str) -> Change:
    def change(folder: ReferenceFolder) -> None:
        assert folder.definition.count(old) >= 1
        folder.definition = folder.definition.replace(old, new, 1)

    return change


# What a sound reference becomes.


def test_trials_keep_the_order_of_their_files(tmp_path: Path) -> None:
    """Arrays follow the properties as defined, and the rows of each file."""
    reference = load(tmp_path)
    scenarios = ["alpha_one", "alpha_two", "beta_one"]
    assert reference.trial_ids == tuple(
        trial_name(scenario, copy, number) for scenario in scenarios for number in (0, 1) for copy in (0, 1)
    )
    assert reference.pair_ids == tuple(
        pair_name(scenario, number) for scenario in scenarios for number in (0, 1)
    )
    assert reference.properties.tolist() == [0] * 8 + [1] * 4
    assert reference.scenarios.tolist() == [0] * 4 + [1] * 4 + [2] * 4
    assert reference.pairs.tolist() == [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5]
    assert reference.copies.tolist() == [0, 1] * 6
    assert reference.labels.tolist() == [0, 1, 1, 0] * 3
    assert reference.is_synthetic
    assert reference.benchmark.name == "tiny"


def test_people_line_up_with_trials(tmp_path: Path) -> None:
    """Counts stand at their trial; single responses go by participant, then by trial."""
    folder = ReferenceFolder()
    folder.rows["human_trials.csv"].reverse()
    folder.rows["human_responses.csv"].reverse()
    people = load_reference(folder.write(tmp_path)).people
    assert people is not None
    assert people.responses is not None
    assert people.n.tolist() == [1] * 12
    assert people.n_yes.tolist() == [0, 0, 1, 1] * 3
    assert people.responses.participant_ids == ("p1", "p2")
    assert people.responses.participants.tolist() == [0] * 6 + [1] * 6
    assert people.responses.trials.tolist() == [0, 2, 4, 6, 8, 10, 1, 3, 5, 7, 9, 11]
    assert people.responses.answers.tolist() == [0, 1] * 6


def test_a_reference_may_lack_single_responses(tmp_path: Path) -> None:
    """Counts alone are human data."""
    people = load(tmp_path, raw={"human_responses.csv": None}).people
    assert people is not None
    assert people.responses is None
    assert people.n.sum() == 12


def test_a_reference_may_lack_human_data(tmp_path: Path) -> None:
    """Without both files there are no people."""
    assert load(tmp_path, raw={"human_responses.csv": None, "human_trials.csv": None}).people is None


def test_trials_without_a_row_have_no_ratings(tmp_path: Path) -> None:
    """A trial that human_trials.csv leaves out was judged by nobody."""
    folder = ReferenceFolder(raw={"human_responses.csv": None})
    del folder.rows["human_trials.csv"][3]
    people = load_reference(folder.write(tmp_path)).people
    assert people is not None
    assert np.flatnonzero(people.n == 0).tolist() == [3]


@pytest.mark.parametrize(
    "spell",
    [lambda text: text.replace(b"\n", b"\r\n"), lambda text: b"\xef\xbb\xbf" + text],
    ids=["CRLF", "byte-order mark"],
)
def test_other_line_ends_and_a_mark_change_nothing(tmp_path: Path, spell: Callable[[bytes], bytes]) -> None:
    """CRLF and one UTF-8 byte-order mark are accepted."""
    plain = ReferenceFolder().write(tmp_path / "plain")
    files = ["Alpha.csv", "Beta.csv", "human_trials.csv", "human_responses.csv"]
    raw: dict[str, bytes | None] = {name: spell(plain.reference_file(name).read_bytes()) for name in files}
    found = load(tmp_path / "other", raw=raw)
    expected = load_reference(plain)
    assert found.trial_ids == expected.trial_ids
    assert found.labels.tolist() == expected.labels.tolist()
    assert found.manifest.digest != expected.manifest.digest


def test_start_frames_may_be_empty(tmp_path: Path) -> None:
    """Nothing is graded by them."""
    assert problems_of(tmp_path, set_cell("Alpha.csv", 0, 5, "")) == []


# What makes tables unusable: one change each, and the one problem that it makes.

ID_RULE = "an id has 1 to 200 printable ASCII characters without blanks and quotes"
FIRST, SECOND = trial_name("alpha_one", 0, 0), trial_name("alpha_one", 1, 0)
TRIALS, RATINGS, RESPONSES = "Alpha.csv", "human_trials.csv", "human_responses.csv"


@pytest.mark.parametrize(
    ("change", "code", "place", "message"),
    [
        (
            set_cell(TRIALS, 1, 0, "two words"),
            "reference-value",
            (TRIALS, 3),
            f"trial_id is 'two words'; {ID_RULE}",
        ),
        (set_cell(TRIALS, 1, 1, ""), "reference-value", (TRIALS, 3), f"pair_id is ''; {ID_RULE}"),
        (set_cell(TRIALS, 0, 3, "2"), "reference-value", (TRIALS, 2), "copy is '2'; it must be 0 or 1"),
        (
            set_cell(TRIALS, 0, 4, "True"),
            "reference-value",
            (TRIALS, 2),
            "label is 'True'; it must be 0 or 1",
        ),
        (
            set_cell(TRIALS, 7, 5, "1.5"),
            "reference-value",
            (TRIALS, 9),
            "start_frame is '1.5'; it must be a whole number or empty",
        ),
        (
            set_cell(TRIALS, 0, 2, "alpha_onne"),
            "reference-scenario",
            (TRIALS, 2),
            "scenario is 'alpha_onne'; benchmark.toml defines no such scenario, the nearest is alpha_one",
        ),
        (
            set_cell(TRIALS, 0, 2, "beta_one"),
            "reference-scenario",
            (TRIALS, 2),
            "scenario is 'beta_one'; that belongs to Beta, and this file is Alpha's",
        ),
        (
            set_cell(TRIALS, 1, 0, FIRST),
            "reference-duplicate",
            (TRIALS, 3),
            f"the trial '{FIRST}' is listed already in reference/Alpha.csv:2",
        ),
        (
            set_cell("Beta.csv", 0, 0, FIRST),
            "reference-duplicate",
            ("Beta.csv", 2),
            f"the trial '{FIRST}' is listed already in reference/Alpha.csv:2",
        ),
        (
            set_content(TRIALS, b"trial,label\nx,1\n"),
            "reference-header",
            (TRIALS, 1),
            "the header is 'trial,label'; it must be trial_id,pair_id,scenario,copy,label,start_frame",
        ),
        (
            set_content(TRIALS, b"trial_id,pair_id,scenario,copy,label,start_frame\n"),
            "reference-malformed",
            (TRIALS, None),
            "has a header but no rows",
        ),
        (
            set_content(TRIALS, b"trial_id,pair_id,scenario,copy,label,start_frame\na,a,alpha_one,0,1\n"),
            "reference-malformed",
            (TRIALS, 2),
            "the line has 5 cells, not 6",
        ),
        (
            set_content(RATINGS, b"trial_id,n,n_yes\na\n"),
            "reference-malformed",
            (RATINGS, 2),
            "the line has 1 cell, not 3",
        ),
        (
            set_content(RATINGS, b"trial_id,n,n_yes\n\na,1,1\n"),
            "reference-malformed",
            (RATINGS, 2),
            "the line is blank",
        ),
        (
            set_content(RATINGS, b'trial_id,n,n_yes\n"a\nb",1,1\n'),
            "reference-malformed",
            (RATINGS, 2),
            "a cell runs over several lines",
        ),
        (
            set_content(RATINGS, b'trial_id,n,n_yes\n"a,1,1\n'),
            "reference-malformed",
            (RATINGS, 2),
            "malformed CSV: unexpected end of data",
        ),
        (
            set_content(RATINGS, b"trial_id,n,n_yes\na,1\r,1\n"),
            "reference-malformed",
            (RATINGS, 2),
            "holds a carriage return inside a line",
        ),
        (
            set_content(RATINGS, b"trial_id,n,n_yes\na,1,\0\n"),
            "reference-malformed",
            (RATINGS, 2),
            "holds a NUL character",
        ),
        (
            set_content(RATINGS, b"trial_id,n,n_yes\n\xff,1,1\n"),
            "reference-unreadable",
            (RATINGS, 2),
            "is not UTF-8 text (byte 0xff)",
        ),
        (
            set_cell(RATINGS, 0, 0, FIRST + "x"),
            "reference-unknown-trial",
            (RATINGS, 2),
            f"no trial list has '{FIRST}x'; the nearest is {FIRST}",
        ),
        (
            set_cell(RESPONSES, 0, 1, "zzz"),
            "reference-unknown-trial",
            (RESPONSES, 2),
            "no trial list has 'zzz'",
        ),
        (
            set_cell(RATINGS, 1, 0, FIRST),
            "reference-duplicate",
            (RATINGS, 3),
            f"the trial '{FIRST}' is on line 2 already",
        ),
        (
            set_cell(RATINGS, 0, 1, "-1"),
            "reference-value",
            (RATINGS, 2),
            "n is '-1'; it must be a whole number",
        ),
        (
            set_cell(RATINGS, 0, 2, ""),
            "reference-value",
            (RATINGS, 2),
            "n_yes is ''; it must be a whole number",
        ),
        (
            set_cell(RATINGS, 0, 1, "1" * 10),
            "reference-value",
            (RATINGS, 2),
            "n is '1111111111'; it must be a whole number",
        ),
        (
            set_cell(RESPONSES, 0, 2, "YES"),
            "reference-value",
            (RESPONSES, 2),
            "response is 'YES'; it must be 0 or 1",
        ),
        (
            set_cell(RESPONSES, 0, 0, "p 1"),
            "reference-value",
            (RESPONSES, 2),
            f"participant_id is 'p 1'; {ID_RULE}",
        ),
        (
            set_cell(RATINGS, 0, 2, "1"),
            "reference-aggregate",
            (RATINGS, 2),
            f"{FIRST} has 1 people, of whom 1 said YES; human_responses.csv has 1, of whom 0 said YES",
        ),
        (
            lambda folder: folder.rows[RATINGS].pop(0),
            "reference-aggregate",
            (RATINGS, None),
            f"{FIRST} has 0 people, of whom 0 said YES; human_responses.csv has 1, of whom 0 said YES",
        ),
        (
            replace_definition("trials = 8", "trials = eight"),
            "reference-definition",
            ("benchmark.toml", 15),
            "is not TOML: Invalid value (at line 15, column 10)",
        ),
        (
            replace_definition("trials = 8", 'trials = "8"'),
            "reference-definition",
            ("benchmark.toml", None),
            "properties[1].trials: Input should be a valid integer",
        ),
        (
            replace_definition("trials = 8", "trails = 8\ntrials = 8"),
            "reference-definition",
            ("benchmark.toml", None),
            "properties[1].trails: is not a known key",
        ),
        (
            replace_definition('title = "Tiny"\n', ""),
            "reference-definition",
            ("benchmark.toml", None),
            "title: is missing",
        ),
        (
            replace_definition('property = "Beta"', 'property = "Gamma"'),
            "reference-definition",
            ("benchmark.toml", None),
            "scenario beta_one names the unknown property 'Gamma'",
        ),
        (
            replace_definition('file = "Alpha.csv"', 'file = "published.csv"'),
            "reference-definition",
            ("benchmark.toml", None),
            "a property cannot have the file published.csv, which holds something else",
        ),
    ],
)
def test_each_fault_is_one_problem(
    tmp_path: Path, change: Change, code: str, place: tuple[str, int | None], message: str
) -> None:
    """Code, file, line and message say what is wrong, and nothing else is reported."""
    found = [(p.code, p.file, p.line, p.message) for p in problems_of(tmp_path, change)]
    assert found == [(code, f"reference/{place[0]}", place[1], message)]


def test_more_yes_than_people(tmp_path: Path) -> None:
    """A count of YES above the count of people is refused, with or without single responses."""

    def change(folder: ReferenceFolder) -> None:
        folder.raw[RESPONSES] = None
        folder.rows[RATINGS][0][2] = "2"

    (problem,) = problems_of(tmp_path, change)
    assert (problem.code, problem.line, problem.message) == (
        "reference-yes-count",
        2,
        "2 of 1 people said YES",
    )


def test_a_person_judges_a_trial_once(tmp_path: Path) -> None:
    """A second response names the line of the first."""

    def change(folder: ReferenceFolder) -> None:
        folder.rows[RESPONSES].append(["p1", FIRST, "1"])
        folder.rows[RATINGS][0][1:] = ["2", "1"]

    (problem,) = problems_of(tmp_path, change)
    assert (problem.code, problem.line) == ("reference-repeated-response", 14)
    assert problem.message == f"p1 judged {FIRST} on line 2 already"


def test_all_faults_are_found_at_once(tmp_path: Path) -> None:
    """Problems of several cells and files come together."""

    def change(folder: ReferenceFolder) -> None:
        folder.rows[TRIALS][0][4] = "yes"
        folder.rows[TRIALS][5][3] = "?"
        folder.raw["Beta.csv"] = b"\xff"
        folder.raw[RATINGS] = b"x\n"

    found = [(p.code, p.file.removeprefix("reference/"), p.line) for p in problems_of(tmp_path, change)]
    assert sorted(found) == [
        ("reference-header", RATINGS, 1),
        ("reference-unreadable", "Beta.csv", 1),
        ("reference-value", TRIALS, 2),
        ("reference-value", TRIALS, 7),
    ]


def test_many_unknown_trials_take_no_time_for_suggestions(tmp_path: Path) -> None:
    """Only the first three unknown names get a suggestion."""

    def change(folder: ReferenceFolder) -> None:
        for row in folder.rows[RATINGS]:
            row[0] += "x"

    messages = [problem.message for problem in problems_of(tmp_path, change)]
    assert [("nearest" in message) for message in messages] == [True] * 3 + [False] * 9


# What loading says.


def test_a_broken_reference_is_refused_with_the_first_problem_and_a_count(tmp_path: Path) -> None:
    """One line names file, line and fault; the hint says how to see the rest."""
    folder = ReferenceFolder()
    folder.rows[TRIALS][0][4] = "x"
    folder.rows[TRIALS][1][4] = "y"
    folder.rows[TRIALS][2][4] = "z"
    with pytest.raises(BrokenReferenceError) as caught:
        load_reference(folder.write(tmp_path))
    assert caught.value.message == (
        "reference/Alpha.csv:2: label is 'x'; it must be 0 or 1 (and 2 more problems)"
    )
    assert caught.value.hint == "all problems: leaderboard reference check"


@pytest.mark.parametrize("name", ["Alpha.csv", "benchmark.toml"])
def test_a_missing_file_is_named(tmp_path: Path, name: str) -> None:
    """Trial lists and the definition must be there."""
    instance = ReferenceFolder().write(tmp_path)
    instance.reference_file(name).unlink()
    with pytest.raises(BrokenReferenceError, match=f"^reference/{re.escape(name)}: is not there") as caught:
        load_reference(instance)
    assert caught.value.hint.startswith("restore it from version control")


def test_single_responses_need_counts(tmp_path: Path) -> None:
    """human_trials.csv is always there when there are human data."""
    with pytest.raises(BrokenReferenceError, match=r"^reference/human_trials\.csv: is not there$"):
        load(tmp_path, raw={RATINGS: None})


def test_a_missing_manifest_asks_for_the_seal(tmp_path: Path) -> None:
    """Nothing is graded against files that nobody sealed."""
    instance = ReferenceFolder().write(tmp_path)
    instance.manifest_file.unlink()
    with pytest.raises(BrokenReferenceError, match=r"^reference/manifest\.json: is not there$") as caught:
        load_reference(instance)
    assert "leaderboard reference seal --kind official|synthetic" in caught.value.hint


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"{", "is not JSON: Expecting property name"),
        (b"[" * 100_000, "is not JSON: "),
        (b'{"kind": "official", "kind": "synthetic"}', "is not JSON: a key appears twice"),
        (b"\xff", "is not JSON: "),
        (b"[]", "Input should be "),
        (b'{"kind": "real", "files": {}, "digest": ""}', "kind: Input should be 'official' or 'synthetic'"),
    ],
)
def test_a_manifest_that_is_none(tmp_path: Path, content: bytes, message: str) -> None:
    """Whatever is in manifest.json, loading says what is wrong with it."""
    instance = ReferenceFolder().write(tmp_path)
    instance.manifest_file.write_bytes(content)
    with pytest.raises(BrokenReferenceError, match=f"^reference/manifest.json: {message}"):
        load_reference(instance)


@pytest.mark.parametrize("name", ["benchmark.toml", "Alpha.csv", "human_trials.csv", "human_responses.csv"])
def test_a_changed_file_is_refused(tmp_path: Path, name: str) -> None:
    """One byte more in any file breaks the seal, even where it changes nothing else."""
    instance = ReferenceFolder().write(tmp_path)
    file = instance.reference_file(name)
    extra = b"# a comment\n" if name == "benchmark.toml" else b""
    file.write_bytes((file.read_bytes() + extra) if extra else b"\xef\xbb\xbf" + file.read_bytes())
    expected = f"^reference/{re.escape(name)}: differs from manifest.json: its checksum is another$"
    with pytest.raises(BrokenReferenceError, match=expected) as caught:
        load_reference(instance)
    assert caught.value.hint == f"{SEAL_HINT}; all problems: leaderboard reference check"


def test_a_file_that_is_not_in_the_manifest_is_refused(tmp_path: Path) -> None:
    """Published numbers that were added later must be sealed too."""
    instance = ReferenceFolder().write(tmp_path)
    instance.reference_file("published.csv").write_text("source\n")
    with pytest.raises(BrokenReferenceError, match=r"published\.csv: is not listed in manifest\.json"):
        load_reference(instance)
    seal_reference(instance, "synthetic")
    assert "published.csv" in load_reference(instance).manifest.files


def test_a_sealed_file_that_is_gone_is_refused(tmp_path: Path) -> None:
    """Optional files are not optional once they are sealed."""
    instance = ReferenceFolder().write(tmp_path)
    instance.reference_file(RESPONSES).unlink()
    with pytest.raises(BrokenReferenceError, match=r"is listed in manifest\.json, but is not there"):
        load_reference(instance)


def test_a_digest_that_is_not_of_the_files_is_refused(tmp_path: Path) -> None:
    """The digest stands for the checksums beside it."""
    instance = ReferenceFolder().write(tmp_path)
    digest = load_reference(instance).manifest.digest
    manifest = instance.manifest_file.read_text()
    instance.manifest_file.write_text(manifest.replace(digest, "0" * 64))
    with pytest.raises(BrokenReferenceError, match="its digest is not that of the checksums that it lists"):
        load_reference(instance)


def test_links_and_folders_are_no_files(tmp_path: Path) -> None:
    """A reference holds its files itself."""
    instance = ReferenceFolder().write(tmp_path / "instance")
    file = instance.reference_file("Alpha.csv")
    file.rename(tmp_path / "elsewhere.csv")
    file.symlink_to(tmp_path / "elsewhere.csv")
    with pytest.raises(
        BrokenReferenceError, match="is a symbolic link; the reference must hold the file itself"
    ):
        load_reference(instance)
    file.unlink()
    file.mkdir()
    with pytest.raises(BrokenReferenceError, match="is a folder, not a file"):
        load_reference(instance)
    file.rmdir()
    os.mkfifo(file)
    with pytest.raises(BrokenReferenceError, match="cannot be read: not a regular file"):
        load_reference(instance)


def test_there_may_be_no_reference_at_all(tmp_path: Path) -> None:
    """A folder without reference/ is told what is missing."""
    with pytest.raises(BrokenReferenceError, match=r"^reference/benchmark\.toml: is not there"):
        load_reference(Instance(tmp_path))


def test_configs_keep_their_commas(tmp_path: Path) -> None:
    """Ids with commas are quoted in the files and whole in memory."""
    assert "," in CONFIG
    assert all(CONFIG in trial_id for trial_id in load(tmp_path, definition=DEFINITION).trial_ids)


def test_the_embedded_reference_loads(repo_root: Path) -> None:
    """The committed reference is sound."""
    reference = load_reference(Instance(repo_root))
    assert (reference.n_trials, len(reference.pair_ids)) == (768, 384)
    assert reference.is_synthetic
