"""Each trap of the stand-in is really there, where it was asked for and nowhere else."""

import re
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import replace
from itertools import pairwise

import pytest

from release_people import SPELLINGS
from release_reading import (
    Cells,
    contradicts,
    listed,
    listed_labels,
    pair_of,
    read_rows,
    told,
    told_answers,
    trial_of,
)
from release_stand_in import LIST_TRAPS, PEOPLE_TRAPS, Release, Trap

SMALL = Release(pairs_per_scenario=4)
CHANGE_THE_TRUTH = {Trap.CONFIG_COMMAS, Trap.SAME_LABEL_PAIRS, Trap.MISSING_TRIAL}


def judged(release: Release) -> list[Cells]:
    """The rows of people's files that are about a test trial."""
    known = release.truth.labels
    return [r for r in told(release) if trial_of(r["stim_ID"]) in known and r["condition"] == "prediction"]


def texts(release: Release) -> list[bytes]:
    return [*release.list_files.values(), *release.people_files.values()]


def answers_by_person(release: Release) -> dict[str, list[bool]]:
    people: dict[str, list[bool]] = {}
    for person, _, is_yes in told_answers(release):
        people.setdefault(person, []).append(is_yes)
    return people


def has_repeats(values: Iterable[object]) -> bool:
    return max(Counter(values).values()) > 1


def sees_both(release: Release) -> bool:
    return has_repeats((person, pair_of(trial_id)) for person, trial_id, _ in told_answers(release))


def alternates(answers: list[bool]) -> bool:
    return all(first != second for first, second in pairwise(answers))


# What in the files shows that a trap is there.
EVIDENCE: dict[Trap, Callable[[Release], bool]] = {
    Trap.FILENAMES_WITHOUT_COPY: lambda r: all(row["filenames"].count("/") == 1 for row in listed(r)),
    Trap.FILENAMES_OF_PAIRS: lambda r: all("_pp/" in row["filenames"] for row in listed(r)),
    Trap.COPY_FOLDER_MP4: lambda r: all("_mp4/" in row["full_stim_paths"] for row in listed(r)),
    Trap.CONFIG_COMMAS: lambda r: all("," in row["full_stim_paths"] for row in listed(r)),
    Trap.SAME_LABEL_PAIRS: lambda r: has_repeats((pair_of(name), said) for name, said in listed_labels(r)),
    Trap.REPEATED_ROW: lambda r: has_repeats(listed_labels(r)),
    Trap.CONTRADICTORY_ROW: lambda r: len(set(listed_labels(r))) > len(dict(listed_labels(r))),
    Trap.CRLF: lambda r: all(b"\r\n" in text for text in texts(r)),
    Trap.BYTE_ORDER_MARK: lambda r: all(text.startswith(b"\xef\xbb\xbf") for text in texts(r)),
    Trap.SPLIT_LIST: lambda r: len(r.list_files) == 5,
    Trap.READOUT_LIST: lambda r: any("/readout/" in name for name in r.test_members),
    Trap.BLANK_LINES: lambda r: all(text.endswith(b"\n\n\n") for text in texts(r)),
    Trap.LOWER_CASE_LABELS: lambda r: {said for _, said in listed_labels(r)} == {"true", "false"},
    Trap.NUMERIC_LABELS: lambda r: {said for _, said in listed_labels(r)} == {"0", "1"},
    Trap.MISSING_TRIAL: lambda r: len({name for name, _ in listed_labels(r)}) % 2 == 1,
    Trap.UNKNOWN_SCENARIO: lambda r: any(name.startswith("mass_ramp_pp-") for name, _ in listed_labels(r)),
    Trap.PRACTICE_TRIALS: lambda r: sum("_familiarization/" in row["stim_ID"] for row in told(r)) == 160,
    Trap.PRACTICE_ON_TEST_TRIALS: lambda r: sum(row["condition"] != "prediction" for row in told(r)) == 2,
    Trap.NEXT_RESPONSES: lambda r: (
        {row["stim_ID"] != "" for row in told(r) if row["response"] == "Next"} == {True, False}
    ),
    Trap.EMPTY_RESPONSES: lambda r: any(row["response"] == row["correct"] == "" for row in told(r)),
    Trap.SERVICE_IDS: lambda r: all(
        re.fullmatch("[0-9a-f]{24}", row.get(column, ""))
        for row in told(r)
        for column in ("prolificIDAnon", "workerId", "studyId", "sessionId")
    ),
    Trap.PRIVATE_COLUMNS: lambda r: {"age", "gender", "comments", "ip_address"} <= told(r)[0].keys(),
    Trap.CONTRADICTED_RESPONSES: lambda r: any(contradicts(row) for row in told(r)),
    Trap.DISAGREEING_LABELS: lambda r: any(
        row["target_hit_zone_label"] != str(r.truth.labels[trial_of(row["stim_ID"])]) for row in judged(r)
    ),
    Trap.DUPLICATE_ANSWERS: lambda r: has_repeats(tuple(row.values()) for row in told(r)),
    Trap.CHANGED_ANSWERS: lambda r: len(set(told_answers(r))) > len({a[:2] for a in told_answers(r)}),
    Trap.UNKNOWN_TRIALS: lambda r: len(judged(r)) < len(told(r)),
    Trap.MIXED_SPELLINGS: lambda r: {row["response"] for row in told(r)} == {s for p in SPELLINGS for s in p},
    Trap.LABELLESS: lambda r: "target_hit_zone_label" not in told(r)[0],
    Trap.RESPONSELESS: lambda r: "response" not in told(r)[0],
    Trap.NAMES_WITHOUT_COPY: lambda r: not any("-copy" in row["stim_ID"] for row in told(r)),
    Trap.STREAK_RATERS: lambda r: sum(all(said) for said in answers_by_person(r).values()) >= 4,
    Trap.ALTERNATING_RATERS: lambda r: sum(map(alternates, answers_by_person(r).values())) >= 4,
    Trap.BOTH_MEMBERS: sees_both,
}


@pytest.mark.parametrize("trap", Trap)
def test_each_trap_is_really_there(trap: Trap) -> None:
    """Its evidence is in the files that have it, and not in those that have not."""
    assert EVIDENCE[trap](replace(SMALL, traps=[trap]))
    assert not EVIDENCE[trap](SMALL)


@pytest.mark.parametrize("trap", [trap for trap in LIST_TRAPS if trap not in CHANGE_THE_TRUTH])
def test_what_is_odd_about_lists_leaves_people_alone(trap: Trap) -> None:
    """Most oddities of the lists change neither the truth nor what people said."""
    truth = replace(SMALL, traps=[trap]).truth
    assert (truth.labels, truth.responses) == (SMALL.truth.labels, SMALL.truth.responses)


@pytest.mark.parametrize("trap", PEOPLE_TRAPS)
def test_what_is_odd_about_people_leaves_lists_alone(trap: Trap) -> None:
    """No oddity of people's files changes a list."""
    assert replace(SMALL, traps=[trap]).list_files == SMALL.list_files


def test_traps_name_what_they_befell() -> None:
    """Trial ids among them are those of the truth, or of trials that must not get into it."""
    everything = Release(pairs_per_scenario=4, traps=list(Trap))
    truth = everything.truth
    assert truth.touched.keys() == set(Trap)
    for trap in (Trap.REPEATED_ROW, Trap.CONTRADICTORY_ROW, Trap.DISAGREEING_LABELS):
        assert len(truth.touched[trap]) == 1
        assert truth.labels.keys() >= set(truth.touched[trap])
    for trap in (Trap.MISSING_TRIAL, Trap.UNKNOWN_SCENARIO, Trap.PRACTICE_TRIALS, Trap.UNKNOWN_TRIALS):
        assert truth.labels.keys().isdisjoint(truth.touched[trap])
    people = {person for person, _, _ in truth.responses}
    for trap in (Trap.STREAK_RATERS, Trap.ALTERNATING_RATERS, Trap.BOTH_MEMBERS):
        assert len(truth.touched[trap]) == 4
        assert people >= set(truth.touched[trap])


def test_training_trials_contradict_test_trials() -> None:
    """Half of the training list bears names of test trials with the other label: only its place tells."""
    release = replace(SMALL, traps=[Trap.READOUT_LIST])
    rows = [
        row
        for name, content in release.test_members.items()
        if name.startswith("testdata_v1/readout/")
        for row in read_rows(content)
    ]
    shared = [row for row in rows if trial_of(row["full_stim_paths"]) in release.truth.labels]
    assert 0 < len(shared) < len(rows)
    for row in shared:
        label = release.truth.labels[trial_of(row["full_stim_paths"])]
        assert row["target_hit_zone_labels"] == str(not label)
    assert all("/readoutdata/" in row["full_stim_paths"] for row in rows)
