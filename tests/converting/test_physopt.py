"""Results of physopt: their dialect, and the real ones of C-SWM."""

import csv
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from builders import build_reference
from leaderboard.converting import FORMATS, Conversion, convert_physopt
from leaderboard.converting.conversion import OmittedScenario, render_predictions
from leaderboard.converting.physopt import COLUMNS, split_runs
from leaderboard.errors import SourceError
from leaderboard.instance import Instance
from leaderboard.reference import Reference, load_reference
from leaderboard.reference.importing import import_reference
from leaderboard.reference.recipes import RECIPES
from leaderboard.reference.source_files import read_source_files

Row = dict[str, str]


@pytest.fixture(scope="module")
def reference() -> Reference:
    """Twelve trials in the scenarios alpha_one, alpha_two (of Alpha) and beta_one (of Beta)."""
    return build_reference(2)


def make_rows(
    reference: Reference, *, training: str = "all", readout: str = "A", model: str = "CSWM"
) -> list[Row]:
    """One run's rows for every trial; ``training`` may be a data set's name, or `same`."""
    rows = []
    for index, trial_id in enumerate(reference.trial_ids):
        scenario = reference.benchmark.scenarios[int(reference.scenarios[index])].id
        label = str(reference.labels[index])
        rows.append(
            {
                "Model": model,
                "Readout Train Data": scenario,
                "Readout Test Data": scenario,
                "Readout Type": readout,
                "Predicted Prob": "[0.25 0.75]",
                "Predicted Outcome": "1",
                "Actual Outcome": label,
                "Stimulus Name": trial_id,
                "Encoder Training Dataset": scenario if training == "same" else training,
                "Dynamics Training Dataset": scenario if training == "same" else training,
            }
        )
    return rows


def write_rows(folder: Path, rows: Sequence[Mapping[str, str]], name: str = "results.csv") -> Path:
    file = folder / name
    with file.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    return file


def convert_changed(folder: Path, reference: Reference, **cells: str) -> Conversion:
    """Convert a run whose first row has these cells instead."""
    first, *others = make_rows(reference)
    changes = {column.replace("_", " "): cell for column, cell in cells.items()}
    return convert_physopt([write_rows(folder, [first | changes, *others])], reference)


def probabilities(conversion: Conversion) -> set[str]:
    return {prediction.probability for prediction in conversion.predictions}


def test_second_number_is_the_probability_of_yes(tmp_path: Path, reference: Reference) -> None:
    """`[0.25 0.75]` means P(YES) = 0.75, in the file's own digits."""
    conversion = convert_physopt([write_rows(tmp_path, make_rows(reference))], reference)
    assert conversion.name == "cswm-all-a"
    assert probabilities(conversion) == {"0.75"}
    assert len(conversion.predictions) == conversion.n_rows == 12


@pytest.mark.parametrize(
    ("printed", "kept"),
    [
        ("[0. 1.]", "1"),
        ("[1. 0.]", "0"),
        ("[ 0.40 0.60 ]", "0.60"),
        ("[0.3\n 0.7]", "0.7"),
        ("[9.99999998e-01 1.80000000e-09]", "1.80000000e-09"),
        ("[1.e-01 9.e-01]", "9e-01"),
        ("[0.5 0.5]", "0.5"),
    ],
)
def test_numbers_are_read_as_arrays_print_them(
    tmp_path: Path, reference: Reference, printed: str, kept: str
) -> None:
    """Padding, exponents and points without decimals are read; all digits are kept."""
    yes = float(kept)
    outcome = str(int(yes > 0.5))
    conversion = convert_changed(tmp_path, reference, Predicted_Prob=printed, Predicted_Outcome=outcome)
    assert conversion.predictions[0].probability == kept
    assert conversion.doubtful == ()


@pytest.mark.parametrize(
    "printed",
    [
        "",
        "0.25 0.75",
        "[0.75]",
        "[0.25, 0.75]",
        "[0.25 0.75 0]",
        "[nan nan]",
        "[-0.25 0.75]",
        "[0.25 1.75]",
        "[0.25 1e400]",
        "[0.25 75%]",
        "[0.25 0.7\u0665]",
        "[0.25 .75]",
        "[0.25 0.75]]",
    ],
)
def test_anything_else_is_refused(tmp_path: Path, reference: Reference, printed: str) -> None:
    """What is not two numbers from 0 to 1 in brackets is refused with file and line."""
    with pytest.raises(SourceError) as caught:
        convert_changed(tmp_path, reference, Predicted_Prob=printed)
    assert caught.value.message == (
        f"{tmp_path / 'results.csv'}:2: Predicted Prob {printed!a} is not two numbers from 0 to 1 "
        "such as [0.25 0.75]"
    )


@pytest.mark.parametrize(
    ("column", "cell", "message"),
    [
        ("Predicted_Outcome", "2", "Predicted Outcome '2' is neither 0 nor 1"),
        ("Actual_Outcome", "True", "Actual Outcome 'True' is neither 0 nor 1"),
        ("Stimulus_Name", "", "Stimulus Name is empty"),
        ("Readout_Test_Data", "", "Readout Test Data '' names no scenario"),
        ("Readout_Test_Data", "a\x1b[31m", "Readout Test Data 'a\\x1b[31m' names no scenario"),
        ("Model", "--", "Model '--' names no model"),
    ],
)
def test_malformed_rows_are_refused(
    tmp_path: Path, reference: Reference, column: str, cell: str, message: str
) -> None:
    """A cell that cannot be understood is refused with file and line."""
    with pytest.raises(SourceError) as caught:
        convert_changed(tmp_path, reference, **{column: cell})
    assert caught.value.message == f"{tmp_path / 'results.csv'}:2: {message}"


def test_missing_column_is_refused(tmp_path: Path, reference: Reference) -> None:
    """A file without a column that is needed is no file of physopt's results."""
    file = tmp_path / "results.csv"
    file.write_text(",".join(COLUMNS[:-1]) + "\n", encoding="utf-8")
    with pytest.raises(SourceError, match=r"results\.csv:1: lacks the column Dynamics Training Dataset"):
        convert_physopt([file], reference)


def test_sum_other_than_one_is_doubted(tmp_path: Path, reference: Reference) -> None:
    """Probabilities that do not add up to 1 are reported, and P(YES) stands as it is."""
    conversion = convert_changed(tmp_path, reference, Predicted_Prob="[0.25 0.70]")
    assert [match.answer.doubts for match in conversion.doubtful] == [
        ("0.25 for NO and 0.70 for YES do not add up to 1",)
    ]
    assert conversion.predictions[0].probability == "0.70"


def test_outcome_other_than_the_likelier_is_doubted(tmp_path: Path, reference: Reference) -> None:
    """A predicted outcome that is not the likelier one is reported, since it may mean swapped columns."""
    conversion = convert_changed(tmp_path, reference, Predicted_Outcome="0")
    assert [match.answer.doubts for match in conversion.doubtful] == [
        ("predicts NO with 0.25 for NO and 0.75 for YES",)
    ]


def test_runs_are_split_by_model_training_and_readout(tmp_path: Path, reference: Reference) -> None:
    """Each combination is a run; rows trained on each scenario by itself make one run together."""
    rows = [
        *make_rows(reference, readout="B"),
        *make_rows(reference, training="same"),
        *make_rows(reference, model="SVG (v2)", training="all_but_beta"),
    ]
    conversions = split_runs([write_rows(tmp_path, rows)], reference)
    assert list(conversions) == ["cswm-all-b", "cswm-same-a", "svg-v2-all-but-beta-a"]
    assert {conversion.n_rows for conversion in conversions.values()} == {12}


def test_mixed_training_is_neither_all_nor_same(tmp_path: Path, reference: Reference) -> None:
    """An encoder and dynamics trained on different data, or a readout fitted elsewhere, make another run."""
    rows = make_rows(reference)
    rows[0] = rows[0] | {"Encoder Training Dataset": "alpha_one"}
    rows[1] = rows[1] | {"Readout Train Data": "beta_one"}
    conversions = split_runs([write_rows(tmp_path, rows)], reference)
    assert {name: conversion.n_rows for name, conversion in conversions.items()} == {
        "cswm-all-a": 10,
        "cswm-all-alpha-one-a": 1,
        "cswm-all-read-beta-one-a": 1,
    }


def test_runs_of_the_same_name_are_refused(tmp_path: Path, reference: Reference) -> None:
    """Two models whose names differ only in what a slug cannot hold are not thrown together."""
    rows = make_rows(reference, model="C-SWM") + make_rows(reference, model="C_SWM")
    file = write_rows(tmp_path, rows)
    with pytest.raises(SourceError) as caught:
        split_runs([file], reference)
    assert caught.value.message == f"{file}: 'C-SWM all A' and 'C_SWM all A' would both be named c-swm-all-a"


def test_several_files_count_as_one_table(tmp_path: Path, reference: Reference) -> None:
    """A run may be spread over files, such as one per scenario."""
    rows = make_rows(reference)
    files = [write_rows(tmp_path, rows[:4], "one.csv"), write_rows(tmp_path, rows[4:], "two.csv")]
    assert len(convert_physopt(files, reference).predictions) == 12


def test_run_must_be_chosen_where_several_fit(tmp_path: Path, reference: Reference) -> None:
    """Without options a file of several runs is refused with their names; options choose one."""
    rows = [*make_rows(reference), *make_rows(reference, readout="B"), *make_rows(reference, training="same")]
    file = write_rows(tmp_path, rows)
    with pytest.raises(SourceError) as caught:
        convert_physopt([file], reference, training="all")
    assert caught.value.message == (
        f"{file}: 2 runs fit where one is needed; there are cswm-all-a, cswm-all-b, cswm-same-a"
    )
    assert caught.value.hint == (
        "choose one with --training and --readout, or convert each with --split-runs DIR"
    )
    assert convert_physopt([file], reference, readout="B").name == "cswm-all-b"
    assert convert_physopt([file], reference, training="same").name == "cswm-same-a"
    with pytest.raises(SourceError, match="none of the runs fits; there are cswm-all-a, "):
        convert_physopt([file], reference, readout="C")


def test_format_is_registered(tmp_path: Path, reference: Reference) -> None:
    """The registry knows the format by name and splits its files into runs."""
    file = write_rows(tmp_path, make_rows(reference))
    assert list(FORMATS["physopt"].split_runs([file], reference)) == ["cswm-all-a"]
    assert all(name == format_.name for name, format_ in FORMATS.items())


@given(cells=st.dictionaries(st.sampled_from(COLUMNS), st.text(max_size=12)))
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_any_cells_give_runs_or_a_refusal(
    tmp_path: Path, reference: Reference, cells: dict[str, str]
) -> None:
    """Whatever stands in a row, the outcome is conversions that account for every row, or a SourceError."""
    first, *others = make_rows(reference)
    cells = {
        column: cell.replace("\0", "").encode("utf-8", "ignore").decode() for column, cell in cells.items()
    }
    try:
        conversions = split_runs([write_rows(tmp_path, [first | cells, *others])], reference)
    except SourceError:
        return
    assert sum(conversion.n_rows for conversion in conversions.values()) == 12


@pytest.fixture(scope="module")
def results_file(shared_dir: Path) -> Path:
    return shared_dir / "data" / "physion-v1" / "models" / "cswm_physopt_results.csv"


@pytest.fixture(scope="module")
def physion(shared_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> Reference:
    instance = Instance(tmp_path_factory.mktemp("real") / "physion")
    recipe = RECIPES["physion"]
    files = read_source_files([shared_dir / "data" / "physion-v1"], recipe.is_wanted)
    import_reference(recipe, files, instance)
    return load_reference(instance)


@pytest.fixture(scope="module")
def real(results_file: Path, physion: Reference) -> dict[str, Conversion]:
    return split_runs([results_file], physion)


@pytest.mark.shared
def test_real_runs_are_six(real: dict[str, Conversion]) -> None:
    """The 48 runs of the real file make six, which account for all of its 10,194 rows."""
    assert list(real) == [f"cswm-{training}-{readout}" for training in ("all", "same") for readout in "abc"]
    assert sum(conversion.n_rows for conversion in real.values()) == 10_194
    for conversion in real.values():
        n_left_out = sum(scenario.n_answered for scenario in conversion.omitted)
        n_rows = len(conversion.predictions) + n_left_out + len(conversion.unmatched)
        assert n_rows == conversion.n_rows


@pytest.mark.shared
@pytest.mark.parametrize("readout", ["a", "b", "c"])
def test_real_runs_trained_on_all_cover_everything(
    real: dict[str, Conversion], physion: Reference, readout: str
) -> None:
    """Trained on all scenarios: 1,200 predictions, 549 rows of other videos, 37 contradicted labels."""
    conversion = real[f"cswm-all-{readout}"]
    assert tuple(prediction.trial_id for prediction in conversion.predictions) == physion.trial_ids
    assert conversion.omitted == ()
    assert len(conversion.unmatched) == 549
    contradicted = Counter(match.scenario for match in conversion.contradicting)
    assert contradicted == {"roll": 35, "support": 1, "drape": 1}


@pytest.mark.shared
@pytest.mark.parametrize("readout", ["a", "b", "c"])
def test_real_runs_trained_on_the_same_lack_drape(real: dict[str, Conversion], readout: str) -> None:
    """Trained on the same scenario: 72 of Drape's 150 trials are there, so Drape is left out."""
    conversion = real[f"cswm-same-{readout}"]
    assert conversion.omitted == (OmittedScenario("drape", 72, 150),)
    assert len(conversion.predictions) == 1050
    assert len(conversion.unmatched) == 527


@pytest.mark.shared
def test_real_rows_are_otherwise_sound(real: dict[str, Conversion]) -> None:
    """No real row is ambiguous, repeated, misplaced or doubtful, and all scenarios are known."""
    assert real
    for conversion in real.values():
        assert not conversion.ambiguous
        assert not conversion.repeated
        assert not conversion.misplaced
        assert not conversion.doubtful
        assert not conversion.unknown_scenarios


@pytest.mark.shared
def test_real_accuracy(real: dict[str, Conversion], physion: Reference) -> None:
    """C-SWM trained on all scenarios with readout A is as accurate as it was found to be."""
    right: Counter[str] = Counter()
    for prediction in real["cswm-all-a"].predictions:
        index = physion.trial_index[prediction.trial_id]
        scenario = physion.benchmark.scenarios[int(physion.scenarios[index])].id
        right[scenario] += (float(prediction.probability) > 0.5) == bool(physion.labels[index])
    accuracy = {scenario: round(n / 150, 6) for scenario, n in right.items()}
    expected = {"support": 0.813333, "collide": 0.593333, "drape": 0.706667, "roll": 0.600000}
    assert expected.items() <= accuracy.items()


@pytest.mark.shared
def test_real_digits_are_kept(results_file: Path, real: dict[str, Conversion]) -> None:
    """Each prediction is the second number of its row, read naively, digit for digit."""
    with results_file.open(encoding="utf-8", newline="") as stream:
        rows = [row for row in csv.DictReader(stream) if row["Readout Type"] == "C"]
    second = {
        row["Stimulus Name"].replace("-redyellow", ""): row["Predicted Prob"].strip("[]").split()[1]
        for row in rows
        if row["Encoder Training Dataset"] == "all"
    }
    predictions = real["cswm-all-c"].predictions
    assert len(predictions) == 1200
    for prediction in predictions:
        assert prediction.probability == re.sub(r"\.$", "", second[prediction.trial_id])


@pytest.mark.shared
def test_real_options_choose_the_split_runs(
    results_file: Path, physion: Reference, real: dict[str, Conversion]
) -> None:
    """Choosing a run by options gives the bytes that splitting gives."""
    conversion = convert_physopt([results_file], physion, training="same", readout="B")
    assert render_predictions(conversion) == render_predictions(real["cswm-same-b"])
