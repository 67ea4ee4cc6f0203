"""What the site prints besides the metrics of a submission: figures of people, and of boards."""

from dataclasses import dataclass
from math import inf
from typing import Protocol

from leaderboard.grading.metrics import Direction


class Described(Protocol):
    """What must be known of a number to print and explain it; every metric has it."""

    @property
    def name(self) -> str:
        """As in files."""

    @property
    def title(self) -> str:
        """For people."""

    @property
    def meaning(self) -> str:
        """What it is, in one sentence."""

    @property
    def direction(self) -> Direction:
        """Which end is better."""

    @property
    def low(self) -> float:
        """The lower end of its range; may be infinite."""

    @property
    def high(self) -> float:
        """The upper end of its range; may be infinite."""

    @property
    def chance(self) -> float | None:
        """What guessing gives, where that is one number."""

    @property
    def is_p_value(self) -> bool:
        """Whether it is a p-value."""


@dataclass(frozen=True)
class Quantity:
    """A number that is no metric of one submission alone."""

    name: str
    title: str
    meaning: str
    direction: Direction
    low: float
    high: float
    chance: float | None = None
    is_p_value: bool = False


OF_PEOPLE: tuple[Quantity, ...] = (
    Quantity(
        "split_half_r",
        "Split-half r",
        "Correlation between the means of two random halves of the people, averaged over many halvings.",
        "none",
        -1,
        1,
        0,
    ),
    Quantity(
        "reliability",
        "Reliability",
        "How well other people would reproduce the human means: the split-half r, stepped up to all people "
        "(Spearman-Brown); from counts where single responses are unknown.",
        "none",
        -inf,
        1,
        0,
    ),
    Quantity(
        "reliability_from_counts",
        "Reliability from counts",
        "The same from numbers of answers alone: 1 less the share of the variance of human means that the "
        "sampling of people explains.",
        "none",
        -inf,
        1,
        0,
    ),
    Quantity(
        "ceiling",
        "Ceiling of human r",
        "The highest human r that noise in people's answers allows: the square root of the reliability.",
        "none",
        0,
        1,
    ),
)
"""How well people agree with each other; on whole properties, and overall."""

OF_BOARDS: tuple[Quantity, ...] = (
    Quantity(
        "best_probability",
        "Probability of being best",
        "Share of resamples in which a submission has the highest accuracy of its board; ties share.",
        "higher",
        0,
        1,
    ),
    Quantity(
        "property_gain",
        "Property gain",
        "Accuracy with property inference minus that of the same system without, with an exact two-sided p "
        "of the paired sign-flip test over pairs.",
        "higher",
        -1,
        1,
        0,
    ),
    Quantity(
        "detectable_difference",
        "Smallest detectable difference",
        "The difference in accuracy between two submissions of a board that a paired test finds in 80 % of "
        "cases.",
        "none",
        0,
        1,
    ),
)
"""What submissions are beside each other."""

OF_COMPARISONS: tuple[Quantity, ...] = (
    Quantity(
        "accuracy_difference",
        "Difference in accuracy",
        "Accuracy of one submission minus that of another, its interval from the same resamples for both.",
        "none",
        -1,
        1,
    ),
    Quantity(
        "paired_p",
        "Exact p of a difference",
        "Two-sided p of the paired sign-flip test over pairs; overall pools the pairs of all properties.",
        "none",
        0,
        1,
        is_p_value=True,
    ),
    Quantity(
        "human_r_difference",
        "Difference in human r",
        "Human r of one submission minus that of another, its interval from the same resamples for both.",
        "none",
        -2,
        2,
    ),
    Quantity(
        "rival_kappa",
        "Kappa of two submissions",
        "Cohen's kappa between the answers of two submissions: their agreement beyond chance.",
        "none",
        -1,
        1,
        0,
    ),
)
"""What two submissions are compared by."""


def find_quantity(name: str) -> Quantity:
    """Look up what is no metric of one submission alone; the name must be one of those above."""
    known = (*OF_PEOPLE, *OF_BOARDS, *OF_COMPARISONS)
    return next(quantity for quantity in known if quantity.name == name)
