"""From files of unknown layout to responses and counts, with an account of every row."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from leaderboard.problems import Problems
from leaderboard.reference.judgements.columns import check_named, take_named
from leaderboard.reference.judgements.counted import Count, parse_counts
from leaderboard.reference.judgements.data import Account, FileAccount, JudgementOptions, Judgements
from leaderboard.reference.judgements.layouts import Layout, Shape, recognise_layout
from leaderboard.reference.judgements.matching import TrialMatcher
from leaderboard.reference.judgements.merging import (
    combine_ratings,
    count_anonymous,
    make_responses,
    merge_answers,
    merge_counts,
    rate_answers,
    report_numbers,
)
from leaderboard.reference.judgements.reporting import FileReport
from leaderboard.reference.judgements.sifting import Answer
from leaderboard.reference.judgements.single import find_secrets, parse_answers
from leaderboard.reference.source_files import SourceFile
from leaderboard.reference.source_tables import SourceTable, parse_source_table

_SHADOW = "._"  # what macOS adds to archives beside each file


@dataclass
class _Gathered:
    """What all files hold."""

    answers: list[Answer] = field(default_factory=list)
    counts: list[Count] = field(default_factory=list)
    files: list[FileAccount] = field(default_factory=list)
    others: list[str] = field(default_factory=list)


def parse_judgements(
    files: Sequence[SourceFile], trials: Mapping[str, bool], options: JudgementOptions, problems: Problems
) -> Judgements | None:
    """Understand files of human data, whatever their layout.

    Parameters
    ----------
    files
        Among them those with human data; others are passed over with a note.
    trials
        The label of every trial of the reference, True for YES, by id in the reference's order.
    options
        How to read what the files leave open.
    problems
        Receives every finding. None of them holds anything that identifies a person.

    Returns
    -------
    Judgements or None
        None, and a problem that is an error, if there are no human data that can be used, or if some of them
        must not be used as they are.

    Raises
    ------
    SourceError
        If a file is not a regular CSV file.
    """
    found = Problems()
    tables = _parse_tables(files, found)
    check_named(tables, options.columns, found)
    gathered = _Gathered()
    if not found.has_errors:
        matcher = TrialMatcher(trials)
        for table in tables:
            _gather(table, matcher, options, gathered, found)
    judgements = None if found.has_errors else _merge(gathered, trials, found)
    problems.found += found
    return judgements


def _parse_tables(files: Sequence[SourceFile], problems: Problems) -> list[SourceTable]:
    """Parse each file once, by name: the order in which they arrive must not decide which answer is first."""
    tables: dict[str, SourceTable] = {}
    for file in sorted(files, key=lambda file: (file.name, file.origin)):
        if file.name.rpartition("/")[2].startswith(_SHADOW):
            continue
        if file.sha256 in tables:
            message = f"is the same file as {tables[file.sha256].file}, and counts once"
            problems.add("import-same-file", message, file.origin)
        else:
            tables[file.sha256] = parse_source_table(file)
    return list(tables.values())


def _gather(
    table: SourceTable,
    matcher: TrialMatcher,
    options: JudgementOptions,
    gathered: _Gathered,
    problems: Problems,
) -> None:
    named = take_named(table.header, options.columns)
    layout = recognise_layout(table, matcher, named)
    if not isinstance(layout, Layout):
        problems.add("import-other-file", f"is taken to hold no human data: {layout}", table.file)
        gathered.others.append(table.file)
        return
    problems.add("import-layout", f"is read as {layout.describe(table.header)}", table.file)
    report = FileReport(
        table.file,
        "rows" if layout.shape is Shape.COUNTS else "answers",
        matcher,
        find_secrets(table, layout),
        options.allow_unmatched,
        problems,
    )
    if layout.shape is Shape.COUNTS:
        counts, account = parse_counts(table, layout, report)
        gathered.counts += counts
    else:
        answers, account = parse_answers(table, layout, report, is_named="response" in named)
        gathered.answers += answers
    gathered.files.append(account)


def _merge(gathered: _Gathered, trials: Mapping[str, bool], problems: Problems) -> Judgements | None:
    merged = merge_answers((a for a in gathered.answers if a.person is not None), problems)
    report_numbers(merged.answers, problems)
    anonymous = [answer for answer in gathered.answers if answer.person is None]
    _report_anonymous(anonymous, problems)
    counts = merge_counts([*gathered.counts, *count_anonymous(anonymous)], problems)
    ratings, has_all = combine_ratings(rate_answers(merged.answers), counts, problems)
    if not ratings:
        _report_nothing(gathered, problems)
    if problems.has_errors:
        return None
    responses = make_responses(merged.answers, trials) if has_all else None
    n_participants = len({response.participant_id for response in responses or ()})
    return Judgements(
        responses=responses,
        ratings={trial_id: ratings[trial_id] for trial_id in trials if trial_id in ratings},
        account=Account(
            tuple(gathered.files), tuple(gathered.others), merged.n_repeated, merged.n_changed, n_participants
        ),
    )


def _report_anonymous(answers: Iterable[Answer], problems: Problems) -> None:
    lines: dict[str, list[int]] = {}
    for answer in answers:
        lines.setdefault(answer.file, []).append(answer.line)
    for file, own in lines.items():
        message = f"does not say who gave its {len(own):,} answers, so only counts are kept"
        hint = "--columns participant=... names the column that does"
        problems.add("import-only-counts", message, file, hint=hint)


def _report_nothing(gathered: _Gathered, problems: Problems) -> None:
    n_files = len(gathered.files) + len(gathered.others)
    message = f"none of {n_files:,} files holds answers or counts that can be used"
    hint = "--columns participant=...,trial=...,response=... names the columns that hold them"
    problems.add("import-no-judgements", message, "human data", hint=hint)
