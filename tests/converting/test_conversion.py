"""From a run's answers to predictions: whole scenarios only, and an account of the rest."""

from dataclasses import replace
from pathlib import Path

import pytest

from builders import build_reference
from leaderboard.converting import READER_VERSION, make_run
from leaderboard.converting.conversion import (
    Conversion,
    OmittedScenario,
    RepeatedTrial,
    convert_run,
    render_predictions,
    write_predictions,
    write_runs,
)
from leaderboard.converting.log import Answer, Run
from leaderboard.converting.matching import AmbiguousAnswer, MatchedAnswer
from leaderboard.converting.merging import Prediction
from leaderboard.converting.traps import Traps
from leaderboard.errors import SourceError
from leaderboard.reference import Reference
from leaderboard.submission import Status


@pytest.fixture(scope="module")
def reference() -> Reference:
    """Twelve trials in the scenarios alpha_one, alpha_two (of Alpha) and beta_one (of Beta)."""
    return build_reference(2)


def answer_all(reference: Reference) -> list[Answer]:
    """An answer to each trial, in the order of the reference, which agrees with its label."""
    return [
        Answer(
            file="log.csv",
            line=index + 2,
            trial_name=trial_id,
            scenario_name=reference.benchmark.scenarios[int(reference.scenarios[index])].id,
            probability=f"0.{index:02d}",
            outcome=bool(reference.labels[index]),
        )
        for index, trial_id in enumerate(reference.trial_ids)
    ]


def convert(answers: list[Answer], reference: Reference) -> Conversion:
    return convert_run(Run("run", tuple(answers)), reference)


def test_complete_run_is_converted_whole(reference: Reference) -> None:
    """Every trial gets its probability, in the reference's order whatever the log's, and nothing is odd."""
    answers = answer_all(reference)
    conversion = convert(answers[::-1], reference)
    assert conversion == Conversion(
        name="run",
        benchmark="Tiny",
        n_rows=12,
        predictions=tuple(Prediction(answer.trial_name, answer.probability) for answer in answers),
        scenarios=("alpha_one", "alpha_two", "beta_one"),
        omitted=(),
        unmatched=(),
        ambiguous=(),
        misplaced=(),
        repeated=(),
        contradicting=(),
        doubtful=(),
        unknown_scenarios=(),
        traps=Traps(
            n_trials=12,
            n_matched=12,
            statuses=((Status.ANSWERED, 12),),
            n_pairs=6,
            n_alike=6,
            repeats=((1, 12),),
            n_answers=12,
        ),
    )


def test_decorated_names_are_resolved(reference: Reference) -> None:
    """The log may decorate its names; the predictions have the reference's ids."""
    answers = [
        replace(a, trial_name=f"/videos/{a.trial_name}-redyellow_img.mp4") for a in answer_all(reference)
    ]
    conversion = convert(answers, reference)
    assert tuple(prediction.trial_id for prediction in conversion.predictions) == reference.trial_ids


def test_paths_of_other_systems_are_resolved(reference: Reference) -> None:
    """A log may name the files of a video on Windows, folders marked by the kind of file, or links."""
    answers = answer_all(reference)
    for index, answer in enumerate(answers):
        name = answer.trial_name.replace("/", "_mp4/", 1)
        backslashed = name.replace("/", "\\")
        link = f"https://example.com/{name.replace(',', '%2C')}_id.png"
        answers[index] = replace(
            answer, trial_name=link if index % 2 else f"D:\\my data\\{backslashed}_aimg.mp4"
        )
    conversion = convert(answers, reference)
    assert tuple(prediction.trial_id for prediction in conversion.predictions) == reference.trial_ids


def test_names_without_their_copy_count_for_no_trial(reference: Reference) -> None:
    """Both members of the pair are named, and the scenario is left out."""
    first, *others = answer_all(reference)
    unclear = replace(first, trial_name="alpha_one/set=a,b/0000_img.mp4")
    conversion = convert([unclear, *others], reference)
    assert conversion.ambiguous == (AmbiguousAnswer(unclear, reference.trial_ids[:2]),)
    assert conversion.omitted == (OmittedScenario("alpha_one", 3, 4),)


def test_incomplete_scenario_is_left_out(reference: Reference) -> None:
    """A scenario of which a trial is missing, and one that is absent, are named with their counts."""
    answers = [a for a in answer_all(reference)[1:] if a.scenario_name != "beta_one"]
    conversion = convert(answers, reference)
    assert conversion.omitted == (OmittedScenario("alpha_one", 3, 4), OmittedScenario("beta_one", 0, 4))
    assert conversion.scenarios == ("alpha_two",)
    assert [prediction.trial_id for prediction in conversion.predictions] == list(reference.trial_ids[4:8])


def test_unmatched_rows_are_kept_apart(reference: Reference) -> None:
    """A row whose name fits no trial is listed and spoils nothing."""
    stranger = replace(answer_all(reference)[0], trial_name="familiarization_0001")
    conversion = convert([*answer_all(reference), stranger], reference)
    assert conversion.unmatched == (stranger,)
    assert len(conversion.predictions) == 12


def test_ambiguous_rows_count_for_no_trial(reference: Reference) -> None:
    """A row whose name fits two trials is listed with both and used for neither."""
    doubled = replace(reference, trial_ids=(*reference.trial_ids[:-1], f"{reference.trial_ids[0]}-redyellow"))
    answers = answer_all(doubled)
    unclear = replace(answers[0], trial_name=f"{answers[0].trial_name}_img")
    conversion = convert([unclear, *answers[1:]], doubled)
    both = tuple(sorted((doubled.trial_ids[0], doubled.trial_ids[-1])))
    assert conversion.ambiguous == (AmbiguousAnswer(unclear, both),)
    assert conversion.omitted == (OmittedScenario("alpha_one", 3, 4),)


def test_trial_in_another_scenario_is_not_used(reference: Reference) -> None:
    """A row whose log has its trial in another scenario than the reference is listed, not used."""
    first, *others = answer_all(reference)
    moved = replace(first, scenario_name="beta_one")
    conversion = convert([moved, *others], reference)
    assert conversion.misplaced == (MatchedAnswer(moved, first.trial_name, "alpha_one"),)
    assert conversion.omitted == (OmittedScenario("alpha_one", 3, 4),)


@pytest.mark.parametrize("name", ["Beta", "bouncing", "beta_one"])
def test_scenario_may_have_its_property_name_or_alias(reference: Reference, name: str) -> None:
    """A log may name a scenario by its id, its property or an alias of the property."""
    properties = tuple(
        p.model_copy(update={"aliases": ("bouncing",)}) if p.name == "Beta" else p
        for p in reference.benchmark.properties
    )
    aliased = replace(reference, benchmark=reference.benchmark.model_copy(update={"properties": properties}))
    answers = answer_all(aliased)
    renamed = [replace(a, scenario_name=name) if a.scenario_name == "beta_one" else a for a in answers]
    conversion = convert(renamed, aliased)
    assert (conversion.misplaced, conversion.unknown_scenarios) == ((), ())
    assert len(conversion.predictions) == 12
    wrong = [replace(a, scenario_name=name) if a.scenario_name == "alpha_one" else a for a in answers]
    assert len(convert(wrong, aliased).misplaced) == 4


def test_unknown_scenario_cannot_be_checked(reference: Reference) -> None:
    """Trials count by their own names where the log's name of the scenario says nothing, and that is told."""
    answers = [replace(answer, scenario_name="set_7") for answer in answer_all(reference)]
    conversion = convert(answers, reference)
    assert conversion.unknown_scenarios == ("set_7",)
    assert len(conversion.predictions) == 12


def test_equal_repetition_counts_once(reference: Reference) -> None:
    """A trial answered twice with the same probability is used once and told."""
    answers = answer_all(reference)
    again = replace(answers[3], line=99)
    conversion = convert([*answers, again], reference)
    assert conversion.repeated == (RepeatedTrial(again.trial_name, (answers[3], again)),)
    assert conversion.repeated[0].is_consistent
    assert len(conversion.predictions) == 12


def test_unequal_repetition_counts_as_no_answer(reference: Reference) -> None:
    """Of two different answers to a trial neither is chosen, so its scenario is not whole."""
    answers = answer_all(reference)
    conversion = convert([*answers, replace(answers[3], probability="0.9")], reference)
    assert [trial.is_consistent for trial in conversion.repeated] == [False]
    assert conversion.omitted == (OmittedScenario("alpha_one", 3, 4),)


def test_repeats_are_merged(reference: Reference) -> None:
    """Answers for different repeats of a trial give their mean; two for the same are one too many."""
    first, *others = answer_all(reference)
    asked = [replace(first, repeat=str(k), probability=p) for k, p in enumerate(("1", "0", "1", "1"))]
    conversion = convert([*asked, *others], reference)
    assert conversion.predictions[0] == Prediction(first.trial_name, "0.75", n_repeats=4, n_answered=4)
    assert (conversion.repeated, conversion.traps.repeats) == ((), ((1, 11), (4, 1)))
    twice = [*asked, replace(asked[1], line=99, probability="1")]
    spoilt = convert([*twice, *others], reference)
    assert [trial.answers for trial in spoilt.repeated] == [(twice[1], twice[4])]
    assert spoilt.omitted == (OmittedScenario("alpha_one", 3, 4),)
    assert (spoilt.traps.n_duplicated, spoilt.traps.n_matched) == (1, 11)


def test_columns_go_in_and_out(reference: Reference) -> None:
    """Columns of a data frame make a run, rows of one trial being repeats, and predictions are columns."""
    names = [f"videos/{trial_id}_img.mp4" for trial_id in reference.trial_ids]
    texts = ["Yes.", None, *["no"] * 10]
    run = make_run([*names, names[0]], [*texts, "Final answer: no"], "mine")
    columns = convert_run(run, reference).to_columns()
    assert columns["trial_id"] == list(reference.trial_ids)
    assert columns["probability"] == ["0.5", "", *["0"] * 10]
    assert columns["status"] == ["answered", "unparsable", *["answered"] * 10]
    assert run.reader == READER_VERSION
    with pytest.raises(ValueError, match="shorter"):
        make_run(names, texts[:-1])


def test_gaps_of_data_frames_are_no_answers(reference: Reference) -> None:
    """None and NaN are what a data frame has where a model said nothing; other things are refused."""
    texts: list[object] = ["yes", *[None, float("nan")] * 5, "no"]
    columns = convert_run(make_run(reference.trial_ids, texts), reference).to_columns()
    assert columns["status"] == ["answered", *["unparsable"] * 10, "answered"]
    with pytest.raises(ValueError, match=r"^the answer in row 2 is 1, not a text$"):
        make_run(reference.trial_ids, ["yes", 1, *texts[2:]])


def test_unanswered_trials_keep_their_scenario_whole(reference: Reference) -> None:
    """A trial without an answer is written with its status, and the column is there only if needed."""
    first, *others = answer_all(reference)
    silent = replace(first, probability="", status=Status.REFUSED)
    conversion = convert([silent, *others], reference)
    assert conversion.omitted == ()
    lines = render_predictions(conversion).splitlines()
    assert lines[:3] == [
        b"trial_id,probability,status",
        b'"alpha_one-copy0/set=a,b/0000",,refused',
        b'"alpha_one-copy1/set=a,b/0000",0.01,answered',
    ]


def test_log_need_not_say_scenario_or_outcome(reference: Reference) -> None:
    """What the log does not say is not compared."""
    answers = [replace(a, scenario_name="", outcome=None) for a in answer_all(reference)]
    conversion = convert(answers, reference)
    assert (conversion.unknown_scenarios, conversion.contradicting) == ((), ())
    assert len(conversion.predictions) == 12


def test_contradicting_outcome_is_told_and_kept(reference: Reference) -> None:
    """Where the log takes another outcome to be true than the label, the prediction stands."""
    first, *others = answer_all(reference)
    turned = replace(first, outcome=not first.outcome)
    conversion = convert([turned, *others], reference)
    assert conversion.contradicting == (MatchedAnswer(turned, first.trial_name, "alpha_one"),)
    assert len(conversion.predictions) == 12


def test_doubtful_numbers_are_told_and_kept(reference: Reference) -> None:
    """A row whose numbers do not fit together is listed, and its P(YES) stands."""
    first, *others = answer_all(reference)
    doubtful = replace(first, doubts=("0.3 and 0.6 do not add up to 1",))
    conversion = convert([doubtful, *others], reference)
    assert conversion.doubtful == (MatchedAnswer(doubtful, first.trial_name, "alpha_one"),)
    assert conversion.predictions[0] == Prediction(first.trial_name, "0.00")


def test_written_file_quotes_commas_and_keeps_digits(reference: Reference, tmp_path: Path) -> None:
    """Ids with commas are quoted, digits stay as they are, and an older file is replaced."""
    answers = [replace(answer, probability="1.50e-03") for answer in answer_all(reference)]
    file = tmp_path / "predictions.csv"
    file.write_text("old", encoding="utf-8")
    write_predictions(convert(answers, reference), file)
    lines = file.read_bytes().split(b"\n")
    assert lines[:2] == [b"trial_id,probability", b'"alpha_one-copy0/set=a,b/0000",1.50e-03']
    assert (len(lines), lines[-1]) == (14, b"")


def test_nothing_to_write_is_an_error(reference: Reference, tmp_path: Path) -> None:
    """A run without a whole scenario writes no file, and the message says what its rows look like."""
    answers = [replace(answer, trial_name=f"other_{answer.line}") for answer in answer_all(reference)]
    conversion = convert(answers, reference)
    message = (
        "run: nothing to write, because no scenario of Tiny is covered whole; "
        "12 of 12 rows match no trial, for example 'other_2'"
    )
    with pytest.raises(SourceError) as caught:
        write_predictions(conversion, tmp_path / "predictions.csv")
    assert caught.value.message == message
    twice = [
        *answer_all(reference),
        *(replace(answer, probability="0.125") for answer in answer_all(reference)),
    ]
    with pytest.raises(SourceError, match=r"covered whole; 24 rows give an answer to 0 of 12 trials$"):
        write_predictions(convert(twice, reference), tmp_path / "predictions.csv")
    with pytest.raises(SourceError, match="nothing to write"):
        write_runs({"run": conversion}, tmp_path / "runs")
    assert list(tmp_path.iterdir()) == []


def test_each_run_gets_a_folder(reference: Reference, tmp_path: Path) -> None:
    """Every run that covers a scenario is written under its name; one that covers none is passed over."""
    whole = convert(answer_all(reference), reference)
    none = convert(answer_all(reference)[:1], reference)
    files = write_runs({"whole": whole, "none": none}, tmp_path / "runs")
    assert files == (tmp_path / "runs" / "whole" / "predictions.csv",)
    assert files[0].read_bytes() == render_predictions(whole)
    assert [path.name for path in (tmp_path / "runs").iterdir()] == ["whole"]
