"""Files of counts: how many people judged each trial, and how many of them said YES or were right."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum, auto
from fractions import Fraction

from leaderboard.reference.judgements.answers import (
    count_decimals,
    is_empty,
    parse_answer,
    parse_count,
    parse_share,
)
from leaderboard.reference.judgements.data import FileAccount, Rating
from leaderboard.reference.judgements.layouts import Layout
from leaderboard.reference.judgements.matching import TrialMatcher
from leaderboard.reference.judgements.practice import PracticeMarks, is_practice
from leaderboard.reference.judgements.reporting import FileReport
from leaderboard.reference.source_tables import SourceTable
from leaderboard.trial_names import Ambiguous

# A share with 16 digits times the number of people is this close to a whole number.
TOLERANCE = Fraction(1, 1_000_000)


@dataclass(frozen=True)
class Count:
    """The counts of one trial, and where they are."""

    file: str
    line: int
    trial_id: str
    rating: Rating


class _Fate(Enum):
    PRACTICE = auto()
    EMPTY = auto()
    UNMATCHED = auto()
    AMBIGUOUS = auto()
    USED = auto()


@dataclass(frozen=True)
class _RawCount:
    """One row: its cells, and the label that the file gives the trial, None if none."""

    line: int
    name: str
    n: str
    hits: str
    label: bool | None
    is_practice: bool


def parse_counts(table: SourceTable, layout: Layout, report: FileReport) -> tuple[list[Count], FileAccount]:
    """Understand the counts of a file; ``report`` receives every finding."""
    role = layout.hits
    piles: dict[_Fate, list[_RawCount]] = {fate: [] for fate in _Fate}
    for raw in _read_rows(table, layout):
        piles[_decide(raw, report.matcher)].append(raw)
    used = piles[_Fate.USED]
    n_named = len(table.rows) - len(piles[_Fate.PRACTICE]) - len(piles[_Fate.EMPTY])
    report.report_left_out("import-practice", piles[_Fate.PRACTICE], "about practice trials")
    report.report_left_out("import-non-answer", piles[_Fate.EMPTY], "that are empty or about no trial")
    report.report_matches(n_named, piles[_Fate.UNMATCHED], piles[_Fate.AMBIGUOUS])
    _report_labels(used, report, matters=role == "correct")
    is_sound = all(_has_numbers(raw, role) for raw in used)
    counts = _count_people(used, role, report) if is_sound else []
    if not is_sound:
        _report_values(used, role, report)
    return counts, FileAccount(
        file=table.file,
        layout=layout.shape.value,
        n_rows=len(table.rows),
        n_practice=len(piles[_Fate.PRACTICE]),
        n_empty=len(piles[_Fate.EMPTY]),
        n_unmatched=len(piles[_Fate.UNMATCHED]),
        n_ambiguous=len(piles[_Fate.AMBIGUOUS]),
        n_unclear=len(used) - len(counts),
        n_used=len(counts),
    )


def _read_rows(table: SourceTable, layout: Layout) -> list[_RawCount]:
    marks, label = PracticeMarks(table.header), layout.columns.get("label")
    return [
        _RawCount(
            row.line,
            row[layout.columns["trial"]].strip(),
            row[layout.columns["count"]],
            row[layout.columns[layout.hits]],
            None if label is None else parse_answer(row[label]),
            marks.are_on(row),
        )
        for row in table.rows
    ]


def _decide(raw: _RawCount, matcher: TrialMatcher) -> _Fate:
    if raw.is_practice or is_practice(raw.name, matcher):
        return _Fate.PRACTICE
    if is_empty(raw.name) or is_empty(raw.n) or is_empty(raw.hits) or parse_count(raw.n) == 0:
        return _Fate.EMPTY
    if matcher.find(raw.name) is not None:
        return _Fate.USED
    return _Fate.AMBIGUOUS if isinstance(matcher.resolve(raw.name), Ambiguous) else _Fate.UNMATCHED


def _report_labels(used: Sequence[_RawCount], report: FileReport, *, matters: bool) -> None:
    told = [
        (trial_id, raw.line, raw.label)
        for raw in used
        if raw.label is not None and (trial_id := report.matcher.find(raw.name)) is not None
    ]
    report.report_labels(told, matters=matters)


def _has_numbers(raw: _RawCount, role: str) -> bool:
    if role == "n_yes":
        n, n_yes = parse_count(raw.n), parse_count(raw.hits)
        return n is not None and n_yes is not None and n_yes <= n
    return parse_count(raw.n) is not None and parse_share(raw.hits) is not None


def _report_values(used: Sequence[_RawCount], role: str, report: FileReport) -> None:
    found = [raw for raw in used if not _has_numbers(raw, role)]
    rule = "a whole number of at most that" if role == "n_yes" else "a share from 0 to 1"
    message = f"{len(found):,} of {len(used):,} rows do not have a whole number as count and {rule} as {role}"
    report.problems.add("import-people-value", message, report.file, line=found[0].line)


def _count_people(used: Sequence[_RawCount], role: str, report: FileReport) -> list[Count]:
    """Recover numbers of people; rows whose numbers are of no whole number of people are left out."""
    shares = [] if role == "n_yes" else [(raw.hits, int(parse_count(raw.n) or 0)) for raw in used]
    half_unit = _find_half_unit(shares)
    counts: list[Count] = []
    impossible: list[_RawCount] = []
    for raw in used:
        n, trial_id = int(parse_count(raw.n) or 0), report.matcher.find(raw.name)
        n_hits = parse_count(raw.hits) if role == "n_yes" else _find_whole(raw.hits, n, half_unit)
        if trial_id is None or n_hits is None:
            impossible.append(raw)
            continue
        label = report.matcher.labels[trial_id] if raw.label is None else raw.label
        n_yes = n_hits if role != "correct" or label else n - n_hits
        counts.append(Count(report.file, raw.line, trial_id, Rating(n, n_yes)))
    report.report_left_out("import-count", impossible, "whose share is that of no whole number of people")
    return counts


def _find_half_unit(shares: Sequence[tuple[str, int]]) -> Fraction:
    """Return how far rounding may have moved the shares of a column: not at all if all give whole numbers."""
    products = [Fraction(text.strip()) * n for text, n in shares]
    if all(abs(product - round(product)) <= TOLERANCE for product in products):
        return Fraction(0)
    return Fraction(1, 2 * 10 ** max(count_decimals(text) for text, _ in shares))


def _find_whole(text: str, n: int, half_unit: Fraction) -> int | None:
    """Find the one number of people that is printed as this share; None if there are none or several."""
    reach = max(TOLERANCE, half_unit * n)
    product = Fraction(text.strip()) * n
    first, last = max(0, math.ceil(product - reach)), min(n, math.floor(product + reach))
    return first if first == last else None
