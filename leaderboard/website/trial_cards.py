"""The page of each trial: its answer, its twin, what people said, and every submission's probability."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import isnan

import numpy as np

from leaderboard.grading import subset_masks
from leaderboard.metrics.accuracy import Booleans, Floats
from leaderboard.metrics.published import wilson_interval
from leaderboard.ranking import Entry
from leaderboard.reference import Reference
from leaderboard.reference.data import Integers
from leaderboard.website.describing import (
    SUBSET_TITLES,
    count_of,
    describe_subset,
    property_path,
    scenario_path,
    submission_path,
)
from leaderboard.website.material import Material
from leaderboard.website.numbers import ABSENT, show_ends, show_exactly, show_number, show_percent
from leaderboard.website.pages import Fact, Link
from leaderboard.website.trial_pages import Answer, Said, TrialPage
from leaderboard.website.trial_paths import list_path, trial_anchor, trial_path
from leaderboard.website.trial_rows import HALF_CREDIT, TrialRows
from leaderboard.website.trial_tables import LABELS

MAX_ANSWERS = 50
"""A page with more submissions lists as many as this, half of them from either end."""

RIGHT, WRONG, UNDECIDED, NO_ANSWER = ("✓", "right"), ("✗", "wrong"), ("=", "at 0.5"), ("", "no answer")

PEOPLE = Link("People", "people.html")
UNJUDGED = Said(ABSENT, "", "", "nobody judged it")


def compose_trial_pages(material: Material) -> Iterator[TrialPage]:
    """Gather the pages of all trials."""
    composer = _Composer.of(material)
    return (composer.compose(trial) for trial in range(material.reference.n_trials))


def judge(credit: float) -> tuple[str, str]:
    """Say whether an answer is right, as a sign and in words.

    >>> judge(1.0), judge(0.0), judge(0.5)
    (('✓', 'right'), ('✗', 'wrong'), ('=', 'at 0.5'))
    """
    if credit == HALF_CREDIT:
        return UNDECIDED
    return RIGHT if credit else WRONG


@dataclass(frozen=True)
class _Composer:
    """Composes pages from what all of them share.

    Attributes
    ----------
    names
        Name and page of each submission.
    probabilities, credits : (n_trials, n_submissions)
        What each submission says of each trial, and what it earns with that.
    n_right : (n_trials,)
        Ranked submissions that are right.
    subsets
        Easy and hard as far as they are known: the rule, and which trials.
    """

    reference: Reference
    names: Sequence[Link]
    probabilities: Floats
    credits: Floats
    n_right: list[int]
    n_ranked: int
    scenarios: list[Link]
    twins: list[int]
    firsts: list[int]
    subsets: Sequence[tuple[str, Booleans]]

    @classmethod
    def of(cls, material: Material) -> "_Composer":
        """Compute what all pages share."""
        reference = material.reference
        entries = [publication.entry for publication in material.publications]
        shape = (len(entries), reference.n_trials)
        probabilities: Floats = np.array([e.probabilities for e in entries], float).reshape(shape).T
        credits: Floats = np.array([e.credits for e in entries], float).reshape(shape).T
        rows = TrialRows.of(material)
        masks = subset_masks(reference)
        return cls(
            reference=reference,
            names=tuple(_name_all(entries, material)),
            probabilities=probabilities,
            credits=credits,
            n_right=(rows.credits == 1).sum(axis=0).tolist(),
            n_ranked=rows.n_ranked,
            scenarios=list(_link_scenarios(reference)),
            twins=rows.twins.tolist(),
            firsts=rows.firsts.tolist(),
            subsets=[
                (f"{SUBSET_TITLES[name]}: {describe_subset(name, material)}", masks[name])
                for name in masks
                if name != "all"
            ],
        )

    def compose(self, trial: int) -> TrialPage:
        """Gather what the page of a trial shows."""
        reference, trial_id = self.reference, self.reference.trial_ids[trial]
        benchmark, twin = reference.benchmark, self.twins[trial]
        property_ = benchmark.properties[reference.properties[trial]]
        first = reference.trial_ids[self.firsts[trial]]
        n_answered = int((~np.isnan(self.probabilities[trial])).sum())
        return TrialPage(
            path=trial_path(trial_id),
            title=trial_id,
            summary=f"“{benchmark.question}” The answer is {LABELS[reference.labels[trial]]}.",
            row=Link(f"Trials: {property_.name}", f"{list_path(property_.name)}#{trial_anchor(first)}"),
            property=Link(property_.name, property_path(property_.name)),
            scenario=self.scenarios[reference.scenarios[trial]],
            facts=tuple(self._list_facts(trial)),
            twin=self._link_twin(twin) if twin >= 0 else None,
            people=tuple(self._answer_of_people(trial)),
            answers=tuple(self._list_answers(trial, self._choose(trial, n_answered))),
            note=self._describe_omitted(n_answered),
        )

    def _list_facts(self, trial: int) -> Iterator[Fact]:
        people = self.reference.people
        if people:
            yield Fact("People", self._describe_people(trial))
            rules = [rule for rule, mask in self.subsets if mask[trial]]
            yield Fact("Easy or hard", " ".join(rules) or "Neither.")
        if self.n_ranked:
            of_all = f"of {count_of(self.n_ranked, 'ranked submission')}"
            yield Fact("Answered rightly by", f"{self.n_right[trial]:,} {of_all}")

    def _describe_people(self, trial: int) -> str:
        n, n_yes = self._count_people(trial)
        if not n:
            return "Nobody judged it."
        low, high = wilson_interval(n_yes / n, n)
        interval = show_ends(show_percent(low), show_percent(high))
        return f"{n_yes:,} of {n:,} said YES: {show_percent(n_yes / n)} %, 95 % Wilson interval {interval} %"

    def _count_people(self, trial: int) -> tuple[int, int]:
        people = self.reference.people
        return (int(people.n[trial]), int(people.n_yes[trial])) if people else (0, 0)

    def _link_twin(self, twin: int) -> Link:
        n, n_yes = self._count_people(twin)
        words = f"Its answer is {LABELS[self.reference.labels[twin]]}"
        said = f"; {n_yes:,} of {n:,} people said YES." if n else "."
        trial_id = self.reference.trial_ids[twin]
        return Link(trial_id, trial_path(trial_id), words + said)

    def _answer_of_people(self, trial: int) -> Iterator[Answer]:
        if self._count_people(trial)[0]:
            row = (member for member in (trial, self.twins[trial]) if member >= 0)
            yield Answer(PEOPLE, tuple(self._said_by_people(member) for member in row))

    def _said_by_people(self, trial: int) -> Said:
        n, n_yes = self._count_people(trial)
        if not n:
            return UNJUDGED
        n_right = n_yes if self.reference.labels[trial] else n - n_yes
        return _print_said(n_yes / n, (1 + int(np.sign(2 * n_right - n))) / 2)

    def _list_answers(self, trial: int, chosen: Integers) -> Iterator[Answer]:
        row = [member for member in (trial, self.twins[trial]) if member >= 0]
        said = (self._list_said(member, chosen) for member in row)
        for index, *of_row in zip(chosen.tolist(), *said, strict=True):
            yield Answer(self.names[index], tuple(of_row))

    def _list_said(self, trial: int, chosen: Integers) -> Iterator[Said]:
        """Print what the chosen submissions say of a trial; of many, these are few of them."""
        given = self.probabilities[trial, chosen].tolist(), self.credits[trial, chosen].tolist()
        return (_print_said(*both) for both in zip(*given, strict=True))

    def _choose(self, trial: int, n_answered: int) -> Integers:
        """Choose the submissions to list: all, or of many that answered those at either end."""
        order = np.argsort(-self.probabilities[trial], kind="stable")  # without an answer last
        if order.size <= MAX_ANSWERS:
            return order
        answered, half = order[:n_answered], MAX_ANSWERS // 2
        return answered if n_answered <= MAX_ANSWERS else np.concatenate([answered[:half], answered[-half:]])

    def _describe_omitted(self, n_answered: int) -> str:
        n, half = len(self.names), MAX_ANSWERS // 2
        if n <= MAX_ANSWERS:
            return ""
        ends = (
            f", of which the {half} highest and the {half} lowest are listed"
            if n_answered > MAX_ANSWERS
            else ""
        )
        given = count_of(n_answered, "probability", "probabilities")
        return f"{n:,} submissions, {given}{ends}; all are in the submissions' files."


def _link_scenarios(reference: Reference) -> Iterator[Link]:
    """Link all scenarios; the only one of a property is the property, which is linked beside it."""
    benchmark = reference.benchmark
    for scenario in benchmark.scenarios:
        is_alone = len(benchmark.scenarios_of(scenario.property)) == 1
        yield Link(scenario.title, "" if is_alone else scenario_path(scenario.property, scenario.id))


def _name_all(entries: Sequence[Entry], material: Material) -> Iterator[Link]:
    """Name each submission; where several have one name, the board tells which is meant."""
    n_named = Counter(entry.metadata.submission.name for entry in entries)
    for entry in entries:
        name, standing = entry.metadata.submission.name, material.standings.get(entry.slug)
        below = standing[0].track.title if standing and n_named[name] > 1 else ""
        title = f"{name} (baseline)" if entry.is_baseline else name
        yield Link(title, submission_path(entry.slug), below)


@lru_cache(2**16)  # on the page of a trial and on that of its twin
def _print_said(probability: float, credit: float) -> Said:
    if isnan(probability):
        return Said(ABSENT, "", *NO_ANSWER)
    return Said(show_number(probability), show_exactly(probability), *judge(credit))
