"""A dropped trial is gone from everything that is graded, and nothing else changes."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from builders import build_reference, build_submission
from leaderboard.errors import BrokenReferenceError
from leaderboard.grading import grade
from leaderboard.metrics.pairs import find_pairs
from leaderboard.reference import Reference, load_reference
from leaderboard.reference.dropping import drop_trials
from reference_folders import ReferenceFolder, pair_name, trial_name

TRIAL, PARTNER = trial_name("alpha_one", 0, 0), trial_name("alpha_one", 1, 0)
REFERENCE = build_reference(3)


def errata(*trial_ids: str) -> bytes:
    """Write errata that drop trials."""
    return "".join(
        f'[[drop]]\ntrial_id = "{trial_id}"\nreason = "The video is empty."\n' for trial_id in trial_ids
    ).encode()


def load(root: Path, *dropped: str) -> Reference:
    return load_reference(ReferenceFolder(raw={"errata.toml": errata(*dropped)}).write(root))


def test_a_dropped_trial_is_out_of_everything(tmp_path: Path) -> None:
    """Trial, ratings and responses are gone; id, reason and place are kept for whoever asks."""
    reference = load(tmp_path, TRIAL)
    assert TRIAL not in reference.trial_ids
    assert reference.n_trials == 11
    assert reference.dropped == {TRIAL: "The video is empty."}
    (dropped,) = reference.dropped_trials
    assert (dropped.pair_id, dropped.position, dropped.participant_ids) == (
        pair_name("alpha_one", 0),
        0,
        ("p1",),
    )
    assert reference.people is not None
    assert reference.people.responses is not None
    assert reference.people.n.size == 11
    assert reference.people.responses.answers.size == 11


def test_the_partner_stands_alone(tmp_path: Path) -> None:
    """Its pair keeps its id and has one trial; the other pairs are whole."""
    reference = load(tmp_path, TRIAL)
    index = reference.trial_index[PARTNER]
    assert reference.pair_ids[reference.pairs[index]] == pair_name("alpha_one", 0)
    assert len(find_pairs(reference.pairs)) == 5
    assert len(reference.pair_ids) == 6


def test_a_pair_without_trials_is_gone(tmp_path: Path) -> None:
    """With both trials dropped there is no such pair, and pairs are numbered without a gap."""
    reference = load(tmp_path, TRIAL, PARTNER)
    assert pair_name("alpha_one", 0) not in reference.pair_ids
    assert sorted(set(reference.pairs.tolist())) == list(range(5))


def test_people_who_judged_nothing_else_are_gone(tmp_path: Path) -> None:
    """Somebody whose only answer was to a dropped trial is no participant any more."""
    folder = ReferenceFolder(raw={"errata.toml": errata(TRIAL)})
    folder.rows["human_responses.csv"][0][0] = "p0"
    reference = load_reference(folder.write(tmp_path))
    assert reference.people is not None
    assert reference.people.responses is not None
    assert reference.people.responses.participant_ids == ("p1", "p2")
    assert sorted(set(reference.people.responses.participants.tolist())) == [0, 1]


def test_without_an_answer_nothing_is_known_of_single_people(tmp_path: Path) -> None:
    """If people judged dropped trials only, nobody's responses are left, and no trial is rated."""
    folder = ReferenceFolder(raw={"errata.toml": errata(TRIAL)})
    for name in ("human_trials.csv", "human_responses.csv"):
        del folder.rows[name][1:]
    people = load_reference(folder.write(tmp_path)).people
    assert people is not None
    assert (people.responses, int(people.n.sum())) == (None, 0)


def test_an_unknown_trial_is_not_dropped(tmp_path: Path) -> None:
    """What is in no list cannot be taken out of it; the check says so, and loading goes on."""
    reference = load(tmp_path, "alpha_one-copy0/other/0000")
    assert reference.n_trials == 12
    assert reference.dropped == {}


def test_errata_are_sealed(tmp_path: Path) -> None:
    """They are part of the reference's identity: adding them breaks the seal."""
    instance = ReferenceFolder().write(tmp_path)
    instance.reference_file("errata.toml").write_bytes(errata(TRIAL))
    with pytest.raises(
        BrokenReferenceError, match=r"^reference/errata.toml: is not listed in manifest.json$"
    ):
        load_reference(instance)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"[[drop\n", r"reference/errata.toml:1: is not TOML"),
        (b"\xff", r"reference/errata.toml: is not TOML"),
        (b'[[drop]]\ntrial_id = "a"\n', r"reference/errata.toml: drop\[1\].reason: is missing"),
        (b'[[remove]]\ntrial_id = "a"\n', r"reference/errata.toml: remove: is not a known key"),
        (
            errata(*(trial_name("beta_one", copy, number) for number in (0, 1) for copy in (0, 1))),
            r"reference/errata.toml: drops every trial of Beta",
        ),
    ],
)
def test_errata_that_cannot_be_followed_are_refused(tmp_path: Path, content: bytes, message: str) -> None:
    """Nothing is graded by errata that nobody understands, or that leave nothing to grade."""
    instance = ReferenceFolder(raw={"errata.toml": content}).write(tmp_path)
    with pytest.raises(BrokenReferenceError, match=message):
        load_reference(instance)


@given(st.sets(st.integers(0, REFERENCE.n_trials - 1), max_size=8))
def test_what_is_left_is_as_it_was(dropped: set[int]) -> None:
    """Every trial that is left has the label, scenario, pair, copy and ratings that it had."""
    left = drop_trials(REFERENCE, {REFERENCE.trial_ids[index]: "why" for index in dropped})
    assert [trial.position for trial in left.dropped_trials] == sorted(dropped)
    assert left.people is not None
    assert REFERENCE.people is not None
    for trial_id, new in left.trial_index.items():
        old = REFERENCE.trial_index[trial_id]
        assert left.pair_ids[left.pairs[new]] == REFERENCE.pair_ids[REFERENCE.pairs[old]]
        for name in ("properties", "scenarios", "copies", "labels"):
            assert getattr(left, name)[new] == getattr(REFERENCE, name)[old]
        assert left.people.n[new] == REFERENCE.people.n[old]
        assert left.people.n_yes[new] == REFERENCE.people.n_yes[old]
    assert left.people.responses is not None
    n = np.bincount(left.people.responses.trials, minlength=left.n_trials)
    assert n.tolist() == left.people.n.tolist()


def test_a_reference_with_dropped_trials_can_be_graded() -> None:
    """Scores are those of the trials that are left, whole scenarios may be gone."""
    dropped = [trial_id for trial_id in REFERENCE.trial_ids if trial_id.startswith("alpha_two")]
    left = drop_trials(REFERENCE, dict.fromkeys([*dropped, REFERENCE.trial_ids[0]], "why"))
    result = grade(build_submission(left, left.labels.astype(float).tolist()), left)
    assert result.coverage.trials == REFERENCE.n_trials - 7
    assert result.coverage.complete
    assert result.scores["overall"]["all"].metrics["accuracy"].value == 1.0
