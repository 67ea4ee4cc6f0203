"""Official files in every dialect and with every trap give the right reference, or are told to be odd."""

import csv
import io
from collections.abc import Collection
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from leaderboard.errors import LeaderboardError
from leaderboard.instance import Instance
from leaderboard.reference import Reference, load_reference
from leaderboard.reference.importing import ImportReport, import_reference
from leaderboard.reference.recipes import RECIPES, ImportOptions
from leaderboard.reference.source_files import SourceFile, read_source_files
from release_stand_in import (
    LIST_TRAPS,
    WINDOWS_ROOT,
    Columns,
    Layout,
    ListNames,
    Release,
    Trap,
    answer_sheets,
    traps_for,
)

RECIPE = RECIPES["physionpp"]
SMALL = Release(pairs_per_scenario=4)


def files_of(release: Release) -> list[SourceFile]:
    members = {**release.test_members, **release.human_members}
    return [SourceFile(name, name, members[name]) for name in sorted(members) if is_read(name)]


def is_read(name: str) -> bool:
    return RECIPE.is_wanted(name) and "__MACOSX" not in name


def run(release: Release, folder: Path, *, allow_unmatched: bool = False) -> ImportReport:
    options = ImportOptions(allow_unmatched=allow_unmatched)
    return import_reference(RECIPE, files_of(release), Instance(folder / "new"), options=options)


def labels_of(reference: Reference) -> dict[str, bool]:
    return dict(zip(reference.trial_ids, (reference.labels == 1).tolist(), strict=True))


def counts_of(reference: Reference) -> dict[str, tuple[int, int]]:
    assert reference.people is not None
    counts = zip(reference.people.n.tolist(), reference.people.n_yes.tolist(), strict=True)
    return {trial_id: count for trial_id, count in zip(reference.trial_ids, counts, strict=True) if count[0]}


def sheets_of(reference: Reference) -> list[tuple[tuple[str, bool], ...]]:
    assert reference.people is not None
    assert reference.people.responses is not None
    found = reference.people.responses
    return answer_sheets(
        [
            (found.participant_ids[person], reference.trial_ids[trial], bool(answer))
            for person, trial, answer in zip(found.participants, found.trials, found.answers, strict=True)
        ]
    )


def codes_of(report: ImportReport) -> set[str]:
    """What was found, apart from labels that are out of balance because of something else."""
    return {problem.code for problem in report.problems} - {"reference-imbalance"}


def test_the_full_release_gives_the_benchmark(tmp_path: Path) -> None:
    """768 trials, 96 pairs for each property, 50 people each: labels, frames and answers are the truth's."""
    release = Release()
    report = run(release, tmp_path)
    assert report.manifest is not None
    reference = load_reference(Instance(tmp_path / "new"))
    assert labels_of(reference) == release.truth.labels
    assert counts_of(reference) == release.truth.counts
    assert sheets_of(reference) == answer_sheets(release.truth.responses)
    assert [(p.name, p.n_trials, p.n_rated) for p in report.properties] == [
        (name, 192, 192) for name in ("Mass", "Friction", "Elasticity", "Deformability")
    ]
    lists = [read_rows(Instance(tmp_path / "new").reference_file(f"{p.name}.csv")) for p in report.properties]
    frames = {row["trial_id"]: int(row["start_frame"]) for rows in lists for row in rows}
    assert frames == release.truth.start_frames


def read_rows(file: Path) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(file.read_text(encoding="utf-8"))))


def test_the_definition_is_this_repositorys(repo_root: Path) -> None:
    """A new instance is defined as the one in this repository, so both cannot drift apart."""
    assert RECIPE.render_definition() == (repo_root / "reference" / "benchmark.toml").read_bytes()


@pytest.mark.parametrize("names", ListNames)
@pytest.mark.parametrize("columns", Columns)
def test_every_dialect_of_lists_gives_the_same_reference(
    names: ListNames, columns: Columns, tmp_path: Path
) -> None:
    """Names of files, families of columns, an index column and Windows paths change nothing."""
    plain = run(SMALL, tmp_path / "plain").manifest
    release = replace(SMALL, list_names=names, columns=columns, has_index=True, root=WINDOWS_ROOT)
    manifest = run(release, tmp_path / "other").manifest
    assert plain is not None
    assert manifest is not None
    assert manifest.digest == plain.digest


@pytest.mark.parametrize("layout", Layout)
@pytest.mark.parametrize("is_one_file", [False, True])
def test_every_layout_of_people_gives_their_counts(layout: Layout, is_one_file: bool, tmp_path: Path) -> None:
    """Rows for answers, for people, for trials, or counts alone: as much as is known is kept."""
    release = replace(SMALL, layout=layout, is_one_people_file=is_one_file)
    run(release, tmp_path)
    reference = load_reference(Instance(tmp_path / "new"))
    assert counts_of(reference) == release.truth.counts
    if layout is Layout.AGGREGATED:
        assert reference.people is not None
        assert reference.people.responses is None
    else:
        assert sheets_of(reference) == answer_sheets(release.truth.responses)


# What each trap is reported as; None where the reference simply comes out right.
FINDINGS: dict[Trap, str | None] = {
    Trap.FILENAMES_WITHOUT_COPY: None,
    Trap.FILENAMES_OF_PAIRS: None,
    Trap.COPY_FOLDER_MP4: None,
    Trap.CONFIG_COMMAS: None,
    Trap.SAME_LABEL_PAIRS: "reference-equal-labels",
    Trap.REPEATED_ROW: "import-listed-twice",
    Trap.CONTRADICTORY_ROW: "import-label-conflict",
    Trap.CRLF: None,
    Trap.BYTE_ORDER_MARK: None,
    Trap.SPLIT_LIST: None,
    Trap.READOUT_LIST: "import-other-split",
    Trap.BLANK_LINES: None,
    Trap.LOWER_CASE_LABELS: None,
    Trap.NUMERIC_LABELS: None,
    Trap.MISSING_TRIAL: "reference-incomplete-pair",
    Trap.UNKNOWN_SCENARIO: "import-unknown-scenario",
}


def test_every_trap_of_lists_has_its_finding() -> None:
    """A new trap of the stand-in must be looked at here."""
    assert set(FINDINGS) == set(LIST_TRAPS)


@pytest.mark.parametrize("trap", LIST_TRAPS, ids=lambda trap: trap.name)
def test_each_trap_of_lists_is_right_or_named(trap: Trap, tmp_path: Path) -> None:
    """No trap puts a wrong label into the reference; what cannot be right is a finding."""
    release = replace(SMALL, traps=[trap])
    report = run(release, tmp_path)
    finding = FINDINGS[trap]
    assert codes_of(report) - codes_of(run(SMALL, tmp_path / "plain")) == ({finding} if finding else set())
    if trap is Trap.UNKNOWN_SCENARIO:
        assert report.manifest is None
        return
    expected = dict(release.truth.labels)
    dropped = release.truth.touched[trap] if trap is Trap.CONTRADICTORY_ROW else ()
    for trial_id in dropped:
        del expected[trial_id]
    assert labels_of(load_reference(Instance(tmp_path / "new"))) == expected


def test_all_traps_of_lists_together_are_right_or_named(tmp_path: Path) -> None:
    """Whatever is odd at once, no label is wrong and every finding is there."""
    traps = [trap for trap in LIST_TRAPS if trap is not Trap.UNKNOWN_SCENARIO]
    release = replace(SMALL, traps=traps)
    report = run(release, tmp_path)
    assert {code for trap in traps if (code := FINDINGS[trap])} <= codes_of(report)
    found = labels_of(load_reference(Instance(tmp_path / "new")))
    assert found.items() <= release.truth.labels.items()
    assert release.truth.labels.keys() - found.keys() == {*release.truth.touched[Trap.CONTRADICTORY_ROW]}


# Without the response or the copy nobody can tell what was answered; each of these is tested alone.
TELLING_NOTHING = {Trap.UNKNOWN_SCENARIO, Trap.NAMES_WITHOUT_COPY, Trap.RESPONSELESS, Trap.LABELLESS}


def test_all_traps_of_lists_and_people_together_give_the_true_counts(tmp_path: Path) -> None:
    """Whatever else is odd at once, every trial that is left has the label and the answers that it had."""
    traps = [trap for trap in traps_for(Layout.LONG) if trap not in TELLING_NOTHING]
    release = replace(SMALL, traps=traps)
    report = run(release, tmp_path, allow_unmatched=True)
    assert report.manifest is not None
    reference = load_reference(Instance(tmp_path / "new"))
    left = set(reference.trial_ids)
    assert labels_of(reference).items() <= release.truth.labels.items()
    assert counts_of(reference) == {t: count for t, count in release.truth.counts.items() if t in left}


def test_names_without_their_copy_are_refused(tmp_path: Path) -> None:
    """If people's files do not say which member of a pair was seen, nothing is guessed or written."""
    report = run(replace(SMALL, traps=[Trap.NAMES_WITHOUT_COPY]), tmp_path)
    assert report.is_refused
    assert "import-match-rate" in codes_of(report)
    assert list(tmp_path.iterdir()) == []


@settings(max_examples=1000, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_mutated_files_give_a_reference_or_findings(tmp_path: Path, data: st.DataObject) -> None:
    """A byte changed, cut or added anywhere ends in a report or a clear refusal, never in a traceback."""
    files = files_of(SMALL)
    index = data.draw(st.integers(0, len(files) - 1))
    content = bytearray(files[index].content)
    start = data.draw(st.integers(0, len(content)))
    stop = data.draw(st.integers(start, min(start + 40, len(content))))
    content[start:stop] = data.draw(st.binary(max_size=8))
    files[index] = replace(files[index], content=bytes(content))
    folder = tmp_path / str(len(list(tmp_path.iterdir())))
    try:
        report = import_reference(RECIPE, files, Instance(folder))
    except LeaderboardError:
        return  # refused as a whole
    assert report.manifest is not None or any(problem.is_error for problem in report.problems)


def test_folders_and_zips_give_the_same_reference(tmp_path: Path) -> None:
    """Unpacked or not, together or apart: the same digest."""
    release = replace(SMALL, traps=[Trap.READOUT_LIST])
    (tmp_path / "new").mkdir()
    ways: dict[str, Collection[Path]] = {
        "folder": [release.write_folder(tmp_path / "unpacked")],
        "zips": release.write_zips(tmp_path / "zips"),
        "folder of zips": [tmp_path / "zips"],
    }
    digests = set()
    for name, paths in ways.items():
        files = read_source_files(list(paths), RECIPE.is_wanted)
        manifest = import_reference(RECIPE, files, Instance(tmp_path / "new" / name)).manifest
        assert manifest is not None
        digests.add(manifest.digest)
    assert len(digests) == 1
