"""What a submission does trial by trial, drawn: agreement with people, and calibration."""

from collections.abc import Iterator, Sequence

import numpy as np

from leaderboard.grading import find_metric
from leaderboard.metrics.accuracy import Booleans, Floats
from leaderboard.metrics.calibration import find_bins
from leaderboard.metrics.published import Z, wilson_interval
from leaderboard.models import Bin
from leaderboard.models.benchmark import OVERALL
from leaderboard.ranking import Entry
from leaderboard.reference import People
from leaderboard.website.describing import answers_of, warn_of_simulation
from leaderboard.website.figures.calibration import Diagram, Interval, draw_diagram
from leaderboard.website.figures.marks import Drawing
from leaderboard.website.figures.readings import read_score
from leaderboard.website.figures.scatter import Scatter, draw_scatter
from leaderboard.website.material import Material
from leaderboard.website.pair_figures import mask_of
from leaderboard.website.quantities import find_quantity
from leaderboard.website.score_tables import list_scopes

TOWARD_LABEL = (
    "How often YES was right, by submitted probability; bars are 95 % Wilson intervals that take trials as "
    "independent. On the dashed line probabilities mean what they say."
)
TOWARD_PEOPLE = (
    "Mean share of people who said YES, by submitted probability; bars are 95 % intervals of that mean over "
    "trials. On the dashed line the submission is as sure as people are divided."
)
ONE_POINT = "One point per trial."
MIN_FOR_INTERVAL = 2


def draw_calibrations(entry: Entry, material: Material) -> tuple[Drawing, ...]:
    """Draw the reliability diagrams overall, or of what is covered of the properties where not all are."""
    calibration = entry.result.calibration
    scopes = [OVERALL] if OVERALL in calibration else list(calibration)
    return tuple(drawing for scope in scopes for drawing in _draw_calibration(entry, material, scope))


def _draw_calibration(entry: Entry, material: Material, scope: str) -> Iterator[Drawing]:
    calibration, warning = entry.result.calibration[scope], warn_of_simulation(material)
    where = "" if scope == OVERALL else f", {scope}"
    key = f"calibration-{scope}"
    yield draw_diagram(
        Diagram(
            key=f"{key}-label",
            title=f"Toward the label{where}",
            caption=TOWARD_LABEL,
            bins=calibration.label,
            intervals=[_find_wilson(bin_) for bin_ in calibration.label],
            axis="YES was right",
            warning=warning,
        )
    )
    people = material.reference.people
    if people and calibration.people:
        chosen = mask_of(material.reference, scope) & (people.n > 0)
        yield draw_diagram(
            Diagram(
                key=f"{key}-people",
                title=f"Toward people{where}",
                caption=TOWARD_PEOPLE,
                bins=calibration.people,
                intervals=_spread_people(people, answers_of(entry), chosen, calibration.people),
                axis="people said YES",
                warning=warning,
                is_people=True,
            )
        )


def _find_wilson(bin_: Bin) -> Interval:
    return wilson_interval(bin_.observed, bin_.n) if bin_.observed is not None and bin_.n else None


def _spread_people(people: People, answers: Floats, chosen: Booleans, bins: Sequence[Bin]) -> list[Interval]:
    """Find the interval of the mean share in each bin, from how shares differ between the chosen trials."""
    shares = people.n_yes[chosen] / people.n[chosen]
    numbers = find_bins(answers[chosen])
    intervals: list[Interval] = []
    for number, bin_ in enumerate(bins):
        inside = shares[numbers == number]
        if inside.size < MIN_FOR_INTERVAL or bin_.observed is None:
            intervals.append(None)
            continue
        half = Z * float(inside.std(ddof=1)) / float(np.sqrt(inside.size))
        intervals.append((max(bin_.observed - half, 0), min(bin_.observed + half, 1)))
    return intervals


def draw_agreement(entry: Entry, material: Material) -> Iterator[Drawing]:
    """Draw the submission against people, as far as these judged what it answered."""
    people = material.reference.people
    if people is None:
        return
    shown = (people.n > 0) & ~np.isnan(entry.probabilities)
    if not shown.any():
        return
    statement = _describe_agreement(entry, material)
    yield draw_scatter(
        Scatter(
            key="scatter",
            title="Model against people",
            caption=f"{ONE_POINT} {statement}",
            statement=statement,
            trials=np.flatnonzero(shown) + 1,  # as in the table of all trials; ids would be most of the file
            shares=people.n_yes[shown] / people.n[shown],
            probabilities=entry.probabilities[shown],
            labels=material.reference.labels[shown],
            warning=warn_of_simulation(material),
        )
    )


def _describe_agreement(entry: Entry, material: Material) -> str:
    """Say human r, its interval and its ceiling, overall or of what is covered."""
    metric, ceiling = find_metric("human_r"), find_quantity("ceiling")
    scopes = list_scopes(entry, material.reference.benchmark, "all")
    graded = [(scope, title, level) for scope, title, level in scopes if entry.score("human_r", scope)]
    highest = min((level for _, _, level in graded), default=0)
    parts = []
    for scope, title, _ in (whole for whole in graded if whole[2] == highest):
        name = metric.title if scope == OVERALL else f"{metric.title}, {title}"
        parts.append(read_score(metric, name, entry.score("human_r", scope)))
        limit = material.people_score(ceiling.name, scope, "all")
        if limit and limit.value is not None:
            parts.append(read_score(ceiling, "ceiling", limit))
    pooled = (
        " All properties together; overall r is the mean of theirs."
        if highest == 0 and len(graded) > 1
        else ""
    )
    return f"{'; '.join(parts)}.{pooled}" if parts else ""
