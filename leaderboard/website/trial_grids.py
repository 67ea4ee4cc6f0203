"""All trials at a glance: a square for each pair, shaded by how much of it is right."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from leaderboard.metrics.accuracy import Floats
from leaderboard.models.benchmark import OVERALL, Scenario
from leaderboard.ranking import Entry
from leaderboard.website.describing import count_of, submission_path, submission_trials_path
from leaderboard.website.material import Material
from leaderboard.website.numbers import ABSENT
from leaderboard.website.pages import Link
from leaderboard.website.trial_pages import GridCell, GridPage, GridRow, GridSection
from leaderboard.website.trial_paths import (
    TRIALS_PATH,
    TRIALS_TABLE,
    list_path,
    scenario_anchor,
    trial_anchor,
)
from leaderboard.website.trial_rows import TrialRows
from leaderboard.website.trial_tables import link_choices, name_row

N_LEVELS = 5
SHARES = (
    ("0", "below 20 %"),
    ("1", "20 to 40 %"),
    ("2", "40 to 60 %"),
    ("3", "60 to 80 %"),
    ("4", "80 % and more"),
)
OF_PAIR = (("0", "none right"), ("2", "one"), ("4", "both right"))
OF_TRIAL = (("0", "wrong"), ("2", "at 0.5"), ("4", "right"))
OF_PEOPLE = "% of people's answers right"
OF_SUBMISSIONS = "% of ranked submissions right throughout"
OF_CREDIT = "how many of its trials are right"


def compose_trials(material: Material) -> GridPage:
    """Gather what the page of all trials shows: how much of each pair people, or submissions, get right."""
    rows = TrialRows.of(material)
    shares, words = _judge_rows(rows)
    return GridPage(
        path=TRIALS_PATH,
        title="Trials",
        summary=_describe_size(material),
        back=None,
        choices=link_choices(material, rows),
        note=_explain_squares(material, words),
        legend=SHARES,
        sections=tuple(_Grid(material, rows, shares, _show_percent(words)).list_sections()),
        table=Link("All trials as a table (CSV)", TRIALS_TABLE),
    )


def compose_submission_trials(material: Material) -> Iterator[GridPage]:
    """Gather a page for each submission: how much of each pair it gets right."""
    rows = TrialRows.of(material)
    for entry in (publication.entry for publication in material.publications):
        name = entry.metadata.submission.name
        grid = _Grid(material, rows, _mean_credits(entry, rows), _show_credit)
        yield GridPage(
            path=submission_trials_path(entry.slug),
            title=f"{name}, trial by trial",
            summary=_describe_size(material),
            back=Link(name, submission_path(entry.slug)),
            choices=(),
            note=_explain_squares(material, OF_CREDIT),
            legend=OF_PAIR if material.has_pairs else OF_TRIAL,
            sections=tuple(grid.list_sections()),
        )


def _judge_rows(rows: TrialRows) -> tuple[Floats, str]:
    """Say how much of each row is right for people, without these for submissions, and what that counts."""
    if rows.reference.people is not None or not rows.n_ranked:
        return rows.share_right(), OF_PEOPLE
    return rows.n_right / rows.n_ranked, OF_SUBMISSIONS


def _mean_credits(entry: Entry, rows: TrialRows) -> Floats:
    """Give the mean credit of the trials of each row, NaN where none has an answer; (n_trials,)."""
    credits = np.where(np.isnan(entry.probabilities), 0, entry.credits)
    twins = np.where(rows.twins < 0, np.arange(credits.size), rows.twins)
    means: Floats = (credits + credits[twins]) / 2
    means[rows.all_of_row(np.isnan(entry.probabilities))] = np.nan
    return means


def _describe_size(material: Material) -> str:
    count = material.count(OVERALL)
    in_pairs = f" in {count_of(count.n_pairs, 'pair')}" if count.n_pairs else ""
    return f"“{material.reference.benchmark.question}” asked of {count_of(count.n, 'trial')}{in_pairs}."


def _explain_squares(material: Material, words: str) -> str:
    kind = "pair" if material.has_pairs else "trial"
    return f"Each square is a {kind} and leads to its row in the lists. The number in it: {words}."


_Show = Callable[[float, int], tuple[str, str]]
"""From the share that is right of so many trials to the text of a square, and to what that says in words."""


def _show_percent(words: str) -> _Show:
    def show(share: float, _: int) -> tuple[str, str]:
        return f"{100 * share:.0f}", f"{100 * share:.0f} {words}"

    return show


def _show_credit(share: float, n_members: int) -> tuple[str, str]:
    """Print how many trials are right; one at 0.5 counts half.

    >>> _show_credit(0.5, 2), _show_credit(0.75, 2)
    (('1', '1 of 2 right'), ('1.5', '1.5 of 2 right'))
    """
    return f"{share * n_members:g}", f"{share * n_members:g} of {n_members} right"


@dataclass(frozen=True)
class _Grid:
    """Squares of all rows; ``shares`` is how much of each is right, (n_trials,)."""

    material: Material
    rows: TrialRows
    shares: Floats
    show: _Show

    def list_sections(self) -> Iterator[GridSection]:
        """Lay out all properties that have trials."""
        benchmark = self.material.reference.benchmark
        for property_ in benchmark.properties:
            path = list_path(property_.name)
            rows = (self._lay_out(scenario, path) for scenario in benchmark.scenarios_of(property_.name))
            filled = tuple(row for row in rows if row.cells)
            if filled:
                yield GridSection(f"of-{property_.name.lower()}", property_.name, filled)

    def _lay_out(self, scenario: Scenario, path: str) -> GridRow:
        pairs, alone = self.rows.list_rows(scenario.id)
        members = [*pairs.tolist(), *alone.tolist()]
        cells = tuple(self._shade(own, scenario, path) for own in members)
        return GridRow(Link(scenario.title, f"{path}#{scenario_anchor(scenario.id)}"), cells)

    def _shade(self, members: list[int], scenario: Scenario, path: str) -> GridCell:
        reference, share = self.material.reference, float(self.shares[members[0]])
        target = f"{path}#{trial_anchor(reference.trial_ids[members[0]])}"
        name = name_row(reference, members, scenario)
        if np.isnan(share):
            return GridCell(target, ABSENT, "", f"{name}: no answer")
        text, words = self.show(share, len(members))
        return GridCell(target, text, str(min(int(share * N_LEVELS), N_LEVELS - 1)), f"{name}: {words}")
