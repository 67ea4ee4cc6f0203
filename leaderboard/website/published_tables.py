"""The page of published numbers: as printed, with what an audit finds, never among graded rows."""

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import groupby

from leaderboard.auditing import FLAGS, AuditedNumber, audit
from leaderboard.models.published import ACCURACY, PublishedNumber
from leaderboard.website.describing import count_of
from leaderboard.website.material import Material
from leaderboard.website.numbers import EN_DASH, show_percent
from leaderboard.website.pages import Fact
from leaderboard.website.published_pages import (
    PublishedCell,
    PublishedPage,
    PublishedRow,
    PublishedSource,
    PublishedTable,
)

PROTOCOL_WORDS = {
    "separate": "one model for each property",
    "unified": "one model for all properties",
    "zero_shot": "not trained on the benchmark",
    "with_property": "standard video",
    "without_property": "video without the part that shows the property",
    "fully_observed": "video with the outcome",
    "implicit": "property inferred implicitly",
    "explicit": "property inferred explicitly",
}

_Protocol = tuple[str, ...]


def compose_published(material: Material) -> PublishedPage:
    """Gather what the page of published numbers shows."""
    audited = audit(material.published)
    counts = Counter(flag for each in audited for flag in each.flags)
    by_source = groupby(audited, lambda each: (each.number.source, str(each.number.url or "")))
    return PublishedPage(
        path="published.html",
        title="Published numbers",
        summary=(
            "Figures of papers, exactly as printed. Nobody published the predictions behind them, so they "
            "cannot be graded again and never stand among graded rows."
        ),
        sources=tuple(
            PublishedSource(source, target, tuple(_make_tables(list(own), number)))
            for number, ((source, target), own) in enumerate(by_source, 1)
        ),
        flags=tuple(
            Fact(flag, f"{count_of(counts[flag], 'figure')}: {meaning}.")
            for flag, meaning in FLAGS.items()
            if counts[flag]
        ),
    )


def _make_tables(audited: Sequence[AuditedNumber], source: int) -> Iterable[PublishedTable]:
    for number, (protocol, found) in enumerate(groupby(audited, lambda each: _protocol_of(each.number)), 1):
        own = list(found)
        columns = tuple(dict.fromkeys(_column_of(each.number) for each in own))
        systems = dict.fromkeys(each.number.system for each in own)
        cells = {(each.number.system, _column_of(each.number)): _make_cell(each) for each in own}
        yield PublishedTable(
            key=f"published-{source}-{number}",
            title=_capitalize(", ".join(protocol[:-1]) or "protocol not known"),
            note=protocol[-1],
            columns=columns,
            rows=tuple(
                PublishedRow(system, tuple(cells.get((system, c), PublishedCell()) for c in columns))
                for system in systems
            ),
        )


def _protocol_of(number: PublishedNumber) -> _Protocol:
    """Describe how systems were trained and tested, in words, and last what the source adds."""
    keys = (number.training, number.testing, number.auxiliary)
    words = [PROTOCOL_WORDS[key] for key in keys if key]
    if number.training_trials is not None:
        words.append(count_of(number.training_trials, "training trial"))
    return (*words, number.note)


def _capitalize(text: str) -> str:
    return text[:1].upper() + text[1:]


def _column_of(number: PublishedNumber) -> str:
    return number.scope if number.metric == ACCURACY else f"{number.scope}, {number.metric}"


def _make_cell(each: AuditedNumber) -> PublishedCell:
    details = []
    if each.rights is not None:
        low, high = each.rights.interval
        details.append(f"{show_percent(low)}{EN_DASH}{show_percent(high)}")
    if each.mean is not None:
        details.append(f"mean of parts {100 * float(each.mean):.2f}")
    return PublishedCell(each.number.printed, tuple(details), each.flags)
