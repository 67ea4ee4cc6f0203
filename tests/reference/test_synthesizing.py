"""The simulated reference looks like the paper's data, never changes, and is never taken for them."""

import csv
import io
from collections import Counter
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from builders import build_benchmark
from leaderboard.errors import BrokenReferenceError, InstanceError
from leaderboard.instance import Instance
from leaderboard.models import Benchmark
from leaderboard.problems import Problems
from leaderboard.reference import Reference, Responses, load_reference
from leaderboard.reference.checking import check_reference
from leaderboard.reference.definition import parse_benchmark
from leaderboard.reference.describing import describe_reference
from leaderboard.reference.sealing import seal_reference
from leaderboard.reference.synthesizing import synthesize, synthesize_reference
from reference_folders import DEFINITION, ReferenceFolder

DEFAULT_SEED = 20231105
N_SPLITS = 100

Floats = NDArray[np.float64]


@cache
def embedded(root: Path) -> Reference:
    return load_reference(Instance(root))


@pytest.fixture
def reference(repo_root: Path) -> Reference:
    """The committed reference."""
    return embedded(repo_root)


@pytest.fixture
def responses(reference: Reference) -> Responses:
    """Its people's single responses."""
    assert reference.people is not None
    assert reference.people.responses is not None
    return reference.people.responses


def synthesize_tiny(seed: int, definition: str = DEFINITION) -> dict[str, bytes]:
    return synthesize(parse_tiny(definition), seed)


def parse_tiny(definition: str) -> Benchmark:
    benchmark = parse_benchmark(definition.encode(), Problems())
    assert benchmark is not None
    return benchmark


def sets_of(responses: Responses) -> dict[frozenset[int], list[int]]:
    """The people of each set of trials."""
    people: dict[frozenset[int], list[int]] = {}
    for person in range(len(responses.participant_ids)):
        seen = frozenset(responses.trials[responses.participants == person].tolist())
        people.setdefault(seen, []).append(person)
    return people


def split_half_correlation(reference: Reference, responses: Responses) -> float:
    """Correlate the means of random halves of each set's people; average over splits and properties."""
    answers = np.full((len(responses.participant_ids), reference.n_trials), np.nan)
    answers[responses.participants, responses.trials] = responses.answers
    rng = np.random.default_rng(0)
    values = []
    for _ in range(N_SPLITS):
        halves = np.empty((2, reference.n_trials))
        for seen, people in sets_of(responses).items():
            columns = np.array(sorted(seen))
            shuffled = rng.permutation(people)
            for half, members in enumerate(np.array_split(shuffled, 2)):
                halves[half, columns] = answers[np.ix_(members, columns)].mean(axis=0)
        values.append([_correlate(halves[:, reference.properties == index]) for index in range(4)])
    return float(np.mean(values))


def _correlate(halves: Floats) -> float:
    first, second = halves - halves.mean(axis=1, keepdims=True)
    return float(first @ second / np.sqrt((first @ first) * (second @ second)))


# The committed files.


def test_the_committed_reference_is_reproduced_byte_for_byte(repo_root: Path, reference: Reference) -> None:
    """The generator makes the files in reference/, every byte of them."""
    instance = Instance(repo_root)
    for name, content in synthesize(reference.benchmark, DEFAULT_SEED).items():
        assert instance.reference_file(name).read_bytes() == content, name


def test_the_committed_manifest_is_reproduced_too(repo_root: Path, tmp_path: Path) -> None:
    """The command that made the reference makes it again in an empty instance."""
    committed, instance = Instance(repo_root), Instance(tmp_path)
    instance.reference_dir.mkdir()
    instance.benchmark_file.write_bytes(committed.benchmark_file.read_bytes())
    manifest = synthesize_reference(instance, DEFAULT_SEED)
    # The committed reference may hold published numbers besides, which nobody simulates.
    sealed = {n: s for n, s in embedded(repo_root).manifest.files.items() if n != "published.csv"}
    assert manifest.files == sealed
    assert manifest.kind == embedded(repo_root).manifest.kind == "synthetic"


def test_counts_are_those_of_the_paper(reference: Reference) -> None:
    """192 trials in 96 pairs for each property, half of them YES; scenarios as large as defined."""
    for part in describe_reference(reference).parts:
        assert part.n_trials == part.expected == 2 * part.n_pairs == 2 * part.n_yes_labels
    sizes = Counter(np.bincount(reference.scenarios).tolist())
    assert sizes == {64: 6, 96: 4}
    assert np.bincount(reference.properties).tolist() == [192] * 4


def test_no_id_passes_for_a_real_one(reference: Reference) -> None:
    """Every config says synthetic, and each scenario has several configs."""
    configs = [trial_id.split("/")[1] for trial_id in reference.trial_ids]
    assert all(config.startswith("synthetic-") for config in configs)
    for index in range(len(reference.benchmark.scenarios)):
        assert len({configs[i] for i in np.flatnonzero(reference.scenarios == index)}) == 4


def test_ids_have_the_released_shape(reference: Reference) -> None:
    """<scenario>-copy<k>/<config>/<NNNN>, with commas and equals signs in some configs."""
    for index, trial_id in enumerate(reference.trial_ids):
        folder, config, number = trial_id.split("/")
        scenario = reference.benchmark.scenarios[reference.scenarios[index]].id
        assert folder == f"{scenario}-copy{reference.copies[index]}"
        assert reference.pair_ids[reference.pairs[index]] == f"{scenario}/{config}/{number}"
        assert len(number) == 4
    assert any("," in trial_id for trial_id in reference.trial_ids)
    assert any("=" in trial_id for trial_id in reference.trial_ids)


def test_copies_say_nothing_about_labels(reference: Reference) -> None:
    """In half of each scenario's pairs copy 0 ends in YES."""
    for index in range(len(reference.benchmark.scenarios)):
        labels = reference.labels[(reference.scenarios == index) & (reference.copies == 0)]
        assert 2 * labels.sum() == labels.size


def test_the_design_is_the_paper_s(reference: Reference, responses: Responses) -> None:
    """50 people for each property judge 32 trials each, 16 of them YES, and never both trials of a pair."""
    assert responses.participant_ids == tuple(f"p{number:03d}" for number in range(1, 201))
    for person in range(200):
        seen = responses.trials[responses.participants == person]
        assert seen.size == 32
        assert set(reference.properties[seen].tolist()) == {person // 50}
        assert reference.labels[seen].sum() == 16
        assert np.unique(reference.pairs[seen]).size == 32


def test_people_share_sets(responses: Responses) -> None:
    """Each property has 6 disjoint sets, judged by 8 or 9 people."""
    sets = sets_of(responses)
    assert len(sets) == 24
    assert sum(len(seen) for seen in sets) == len(frozenset().union(*sets)) == 768
    assert Counter(len(people) for people in sets.values()) == {9: 8, 8: 16}


def test_people_are_as_good_as_in_the_paper(reference: Reference) -> None:
    """Human accuracy is 0.60 ± 0.01, near that in each property, and lowest for Deformability."""
    description = describe_reference(reference)
    assert description.human_accuracy == pytest.approx(0.60, abs=0.01)
    values = {
        part.name: part.human_accuracy
        for part in description.parts
        if part.kind == "property" and isinstance(part.human_accuracy, float)
    }
    assert values == {name: pytest.approx(0.60, abs=0.03) for name in values}
    assert min(values, key=values.__getitem__) == "Deformability"


def test_people_agree_as_in_the_paper(reference: Reference, responses: Responses) -> None:
    """The uncorrected split-half correlation is 0.37 ± 0.02."""
    assert split_half_correlation(reference, responses) == pytest.approx(0.37, abs=0.02)


def test_some_pairs_are_easy_some_hard_and_some_both(reference: Reference) -> None:
    """Every property has all three, and every scenario some that are both."""
    for part in describe_reference(reference).parts:
        assert part.n_easy > part.n_easy_and_hard > 0
        assert part.kind == "scenario" or part.n_hard > part.n_easy_and_hard


# Any seed, any benchmark.


def test_seeds_differ_and_repeat() -> None:
    """The seed alone decides."""
    assert synthesize_tiny(1) == synthesize_tiny(1)
    assert synthesize_tiny(1) != synthesize_tiny(2)


@settings(max_examples=20)
@given(st.integers(0, 2**32), st.integers(1, 40))
def test_any_benchmark_of_pairs_gets_a_sound_reference(seed: int, pairs_per_scenario: int) -> None:
    """Whatever the seed and the size, labels of a pair oppose and nobody sees both of its trials."""
    files = synthesize(build_benchmark(pairs_per_scenario), seed)
    for name, n_scenarios in (("Alpha.csv", 2), ("Beta.csv", 1)):
        rows = list(csv.DictReader(io.StringIO(files[name].decode())))
        assert len(rows) == 2 * n_scenarios * pairs_per_scenario
        assert len({row["trial_id"] for row in rows}) == len(rows)
        assert {row["label"] for row in rows} == {"0", "1"}
        for first, second in zip(rows[::2], rows[1::2], strict=True):
            assert first["pair_id"] == second["pair_id"]
            assert (first["copy"], second["copy"]) == ("0", "1")
            assert {first["label"], second["label"]} == {"0", "1"}
    trials = list(csv.DictReader(io.StringIO((files["Alpha.csv"] + files["Beta.csv"]).decode())))
    pair_of = {row["trial_id"]: row["pair_id"] for row in trials}
    judged = list(csv.DictReader(io.StringIO(files["human_responses.csv"].decode())))
    seen = [(row["participant_id"], pair_of[row["trial_id"]]) for row in judged]
    assert len(set(seen)) == len(seen)


def test_a_tiny_reference_is_written_and_sealed(tmp_path: Path) -> None:
    """What is written passes every check, in place of what was there."""
    instance = ReferenceFolder().write(tmp_path)
    manifest = synthesize_reference(instance, 5)
    assert load_reference(instance).manifest == manifest
    assert check_reference(instance).problems == ()


def test_scenarios_without_a_count_share_their_property_s(tmp_path: Path) -> None:
    """Half of Alpha's 8 trials go to each of its two scenarios."""
    definition = DEFINITION.replace('property = "Alpha"\ntrials = 4', 'property = "Alpha"')
    instance = ReferenceFolder(definition=definition).write(tmp_path)
    synthesize_reference(instance, 5)
    assert np.bincount(load_reference(instance).scenarios).tolist() == [4, 4, 4]


def test_odd_numbers_of_trials_make_no_pairs() -> None:
    """The scenario is named."""
    message = r"^reference/benchmark\.toml: scenario beta_one has 3 trials, which make no pairs$"
    with pytest.raises(BrokenReferenceError, match=message):
        synthesize_tiny(
            0, DEFINITION.replace('property = "Beta"\ntrials = 4', 'property = "Beta"\ntrials = 3')
        )


def test_a_definition_is_needed(tmp_path: Path) -> None:
    """Without benchmark.toml there is nothing to simulate, and nothing is written."""
    with pytest.raises(BrokenReferenceError, match=r"^reference/benchmark\.toml: is not there"):
        synthesize_reference(Instance(tmp_path), 0)
    assert list(tmp_path.iterdir()) == []


def test_official_data_are_not_overwritten(tmp_path: Path) -> None:
    """Real people are worth more than simulated ones."""
    instance = ReferenceFolder().write(tmp_path)
    seal_reference(instance, "official")
    before = instance.reference_file("Alpha.csv").read_bytes()
    with pytest.raises(InstanceError, match=r"^reference/ holds official data") as caught:
        synthesize_reference(instance, 0)
    assert "--root DIR" in caught.value.hint
    assert instance.reference_file("Alpha.csv").read_bytes() == before
