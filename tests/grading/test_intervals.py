"""Intervals: every metric on every resample, against metrics of trials that are really drawn."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from scipy import stats

from builders import build_reference, build_submission, shuffle_pairs
from leaderboard.grading import METRICS, Yardstick, find_metric, grade, tally_scores
from leaderboard.grading.draws import Draws
from leaderboard.grading.observations import Observations
from leaderboard.grading.tally import Tally
from leaderboard.metrics import agreement, calibration
from leaderboard.metrics.undefined import Undefined
from leaderboard.reference import Reference

FIRST_ORDER = ("ece", "human_ece", "error_consistency", "cohen_kappa")
SCALED = ("human_r_normalized",)
NAMES = [metric.name for metric in METRICS if not metric.is_p_value]
REFERENCE = build_reference(8, seed=3)
COUNTS = build_reference(8, seed=3, responses=False)
PROBABILITIES = np.random.default_rng(5).random(REFERENCE.n_trials).round(1)
EVERYTHING = np.ones(REFERENCE.n_trials, bool)


def _leave_gaps(reference: Reference) -> Reference:
    """Let nobody judge some trials and one person others; one pair has equal labels, and one is no pair."""
    people = reference.people
    assert people is not None
    n = np.where(np.arange(reference.n_trials) % 5 == 1, 0, people.n)
    n = np.where(np.arange(reference.n_trials) % 7 == 2, 1, n)
    labels, pairs = reference.labels.copy(), reference.pairs.copy()
    for scenario in np.unique(reference.scenarios):
        first = int(np.flatnonzero(reference.scenarios == scenario)[0])
        labels[first : first + 2] = scenario % 2
        pairs[first + 3] = pairs.max() + 1
    pair_ids = (
        *reference.pair_ids,
        *(f"single {k}" for k in range(int(pairs.max()) + 1 - len(reference.pair_ids))),
    )
    people = replace(people, n=n, n_yes=np.minimum(people.n_yes, n), responses=None)
    return replace(reference, labels=labels, pairs=pairs, pair_ids=pair_ids, people=people)


GAPS = _leave_gaps(COUNTS)


def observe(reference: Reference, probabilities: np.ndarray = PROBABILITIES) -> Observations:
    """Line up predictions, some of them ties and some unanswered, with a reference."""
    answered = np.arange(reference.n_trials) % 11 != 0
    q = np.where(answered, probabilities, 0.5)
    return Observations.of(build_submission(reference, q.tolist(), answered=answered.tolist()), reference)


def draw_trials(o: Observations, mask: np.ndarray, weights: np.ndarray) -> Observations:
    """Repeat the trials of each pair as often as it is drawn; each copy is a pair of its own."""
    kept = np.flatnonzero(mask)
    copies = [(i, o.pairs[i] + 1000 * copy) for i in kept for copy in range(int(weights[o.pairs[i]]))]
    index, pairs = np.array(copies, np.int64).reshape(-1, 2).T
    names = ("probabilities", "credits", "answered", "labels", "n", "n_yes")
    arrays: dict[str, Any] = {
        name: None if getattr(o, name) is None else getattr(o, name)[index] for name in names
    }
    return replace(o, **arrays, pairs=pairs, responses=None)


@pytest.mark.parametrize("reference", [COUNTS, GAPS], ids=["all rated", "with gaps"])
@pytest.mark.parametrize("name", [name for name in NAMES if name not in FIRST_ORDER + SCALED])
def test_each_resample_is_the_metric_of_the_drawn_trials(name: str, reference: Reference) -> None:
    """Weighted sums give what the metric's own function gives on the drawn trials, in every cell."""
    yardstick, o = Yardstick.of(reference), observe(reference)
    tally = tally_scores(o, EVERYTHING, yardstick)
    checked = 0
    for cell in yardstick.list_cells(EVERYTHING):
        if isinstance(tally.estimates[cell.scope.name][cell.subset][name], Undefined):
            assert (cell.scope.name, cell.subset, name) not in tally.resampled
            continue
        for b in range(0, 200, 20):
            drawn = draw_trials(o, cell.mask, yardstick.draws.pairs[:, b])
            expected = find_metric(name).compute(drawn) if drawn.labels.size else Undefined("nothing drawn")
            value = np.nan if isinstance(expected, Undefined) else expected
            found = tally.resampled[cell.scope.name, cell.subset, name][b]
            assert found == pytest.approx(value, abs=2e-6, nan_ok=True)
            checked += not np.isnan(value)
    assert checked > 50


def test_overall_resamples_are_means_of_the_properties() -> None:
    """Resample by resample, since the properties' pairs are drawn together."""
    tally = tally_scores(observe(COUNTS), EVERYTHING, Yardstick.of(COUNTS))
    parts = [tally.resampled[name, "easy", "brier"] for name in ("Alpha", "Beta")]
    assert tally.resampled["overall", "easy", "brier"] == pytest.approx(np.mean(parts, axis=0), nan_ok=True)


def test_resamples_do_not_depend_on_the_order_of_pairs() -> None:
    """To the last bit: sums on a grid are exact, so no machine may add in an order that shows."""
    yardstick = Yardstick.of(REFERENCE)
    shuffled, place = shuffle_pairs(REFERENCE, 1)
    pairs = yardstick.draws.pairs[np.argsort(place)]
    probabilities = np.random.default_rng(2).random(REFERENCE.n_trials)
    plain = tally_scores(observe(REFERENCE, probabilities), EVERYTHING, yardstick).resampled
    other = tally_scores(
        observe(shuffled, probabilities),
        EVERYTHING,
        Yardstick(shuffled, Draws(pairs, yardstick.draws.people)),
    ).resampled
    assert plain.keys() == other.keys()
    assert {"accuracy", "auc", "human_r_normalized", "cohen_kappa"} <= {metric for _, _, metric in plain}
    for key, values in plain.items():
        assert np.array_equal(values, other[key], equal_nan=True), key


def _weigh_responses(reference: Reference, v: np.ndarray) -> np.ndarray:
    """Compute human means with weights for single responses."""
    people = reference.people
    assert people is not None
    assert people.responses is not None
    r = people.responses
    votes = np.bincount(r.trials, v * r.answers, minlength=reference.n_trials)
    means: np.ndarray = votes / np.bincount(r.trials, v, minlength=reference.n_trials)
    return means


def _gap(o: Observations, h: np.ndarray) -> float:
    return float(o.credits.mean() - np.where(o.labels == 1, h, 1 - h).mean())


BY_HUMAN_MEANS: dict[str, Callable[[Observations, np.ndarray], object]] = {
    "human_r": lambda o, h: agreement.human_r(o.probabilities, h),
    "human_r_partial": lambda o, h: agreement.human_r_partial(o.probabilities, h, o.labels),
    "human_rmse": lambda o, h: agreement.human_rmse(o.probabilities, h),
    "human_ece": lambda o, h: calibration.human_ece(o.probabilities, h),
    "human_gap": _gap,
}


@pytest.mark.parametrize("name", sorted(BY_HUMAN_MEANS))
def test_drawn_people_move_metrics_to_first_order(name: str) -> None:
    """With every pair drawn once, a resample is the value plus slopes times how often people are drawn."""
    draws = np.array([[0, 2, 1], [3, 1, 0]] + [[1, 1, 1]] * 10, float)
    yardstick = Yardstick(REFERENCE, Draws(np.ones((len(REFERENCE.pair_ids), 3)), draws))
    o, step = observe(REFERENCE), 1e-6
    tally = tally_scores(o, EVERYTHING, yardstick)
    alpha = REFERENCE.in_property("Alpha")
    selected = o.select(alpha)

    def value(v: np.ndarray) -> float:
        return float(BY_HUMAN_MEANS[name](selected, _weigh_responses(REFERENCE, v)[alpha]))  # type: ignore[arg-type]

    persons = REFERENCE.people.responses.participants  # type: ignore[union-attr]
    one = np.ones(persons.size)
    slopes = np.array([(value(one + d) - value(one - d)) / (2 * step) for d in step * np.eye(one.size)])
    by_person = np.bincount(persons, slopes)
    scale = np.sqrt(max(0, 1 - (slopes**2).sum() / (by_person**2).sum()))
    expected = value(one) + scale * by_person @ (draws - 1)
    assert tally.resampled["Alpha", "all", name] == pytest.approx(expected, abs=1e-5)


def test_kappas_are_their_value_plus_what_drawn_trials_and_people_pull() -> None:
    """Drawing everything once gives the value in every resample, and the intervals lie around it."""
    n = len(REFERENCE.pair_ids)
    once = Yardstick(REFERENCE, Draws(np.ones((n, 2)), np.ones((12, 2))))
    tally = tally_scores(observe(REFERENCE), EVERYTHING, once)
    for name in ("error_consistency", "cohen_kappa"):
        assert tally.resampled["Alpha", "all", name] == pytest.approx(tally.estimates["Alpha"]["all"][name])
    scores = tally_scores(observe(REFERENCE), EVERYTHING, Yardstick.of(REFERENCE)).assemble(["Alpha"])
    for name in FIRST_ORDER:
        score = scores["Alpha"]["all"].metrics[name]
        assert score.low is not None
        assert score.high is not None
        assert score.value is not None
        assert score.low < score.value < score.high


@pytest.mark.parametrize("name", [name for name in NAMES if name not in SCALED])
def test_drawing_everything_once_gives_the_value(name: str) -> None:
    """The resample that is the data has the metric's value."""
    n = len(REFERENCE.pair_ids)
    once = Yardstick(REFERENCE, Draws(np.ones((n, 1)), np.ones((12, 1))))
    tally = tally_scores(observe(REFERENCE), EVERYTHING, once)
    for scope, subset in (("overall", "all"), ("Alpha", "easy"), ("alpha_one", "all")):
        value = tally.estimates[scope][subset][name]
        assert tally.resampled[scope, subset, name] == pytest.approx(value, abs=2e-6)


@dataclass
class _Known:
    """What SciPy needs of an earlier bootstrap: its distribution."""

    bootstrap_distribution: np.ndarray


def test_intervals_equal_those_of_scipy_on_the_same_resamples() -> None:
    """SciPy's percentile bootstrap of the same weights gives the same ends."""
    o, yardstick = observe(COUNTS), Yardstick.of(COUNTS)
    tally = tally_scores(o, EVERYTHING, yardstick)
    score = tally.assemble(["alpha_one"])["alpha_one"]["all"].metrics["accuracy"]
    mask = COUNTS.in_scenario("alpha_one")
    by_pair = np.bincount(o.pairs[mask], o.credits[mask]) / 2
    weights = yardstick.draws.pairs[: by_pair.size]
    known = _Known(np.array([np.repeat(by_pair, w.astype(int)).mean() for w in weights.T]))
    expected = stats.bootstrap(
        (by_pair,), np.mean, n_resamples=0, bootstrap_result=known, method="percentile"
    ).confidence_interval
    assert (score.low, score.high) == pytest.approx((expected.low, expected.high), abs=1e-6)


def test_resamples_without_variance_are_counted() -> None:
    """A correlation over few pairs has no value where they do not vary; the result says how often."""
    probabilities = np.full(COUNTS.n_trials, 0.5)
    probabilities[:2] = (0.1, 0.9)
    tally = tally_scores(observe(COUNTS, probabilities), EVERYTHING, Yardstick.of(COUNTS))
    score = tally.assemble(["alpha_one"])["alpha_one"]["all"].metrics["human_r"]
    assert score.undefined_resamples == int(
        (tally.resampled["alpha_one", "all", "human_r"] != 0).sum()
    ) - int(np.isfinite(tally.resampled["alpha_one", "all", "human_r"]).sum())
    assert 0 < (score.undefined_resamples or 0) < 200


def test_values_that_differ_in_the_ninth_decimal_have_an_interval() -> None:
    """Correlations are computed from centred and scaled values, so the grid is never too coarse."""
    nearly_equal = build_submission(COUNTS, (0.6 + 1e-9 * PROBABILITIES).tolist())
    tally = tally_scores(Observations.of(nearly_equal, COUNTS), EVERYTHING, Yardstick.of(COUNTS))
    found = tally.resampled["Alpha", "all", "human_r"]
    assert np.isfinite(found).all()
    assert found.std() > 0.01


@pytest.mark.parametrize("reference", [REFERENCE, COUNTS], ids=["responses", "counts"])
def test_every_number_but_p_values_has_an_interval_within_its_range(reference: Reference) -> None:
    """Low and high are within the metric's range and in order."""
    result = grade(build_submission(reference, PROBABILITIES.tolist()), reference)
    for subsets in result.scores.values():
        for scores in subsets.values():
            for name, score in scores.metrics.items():
                metric = find_metric(name)
                if metric.is_p_value or score.value is None:
                    assert score.low is None
                    continue
                assert score.low is not None
                assert score.high is not None
                assert metric.low <= score.low <= score.high <= metric.high


def test_the_same_draws_serve_every_submission() -> None:
    """With a yardstick or without: the same bytes, whatever was graded before."""
    yardstick = Yardstick.of(REFERENCE)
    submissions = [build_submission(REFERENCE, q.tolist()) for q in (PROBABILITIES, 1 - PROBABILITIES)]
    with_one = [grade(s, REFERENCE, yardstick=yardstick) for s in submissions]
    assert with_one == [grade(s, REFERENCE) for s in submissions]
    assert isinstance(tally_scores(observe(REFERENCE), EVERYTHING, yardstick), Tally)


@pytest.mark.parametrize("reference", [REFERENCE, COUNTS], ids=["responses", "counts"])
def test_scores_are_the_same_whether_resamples_are_kept(reference: Reference) -> None:
    """Intervals made at once, from memory that then serves the next, are those made in the end."""
    yardstick, o = Yardstick.of(reference), observe(reference)
    kept = tally_scores(o, EVERYTHING, yardstick)
    dropped = tally_scores(o, EVERYTHING, yardstick, keeps_resamples=False)
    scopes = list(kept.estimates)
    assert kept.assemble(scopes) == dropped.assemble(scopes)
    assert kept.resampled
    assert not dropped.resampled


@pytest.mark.parametrize("subsets", [("all",), ("easy", "hard"), ("all", "easy_crossfit")], ids=str)
def test_a_subset_is_scored_the_same_without_the_others(subsets: tuple[str, ...]) -> None:
    """Who wants only some gets only these, with the same resamples."""
    yardstick, o = Yardstick.of(REFERENCE), observe(REFERENCE)
    whole = tally_scores(o, EVERYTHING, yardstick)
    part = tally_scores(o, EVERYTHING, yardstick, subsets=subsets)
    assert {subset for scope in part.estimates.values() for subset in scope} == set(subsets)
    for scope, scores in part.estimates.items():
        assert scores == {subset: whole.estimates[scope][subset] for subset in scores}
    assert part.resampled
    for key, values in part.resampled.items():
        np.testing.assert_array_equal(values, whole.resampled[key])


@pytest.mark.parametrize("metrics", [("accuracy", "human_r"), ("auc", "cohen_kappa")], ids=str)
def test_a_metric_is_scored_the_same_without_the_others(metrics: tuple[str, ...]) -> None:
    """Who wants only some gets these, and the p-value that pools properties, with the same resamples."""
    yardstick, o = Yardstick.of(REFERENCE), observe(REFERENCE)
    whole = tally_scores(o, EVERYTHING, yardstick, subsets=("all",))
    part = tally_scores(o, EVERYTHING, yardstick, subsets=("all",), metrics=metrics)
    assert {metric for _, _, metric in part.resampled} == set(metrics)
    for scope, scores in part.estimates.items():
        assert set(metrics) <= scores["all"].keys() <= {*metrics, "accuracy_p"}
        assert scores["all"] == {metric: whole.estimates[scope]["all"][metric] for metric in scores["all"]}
    for key, values in part.resampled.items():
        np.testing.assert_array_equal(values, whole.resampled[key])


def test_a_reference_too_large_for_float32_gives_the_same_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is summed in float32 while that is exact is summed in float64 beyond."""
    small = tally_scores(observe(REFERENCE), EVERYTHING, Yardstick.of(REFERENCE)).resampled
    monkeypatch.setattr("leaderboard.grading.draws.EXACT_IN_FLOAT32", 0)
    yardstick = Yardstick.of(REFERENCE)
    large = tally_scores(observe(REFERENCE), EVERYTHING, yardstick).resampled
    assert yardstick.draws.small_pairs.dtype == np.float64
    assert small.keys() == large.keys()
    assert all(np.array_equal(small[key], large[key], equal_nan=True) for key in small)
