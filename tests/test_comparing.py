"""Two submissions side by side, against brute force and against themselves exchanged."""

from dataclasses import replace

import numpy as np
import pytest

from builders import build_reference, build_submission
from leaderboard.comparing import Comparison, Contender, ScopeComparison, compare, compare_contenders
from leaderboard.errors import LeaderboardError
from leaderboard.grading import Yardstick, tally_scores
from leaderboard.grading.draws import Draws
from leaderboard.grading.observations import Observations
from leaderboard.metrics.resampling import Interval
from leaderboard.metrics.undefined import Undefined
from leaderboard.reference import Reference
from leaderboard.submission import Submission

REFERENCE = build_reference(6)


def _submission(slug: str, seed: int, reference: Reference = REFERENCE) -> Submission:
    probabilities = np.round(np.random.default_rng(seed).random(reference.n_trials), 2)
    return replace(build_submission(reference, probabilities.tolist()), slug=slug)


A, B = _submission("aaa", 1), _submission("bbb", 2)


def _scope(comparison: Comparison, name: str) -> ScopeComparison:
    return next(scope for scope in comparison.scopes if scope.name == name)


def test_every_shared_scope_is_compared() -> None:
    """Overall, properties and scenarios, with their trials and pairs."""
    comparison = compare(A, B, REFERENCE)
    assert [(s.name, s.n, s.n_pairs) for s in comparison.scopes] == [
        ("overall", 36, 18),
        ("Alpha", 24, 12),
        ("alpha_one", 12, 6),
        ("alpha_two", 12, 6),
        ("Beta", 12, 6),
        ("beta_one", 12, 6),
    ]


def test_the_interval_of_accuracy_equals_a_loop_over_resamples() -> None:
    """Each resample is put together trial by trial, and overall is the mean of the properties."""
    credits = {
        s.slug: np.where(s.probabilities == 0.5, 0.5, (s.probabilities > 0.5) == (REFERENCE.labels == 1))
        for s in (A, B)
    }
    draws = Draws.of(REFERENCE)
    means = []
    for weights in draws.pairs.T:
        parts = []
        for name in ("Alpha", "Beta"):
            trials = np.flatnonzero(REFERENCE.in_property(name))
            drawn = [t for t in trials for _ in range(int(weights[REFERENCE.pairs[t]]))]
            parts.append(np.mean([credits["aaa"][t] - credits["bbb"][t] for t in drawn]))
        means.append(np.mean(parts))
    low, high = np.percentile(means, [2.5, 97.5])
    found = _scope(compare(A, B, REFERENCE), "overall").difference
    assert (found.low, found.high) == pytest.approx((low, high), abs=1e-12)


def test_the_interval_of_human_r_is_of_the_difference_on_each_resample() -> None:
    """The same pairs and people are drawn for both, so what moves both alike leaves the difference alone."""
    yardstick, everything = Yardstick.of(REFERENCE), np.ones(REFERENCE.n_trials, bool)
    tallies = [tally_scores(Observations.of(s, REFERENCE), everything, yardstick) for s in (A, B)]
    a, b = (tally.resampled["Beta", "all", "human_r"] for tally in tallies)
    found = _scope(compare(A, B, REFERENCE), "Beta").human_r_difference
    assert isinstance(found, Interval)
    assert (found.low, found.high) == pytest.approx(np.nanpercentile(a - b, [2.5, 97.5]), abs=1e-12)
    assert found.n_undefined == np.isnan(a - b).sum()


def test_contenders_are_made_once_for_any_number_of_comparisons() -> None:
    """Compared with others before or not, the numbers are those of comparing the two alone."""
    yardstick, everything = Yardstick.of(REFERENCE), np.ones(REFERENCE.n_trials, bool)
    a, b, c = (
        Contender.of(s, everything, yardstick) for s in (A, B, replace(A, probabilities=A.probabilities / 2))
    )
    compare_contenders(a, c, reference=REFERENCE)
    compare_contenders(c, b, reference=REFERENCE)
    assert compare_contenders(a, b, reference=REFERENCE) == compare(A, B, REFERENCE)


def test_exchanging_the_two_turns_every_sign_and_keeps_p() -> None:
    """A against B is B against A seen from the other side."""
    forward, backward = compare(A, B, REFERENCE), compare(B, A, REFERENCE)
    for one, other in zip(forward.scopes, backward.scopes, strict=True):
        assert (one.p, one.kappa) == (other.p, other.kappa)
        assert one.difference.value == -other.difference.value
        ends = (-other.difference.high, -other.difference.low)
        assert (one.difference.low, one.difference.high) == pytest.approx(ends, abs=1e-12)
        assert one.overlap.n_only_a == other.overlap.n_only_b
        assert one.overlap.n_pairs_a == other.overlap.n_pairs_b


def test_a_submission_does_not_differ_from_itself() -> None:
    """No difference, p of 1, full agreement, and nothing in which one is better."""
    scope = _scope(compare(A, A, REFERENCE), "overall")
    assert (scope.difference, scope.p) == (Interval(0.0, 0.0, 0.0), 1.0)
    assert (scope.overlap.n_only_a, scope.overlap.n_pairs_a, scope.overlap.n_pairs_equal) == (0, 0, 18)
    assert scope.kappa == pytest.approx(1.0)


def test_counts_add_up_to_trials_and_pairs() -> None:
    """Every trial and every pair is in one cell."""
    for scope in compare(A, B, REFERENCE).scopes:
        o = scope.overlap
        assert o.n_both_right + o.n_only_a + o.n_only_b + o.n_neither == scope.n
        assert o.n_pairs_a + o.n_pairs_b + o.n_pairs_equal == scope.n_pairs


def test_the_largest_differences_come_first_and_ties_by_id() -> None:
    """Ten trials at most, in an order that does not depend on the file's."""
    trials = compare(A, B, REFERENCE).trials
    distances = [abs(t.probability_a - t.probability_b) for t in trials]
    assert len(trials) == 10
    assert distances == sorted(distances, reverse=True)
    same = build_submission(REFERENCE, [0.9] * REFERENCE.n_trials)
    other = build_submission(REFERENCE, [0.1] * REFERENCE.n_trials)
    ids = [t.trial_id for t in compare(same, other, REFERENCE).trials]
    assert ids == sorted(REFERENCE.trial_ids)[:10]


def test_only_what_both_cover_is_compared() -> None:
    """A partial submission is compared where it can be."""
    covered = REFERENCE.in_property("Beta").tolist()
    partial = build_submission(REFERENCE, [0.5] * REFERENCE.n_trials, answered=covered, covered=covered)
    assert [s.name for s in compare(A, partial, REFERENCE).scopes] == ["Beta", "beta_one"]
    rest = (~REFERENCE.in_property("Beta")).tolist()
    other = build_submission(REFERENCE, [0.5] * REFERENCE.n_trials, answered=rest, covered=rest)
    with pytest.raises(LeaderboardError, match="cover no scenario in common"):
        compare(partial, other, REFERENCE)


def test_what_has_no_value_says_why() -> None:
    """Constant predictions have no correlation; without people there is none at all."""
    constant = build_submission(REFERENCE, [0.9] * REFERENCE.n_trials)
    scope = _scope(compare(constant, constant, REFERENCE), "overall")
    assert scope.human_r_difference == Undefined("A has no human r: all probabilities are equal")
    assert scope.kappa == Undefined("both give one and the same answer to every trial")
    bare = build_reference(6, n_people=0)
    scope = _scope(compare(_submission("a", 1, bare), _submission("b", 2, bare), bare), "overall")
    assert scope.human_r_difference == Undefined("the reference has no human data")


def test_with_counts_only_people_are_fixed() -> None:
    """Without single responses only pairs are drawn, and the interval is narrower or equal in trend."""
    counts = build_reference(6, responses=False)
    assert Draws.of(counts).people is None
    found = _scope(compare(_submission("a", 1, counts), _submission("b", 2, counts), counts), "Beta")
    assert isinstance(found.human_r_difference, Interval)


def test_one_trial_has_no_kappa_for_another_reason() -> None:
    """Two that differ on the only trial of a scope do not give one and the same answer."""
    kept = [0, *range(12, 36)]
    names = ("properties", "scenarios", "pairs", "copies", "labels")
    arrays = {name: getattr(REFERENCE, name)[kept] for name in names}
    trial_ids = tuple(REFERENCE.trial_ids[index] for index in kept)
    reference = replace(REFERENCE, trial_ids=trial_ids, people=None, **arrays)
    yes, no = (build_submission(reference, [p] * len(kept)) for p in (0.9, 0.1))
    assert _scope(compare(yes, no, reference), "alpha_one").kappa == Undefined("there is but one trial")
    why = "both give one and the same answer to every trial"
    assert _scope(compare(yes, yes, reference), "alpha_two").kappa == Undefined(why)
