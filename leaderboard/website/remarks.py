"""What stands below a board: how to read its numbers, and how sure they are."""

from collections.abc import Iterator

from leaderboard.grading.scopes import CROSSFIT_SUBSETS
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Board
from leaderboard.website.describing import count_of, describe_subset, list_subsets
from leaderboard.website.material import Material
from leaderboard.website.numbers import show_percent
from leaderboard.website.pages import Fact


def list_remarks(board: Board, material: Material) -> tuple[Fact, ...]:
    """Explain what the board shows, as far as it shows it."""
    facts = [Fact("How sure", describe_intervals(material)), *_explain_ranks(board)]
    if any(row.gain for row in board.ranked):
        facts.append(Fact("Gain", GAIN))
    if material.people:
        facts.append(Fact("Ceiling", CEILING))
        facts += [Fact(subset.title(), describe_subset(subset, material)) for subset in ("easy", "hard")]
        facts.append(Fact("Caution", _warn_of_selection(material)))
    return tuple(facts)


GAIN = (
    "Accuracy minus that of the same system tested without property inference, in points, with its 95 % "
    "interval and the exact two-sided p of a paired sign-flip test."
)
CEILING = (
    "In the column of human r people have their ceiling, the highest r that noise in their answers allows: "
    "the square root of the reliability of their means. The share of the ceiling is r divided by it, "
    "property by property; it is not cut at 1."
)


def describe_intervals(material: Material) -> str:
    """Say how the intervals were made."""
    people = material.reference.people
    drawn = "pairs of trials" if material.has_pairs else "trials"
    of_people = " and, where their answers matter, people" if people and people.responses else ""
    resamples = count_of(material.reference.benchmark.grading.resamples, "resample")
    return (
        f"Below each score stands its 95 % interval: percentile bootstrap over {drawn} within "
        f"scenarios{of_people}, {resamples}, the same for all submissions."
    )


def _explain_ranks(board: Board) -> Iterator[Fact]:
    if not any(row.standing for row in board.ranked):
        return
    yield Fact(
        "Rank set",
        "Below each rank stands its 95 % rank set: the ranks that paired tests against all other submissions "
        "of the board do not exclude.",
    )
    yield Fact(
        "Best",
        "Among the best are the first and all that an exact paired test cannot tell from it, at 5 % and "
        "corrected for the number of tests (Holm).",
    )
    if isinstance(board.detectable, float):
        points = show_percent(board.detectable)
        yield Fact(
            "Detectable",
            f"A difference of {points} points is found in 80 % of cases with so many trials, a smaller one "
            "less often.",
        )


def _warn_of_selection(material: Material) -> str:
    both = " A pair can be easy and hard at once." if material.has_pairs else ""
    return (
        "Trials are chosen and people measured on the same responses, so people look better on easy and "
        f"worse on hard trials than they are{_measure_selection(material)}. The accuracy of submissions is "
        f"free of that.{both}"
    )


def _measure_selection(material: Material) -> str:
    """Put people's accuracy by the rule beside that of people who did not choose the trials."""
    if CROSSFIT_SUBSETS[0] not in list_subsets(material):
        return ""
    subsets = ("easy", "hard", *CROSSFIT_SUBSETS)
    scores = [material.people_score("accuracy", OVERALL, subset) for subset in subsets]
    shown = [show_percent(score.value) for score in scores if score and score.value is not None]
    if len(shown) < len(subsets):
        return ""
    easy, hard, easy_crossfit, hard_crossfit = shown
    return (
        f": {easy} % on easy and {hard} % on hard trials, but {easy_crossfit} % and {hard_crossfit} % where "
        "one half of the people chooses and the other half is measured (cross-fitted)"
    )
