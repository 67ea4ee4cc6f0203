"""Official files become the reference as a whole, or nothing changes and the report says why."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from leaderboard.errors import BrokenReferenceError, InstanceError
from leaderboard.files import csv_text
from leaderboard.instance import Instance
from leaderboard.models import Source
from leaderboard.problems import Problems
from leaderboard.reference import load_reference
from leaderboard.reference.importing import ImportReport, import_reference
from leaderboard.reference.recipes import Draft, ImportedProperty, ImportOptions, Recipe
from leaderboard.reference.source_files import SourceFile
from reference_folders import DEFINITION, HEADERS, ReferenceFolder, Rows, trial_name

SOURCE = Source(what="everything", url="https://example.com/all.zip", sha256="0" * 64)
PROPERTY = ImportedProperty("Alpha", 8, 8, 0.5)


def draft_copy(
    files: Sequence[SourceFile], definition: bytes, options: ImportOptions, problems: Problems
) -> Draft | None:
    """Take the files for the reference's own; an empty one is an error."""
    del options
    for file in files:
        if not file.content:
            problems.add("import-no-trials", "is empty", file.origin)
    contents = {file.name: file.content for file in files}
    return Draft({"benchmark.toml": definition, **contents}, (PROPERTY,), (SOURCE,))


RECIPE = Recipe(
    name="tiny",
    title="Tiny",
    render_definition=DEFINITION.encode,
    is_wanted=lambda name: name.endswith(".csv"),
    list_remotes=lambda _: (),
    draft=draft_copy,
)


def official_files(rows: dict[str, Rows] | None = None) -> list[SourceFile]:
    tables = ReferenceFolder().rows if rows is None else rows
    return [
        SourceFile(name, f"official/{name}", csv_text(HEADERS[name], content).encode())
        for name, content in tables.items()
    ]


def run(instance: Instance, files: Sequence[SourceFile], *, accept_change: bool = False) -> ImportReport:
    return import_reference(RECIPE, files, instance, accept_change=accept_change)


def snapshot(folder: Path) -> dict[str, bytes]:
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def other_rows() -> dict[str, Rows]:
    """Another label, another answer, one trial less and one more."""
    rows = ReferenceFolder().rows
    rows["Beta.csv"][0][4] = "1"
    rows["human_trials.csv"][1][2] = "0" if rows["human_trials.csv"][1][2] == "1" else "1"
    rows["human_responses.csv"][1][2] = rows["human_trials.csv"][1][2]
    gone = rows["Alpha.csv"].pop()[0]
    rows["human_trials.csv"] = [row for row in rows["human_trials.csv"] if row[0] != gone]
    rows["human_responses.csv"] = [row for row in rows["human_responses.csv"] if row[1] != gone]
    rows["Beta.csv"].append([trial_name("beta_one", 0, 9), "lone", "beta_one", "0", "1", ""])
    return rows


def test_a_new_instance_gets_the_recipes_definition(tmp_path: Path) -> None:
    """Where nothing is there, everything is made, sealed as official with its sources."""
    instance = Instance(tmp_path / "new")
    report = run(instance, official_files())
    reference = load_reference(instance)
    assert report.manifest == reference.manifest
    assert reference.manifest.kind == "official"
    assert reference.manifest.sources == (SOURCE,)
    assert instance.benchmark_file.read_text() == DEFINITION
    assert not report.is_refused


def test_a_simulated_reference_is_replaced(tmp_path: Path) -> None:
    """Its definition and published numbers stay, its trials and people go."""
    definition = DEFINITION.replace('title = "Tiny"', 'title = "My Tiny"')
    folder = ReferenceFolder(definition=definition, raw={"human_responses.csv": None})
    instance = folder.write(tmp_path)
    instance.reference_file("published.csv").write_bytes(b"kept as it is\n")
    report = run(instance, official_files())
    assert report.difference is None
    assert load_reference(instance).benchmark.title == "My Tiny"
    assert instance.reference_file("published.csv").read_bytes() == b"kept as it is\n"
    assert instance.reference_file("human_responses.csv").exists()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["reference"]


def test_the_same_reference_is_left_alone(tmp_path: Path) -> None:
    """Importing what is there already writes nothing and is no failure."""
    instance = Instance(tmp_path / "new")
    run(instance, official_files())
    before = snapshot(tmp_path)
    report = run(instance, official_files())
    assert (report.manifest, bool(report.difference), report.is_refused) == (None, False, False)
    assert snapshot(tmp_path) == before


def test_a_changed_official_reference_is_refused_with_the_difference(tmp_path: Path) -> None:
    """Each kind of change is told by trial; nothing is written."""
    instance = Instance(tmp_path / "new")
    run(instance, official_files())
    before = snapshot(tmp_path)
    report = run(instance, official_files(other_rows()))
    assert report.is_refused
    assert snapshot(tmp_path) == before
    assert report.difference is not None
    assert report.difference.added == (trial_name("beta_one", 0, 9),)
    assert report.difference.removed == (trial_name("alpha_two", 1, 1),)
    assert report.difference.relabelled == (trial_name("beta_one", 0, 0),)
    assert report.difference.rated_otherwise == (trial_name("alpha_one", 1, 0),)
    names = ("Alpha.csv", "Beta.csv", "human_responses.csv", "human_trials.csv")
    assert report.difference.files == names


def test_an_accepted_change_replaces_the_official_reference(tmp_path: Path) -> None:
    """What is accepted is written, and the difference is still told."""
    instance = Instance(tmp_path / "new")
    first = run(instance, official_files()).manifest
    report = run(instance, official_files(other_rows()), accept_change=True)
    assert report.manifest == load_reference(instance).manifest != first
    assert report.difference
    assert not report.is_refused


def test_departures_of_the_new_reference_are_told(tmp_path: Path) -> None:
    """What `reference check` would find afterwards is in the report, so nothing has to be looked for."""
    report = run(Instance(tmp_path / "new"), official_files(other_rows()))
    codes = {problem.code for problem in report.problems}
    assert {"reference-trial-count", "reference-incomplete-pair", "reference-equal-labels"} <= codes
    assert report.manifest is not None


def test_errors_write_nothing(tmp_path: Path) -> None:
    """If a file cannot be understood, nothing is made, and the report holds the problem alone."""
    files = [*official_files(), SourceFile("more.csv", "official/more.csv", b"")]
    report = run(Instance(tmp_path / "new"), files)
    assert report.is_refused
    assert [(p.code, p.file) for p in report.problems] == [("import-no-trials", "official/more.csv")]
    assert list(tmp_path.iterdir()) == []


def test_trials_that_cannot_be_graded_get_errata(tmp_path: Path) -> None:
    """They stay in the lists and leave the reference, beside what a maintainer had dropped already."""
    own, contested = trial_name("alpha_one", 0, 0), trial_name("beta_one", 0, 0)
    instance = ReferenceFolder().write(tmp_path)
    errata = f'[[drop]]\ntrial_id = "{own}"\nreason = "Mine."\n'
    instance.reference_file("errata.toml").write_text(errata)

    def draft(
        files: Sequence[SourceFile], definition: bytes, options: ImportOptions, problems: Problems
    ) -> Draft | None:
        found = draft_copy(files, definition, options, problems)
        assert found is not None
        return replace(found, dropped={contested: "Both.", own: "Theirs."})

    import_reference(replace(RECIPE, draft=draft), official_files(), instance)
    assert load_reference(instance).dropped == {own: "Mine.", contested: "Both."}
    written = instance.reference_file("errata.toml").read_text()
    assert written == f'{errata}\n[[drop]]\ntrial_id = "{contested}"\nreason = "Both."\n'


def test_unusable_drafts_write_nothing(tmp_path: Path) -> None:
    """A recipe that makes files which no grader could read is stopped before anything is written."""
    rows = ReferenceFolder().rows
    rows["Alpha.csv"][0][4] = "2"
    with pytest.raises(BrokenReferenceError, match="label is '2'; it must be 0 or 1"):
        run(Instance(tmp_path / "new"), official_files(rows))
    assert list(tmp_path.iterdir()) == []


def test_another_benchmarks_instance_is_refused(tmp_path: Path) -> None:
    """A recipe does not overwrite the reference of something else."""
    definition = DEFINITION.replace('name = "tiny"', 'name = "other"', 1)
    instance = ReferenceFolder(definition=definition).write(tmp_path)
    with pytest.raises(InstanceError, match="is of Tiny, not of Tiny") as caught:
        run(instance, official_files())
    assert caught.value.hint == "name a new folder with --root DIR"


def test_a_broken_official_reference_is_replaced_only_if_any_change_is_accepted(tmp_path: Path) -> None:
    """Nobody knows what a broken one was, so replacing it is a change."""
    instance = Instance(tmp_path / "new")
    run(instance, official_files())
    instance.reference_file("Alpha.csv").write_bytes(b"broken")
    with pytest.raises(BrokenReferenceError):
        run(instance, official_files())
    assert run(instance, official_files(), accept_change=True).manifest == load_reference(instance).manifest
