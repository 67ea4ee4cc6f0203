"""Every departure from the definition is a finding, and nothing is a traceback."""

from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

from leaderboard.errors import BrokenReferenceError
from leaderboard.files import canonical_json
from leaderboard.instance import Instance
from leaderboard.problems import Severity
from leaderboard.reference import load_reference
from leaderboard.reference.checking import check_reference
from leaderboard.reference.published import PUBLISHED_HEADER
from reference_folders import ReferenceFolder, pair_name, seal_blindly, trial_name

Change = Callable[[ReferenceFolder], object]
Finding = tuple[str, str, int | None, str]

TRIALS, RATINGS, RESPONSES = "Alpha.csv", "human_trials.csv", "human_responses.csv"
PAIR, NEXT_PAIR, FAR_PAIR = pair_name("alpha_one", 0), pair_name("alpha_one", 1), pair_name("alpha_two", 0)
ERRATA = f"""\
[[accept]]
code = "reference-copies"
reason = "Known."
[[drop]]
trial_id = "{trial_name("alpha_two", 0, 0)}"
reason = "Empty."
""".encode()
FILES = ["benchmark.toml", TRIALS, "Beta.csv", RATINGS, RESPONSES, "manifest.json"]


def findings_of(instance: Instance) -> list[Finding]:
    found = check_reference(instance).problems
    return [(p.code, p.file.removeprefix("reference/"), p.line, p.message) for p in found]


def without_people(folder: ReferenceFolder) -> None:
    folder.raw |= {RATINGS: None, RESPONSES: None}


def drop_trial(folder: ReferenceFolder, trial_id: str) -> None:
    """Take a trial out of its list and out of the human data."""
    for rows in folder.rows.values():
        rows[:] = [row for row in rows if trial_id not in row]


def rename_everywhere(folder: ReferenceFolder, old: str, new: str) -> None:
    for rows in folder.rows.values():
        rows[:] = [[cell.replace(old, new) for cell in row] for row in rows]


def make_one_trial_too_few(folder: ReferenceFolder) -> None:
    drop_trial(folder, trial_name("beta_one", 1, 1))
    drop_trial(folder, trial_name("beta_one", 0, 1))


def make_scenario_without_trials(folder: ReferenceFolder) -> None:
    folder.definition += '\n[[scenarios]]\nid = "beta_two"\ntitle = "Beta two"\nproperty = "Beta"\n'


def make_pair_of_one(folder: ReferenceFolder) -> None:
    folder.rows[TRIALS][1][1] = "alone"


def make_pair_of_four(folder: ReferenceFolder) -> None:
    for row in folder.rows[TRIALS][2:4]:
        row[1] = PAIR


def make_pair_across_scenarios(folder: ReferenceFolder) -> None:
    """Swap the second trials of two pairs with each other."""
    rows = folder.rows[TRIALS]
    rows[1][1], rows[5][1] = rows[5][1], rows[1][1]


def make_equal_labels(folder: ReferenceFolder) -> None:
    folder.rows[TRIALS][0][4] = "1"
    folder.rows[TRIALS][2][4] = "0"


def make_equal_copies(folder: ReferenceFolder) -> None:
    folder.rows[TRIALS][1][3] = "0"


def make_pairs_of_their_own(folder: ReferenceFolder) -> None:
    for row in folder.rows["Beta.csv"]:
        row[1] = row[0]


def make_unbalanced(folder: ReferenceFolder) -> None:
    for row in folder.rows["Beta.csv"]:
        row[1] = row[0]
    folder.rows["Beta.csv"][0][4] = "1"


def make_unrated(folder: ReferenceFolder) -> None:
    for name in (RATINGS, RESPONSES):
        del folder.rows[name][2:4]


def make_unrated_by_zero(folder: ReferenceFolder) -> None:
    del folder.rows[RESPONSES][2:4]
    for row in folder.rows[RATINGS][2:4]:
        row[1:] = ["0", "0"]


def make_telling_names(folder: ReferenceFolder) -> None:
    folder.rows[RESPONSES] = [[row[0].replace("p1", "5f3c9a"), *row[1:]] for row in folder.rows[RESPONSES]]


def make_both_members_seen(folder: ReferenceFolder) -> None:
    folder.rows[RESPONSES][1][0] = "p1"


def make_official(folder: ReferenceFolder) -> None:
    folder.kind = "official"


def make_one_real_id(folder: ReferenceFolder) -> None:
    rename_everywhere(folder, trial_name("alpha_one", 0, 0), "alpha_one-copy0/size=1,2/0000")


IMBALANCE = [
    ("reference-imbalance", TRIALS, None, "5 of 8 trials of Alpha end in YES, not half of them"),
    ("reference-imbalance", TRIALS, None, "3 of 4 trials of alpha_one end in YES, not half of them"),
]


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (
            make_one_trial_too_few,
            [
                ("reference-trial-count", "Beta.csv", None, "Beta has 2 trials, not the 4 expected"),
                ("reference-trial-count", "Beta.csv", None, "beta_one has 2 trials, not the 4 expected"),
            ],
        ),
        (
            make_scenario_without_trials,
            [("reference-trial-count", "Beta.csv", None, "beta_two has 0 trials, not the 1 expected")],
        ),
        (
            make_pair_of_one,
            [
                ("reference-incomplete-pair", TRIALS, 2, f"the pair {PAIR} has 1 trial, not two"),
                ("reference-incomplete-pair", TRIALS, 3, "the pair alone has 1 trial, not two"),
            ],
        ),
        (
            make_pair_of_four,
            [
                ("reference-incomplete-pair", TRIALS, 2, f"the pair {PAIR} has 4 trials, not two"),
                (
                    "reference-both-members",
                    RESPONSES,
                    None,
                    f"2 people saw both trials of a pair, for instance p1 of {PAIR}",
                ),
            ],
        ),
        (
            make_pair_across_scenarios,
            [
                (
                    "reference-split-pair",
                    TRIALS,
                    7,
                    f"the trials of the pair {PAIR} are in different scenarios, alpha_one and alpha_two",
                ),
                (
                    "reference-split-pair",
                    TRIALS,
                    6,
                    f"the trials of the pair {FAR_PAIR} are in different scenarios, alpha_one and alpha_two",
                ),
            ],
        ),
        (
            make_equal_labels,
            [
                (
                    "reference-equal-labels",
                    TRIALS,
                    3,
                    f"both trials of the pair {PAIR} end in YES; they should end differently",
                ),
                (
                    "reference-equal-labels",
                    TRIALS,
                    5,
                    f"both trials of the pair {NEXT_PAIR} end in NO; they should end differently",
                ),
            ],
        ),
        (
            make_equal_copies,
            [
                (
                    "reference-copies",
                    TRIALS,
                    3,
                    f"both trials of the pair {PAIR} are copy 0; they should be copy 0 and copy 1",
                )
            ],
        ),
        (
            make_pairs_of_their_own,
            [
                (
                    "reference-no-pairs",
                    "Beta.csv",
                    None,
                    "Beta has no pairs: each trial has a pair id of its own",
                )
            ],
        ),
        (
            make_unbalanced,
            [
                (
                    "reference-no-pairs",
                    "Beta.csv",
                    None,
                    "Beta has no pairs: each trial has a pair id of its own",
                ),
                (
                    "reference-imbalance",
                    "Beta.csv",
                    None,
                    "3 of 4 trials of beta_one end in YES, not half of them",
                ),
            ],
        ),
        (without_people, [("reference-unrated", RATINGS, None, "there are no human data")]),
        (make_unrated, [("reference-unrated", RATINGS, None, "nobody judged 2 of the 8 trials of Alpha")]),
        (
            make_unrated_by_zero,
            [("reference-unrated", RATINGS, None, "nobody judged 2 of the 8 trials of Alpha")],
        ),
        (
            make_telling_names,
            [
                (
                    "reference-participant-id",
                    RESPONSES,
                    None,
                    "1 of 2 participants are not named p and a number, for instance 5f3c9a",
                )
            ],
        ),
        (
            make_both_members_seen,
            [
                (
                    "reference-both-members",
                    RESPONSES,
                    None,
                    f"1 person saw both trials of a pair, for instance p1 of {PAIR}",
                )
            ],
        ),
        (
            make_official,
            [
                (
                    "reference-kind",
                    "manifest.json",
                    None,
                    "the kind is official, but 12 of 12 trial ids hold the word synthetic",
                )
            ],
        ),
        (
            make_one_real_id,
            [
                (
                    "reference-kind",
                    "manifest.json",
                    None,
                    "the kind is synthetic, but 11 of 12 trial ids hold the word synthetic",
                )
            ],
        ),
    ],
)
def test_each_departure_is_a_finding(tmp_path: Path, change: Change, expected: list[Finding]) -> None:
    """A reference with exactly this departure has exactly these findings, and can be graded all the same."""
    folder = ReferenceFolder()
    change(folder)
    instance = folder.write(tmp_path)
    assert findings_of(instance) == expected
    load_reference(instance)


def test_properties_with_several_scenarios_are_balanced_as_a_whole(tmp_path: Path) -> None:
    """One label more is reported for the property and for its scenario."""
    folder = ReferenceFolder()
    folder.rows[TRIALS][0][4] = "1"
    found = findings_of(folder.write(tmp_path))
    assert [finding for finding in found if finding[0] == "reference-imbalance"] == IMBALANCE


def test_a_sound_reference_has_no_findings(tmp_path: Path) -> None:
    """What is as expected is not mentioned."""
    assert check_reference(ReferenceFolder().write(tmp_path)).problems == ()


def test_the_embedded_reference_is_sound(repo_root: Path) -> None:
    """The committed reference departs in nothing but the number of sets, which the paper gives as 8."""
    problems = check_reference(Instance(repo_root)).problems
    assert {problem.severity for problem in problems} == {Severity.NOTE}
    assert [problem.message for problem in problems] == [
        f"the people of {name} saw 6 different sets of trials, not the 8 expected"
        for name in ("Mass", "Friction", "Elasticity", "Deformability")
    ]


def test_published_numbers_that_cannot_be_read_are_told(tmp_path: Path) -> None:
    """The check looks into the file; grading, which needs nothing of it, goes on."""
    instance = ReferenceFolder(raw={"published.csv": b"source\nA Paper\n"}).write(tmp_path)
    found = [p for p in check_reference(instance).problems if p.code == "reference-published"]
    assert [(p.file, p.line, p.message.partition(";")[0]) for p in found] == [
        (
            "reference/published.csv",
            1,
            f"lacks the columns {', '.join(PUBLISHED_HEADER[1:])}",
        )
    ]


def test_stray_files_are_found_and_hidden_ones_left_alone(tmp_path: Path) -> None:
    """What is no part of a reference is not sealed, so it should not be there."""
    instance = ReferenceFolder().write(tmp_path)
    for name in ("notes.txt", ".DS_Store", "Gamma.csv"):
        instance.reference_file(name).touch()
    assert findings_of(instance) == [
        ("reference-stray-file", name, None, "is no part of a reference, and is not sealed")
        for name in ("Gamma.csv", "notes.txt")
    ]


def test_every_changed_file_is_named(tmp_path: Path) -> None:
    """Each file that differs from its checksum has a finding of its own."""
    instance = ReferenceFolder().write(tmp_path)
    manifest = canonical_json(
        {"kind": "synthetic", "files": dict.fromkeys(FILES[:-1], "0" * 64), "digest": "0" * 64}
    )
    instance.manifest_file.write_text(manifest)
    found = findings_of(instance)
    assert [(code, file) for code, file, _, _ in found] == [
        *(("reference-seal", name) for name in sorted(FILES[:-1])),
        ("reference-manifest", "manifest.json"),
    ]


def test_a_broken_seal_does_not_hide_departures(tmp_path: Path) -> None:
    """Findings about content come beside those about checksums."""
    folder = ReferenceFolder()
    instance = folder.write(tmp_path)
    file = instance.reference_file(TRIALS)
    file.write_text(file.read_text().replace(f'"{PAIR}",alpha_one,1', f'"{PAIR}",alpha_one,0'))
    assert [code for code, _, _, _ in findings_of(instance)] == ["reference-seal", "reference-copies"]


def test_departures_are_found_before_sealing(tmp_path: Path) -> None:
    """A new reference can be checked while it has no manifest; its kind is then nobody's claim."""
    folder = ReferenceFolder()
    folder.rows[TRIALS][1][3] = "0"
    instance = folder.write(tmp_path)
    instance.manifest_file.unlink()
    assert [code for code, _, _, _ in findings_of(instance)] == ["reference-file-missing", "reference-copies"]


def test_errors_are_what_loading_refuses(tmp_path: Path) -> None:
    """A contradiction in human data is an error of its own, and departures are reported beside it."""
    folder = ReferenceFolder()
    folder.rows[RATINGS][0][2] = "1"
    folder.rows[TRIALS][1][3] = "0"
    instance = folder.write(tmp_path)
    assert [code for code, _, _, _ in findings_of(instance)] == ["reference-aggregate", "reference-copies"]
    with pytest.raises(BrokenReferenceError, match="of whom 1 said YES"):
        load_reference(instance)


@given(st.data())
def test_mangled_files_give_findings(data: st.DataObject) -> None:
    """Whatever is cut out of, put into or taken from the files, there are findings and no traceback."""
    with TemporaryDirectory() as name:
        instance = ReferenceFolder(raw={"errata.toml": ERRATA}).write(Path(name))
        files = [*FILES, "errata.toml"]
        for file in data.draw(st.lists(st.sampled_from(files), min_size=1, max_size=3, unique=True)):
            path = instance.reference_file(file)
            content = path.read_bytes()
            mangled = _mangle(content, data)
            if mangled is None:
                path.unlink()
            else:
                path.write_bytes(mangled)
        if data.draw(st.booleans()):
            seal_blindly(instance)
        found = check_reference(instance).problems
        is_loadable = not any(problem.is_error for problem in found)
        if is_loadable:
            load_reference(instance)
        else:
            with pytest.raises(BrokenReferenceError, match=r"^reference/"):
                load_reference(instance)


def _mangle(content: bytes, data: st.DataObject) -> bytes | None:
    """Remove a file, or replace a stretch of it by bytes that mean something in one format or another."""
    if data.draw(st.integers(0, 9)) == 0:
        return None
    start = data.draw(st.integers(0, len(content)))
    end = data.draw(st.integers(start, min(len(content), start + 40)))
    pieces = [
        b"",
        b",",
        b'"',
        b"\n",
        b"\r",
        b"\0",
        b"\xff",
        b"0",
        b"2",
        b"[",
        b"{",
        b"=",
        b"9" * 30,
        b"synthetic",
    ]
    filling = data.draw(st.sampled_from(pieces) | st.binary(max_size=8))
    return content[:start] + filling + content[end:]
