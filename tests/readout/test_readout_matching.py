"""Which features belong to which trials."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from builders import build_reference
from feature_sets import name_pairs
from leaderboard.errors import SourceError
from leaderboard.readout.features import Features, features_from_columns
from leaderboard.readout.matching import (
    FittingSet,
    Scope,
    TargetSet,
    check_separate,
    gather_fitting_sets,
    list_test_trials,
    match_test_sets,
)

REFERENCE = build_reference()
TRIALS = list_test_trials(REFERENCE)
N_TRIALS = len(REFERENCE.trial_ids)


def take(trial_ids: list[str] | tuple[str, ...], name: str = "file", **more: Any) -> Features:
    """Features whose first number is the place of the trial."""
    columns = {"trial_id": list(trial_ids), "features": [[n, 1.0] for n in range(len(trial_ids))], **more}
    with_labels = "label" in more
    return features_from_columns(columns, name=name, with_labels=with_labels)


def take_fitting(n_pairs: int = 3, scenario: str = "own", **more: Any) -> Features:
    trial_ids, _ = name_pairs(n_pairs, scenario)
    return take(trial_ids, name=scenario, **{"label": [0, 1] * n_pairs, **more})


def test_what_is_taken_of_a_reference() -> None:
    """Names of trials, properties and scenarios are taken, and nothing of labels or people."""
    assert vars(TRIALS).keys() == {"benchmark", "trial_ids", "properties", "scenarios", "property_names"}
    assert TRIALS.property_names["alpha_one"] == "Alpha"
    assert TRIALS.properties.count("Beta") == 8


def test_trials_are_sorted_and_labels_go_with_them() -> None:
    """A set to fit on is in the order of ids, whatever the order in the file."""
    trial_ids, _ = name_pairs(2)
    shuffled = [trial_ids[row] for row in (3, 0, 2, 1)]
    (found,) = gather_fitting_sets([take(shuffled, label=[1, 0, 0, 1])], TRIALS, "all").values()
    assert found.trial_ids == tuple(sorted(trial_ids))
    rows = [shuffled.index(trial_id) for trial_id in found.trial_ids]
    assert found.values[:, 0].tolist() == rows
    assert found.labels.tolist() == [[1, 0, 0, 1][row] for row in rows]


def test_pairs_follow_from_the_folder_of_the_copy() -> None:
    """Where no pairs are given, trials that differ in the mark of the copy alone are a pair."""
    (found,) = gather_fitting_sets([take_fitting(2)], TRIALS, "all").values()
    names = dict(zip(found.trial_ids, found.pair_ids, strict=True))
    assert names["own-copy0/set=x/0001"] == names["own-copy1/set=x/0001"] == "own/set=x/0001"


def test_given_pairs_count() -> None:
    """Pairs that are given stand, whatever the ids look like."""
    (found,) = gather_fitting_sets(
        [take(["b", "a"], label=[0, 1], pair_id=["p", "q"])], TRIALS, "all"
    ).values()
    assert dict(zip(found.trial_ids, found.pair_ids, strict=True)) == {"a": "q", "b": "p"}


def test_only_property_need_not_be_said() -> None:
    """Where a benchmark has one property, all trials to fit on belong to it."""
    single = replace(TRIALS, properties=("Alpha",) * N_TRIALS)
    assert list(gather_fitting_sets([take_fitting()], single, "property")) == ["Alpha"]


def test_properties_are_known_by_every_name() -> None:
    """A property goes by its name or by those of its scenarios; parts come in the benchmark's order."""
    files = [take_fitting(scenario="b", property=["beta_one"] * 6)]
    files += [take_fitting(scenario="a", property=["Alpha"] * 6)]
    found = gather_fitting_sets(files, TRIALS, "property")
    assert {name: len(part.trial_ids) for name, part in found.items()} == {"Alpha": 6, "Beta": 6}
    assert list(found) == ["Alpha", "Beta"]


@pytest.mark.parametrize(
    ("files", "scope", "message"),
    [
        ([take(["a-copy0/1"])], "all", "file: lacks label, 1 where a trial ends with YES"),
        ([take_fitting(), take_fitting()], "all", "trial 'own-copy0/set=x/0000' is in own and in own"),
        ([take_fitting()], "property", "own: does not say which property its trials belong to"),
        ([take_fitting(property=["Gamma"] * 6)], "property", "own: property 'Gamma' is none of Tiny"),
        (
            [take(TRIALS.trial_ids, label=[0] * N_TRIALS, property=["Beta"] * N_TRIALS)],
            "property",
            f"file: trial '{TRIALS.trial_ids[0]}' belongs to Alpha, and is given for Beta",
        ),
        ([take(["a", "b"], label=[0, 1])], "all", "file: does not say which trials make a pair"),
    ],
)
def test_unclear_trials_are_refused(files: list[Features], scope: Scope, message: str) -> None:
    """What a trial to fit on needs is asked for by name."""
    with pytest.raises(SourceError, match=f"^{message}"):
        gather_fitting_sets(files, TRIALS, scope)


def test_files_of_different_width_do_not_mix() -> None:
    """Files that are fitted together have the same features."""
    wide = take_fitting(scenario="wide", features=np.ones((6, 3)))
    with pytest.raises(SourceError, match="own and wide have 2 and 3 features and would be fitted together"):
        gather_fitting_sets([take_fitting(), wide], TRIALS, "all")


def test_test_trials_go_by_their_names() -> None:
    """Names of files, in any order and over several files, are resolved to trial ids."""
    names = [f"videos/{trial_id}_img.mp4" for trial_id in reversed(TRIALS.trial_ids)]
    halves = [take(names[:10]), take(names[10:])]
    sets, coverage = match_test_sets(halves, TRIALS, "property")
    assert tuple(t for found in sets.values() for t in found.trial_ids) == TRIALS.trial_ids
    assert sets["Beta"].values[:, 0].tolist() == [7, 6, 5, 4, 3, 2, 1, 0]
    assert (len(coverage.scenarios), coverage.omitted, coverage.unmatched) == (3, {}, ())


def test_broken_scenarios_are_left_out() -> None:
    """A scenario that lacks a trial is left out and counted; a name that fits none is listed."""
    names = [*TRIALS.trial_ids[1:], "elsewhere/0001"]
    sets, coverage = match_test_sets([take(names)], TRIALS, "all")
    assert list(sets) == ["all"]
    assert len(sets["all"].trial_ids) == N_TRIALS - 8
    assert coverage.omitted == {"alpha_one": (7, 8)}
    assert coverage.unmatched == ("elsewhere/0001",)


def test_test_trials_must_be_there_once() -> None:
    """Two rows of one trial are refused with names and files, and so is a file without a whole scenario."""
    first = TRIALS.trial_ids[0]
    with pytest.raises(SourceError, match=f"^'{first}' in file and '{first}.mp4' in file both mean trial"):
        match_test_sets([take([*TRIALS.trial_ids, f"{first}.mp4"])], TRIALS, "all")
    with pytest.raises(
        SourceError, match=f"^'{first}' in file and '{first}' in more both mean trial {first}$"
    ):
        match_test_sets([take(TRIALS.trial_ids), take([first], name="more")], TRIALS, "all")
    message = "^no scenario of Tiny has features for every trial; "
    with pytest.raises(SourceError, match=f"{message}1 name fits no trial or several, such as 'other/1'$"):
        match_test_sets([take(["other/1"])], TRIALS, "all")
    with pytest.raises(SourceError, match=f"{message}most are there of alpha_one: 2 of 8$"):
        match_test_sets([take(TRIALS.trial_ids[:2])], TRIALS, "all")


def test_test_trials_to_fit_on_are_refused() -> None:
    """Equal ids are common, and so are equal distances; all of both are the test trials themselves."""
    values, labels = np.array([[0.0], [0.0], [1.0]]), np.array([0, 1, 1])
    fitting = FittingSet("Alpha", ("a", "b", "c"), ("p", "p", "q"), values, labels)
    test = TargetSet(("a", "b", "x"), np.array([[0.0], [2.0], [1.0]]))
    check_separate(fitting, test)
    with pytest.raises(SourceError, match=r"^Alpha: 2 trials to fit on have ids and features of test trials"):
        check_separate(fitting, replace(test, values=values))
