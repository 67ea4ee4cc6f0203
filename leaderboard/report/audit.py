"""Audited numbers as a terminal table and as JSON."""

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from itertools import groupby

from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from leaderboard.auditing import FLAGS, AuditedNumber, Rights
from leaderboard.files import canonical_json
from leaderboard.models import Score
from leaderboard.models.published import PublishedNumber
from leaderboard.report.terminal import ABSENT, Terminal, format_p, new_table, render_tables

WIDE = 125  # below it, all columns together would break flags apart
COLUMNS = ("system", "scope", "printed", "right of n", "95 %", "p", "mean of parts", "flags")
NARROW_COLUMNS = ("system", "scope", "printed", "right of n", "flags")
NOTES = (
    "right of n: the whole numbers that give the figure, in brackets its neighbours if none does; "
    "95 %: Wilson interval of such a share; p: exact, two-sided, against coin flips."
)


def render_audit(audited: Sequence[AuditedNumber], *, terminal: Terminal | None = None) -> str:
    """Tabulate published numbers by source and protocol, and count and explain the flags."""
    terminal = terminal or Terminal()
    columns = COLUMNS if terminal.width >= WIDE else NARROW_COLUMNS
    parts: list[RenderableType] = []
    for heading, group in groupby(audited, lambda each: _describe_group(each.number)):
        table = _new_table(columns)
        for each in group:
            cells = _cells(each)
            table.add_row(*(cells[column] for column in columns))
        parts += [Text(heading, "bold"), table]
    return render_tables([*parts, *_summary(audited), "", Text(NOTES, "dim")], terminal)


def render_audit_json(audited: Sequence[AuditedNumber]) -> str:
    """Render the same for programs: each row of the file with what was found, and how often each flag is set.

    Shares are in [0, 1]; what is unknown or does not apply is null.
    """
    return canonical_json(
        {"numbers": [_describe(each) for each in audited], "flags": dict(_count_flags(audited))}
    )


def _describe(each: AuditedNumber) -> dict[str, object]:
    return each.number.model_dump(mode="json") | {
        "value": _round(each.number.figure.value),
        "rights": _describe_rights(each.rights) if each.rights else None,
        "n_parts": each.n_parts,
        "mean_of_parts": None if each.mean is None else _round(each.mean),
        "flags": list(each.flags),
    }


def _describe_rights(rights: Rights) -> dict[str, object]:
    return {
        "fit": rights.fit,
        "counts": [rights.counts[0], rights.counts[-1]],
        "low": _round(rights.interval[0]),
        "high": _round(rights.interval[1]),
        "p": _round(rights.p) or float(f"{rights.p:.6g}"),
    }


def _round(value: float | Fraction) -> float:
    return round(float(value), 6)


def _count_flags(audited: Sequence[AuditedNumber]) -> list[tuple[str, int]]:
    counts = Counter(flag for each in audited for flag in each.flags)
    return [(flag, counts[flag]) for flag in FLAGS if counts[flag]]


def _describe_group(number: PublishedNumber) -> str:
    trials = None if number.training_trials is None else f"{number.training_trials:,} training trials"
    protocol = [number.training, number.testing, trials, number.auxiliary]
    known = ", ".join(part for part in protocol if part) or "protocol not known"
    return f"{number.source}: {known}" + (f" ({number.note})" if number.note else "")


def _new_table(columns: Sequence[str]) -> Table:
    table = new_table(columns)
    for column in table.columns:
        if column.header in ("scope", "flags"):
            column.justify = "left"
        if column.header == "flags":
            column.no_wrap = False
    return table


def _cells(each: AuditedNumber) -> dict[str, str]:
    number, rights = each.number, each.rights
    metric = "" if rights or number.metric == "accuracy" else f" ({number.metric})"
    return {
        "system": number.system,
        "scope": f"{number.scope}{metric}",
        "printed": number.printed,
        "right of n": _show_counts(rights, number) if rights else ABSENT,
        "95 %": f"{100 * rights.interval[0]:.1f}-{100 * rights.interval[1]:.1f}" if rights else ABSENT,
        "p": format_p(Score(value=rights.p) if rights else None),
        "mean of parts": ABSENT if each.mean is None else f"{float(100 * each.mean):.2f}",
        "flags": ", ".join(each.flags),
    }


def _show_counts(rights: Rights, number: PublishedNumber) -> str:
    first, last = rights.counts[0], rights.counts[-1]
    shown = str(first) if first == last else f"{first}-{last}"
    return f"{f'({shown})' if rights.fit == 'impossible' else shown} of {number.n_trials}"


def _summary(audited: Sequence[AuditedNumber]) -> list[RenderableType]:
    counts = _count_flags(audited)
    noun = "number" if len(audited) == 1 else "numbers"
    lines: list[RenderableType] = [f"{len(audited)} {noun}{':' if counts else ', none with a flag'}"]
    return lines + [f"{count:5} {flag}: {FLAGS[flag]}" for flag, count in counts]
