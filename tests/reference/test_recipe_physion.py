"""The predecessor's official files become an instance, and every oddity in them is told."""

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from leaderboard.errors import SourceError
from leaderboard.files import sha256_hex
from leaderboard.instance import Instance
from leaderboard.models import Protocol
from leaderboard.problems import Problem, Severity
from leaderboard.reference import Reference, load_reference
from leaderboard.reference.importing import ImportReport, import_reference
from leaderboard.reference.recipes import RECIPES
from leaderboard.reference.recipes.physion_definition import OFFICIAL_SOURCES, PROPERTIES
from leaderboard.reference.source_files import read_source_files

HUMAN_ACCURACY = {
    "Drape": 0.679394,
    "Collide": 0.806526,
    "Contain": 0.762980,
    "Dominoes": 0.689377,
    "Drop": 0.744348,
    "Link": 0.644329,
    "Roll": 0.868129,
    "Support": 0.763333,
}
FILES = {p.scenario: p.human_file for p in PROPERTIES}


@dataclass
class Official:
    """A small copy of the official folder: two trials per scenario, of which ten people judged each."""

    folder: Path

    @property
    def stimuli(self) -> Path:
        return self.folder / "stimulus_names_and_labels.csv"

    def humans(self, scenario: str) -> Path:
        return self.folder / "humans" / FILES[scenario]

    def replace(self, file: Path, old: str, new: str) -> None:
        text = file.read_text(encoding="utf-8")
        assert old in text
        file.write_text(text.replace(old, new), encoding="utf-8")


@pytest.fixture
def official(tmp_path: Path) -> Official:
    copy = Official(tmp_path / "official")
    (copy.folder / "humans").mkdir(parents=True)
    lines = ["stim_ID,scenario,stim_url,correct,label"]
    for scenario in reversed(FILES):
        lines += [
            f"{scenario}_0002,{scenario},https://example.com/{scenario}_0002_img.mp4,0.3,False",
            f"{scenario}_0001,{scenario},https://example.com/{scenario}_0001_img.mp4,0.9,True",
        ]
        people = ["stim_ID,correct,c", f"{scenario}_0001,0.9,10", f"{scenario}_0002,0.3,10"]
        copy.humans(scenario).write_text("\n".join(people) + "\n", encoding="utf-8")
    copy.stimuli.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return copy


@pytest.fixture
def instance(tmp_path: Path) -> Instance:
    return Instance(tmp_path / "physion")


def import_physion(folder: Path, instance: Instance) -> ImportReport:
    recipe = RECIPES["physion"]
    return import_reference(recipe, read_source_files([folder], recipe.is_wanted), instance)


def oddities(report: ImportReport) -> list[Problem]:
    """What was found in the files, apart from the small copy not being the official ones."""
    found = [problem for problem in report.problems if problem.code.startswith("import-")]
    return [problem for problem in found if problem.code != "import-version"]


def read_people(instance: Instance) -> dict[str, tuple[int, int]]:
    with (instance.reference_dir / "human_trials.csv").open(encoding="utf-8", newline="") as stream:
        return {row["trial_id"]: (int(row["n"]), int(row["n_yes"])) for row in csv.DictReader(stream)}


def snapshot(folder: Path) -> dict[str, bytes]:
    files = [path for path in folder.rglob("*") if path.is_file()]
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def test_regular_files_give_an_instance(official: Official, instance: Instance) -> None:
    """Trials are sorted, each its own pair; YES counts follow the label; nothing is odd."""
    report = import_physion(official.folder, instance)
    assert oddities(report) == []
    assert (instance.reference_dir / "Drape.csv").read_text(encoding="utf-8") == (
        "trial_id,pair_id,scenario,copy,label,start_frame\n"
        "drape_0001,drape_0001,drape,0,1,\n"
        "drape_0002,drape_0002,drape,0,0,\n"
    )
    people = read_people(instance)
    assert people["roll_0001"] == (10, 9)
    assert people["roll_0002"] == (10, 7)
    assert [(p.n_trials, p.n_rated, p.human_accuracy) for p in report.properties] == [(2, 2, 0.6)] * 8


def test_instance_is_complete(official: Official, instance: Instance) -> None:
    """Reference, submissions and site are there, and nothing else is left beside them."""
    import_physion(official.folder, instance)
    assert sorted(path.name for path in instance.root.iterdir()) == ["reference", "site", "submissions"]
    assert sorted(path.name for path in instance.root.parent.iterdir()) == ["official", "physion"]
    names = {"benchmark.toml", "manifest.json", "human_trials.csv", *(p.file for p in PROPERTIES)}
    assert {path.name for path in instance.reference_dir.iterdir()} == names
    assert list(instance.submission_dirs()) == []


def test_definition_takes_every_protocol(official: Official, instance: Instance) -> None:
    """Whatever a submission's way of training and testing, it belongs to exactly one track."""
    import_physion(official.folder, instance)
    benchmark = load_reference(instance).benchmark
    tracks = {"unified": "all-scenarios", "separate": "same-scenario", "zero_shot": "zero-shot"}
    for training, track_id in tracks.items():
        for testing in ("with_property", "without_property", "fully_observed"):
            protocol = Protocol.model_validate({"training": training, "testing": testing})
            assert [t.id for t in benchmark.tracks if t.accepts(protocol)] == [track_id]
    assert benchmark.default_track.id == "all-scenarios"


def test_definition_names_eight_properties(official: Official, instance: Instance) -> None:
    """Each property has one scenario of its name in lower case and knows the names of the official files."""
    import_physion(official.folder, instance)
    benchmark = load_reference(instance).benchmark
    assert [p.name for p in benchmark.properties] == (
        ["Dominoes", "Support", "Collide", "Contain", "Drop", "Link", "Roll", "Drape"]
    )
    assert [(s.id, s.property) for s in benchmark.scenarios] == (
        [(p.name.lower(), p.name) for p in benchmark.properties]
    )
    assert {p.trials for p in benchmark.properties} == {s.trials for s in benchmark.scenarios} == {150}
    assert {alias: p.name for p in benchmark.properties for alias in p.aliases} == {
        "clothiness": "Drape",
        "cloth": "Drape",
        "collision": "Collide",
        "containment": "Contain",
        "linking": "Link",
        "rollingsliding": "Roll",
        "rollslide": "Roll",
        "towers": "Support",
    }
    assert (benchmark.grading.easy, benchmark.grading.hard, benchmark.grading.resamples) == (
        "2/3",
        "1/3",
        10000,
    )


def test_manifest_says_where_it_came_from(official: Official, instance: Instance) -> None:
    """The seal is official and holds the checksum of each file that was read, not of those expected."""
    report = import_physion(official.folder, instance)
    assert report.manifest is not None
    assert report.manifest == load_reference(instance).manifest
    assert report.manifest.kind == "official"
    read = [official.stimuli, *(official.humans(p.scenario) for p in PROPERTIES)]
    assert [source.sha256 for source in report.manifest.sources] == [sha256_hex(f.read_bytes()) for f in read]
    assert [source.url for source in report.manifest.sources] == [source.url for source in OFFICIAL_SOURCES]


def test_other_versions_are_told(official: Official, instance: Instance) -> None:
    """Each file that is not the one known by its checksum is named with a link to that one."""
    found = [p for p in import_physion(official.folder, instance).problems if p.code == "import-version"]
    assert [problem.file for problem in found] == [
        str(official.stimuli),
        *(str(official.humans(p.scenario)) for p in PROPERTIES),
    ]
    assert found[0].message == (
        f"is another version than the one known: sha256 {sha256_hex(official.stimuli.read_bytes())}, "
        f"not {OFFICIAL_SOURCES[0].sha256}"
    )
    assert found[0].hint == f"compare with {OFFICIAL_SOURCES[0].url}"


def test_order_of_rows_does_not_matter(official: Official, tmp_path: Path) -> None:
    """The same rows in another order, with other line ends, give the same digest."""
    first = import_physion(official.folder, Instance(tmp_path / "first"))
    for file in [official.stimuli, *(official.humans(scenario) for scenario in FILES)]:
        header, *rows = file.read_text(encoding="utf-8").splitlines()
        file.write_bytes("\r\n".join([header, *reversed(rows)]).encode())
    second = import_physion(official.folder, Instance(tmp_path / "second"))
    assert first.manifest is not None
    assert second.manifest is not None
    assert first.manifest.digest == second.manifest.digest


def test_decorated_names_are_resolved(official: Official, instance: Instance) -> None:
    """A human file may decorate its names; the counts reach the same trials."""
    official.replace(official.humans("roll"), "roll_0001", "roll-redyellow_0001_img")
    assert oddities(import_physion(official.folder, instance)) == []
    assert read_people(instance)["roll_0001"] == (10, 9)


def test_scenarios_may_have_any_of_their_names(official: Official, instance: Instance) -> None:
    """The table of stimuli may call a scenario as the human files and logs do."""
    official.replace(official.stimuli, ",drape,", ",clothiness,")
    official.replace(official.stimuli, ",support,", ",towers,")
    assert oddities(import_physion(official.folder, instance)) == []


def problem_about_roll(
    official: Official, code: str, message: str, line: int | None, hint: str = ""
) -> Problem:
    return Problem(code, message, str(official.humans("roll")), line, hint)


UNRATED = "1 of 2 trials of Roll have no usable row; they stay all the same"


def test_unknown_name_is_told_and_left_out(official: Official, instance: Instance) -> None:
    """A name that fits no trial is reported with the most similar trial, which stays without people."""
    official.replace(official.humans("roll"), "roll_0001", "roll_00x1")
    assert oddities(import_physion(official.folder, instance)) == [
        problem_about_roll(
            official,
            "import-unmatched",
            "'roll_00x1' fits no trial",
            2,
            "the most similar trial is roll_0001",
        ),
        problem_about_roll(official, "import-unrated", UNRATED, None),
    ]
    assert "roll_0001" not in read_people(instance)
    assert "roll_0001" in (instance.reference_dir / "Roll.csv").read_text(encoding="utf-8")


def test_ambiguous_name_is_told_and_left_out(official: Official, instance: Instance) -> None:
    """A name that fits two trials is reported with both, and neither gets the people."""
    official.replace(official.stimuli, "roll_0002,roll", "roll-redyellow_0001,roll")
    official.replace(official.humans("roll"), "roll_0001", "roll_0001_img")
    official.replace(official.humans("roll"), "roll_0002", "roll-redyellow_0001")
    assert oddities(import_physion(official.folder, instance)) == [
        problem_about_roll(
            official,
            "import-ambiguous",
            "'roll_0001_img' fits several trials: roll-redyellow_0001, roll_0001",
            2,
        ),
        problem_about_roll(official, "import-unrated", UNRATED, None),
    ]
    assert {"roll_0001", "roll-redyellow_0001"} & read_people(instance).keys() == {"roll-redyellow_0001"}


def test_trial_in_foreign_file_is_told_and_left_out(official: Official, instance: Instance) -> None:
    """A trial that the human file of another scenario judges is reported and not counted."""
    official.replace(official.humans("roll"), "roll_0001", "drop_0001")
    assert oddities(import_physion(official.folder, instance)) == [
        problem_about_roll(
            official, "import-scenario", "drop_0001 is in the human file of roll but is a trial of drop", 2
        ),
        problem_about_roll(official, "import-unrated", UNRATED, None),
    ]
    assert read_people(instance)["drop_0001"] == (10, 9)


def test_repeated_trial_is_told_and_left_out(official: Official, instance: Instance) -> None:
    """Of two rows for the same trial, however named, neither is used."""
    official.replace(official.humans("roll"), "roll_0002", "roll_0001_img")
    found = oddities(import_physion(official.folder, instance))
    assert found[0] == problem_about_roll(
        official, "import-repeated", "roll_0001 is judged in line 2 already; neither row is used", 3
    )
    assert not {"roll_0001", "roll_0002"} & read_people(instance).keys()


def test_fraction_of_a_person_is_told_and_left_out(official: Official, instance: Instance) -> None:
    """A share that is no whole number of people is reported, not rounded."""
    official.replace(official.humans("roll"), "roll_0001,0.9,10", "roll_0001,0.9,11")
    assert oddities(import_physion(official.folder, instance))[0] == problem_about_roll(
        official, "import-count", "0.9 of 11 people is 9.9000, not a whole number of people", 2
    )
    assert "roll_0001" not in read_people(instance)


def test_printed_shares_give_exact_counts(official: Official, instance: Instance) -> None:
    """A share printed with 16 digits is the whole number that it came from."""
    official.replace(official.humans("roll"), "roll_0001,0.9,10", "roll_0001,0.7708333333333334,96")
    import_physion(official.folder, instance)
    assert read_people(instance)["roll_0001"] == (96, 74)


def test_other_accuracy_in_the_table_is_told(official: Official, instance: Instance) -> None:
    """Where the two official files disagree on people, the difference is reported and the counts stand."""
    official.replace(official.humans("roll"), "0.9", "0.6")
    assert oddities(import_physion(official.folder, instance)) == [
        problem_about_roll(
            official,
            "import-accuracy",
            "stimulus_names_and_labels.csv gives another human accuracy for 1 of these 2 trials (mean 0.600 "
            "instead of 0.450, at most 0.300 apart); this file's is used, because only it says how many "
            "people it is of",
            None,
        )
    ]
    assert read_people(instance)["roll_0001"] == (10, 6)


def test_people_may_be_missing_altogether(official: Official, instance: Instance) -> None:
    """If no human file matches, the reference has no human data, and all of it is reported."""
    for scenario in FILES:
        official.replace(official.humans(scenario), f"{scenario}_", "other_")
    report = import_physion(official.folder, instance)
    assert [p.code for p in oddities(report)].count("import-unmatched") == 16
    assert load_reference(instance).people is None
    assert {p.human_accuracy for p in report.properties} == {None}


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("drop_0001,drop", "drop 0001,drop", ":9: stim_ID 'drop 0001' cannot be a trial id: "),
        ("drop_0002,drop,", "drop_0002,flip,", ":8: scenario 'flip' is none of dominoes, support, towers, "),
        ("drop_0002,drop,", "drop_0001,drop,", ":9: repeats the trial drop_0001 of line 8"),
        ("0.3,False\ndrop_0001", "0.3,No\ndrop_0001", ":8: label 'No' is neither True nor False"),
        ("0.3,False\ndrop_0001", "30%,False\ndrop_0001", ":8: correct '30%' is no number from 0 to 1"),
        ("0.3,False\ndrop_0001", "nan,False\ndrop_0001", ":8: correct 'nan' is no number from 0 to 1"),
        ("0.3,False\ndrop_0001", "1.3,False\ndrop_0001", ":8: correct '1.3' is no number from 0 to 1"),
        ("0.3,False\ndrop_0001", "0.3\ndrop_0001", ":8: has 4 cells where the header has 5"),
        (",drop,", ",link,", ": holds no trial of Drop"),
        ("stim_ID", "stimulus", ":1: lacks the column stim_ID; found stimulus, scenario, "),
    ],
)
def test_malformed_table_is_refused(
    official: Official, instance: Instance, old: str, new: str, message: str
) -> None:
    """A table of stimuli that cannot be trusted is refused with file and line, and nothing is made."""
    official.replace(official.stimuli, old, new)
    with pytest.raises(SourceError) as caught:
        import_physion(official.folder, instance)
    assert caught.value.message.startswith(f"{official.stimuli}{message}")
    assert not instance.root.exists()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("0.9,10", "0.9,0", ":2: c '0' is no number of people"),
        ("0.9,10", "0.9,ten", ":2: c 'ten' is no number of people"),
        ("0.9,10", "0.9,-1", ":2: c '-1' is no number of people"),
        ("0.9,10", "0.9,10.0", ":2: c '10.0' is no number of people"),
        ("0.9,10", ",10", ":2: correct '' is no number from 0 to 1"),
        ("0.9,10", "9e-1,10", ":2: correct '9e-1' is no number from 0 to 1 in plain decimal notation"),
        ("0.9,10", '0.9,"10', ":3: malformed CSV: unexpected end of data"),
        ("correct", "response", ":1: lacks the column correct; found stim_ID, response, c"),
    ],
)
def test_malformed_human_file_is_refused(
    official: Official, instance: Instance, old: str, new: str, message: str
) -> None:
    """A human file that is not what it should be is refused with file and line, and nothing is made."""
    official.replace(official.humans("link"), old, new)
    with pytest.raises(SourceError) as caught:
        import_physion(official.folder, instance)
    assert caught.value.message.startswith(f"{official.humans('link')}{message}")
    assert not instance.root.exists()


def test_missing_file_is_named(official: Official, instance: Instance) -> None:
    """Without one of the nine files nothing is made."""
    official.humans("drape").unlink()
    with pytest.raises(SourceError, match=r"clothiness_pilot-production_2_testing\.csv is not among"):
        import_physion(official.folder, instance)
    assert not instance.root.exists()


def test_a_file_that_is_there_twice_must_be_the_same(official: Official, instance: Instance) -> None:
    """Of two different files of one name nobody knows which counts."""
    other = official.folder / "older"
    other.mkdir()
    (other / official.stimuli.name).write_text("stim_ID\n", encoding="utf-8")
    with pytest.raises(SourceError, match=r"differ"):
        import_physion(official.folder, instance)
    assert not instance.root.exists()


def test_a_second_import_changes_nothing(official: Official, instance: Instance) -> None:
    """What is there already is left as it is."""
    import_physion(official.folder, instance)
    before = snapshot(instance.root)
    assert not import_physion(official.folder, instance).is_refused
    assert snapshot(instance.root) == before


def test_existing_folder_keeps_what_it_has(official: Official, instance: Instance) -> None:
    """An instance may be made in a folder that holds other things, such as a repository."""
    instance.submissions_dir.mkdir(parents=True)
    (instance.submissions_dir / "notes.txt").write_text("mine", encoding="utf-8")
    (instance.root / "README.md").write_text("mine", encoding="utf-8")
    import_physion(official.folder, instance)
    assert load_reference(instance).n_trials == 16
    assert (instance.submissions_dir / "notes.txt").read_text(encoding="utf-8") == "mine"
    names = sorted(path.name for path in instance.root.iterdir())
    assert names == ["README.md", "reference", "site", "submissions"]


@pytest.fixture(scope="module")
def real_source(shared_dir: Path) -> Path:
    return shared_dir / "data" / "physion-v1"


@pytest.fixture(scope="module")
def real(real_source: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[ImportReport, Reference]:
    instance = Instance(tmp_path_factory.mktemp("real") / "physion")
    return import_physion(real_source, instance), load_reference(instance)


@pytest.mark.shared
def test_real_files_are_the_known_ones(real: tuple[ImportReport, Reference]) -> None:
    """The real files have the known checksums, every name matches, and only known facts are reported."""
    report, _ = real
    codes = [problem.code for problem in oddities(report)]
    assert len(codes) == sum(problem.code.startswith("import-") for problem in report.problems)
    assert {code: codes.count(code) for code in codes} == {"import-accuracy": 8, "import-unrated": 1}
    assert {problem.severity for problem in report.problems} == {Severity.NOTE}
    unrated = next(problem for problem in report.problems if problem.code == "import-unrated")
    assert unrated.message == "56 of 150 trials of Roll have no usable row; they stay all the same"


@pytest.mark.shared
def test_real_trials_are_all_there(real: tuple[ImportReport, Reference]) -> None:
    """There are 150 trials of each property, half of them YES, and 1,144 of the 1,200 were judged."""
    report, reference = real
    assert [p.n_trials for p in report.properties] == [150] * 8
    assert [p.n_rated for p in report.properties] == [150] * 6 + [94, 150]
    assert reference.n_trials == len(reference.pair_ids) == 1200
    assert reference.pair_ids == reference.trial_ids
    assert [int(reference.labels[reference.in_property(p.name)].sum()) for p in report.properties] == [75] * 8
    assert reference.people is not None
    assert int((reference.people.n > 0).sum()) == 1144


@pytest.mark.shared
def test_real_human_accuracy(real: tuple[ImportReport, Reference]) -> None:
    """Human accuracy from the loaded counts is that of the official files, in report and reference."""
    report, reference = real
    assert {p.name: round(p.human_accuracy or 0, 6) for p in report.properties} == HUMAN_ACCURACY
    people = reference.people
    assert people is not None
    n_right = np.where(reference.labels == 1, people.n_yes, people.n - people.n_yes)
    for name, accuracy in HUMAN_ACCURACY.items():
        rated = reference.in_property(name) & (people.n > 0)
        assert (n_right[rated] / people.n[rated]).mean() == pytest.approx(accuracy, abs=5e-7)


@pytest.mark.shared
def test_real_counts_are_those_of_each_row(real_source: Path, real: tuple[ImportReport, Reference]) -> None:
    """Each of the 1,144 rows, read naively, gives the counts that the reference holds."""
    _, reference = real
    people = reference.people
    assert people is not None
    rows: list[Mapping[str, str]] = []
    for file in sorted((real_source / "humans").glob("*.csv")):
        with file.open(encoding="utf-8", newline="") as stream:
            rows += csv.DictReader(stream)
    assert len(rows) == 1144
    for row in rows:
        index = reference.trial_index[row["stim_ID"]]
        share = float(row["correct"]) if reference.labels[index] else 1 - float(row["correct"])
        assert people.n[index] == int(row["c"])
        assert people.n_yes[index] == pytest.approx(share * int(row["c"]), abs=1e-6)
