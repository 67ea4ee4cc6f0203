"""Many files' answers and counts as one: nobody counts twice, and single answers go before counts."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from leaderboard.problems import Problems
from leaderboard.reference.judgements.counted import Count
from leaderboard.reference.judgements.data import Rating, Response
from leaderboard.reference.judgements.participants import rename_participants
from leaderboard.reference.judgements.reporting import list_trials
from leaderboard.reference.judgements.sifting import Answer


@dataclass(frozen=True)
class Merged:
    """Answers of which each is some person's only one to its trial, and how many further ones there were."""

    answers: tuple[Answer, ...]
    n_repeated: int
    n_changed: int


def merge_answers(answers: Iterable[Answer], problems: Problems) -> Merged:
    """Let everybody answer a trial once: the first answer counts, in the order of files and lines.

    The first is the one given without having seen the trial before.
    """
    first: dict[tuple[str | None, str], Answer] = {}
    repeated: list[Answer] = []
    changed: list[Answer] = []
    for answer in answers:
        earlier = first.setdefault((answer.person, answer.trial_id), answer)
        if earlier is not answer:
            (repeated if earlier.is_yes == answer.is_yes else changed).append(answer)
    for found, code, what in (
        (
            repeated,
            "import-same-answer",
            "repeat an earlier one of the same person to the same trial, and count once",
        ),
        (
            changed,
            "import-changed-answer",
            "differ from an earlier one of the same person to the same trial, which counts",
        ),
    ):
        if found:
            problems.add(code, f"answers that {what}: {len(found):,}", found[0].file, line=found[0].line)
    return Merged(tuple(first.values()), len(repeated), len(changed))


def merge_counts(counts: Iterable[Count], problems: Problems) -> dict[str, Count]:
    """Take each trial's counts once; two that differ are refused, because they may be of the same people."""
    merged: dict[str, Count] = {}
    differing: dict[str, Count] = {}
    for count in counts:
        if merged.setdefault(count.trial_id, count).rating != count.rating:
            differing.setdefault(count.trial_id, count)
    if differing:
        later = next(iter(differing.values()))
        earlier = merged[later.trial_id]
        message = (
            f"{later.rating.n_yes} of {later.rating.n} people said YES to {later.trial_id}, and "
            f"{earlier.rating.n_yes} of {earlier.rating.n} in {earlier.file}:{earlier.line}; "
            f"trials with such different counts: {len(differing):,}"
        )
        hint = "leave out one of the two, or add them up if they are of different people"
        problems.add("import-two-counts", message, later.file, line=later.line, hint=hint)
    return merged


def count_anonymous(answers: Iterable[Answer]) -> list[Count]:
    """Count the answers of each file that does not say who answered."""
    found: dict[tuple[str, str], list[Answer]] = {}
    for answer in answers:
        found.setdefault((answer.file, answer.trial_id), []).append(answer)
    return [Count(file, own[0].line, trial_id, _rate(own)) for (file, trial_id), own in found.items()]


def rate_answers(answers: Iterable[Answer]) -> dict[str, Rating]:
    """Count the answers to each trial."""
    by_trial: dict[str, list[Answer]] = {}
    for answer in answers:
        by_trial.setdefault(answer.trial_id, []).append(answer)
    return {trial_id: _rate(own) for trial_id, own in by_trial.items()}


def combine_ratings(
    rated: Mapping[str, Rating], counts: Mapping[str, Count], problems: Problems
) -> tuple[dict[str, Rating], bool]:
    """Put counts beside those of single answers, which go before them.

    Returns
    -------
    tuple
        Counts of all judged trials, and whether single answers are behind all of them.
    """
    differing = [
        count for trial_id, count in counts.items() if rated.get(trial_id, count.rating) != count.rating
    ]
    if differing:
        shown = list_trials([count.trial_id for count in differing])
        message = (
            "gives other counts than single answers, which are taken, "
            f"for {len(differing):,} of {len(counts):,} trials: {shown}"
        )
        problems.add("import-counts-differ", message, differing[0].file, line=differing[0].line)
    added = {trial_id: count for trial_id, count in counts.items() if trial_id not in rated}
    if added and rated:
        message = (
            f"of {len(added) + len(rated):,} judged trials, {len(rated):,} have single answers; a reference "
            "has these for all judged trials or for none, so only counts are kept"
        )
        first = next(iter(added.values()))
        problems.add("import-only-counts", message, first.file, line=first.line)
    return {**rated, **{trial_id: count.rating for trial_id, count in added.items()}}, not added


def make_responses(answers: Sequence[Answer], trial_ids: Iterable[str]) -> tuple[Response, ...]:
    """Give participants opaque ids and sort their answers by the order of answering, otherwise by trial."""
    names = rename_participants(answer.person for answer in answers if answer.person is not None)
    order = {trial_id: place for place, trial_id in enumerate(trial_ids)}
    files = {file: place for place, file in enumerate(dict.fromkeys(answer.file for answer in answers))}
    responses = [
        (names[answer.person], files[answer.file], answer.place, order[answer.trial_id], answer)
        for answer in answers
        if answer.person is not None
    ]
    return tuple(
        Response(participant_id, answer.trial_id, answer.is_yes)
        for participant_id, *_, answer in sorted(responses, key=lambda found: found[:-1])
    )


def report_numbers(answers: Iterable[Answer], problems: Problems) -> None:
    """Warn where people are numbered in several files: person 1 may be somebody else in each."""
    files: dict[str, set[str]] = {}
    for answer in answers:
        if answer.person is not None and answer.person.isdigit():
            files.setdefault(answer.person, set()).add(answer.file)
    shared = [names for names in files.values() if len(names) > 1]
    if shared:
        named = sorted(set[str]().union(*shared))
        message = (
            "participants with the same plain number in several files, each of whom counts as one: "
            f"{len(shared):,}"
        )
        hint = (
            "if the files number different people, make the numbers distinct, such as mass-1 and friction-1"
        )
        problems.add("import-participant-numbers", message, named[0], hint=hint)


def _rate(answers: Sequence[Answer]) -> Rating:
    return Rating(len(answers), sum(answer.is_yes for answer in answers))
