"""What a conversion made of a log, as text: what was left out and why, and what to look at."""

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

from leaderboard.converting.conversion import Conversion, MatchedAnswer, OmittedScenario, RepeatedTrial
from leaderboard.converting.log import Answer
from leaderboard.reference.cells import quote

MAX_EXAMPLES = 3


def render_conversion(conversion: Conversion) -> str:
    """Account for every row of a run: written, left out, or kept but odd.

    Each kind of oddity has its count, the scenarios where it occurs, and the lines of some examples.
    """
    n_written = len(conversion.scenarios)
    counts = f"{conversion.n_rows:,} rows give {len(conversion.predictions):,} predictions"
    coverage = f"{n_written} of the {n_written + len(conversion.omitted)} scenarios of {conversion.benchmark}"
    lines = [
        f"{conversion.name}: {counts}, for {coverage}",
        *_section("left out", [*_describe_left_out(conversion), *_describe_omitted(conversion.omitted)]),
        *_section("kept, but worth a look", _describe_kept(conversion)),
    ]
    return "\n".join(lines) + "\n"


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
        "rows whose numbers do not fit together",
        [match.answer for match in conversion.doubtful],
        [f"{m.trial_id}: {'; '.join(m.answer.doubts)}" for m in conversion.doubtful],
    )
    equal = [trial for trial in conversion.repeated if trial.is_consistent]
    lines += _describe_repeated("trials with several answers that are equal, used once", equal)
    if conversion.unknown_scenarios:
        names = ", ".join(conversion.unknown_scenarios)
        lines.append(
            f"scenarios that {conversion.benchmark} does not know, so that only trials count: {names}"
        )
    return lines


def _describe_contradiction(match: MatchedAnswer) -> str:
    log, label = ("YES", "NO") if match.answer.outcome else ("NO", "YES")
    return f"{_place(match.answer)}: {match.trial_id} is {log} in the log, its label is {label}"


def _describe_rows(what: str, answers: Sequence[Answer], remarks: Sequence[str]) -> list[str]:
    """Count one kind of row, say where it occurs, and show some; ``remarks`` has one for each answer."""
    if not answers:
        return []
    head = f"{what}: {len(answers):,} ({_tally(answer.scenario_name for answer in answers)})"
    shown = [f"{_place(answer)}: {remark}" for answer, remark in zip(answers, remarks, strict=True)]
    return [head, *_examples(shown)]


def _describe_repeated(what: str, trials: Sequence[RepeatedTrial]) -> list[str]:
    if not trials:
        return []
    shown = [f"{trial.trial_id}: {', '.join(map(_place, trial.answers))}" for trial in trials]
    return [f"{what}: {len(trials):,}", *_examples(shown)]


def _examples(texts: Sequence[str]) -> list[str]:
    lines = [f"  {text}" for text in texts[:MAX_EXAMPLES]]
    n_more = len(texts) - len(lines)
    return [*lines, f"  and {n_more:,} more"] if n_more else lines


def _place(answer: Answer) -> str:
    return f"{Path(answer.file).name}:{answer.line}"


def _tally(names: Iterable[str]) -> str:
    counts = sorted(Counter(names).items(), key=lambda count: (-count[1], count[0]))
    return ", ".join(f"{name} {n:,}" for name, n in counts)


def _section(title: str, lines: Sequence[str]) -> list[str]:
    return [f"  {title}:", *(f"    {line}" for line in lines)] if lines else []
