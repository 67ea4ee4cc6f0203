"""Lists of trials: for each pair its labels, what people said, and how many submissions got it right."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from leaderboard.metrics.accuracy import Booleans
from leaderboard.models import Property
from leaderboard.models.benchmark import Scenario
from leaderboard.reference import Reference
from leaderboard.reference.data import Integers
from leaderboard.website.describing import count_of, property_path
from leaderboard.website.material import Material
from leaderboard.website.numbers import show_percent
from leaderboard.website.pages import Link
from leaderboard.website.trial_choices import Choice, list_choices
from leaderboard.website.trial_pages import (
    TrialCell,
    TrialChoices,
    TrialGroup,
    TrialListPage,
    TrialRow,
    TrialSection,
    TrialTable,
)
from leaderboard.website.trial_paths import choice_path, list_path, scenario_anchor, trial_anchor, trial_path
from leaderboard.website.trial_rows import HALF_CREDIT, TrialRows

LABELS = ("NO", "YES")
COUNT_TITLES = {2: ("Both right", "One", "None"), 1: ("Right", "Wrong")}
UNDECIDED = "At 0.5"


def compose_trial_lists(material: Material) -> Iterator[TrialListPage]:
    """Gather the lists of trials: one of each property, and one of each choice."""
    rows = TrialRows.of(material)
    lister, choices = _Lister(material, rows), tuple(list_choices(material, rows))
    for property_ in material.reference.benchmark.properties:
        inside = material.reference.in_property(property_.name)
        path, title = list_path(property_.name), f"Trials: {property_.name}"
        yield lister.compose(path, title, "", inside, choices)
    for choice in choices:
        path, title = choice_path(choice.key), f"Trials: {choice.title}"
        yield lister.compose(path, title, choice.meaning, choice.mask, choices)


def link_choices(material: Material, rows: TrialRows, current: str = "") -> tuple[TrialChoices, ...]:
    """Link all lists, each with the number of its rows; ``current`` is the path of the page itself."""
    return _link_lists(material, rows, tuple(list_choices(material, rows)), current)


def _link_lists(
    material: Material, rows: TrialRows, choices: tuple[Choice, ...], current: str
) -> tuple[TrialChoices, ...]:
    begins = rows.firsts == np.arange(len(rows.firsts))
    reference = material.reference

    def link(title: str, path: str, mask: Booleans) -> Link:
        return Link(title, path, f"{int((mask & begins).sum()):,}", is_current=path == current)

    names = [property_.name for property_ in reference.benchmark.properties]
    by_property = (link(name, list_path(name), reference.in_property(name)) for name in names)
    by_answers = (link(choice.title, choice_path(choice.key), choice.mask) for choice in choices)
    lists = (TrialChoices("By property", tuple(by_property)), TrialChoices("By answers", tuple(by_answers)))
    return tuple(group for group in lists if group.lists)


@dataclass(frozen=True)
class _Lister:
    """Lists trials."""

    material: Material
    rows: TrialRows

    @property
    def reference(self) -> Reference:
        return self.material.reference

    def compose(
        self, path: str, title: str, meaning: str, chosen: Booleans, choices: tuple[Choice, ...]
    ) -> TrialListPage:
        """Gather what a list of chosen trials shows."""
        n_trials = int(chosen.sum())
        n_pairs = int((chosen & (self.rows.twins >= 0)).sum()) // 2
        in_pairs = f" in {count_of(n_pairs, 'pair')}" if n_pairs else ""
        sections = (self._list_section(p, chosen) for p in self.reference.benchmark.properties)
        return TrialListPage(
            path=path,
            title=title,
            summary=f"{meaning} {count_of(n_trials, 'trial')}{in_pairs}.".strip(),
            choices=_link_lists(self.material, self.rows, choices, path),
            has_people=self.reference.people is not None,
            note=self._explain_counts(),
            sections=tuple(section for section in sections if section.groups),
        )

    def _explain_counts(self) -> str:
        if not self.rows.n_ranked:
            return ""
        who = count_of(self.rows.n_ranked, "ranked submission")
        return f"The last columns say how many of the {who} of all boards got how much of it right."

    def _list_section(self, property_: Property, chosen: Booleans) -> TrialSection:
        """List the chosen trials of a property by scenario."""
        groups = (
            TrialGroup(scenario_anchor(scenario.id), scenario.title, tuple(self._tabulate(scenario, chosen)))
            for scenario in self.reference.benchmark.scenarios_of(property_.name)
        )
        filled = tuple(group for group in groups if group.tables)
        return TrialSection(property_.name, property_path(property_.name), filled)

    def _tabulate(self, scenario: Scenario, chosen: Booleans) -> Iterator[TrialTable]:
        """Tabulate the chosen pairs of a scenario, and its trials without a twin, if there are any."""
        pairs, alone = (members[chosen[members[:, 0]]] for members in self.rows.list_rows(scenario.id))
        if len(pairs):
            yield self._make_table("Pairs", "Pair", ("Copy 0", "Copy 1"), pairs, scenario)
        if len(alone):
            title = "Trials without a twin" if len(pairs) else "Trials"
            yield self._make_table(title, "Trial", ("Answer",), alone, scenario)

    def _make_table(
        self,
        title: str,
        row_title: str,
        member_titles: tuple[str, ...],
        members: Integers,
        scenario: Scenario,
    ) -> TrialTable:
        has_twin = len(member_titles) > 1
        return TrialTable(
            key=f"{'pairs' if has_twin else 'trials'}-{scenario.id}",
            title=title,
            caption=count_of(len(members), row_title.lower()),
            row_title=row_title,
            member_titles=member_titles,
            count_titles=self._name_counts(len(member_titles)),
            rows=tuple(
                self._make_row(own, counts, scenario)
                for own, counts in zip(members.tolist(), self._count_right(members), strict=True)
            ),
        )

    def _name_counts(self, n_members: int) -> tuple[str, ...]:
        if not self.rows.n_ranked:
            return ()
        return COUNT_TITLES[n_members] + ((UNDECIDED,) if self.rows.has_halves else ())

    def _count_right(self, members: Integers) -> list[list[int]]:
        """Count the submissions that got all members of each row right, one fewer, ..., none, undecided."""
        credits = self.rows.credits[:, members]
        is_undecided = (credits == HALF_CREDIT).any(axis=2)
        n_right = np.where(is_undecided, -1, (credits == 1).sum(axis=2))
        kinds = [*range(members.shape[1], -1, -1), *([-1] if self.rows.has_halves else [])]
        counts: list[list[int]] = np.column_stack([(n_right == kind).sum(axis=0) for kind in kinds]).tolist()
        return counts

    def _make_row(self, members: list[int], counts: list[int], scenario: Scenario) -> TrialRow:
        return TrialRow(
            key=trial_anchor(self.reference.trial_ids[members[0]]),
            name=name_row(self.reference, members, scenario),
            members=tuple(self._make_cell(trial) for trial in members),
            counts=tuple(f"{count:,}" for count in counts) if self.rows.n_ranked else (),
        )

    def _make_cell(self, trial: int) -> TrialCell:
        people, label = self.reference.people, LABELS[self.reference.labels[trial]]
        n = int(people.n[trial]) if people else 0
        share = show_percent(people.n_yes[trial] / n) if people and n else ""
        return TrialCell(trial_path(self.reference.trial_ids[trial]), label, share, f"{n:,}" if n else "")


def name_row(reference: Reference, members: list[int], scenario: Scenario) -> str:
    """Name a pair, or a trial without a twin, within its scenario."""
    first = members[0]
    name = reference.pair_ids[reference.pairs[first]] if len(members) > 1 else reference.trial_ids[first]
    return name.removeprefix(f"{scenario.id}/")
