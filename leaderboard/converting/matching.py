"""Which trials the answers of a run are about."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from leaderboard.converting.log import Answer, Run
from leaderboard.reference import Reference
from leaderboard.trial_names import Ambiguous, Resolution, Resolved, TrialNames


@dataclass(frozen=True)
class MatchedAnswer:
    """An answer, the trial that it is about, and that trial's scenario."""

    answer: Answer
    trial_id: str
    scenario: str


@dataclass(frozen=True)
class AmbiguousAnswer:
    """An answer whose name fits several trials."""

    answer: Answer
    trial_ids: tuple[str, ...]


@dataclass
class Matches:
    """Answers sorted by what their names mean.

    ``misplaced`` are those that the log has in another scenario than the reference.
    """

    matched: dict[str, list[MatchedAnswer]] = field(default_factory=dict)
    unmatched: list[Answer] = field(default_factory=list)
    ambiguous: list[AmbiguousAnswer] = field(default_factory=list)
    misplaced: list[MatchedAnswer] = field(default_factory=list)


def list_scenario_names(reference: Reference) -> dict[str, set[str]]:
    """Map ids, property names and aliases to the scenarios that they can mean."""
    scenarios: dict[str, set[str]] = {}
    for p in reference.benchmark.properties:
        own = {scenario.id for scenario in reference.benchmark.scenarios_of(p.name)}
        scenarios.update({scenario: {scenario} for scenario in own})
        for name in (p.name, *p.aliases):
            scenarios.setdefault(name, set()).update(own)
    return scenarios


def match_answers(run: Run, reference: Reference, scenarios_by_name: Mapping[str, set[str]]) -> Matches:
    """Sort a run's answers by the trials that their names mean, if they mean exactly one."""
    names = TrialNames(reference.trial_ids)
    known: dict[str, Resolution] = {}  # repeats of a trial are looked up once
    matches = Matches()
    for answer in run.answers:
        found = known.get(answer.trial_name)
        if found is None:
            found = known[answer.trial_name] = names.resolve(answer.trial_name)
        if isinstance(found, Ambiguous):
            matches.ambiguous.append(AmbiguousAnswer(answer, found.trial_ids))
        elif isinstance(found, Resolved):
            match = MatchedAnswer(answer, found.trial_id, _scenario_of(found.trial_id, reference))
            if match.scenario in scenarios_by_name.get(answer.scenario_name, {match.scenario}):
                matches.matched.setdefault(found.trial_id, []).append(match)
            else:
                matches.misplaced.append(match)
        else:
            matches.unmatched.append(answer)
    return matches


def _scenario_of(trial_id: str, reference: Reference) -> str:
    index = int(reference.scenarios[reference.trial_index[trial_id]])
    return reference.benchmark.scenarios[index].id
