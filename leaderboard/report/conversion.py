"""What a conversion made of a log, as text: what was left out and why, and what to look at."""

from collections import Counter
from collections.abc import Iterable, Sequence

from leaderboard.converting.conversion import Conversion, OmittedScenario, RepeatedTrial
from leaderboard.converting.log import Answer
from leaderboard.converting.matching import MatchedAnswer
from leaderboard.converting.traps import Traps
from leaderboard.ids import is_id
from leaderboard.problems import Problem
from leaderboard.reference.cells import quote
from leaderboard.report.problems import problems_data, render_problems

MAX_EXAMPLES = 3


def render_conversion(conversion: Conversion, problems: Sequence[Problem] = ()) -> str:
    """Account for every row of a run: written, left out, or kept but odd; then list signs of mistakes.

    Each kind of oddity has its count, the scenarios where it occurs, and the lines of some examples.
    ``problems`` are those of the predictions as validation finds them.
    """
    n_written = len(conversion.scenarios)
    counts = f"{conversion.n_rows:,} rows give {len(conversion.predictions):,} predictions"
    coverage = f"{n_written} of the {n_written + len(conversion.omitted)} scenarios of {conversion.benchmark}"
    lines = [
        f"{conversion.name}: {counts}, for {coverage}",
        *_section("left out", [*_describe_left_out(conversion), *_describe_omitted(conversion.omitted)]),
        *_section("kept, but worth a look", _describe_kept(conversion)),
        *_section("before you send it", _describe_traps(conversion.traps, conversion.reader)),
        *(f"  {line}" for line in render_problems(problems).splitlines()),
    ]
    return "\n".join(lines) + "\n"


def conversion_data(conversion: Conversion, problems: Sequence[Problem]) -> dict[str, object]:
    """Lay out the account for JSON: counts, the version of the reader, and what validation finds."""
    traps = conversion.traps
    unequal = [trial for trial in conversion.repeated if not trial.is_consistent]
    return {
        "run": conversion.name,
        "answer_reader": conversion.reader,
        "rows": conversion.n_rows,
        "predictions": len(conversion.predictions),
        "scenarios": list(conversion.scenarios),
        "left_out": {s.scenario: [s.n_answered, s.n_trials] for s in conversion.omitted},
        "rows_unmatched": len(conversion.unmatched),
        "rows_ambiguous": traps.n_ambiguous,
        "rows_misplaced": len(conversion.misplaced),
        "trials": traps.n_trials,
        "trials_matched": traps.n_matched,
        "trials_missing": traps.n_missing,
        "trials_duplicated": traps.n_duplicated,
        "trials_contradicted": len(unequal),
        "labels_contradicted": len(conversion.contradicting),
        "statuses": {status.value: count for status, count in traps.statuses},
        "yes": traps.n_yes,
        "ties": traps.n_ties,
        "pairs": traps.n_pairs,
        "pairs_alike": traps.n_alike,
        "repeats": {str(n_repeats): n_trials for n_repeats, n_trials in traps.repeats},
        "answers": traps.n_answers,
        "answers_unread": traps.n_unanswered,
        "validation": problems_data(problems),
    }


def _describe_traps(traps: Traps, reader: int | None) -> list[str]:
    """Count what gives mistakes away, whatever the numbers are."""
    trials = f"{traps.n_matched:,} of {traps.n_trials:,} matched, {traps.n_missing:,} missing"
    lines = [
        f"trials: {trials}, {traps.n_duplicated:,} duplicated; rows ambiguous: {traps.n_ambiguous:,}",
        f"statuses: {', '.join(f'{status.value} {n:,}' for status, n in traps.statuses) or 'none'}",
        f"YES: {_share(traps.n_yes, traps.n_answered)} of the answered trials"
        + (f", and exactly one half: {traps.n_ties:,}" if traps.n_ties else ""),
        f"pairs with the same answer to both members: {_share(traps.n_alike, traps.n_pairs)}",
    ]
    if any(n_repeats > 1 for n_repeats, _ in traps.repeats):
        asked = ", ".join(f"{n_trials:,} trials {n_repeats:,} times" for n_repeats, n_trials in traps.repeats)
        unread = f"{traps.n_unanswered:,} of {traps.n_answers:,} answers say neither YES nor NO"
        lines.append(f"repeats, of which the mean is written: {asked}; {unread}")
    if reader is not None:
        option = f"--answer-reader {reader}"
        lines.append(f"texts were read by version {reader} of the reader: submit with {option}")
    return lines


def _share(n_some: int, n_all: int) -> str:
    """Show a count as part of another.

    >>> _share(1, 8), _share(0, 0)
    ('1 of 8 (12.5 %)', 'none of 0')
    """
    return f"{n_some:,} of {n_all:,} ({100 * n_some / n_all:.1f} %)" if n_all else "none of 0"


def _describe_left_out(conversion: Conversion) -> list[str]:
    """Describe the rows that are not used."""
    unequal = [trial for trial in conversion.repeated if not trial.is_consistent]
    return [
        *_describe_rows(
            f"rows about trials that {conversion.benchmark} does not have",
            conversion.unmatched,
            [quote(answer.trial_name) for answer in conversion.unmatched],
        ),
        *_describe_rows(
            "rows whose name fits several trials",
            [ambiguous.answer for ambiguous in conversion.ambiguous],
            [f"{quote(a.answer.trial_name)} fits {' and '.join(a.trial_ids)}" for a in conversion.ambiguous],
        ),
        *_describe_rows(
            f"rows with their trial in another scenario than {conversion.benchmark} has it in",
            [match.answer for match in conversion.misplaced],
            [f"{m.trial_id} belongs to {m.scenario}" for m in conversion.misplaced],
        ),
        *_describe_repeated("trials with several answers that differ, none of which is used", unequal),
    ]


def _describe_omitted(omitted: Sequence[OmittedScenario]) -> list[str]:
    if not omitted:
        return []
    return [
        f"scenarios that the run does not cover, since they are given whole or not at all: {len(omitted)}",
        *(f"  {s.scenario}: {s.n_answered:,} of {s.n_trials:,} trials are answered" for s in omitted),
    ]


def _describe_kept(conversion: Conversion) -> list[str]:
    """Describe what is used although something about it is odd."""
    contradicting = conversion.contradicting
    lines = []
    if contradicting:
        share = f"{len(contradicting):,} of {len(conversion.predictions):,}"
        tally = _tally(match.scenario for match in contradicting)
        lines.append(f"trials that end differently in the log than by their label: {share} ({tally})")
        lines += _examples([_describe_contradiction(match) for match in contradicting])
    lines += _describe_rows(
        "rows that do not agree with themselves",
        [match.answer for match in conversion.doubtful],
        [f"{m.trial_id}: {'; '.join(m.answer.doubts)}" for m in conversion.doubtful],
    )
    equal = [trial for trial in conversion.repeated if trial.is_consistent]
    lines += _describe_repeated("trials with several answers that are equal, used once", equal)
    if conversion.unknown_scenarios:
        names = ", ".join(map(_show_name, conversion.unknown_scenarios))
        lines.append(
            f"scenarios that {conversion.benchmark} does not know, so that only trials count: {names}"
        )
    return lines


def _describe_contradiction(match: MatchedAnswer) -> str:
    log, label = ("YES", "NO") if match.answer.outcome else ("NO", "YES")
    return f"{match.answer.place}: {match.trial_id} is {log} in the log, its label is {label}"


def _describe_rows(what: str, answers: Sequence[Answer], remarks: Sequence[str]) -> list[str]:
    """Count one kind of row, say where it occurs, and show some; ``remarks`` has one for each answer."""
    if not answers:
        return []
    tally = _tally(answer.scenario_name for answer in answers if answer.scenario_name)
    head = f"{what}: {len(answers):,}{f' ({tally})' if tally else ''}"
    shown = [f"{answer.place}: {remark}" for answer, remark in zip(answers, remarks, strict=True)]
    return [head, *_examples(shown)]


def _describe_repeated(what: str, trials: Sequence[RepeatedTrial]) -> list[str]:
    if not trials:
        return []
    shown = [f"{trial.trial_id}: {', '.join(answer.place for answer in trial.answers)}" for trial in trials]
    return [f"{what}: {len(trials):,}", *_examples(shown)]


def _examples(texts: Sequence[str]) -> list[str]:
    lines = [f"  {text}" for text in texts[:MAX_EXAMPLES]]
    n_more = len(texts) - len(lines)
    return [*lines, f"  and {n_more:,} more"] if n_more else lines


def _tally(names: Iterable[str]) -> str:
    counts = sorted(Counter(names).items(), key=lambda count: (-count[1], count[0]))
    return ", ".join(f"{_show_name(name)} {n:,}" for name, n in counts)


def _show_name(name: str) -> str:
    r"""Show a scenario as a log names it: as it stands, or escaped if it is no name that this project takes.

    >>> print(_show_name("ramp"), _show_name("ramp\x1b[31m"))
    ramp 'ramp\x1b[31m'
    """
    return name if is_id(name) else quote(name)


def _section(title: str, lines: Sequence[str]) -> list[str]:
    return [f"  {title}:", *(f"    {line}" for line in lines)] if lines else []
