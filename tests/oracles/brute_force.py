"""Every metric once more, from docs/method.md alone: plain Python, loops and fractions, no NumPy.

Nothing here is shared with the package. A metric that its formula leaves undefined is None.
"""

import itertools
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True)
class Trial:
    """One trial with everything that is known of it; ``votes`` maps a person to 1 (YES) or 0 (NO)."""

    pair: str
    label: int
    probability: float
    is_answered: bool
    votes: dict[str, int]

    @property
    def q(self) -> float:
        return self.probability if self.is_answered else 0.5

    @property
    def credit(self) -> Fraction:
        if not self.is_answered:
            return Fraction(0)
        if self.probability == 0.5:
            return Fraction(1, 2)
        return Fraction(int((self.probability > 0.5) == (self.label == 1)))

    @property
    def human_mean(self) -> Fraction:
        return Fraction(sum(self.votes.values()), len(self.votes))

    @property
    def human_accuracy(self) -> Fraction:
        return self.human_mean if self.label == 1 else 1 - self.human_mean


Trials = Sequence[Trial]


def accuracy(trials: Trials) -> Fraction:
    return sum((t.credit for t in trials), Fraction(0)) / len(trials)


def accuracy_p(trials: Trials) -> Fraction:
    """Enumerate every pattern of signs."""
    differences = []
    for members in _by_pair(trials):
        if len(members) == 2 and members[0].label != members[1].label:
            answered = sum(t.is_answered for t in members)
            differences.append(sum((t.credit for t in members), Fraction(0)) - Fraction(answered, 2))
        else:
            differences += [t.credit - Fraction(1, 2) if t.is_answered else Fraction(0) for t in members]
    observed = sum(differences, Fraction(0))
    patterns = list(itertools.product((1, -1), repeat=len(differences)))
    reached = sum(
        sum(s * d for s, d in zip(signs, differences, strict=True)) >= observed for signs in patterns
    )
    return Fraction(reached, len(patterns))


def human_r(trials: Trials) -> float | None:
    rated = [t for t in trials if t.votes]
    return _pearson([Fraction(t.q) for t in rated], [t.human_mean for t in rated])


def human_r_partial(trials: Trials) -> float | None:
    """Correlate the residuals of two least-squares lines on the label, in exact fractions."""
    rated = [t for t in trials if t.votes]
    q, h, y = (
        [Fraction(t.q) for t in rated],
        [t.human_mean for t in rated],
        [Fraction(t.label) for t in rated],
    )
    if _pearson(q, h) is None:
        return None
    return _pearson(_residuals(q, y), _residuals(h, y))


def human_rmse(trials: Trials) -> float | None:
    rated = [t for t in trials if t.votes]
    if not rated:
        return None
    return math.sqrt(sum((Fraction(t.q) - t.human_mean) ** 2 for t in rated) / len(rated))


def human_gap(trials: Trials) -> Fraction | None:
    rated = [t for t in trials if t.votes]
    if not rated:
        return None
    return accuracy(rated) - sum((t.human_accuracy for t in rated), Fraction(0)) / len(rated)


def error_consistency(trials: Trials) -> float | None:
    return _mean_kappa(trials, lambda t: t.credit, lambda t, vote: int(vote == t.label))


def cohen_kappa(trials: Trials) -> float | None:
    return _mean_kappa(trials, _answer, lambda _, vote: vote)


def pair_accuracy(trials: Trials) -> Fraction | None:
    pairs = [members for members in _by_pair(trials) if len(members) == 2]
    if not pairs:
        return None
    return sum((a.credit * b.credit for a, b in pairs), Fraction(0)) / len(pairs)


def pair_order(trials: Trials) -> Fraction | None:
    points = []
    for members in _by_pair(trials):
        if len(members) == 2 and members[0].label != members[1].label:
            yes, no = members if members[0].label else members[::-1]
            points.append(Fraction(1, 2) if yes.q == no.q else Fraction(int(yes.q > no.q)))
    return sum(points, Fraction(0)) / Fraction(len(points)) if points else None


def auc(trials: Trials) -> Fraction | None:
    yes = [t.q for t in trials if t.label == 1]
    no = [t.q for t in trials if t.label == 0]
    if not yes or not no:
        return None
    wins = [Fraction(1, 2) if a == b else Fraction(int(a > b)) for a in yes for b in no]
    return sum(wins, Fraction(0)) / len(wins)


def brier(trials: Trials) -> Fraction:
    return sum(((Fraction(t.q) - t.label) ** 2 for t in trials), Fraction(0)) / len(trials)


def ece(trials: Trials) -> Fraction:
    """Sort into bins (0, .1], (.1, .2], ...; bounds are decimals as Python reads them."""
    total = Fraction(0)
    for number in range(1, 11):
        low, high = (number - 1) / 10, number / 10
        inside = [t for t in trials if low < t.q <= high or (number == 1 and t.q == 0)]
        if inside:
            mean_q = sum((Fraction(t.q) for t in inside), Fraction(0)) / len(inside)
            mean_y = Fraction(sum(t.label for t in inside), len(inside))
            total += Fraction(len(inside), len(trials)) * abs(mean_y - mean_q)
    return total


def human_ece(trials: Trials) -> Fraction | None:
    """The same over rated trials, with the share of people who said YES for the label."""
    rated = [t for t in trials if t.votes]
    total = Fraction(0)
    for number in range(1, 11):
        low, high = (number - 1) / 10, number / 10
        inside = [t for t in rated if low < t.q <= high or (number == 1 and t.q == 0)]
        total += abs(sum((Fraction(t.q) - t.human_mean for t in inside), Fraction(0)))
    return total / len(rated) if rated else None


def yes_rate(trials: Trials) -> Fraction:
    return sum((_answer(t) for t in trials), Fraction(0)) / len(trials)


RELIABILITY = 0.25
"""That of the people, to hold the share of the ceiling against."""


def human_r_normalized(trials: Trials) -> float | None:
    r = human_r(trials)
    return None if r is None else r / 0.5  # the square root of the reliability


METRICS: dict[str, Callable[[Trials], Fraction | float | None]] = {
    f.__name__: f
    for f in (
        accuracy,
        accuracy_p,
        human_r,
        human_r_normalized,
        human_r_partial,
        human_rmse,
        human_gap,
        error_consistency,
        cohen_kappa,
        pair_accuracy,
        pair_order,
        auc,
        brier,
        ece,
        human_ece,
        yes_rate,
    )
}


def select(trials: Trials, subset: str) -> list[Trial]:
    """Choose the trials of a subset: pairs with a member above 2/3, or below 1/3."""
    if subset == "all":
        return list(trials)
    chosen = []
    for members in _by_pair(trials):
        shares = [t.human_accuracy for t in members if t.votes]
        is_easy = any(share > Fraction(2, 3) for share in shares)
        is_hard = any(share < Fraction(1, 3) for share in shares)
        if is_easy if subset == "easy" else is_hard:
            chosen += members
    return chosen


def _answer(t: Trial) -> Fraction:
    return Fraction(1, 2) if t.q == 0.5 else Fraction(int(t.q > 0.5))


def _by_pair(trials: Iterable[Trial]) -> list[list[Trial]]:
    groups: dict[str, list[Trial]] = {}
    for trial in trials:
        groups.setdefault(trial.pair, []).append(trial)
    return list(groups.values())


def _pearson(x: Sequence[Fraction], y: Sequence[Fraction]) -> float | None:
    if len(x) < 2 or len(set(x)) == 1 or len(set(y)) == 1:
        return None
    mean_x, mean_y = _mean(x), _mean(y)
    covariance = sum(((a - mean_x) * (b - mean_y) for a, b in zip(x, y, strict=True)), Fraction(0))
    spread = sum((a - mean_x) ** 2 for a in x) * sum((b - mean_y) ** 2 for b in y)
    # Squares are divided before the root is taken, so that tiny numbers stay exact until then.
    return math.copysign(math.sqrt(covariance**2 / spread), covariance)


def _residuals(values: Sequence[Fraction], on: Sequence[Fraction]) -> list[Fraction]:
    mean, mean_on = _mean(values), _mean(on)
    spread = sum(((x - mean_on) ** 2 for x in on), Fraction(0))
    product = sum(((v - mean) * (x - mean_on) for v, x in zip(values, on, strict=True)), Fraction(0))
    slope = product / spread if spread else Fraction(0)
    return [v - mean - slope * (x - mean_on) for v, x in zip(values, on, strict=True)]


def _mean(values: Sequence[Fraction]) -> Fraction:
    return sum(values, Fraction(0)) / len(values)


def _mean_kappa(
    trials: Trials, model: Callable[[Trial], Fraction], person: Callable[[Trial, int], int]
) -> float | None:
    kappas = []
    for name in sorted({name for t in trials for name in t.votes}):
        a = [model(t) for t in trials if name in t.votes]
        b = [Fraction(person(t, t.votes[name])) for t in trials if name in t.votes]
        agreement = sum(1 - abs(x - y) for x, y in zip(a, b, strict=True)) / Fraction(len(a))
        p1, p2 = sum(a) / Fraction(len(a)), sum(b) / Fraction(len(b))
        chance = p1 * p2 + (1 - p1) * (1 - p2)
        if len(a) >= 2 and chance != 1:
            kappas.append((agreement - chance) / (1 - chance))
    return float(sum(kappas) / len(kappas)) if kappas else None
